// What a DomainMesher is made of: a mesher, a follower of its domain, and what both do not know of
// the input. The follower has its say on a change while the mesher can still take it back.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "facade/busy.hpp"
#include "facade/edited_table.hpp"
#include "facade/followed.hpp"
#include "facade/unlimited_mesh.hpp"
#include "mesher/domain_mesher.hpp"

namespace mesher::detail {

class DomainState {
 public:
  using Markers = EditedTable<FeatureId, std::int64_t>;

  DomainState(const Options<2>& options, Extent extent, RegionAreas areas)
      : mesher_(options), extent_(extent), areas_(areas) {}

  // Edits are refused while an update runs, whichever of the meshers it is at.
  void insert(FeatureId id, const Point<2>& point, std::int64_t marker);
  void remove(FeatureId id);
  void move(FeatureId id, const Point<2>& point);
  void insert_line(FeatureId id, const std::vector<FeatureId>& points, std::int64_t marker);
  void remove_line(FeatureId id);
  void insert_seed(const Seed& seed);
  void remove_seed(const SeedName& name);
  void limit(const SizeLimits<2>& limits);
  void limit(const Box<2>& box, const SizeLimits<2>& limits);
  void discard_edits() noexcept;
  [[nodiscard]] bool is_idle() const noexcept { return busy_.is_idle(); }
  DomainUpdate update(const RunControl& control);

  [[nodiscard]] Pslg input() const;
  [[nodiscard]] bool contains_seed(const SeedName& name) const {
    return seeds_.find(name) != nullptr;
  }
  [[nodiscard]] const Mesher<2>& mesher() const noexcept { return mesher_; }
  [[nodiscard]] Extent extent() const noexcept { return extent_; }
  /// Nobody as long as there are points alone.
  [[nodiscard]] const std::optional<DomainFollower>& follower() const noexcept { return follower_; }

  /// Nobody as long as it does not matter to limits of size what lines enclose.
  [[nodiscard]] const UnlimitedMesh* unlimited() const noexcept { return unlimited_.get(); }

 private:
  void prepare();
  void commit() noexcept;
  [[nodiscard]] bool needs_unlimited() const;
  void make_unlimited(const RunControl& control);
  [[nodiscard]] DomainUpdate run(const RunControl& control);
  [[nodiscard]] DomainChange begin(const Change<2>& change);
  [[nodiscard]] DomainChange follow(const Change<2>& change);

  Mesher<2> mesher_;
  Extent extent_;
  RegionAreas areas_;
  Markers point_markers_, line_markers_;
  EditedSeeds seeds_;
  std::optional<DomainFollower> follower_;    // from the first line or seed on
  std::unique_ptr<UnlimitedMesh> unlimited_;  // from the first limits on that it matters to
  Busy busy_;
  bool needs_follower_ = false;  // there are edits to follow
  bool ran_ = false;
};

}  // namespace mesher::detail
