// What a DomainMesher is made of: a mesher, a follower of its domain, and what both do not know of
// the input. The follower has its say on a change while the mesher can still take it back.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "facade/busy.hpp"
#include "facade/edited_table.hpp"
#include "facade/followed.hpp"
#include "facade/unlimited_mesh.hpp"
#include "mesher/domain_mesher.hpp"

namespace mesher::detail {

template <int D>
class DomainState {
 public:
  using Markers = EditedTable<FeatureId, std::int64_t>;

  /// Throws: Error(bad_option).
  DomainState(const Options<D>& options, Extent extent, RegionAreas areas);

  // Edits are refused while an update runs, whichever of the meshers it is at.
  void insert(FeatureId id, const Point<D>& point, std::int64_t marker);
  void remove(FeatureId id);
  void move(FeatureId id, const Point<D>& point);
  void insert_line(FeatureId id, const std::vector<FeatureId>& points, std::int64_t marker);
  void remove_line(FeatureId id);
  void insert_polygon(const mesher::Polygon& polygon, std::int64_t marker);
  void remove_polygon(FeatureId id);
  void insert_seed(const SeedOf<D>& seed);
  void remove_seed(const SeedName& name);
  void limit(const SizeLimits<D>& limits);
  void limit(const Box<D>& box, const SizeLimits<D>& limits);
  void keep_slots(bool keep);
  void discard_edits() noexcept;
  [[nodiscard]] bool is_idle() const noexcept { return busy_.is_idle(); }
  DomainUpdateOf<D> update(const RunControl& control);

  [[nodiscard]] GraphOf<D> input() const;
  [[nodiscard]] bool contains_seed(const SeedName& name) const {
    return seeds_.find(name) != nullptr;
  }
  /// Requires: the slot of a simplex.
  [[nodiscard]] typename DomainChangeOf<D>::Corners corners(Slot simplex) const;
  [[nodiscard]] const Mesher<D>& mesher() const noexcept { return mesher_; }
  [[nodiscard]] Extent extent() const noexcept { return extent_; }
  /// Nobody as long as there are points alone.
  [[nodiscard]] const std::optional<DomainFollowerOf<D>>& follower() const noexcept {
    return follower_;
  }

  /// Nobody as long as it does not matter to limits of size what lines, or polygons, enclose.
  [[nodiscard]] const UnlimitedMesh<D>* unlimited() const noexcept { return unlimited_.get(); }

 private:
  void prepare();
  void commit() noexcept;
  [[nodiscard]] bool needs_unlimited() const;
  void make_unlimited(const RunControl& control);
  void run_with_unlimited(const RunControl& control, const std::function<void()>& run_limited);
  [[nodiscard]] DomainUpdateOf<D> run(const RunControl& control);
  void begin(const Change<D>& change, DomainUpdateOf<D>& update);
  void follow(const Change<D>& change, DomainUpdateOf<D>& update);
  [[nodiscard]] KeptSlots kept_slots(const Change<D>& change, const DomainChangeOf<D>& domain) const;

  Mesher<D> mesher_;
  Extent extent_;
  RegionAreas areas_;
  Markers point_markers_, line_markers_, polygon_markers_;
  EditedSeedsOf<D> seeds_;
  std::optional<DomainFollowerOf<D>> follower_;  // from the first line (polygon) or seed on
  std::unique_ptr<UnlimitedMesh<D>> unlimited_;  // from the first limits on that it matters to
  Busy busy_;
  bool needs_follower_ = false;  // there are edits to follow
  bool ran_ = false;
};

}  // namespace mesher::detail
