// What a Mesher is made of: a mesher, a follower of its domain, and what both do not know of
// the input. The follower has its say on a change while the mesher can still take it back.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "facade/box_mesher.hpp"
#include "facade/followed.hpp"
#include "facade/reentry_guard.hpp"
#include "facade/staged.hpp"
#include "facade/unsized_mesh.hpp"

namespace mesher::detail {

template <int D>
class DomainState {
 public:
  template <class Id>
  using Markers = Staged<Id, std::int64_t>;

  /// Throws: Error(bad_option).
  explicit DomainState(const Options<D>& options);

  // Edits are refused while an update runs, whichever of the meshers it is at.
  void insert(PointId id, const Point<D>& point, std::int64_t marker);
  void remove(PointId id);
  void move(PointId id, const Point<D>& point);
  void insert_line(LineId id, const std::vector<PointId>& points, std::int64_t marker);
  void remove_line(LineId id);
  void insert_polygon(mesher::Polygon polygon);
  void remove_polygon(PolygonId id);
  void insert_seed(const Seed<D>& seed);
  void remove_seed(const SeedId& name);
  void limit(const SizeLimits<D>& limits);
  void limit(const Box<D>& box, const SizeLimits<D>& limits);
  void keep_slots(bool keep);
  void discard_edits() noexcept;
  [[nodiscard]] bool is_idle() const noexcept { return busy_.is_idle(); }
  DomainUpdate<D> update(const RunControl& control);

  [[nodiscard]] Graph<D> input() const;
  [[nodiscard]] std::optional<GraphPoint<D>> point(PointId id) const;
  [[nodiscard]] std::optional<Polyline> line(LineId id) const;
  [[nodiscard]] std::optional<mesher::Polygon> polygon(PolygonId id) const;
  [[nodiscard]] std::optional<Seed<D>> seed(const SeedId& name) const;
  [[nodiscard]] bool contains_seed(const SeedId& name) const {
    return seeds_.find(name) != nullptr;
  }
  /// Requires: the slot of a simplex.
  [[nodiscard]] typename DomainChange<D>::Corners corners(Slot simplex) const;
  [[nodiscard]] const BoxMesher<D>& mesher() const noexcept { return mesher_; }
  [[nodiscard]] Extent extent() const noexcept { return extent_; }
  /// Nobody as long as there are points alone.
  [[nodiscard]] const std::optional<DomainFollower<D>>& follower() const noexcept {
    return follower_;
  }

  /// Nobody as long as it does not matter to limits of size what lines, or polygons, enclose.
  [[nodiscard]] const UnsizedMesh<D>* unlimited() const noexcept { return unlimited_.get(); }

 private:
  void prepare();
  void commit() noexcept;
  [[nodiscard]] bool needs_unlimited() const;
  void make_unlimited(const RunControl& control);
  void run_with_unlimited(const RunControl& control, const std::function<void()>& run_limited);
  [[nodiscard]] DomainUpdate<D> run(const RunControl& control);
  void begin(const Change<D>& change, DomainUpdate<D>& update);
  void follow(const Change<D>& change, DomainUpdate<D>& update);
  [[nodiscard]] KeptSlots kept_slots(const Change<D>& change, const DomainChange<D>& domain) const;

  BoxMesher<D> mesher_;
  Extent extent_;
  RegionAreas areas_;
  Markers<PointId> point_markers_;
  Markers<LineId> line_markers_;
  Markers<PolygonId> polygon_markers_;
  EditedSeedsOf<D> seeds_;
  std::optional<DomainFollower<D>> follower_;  // from the first line (polygon) or seed on
  std::unique_ptr<UnsizedMesh<D>> unlimited_;  // from the first limits on that it matters to
  ReentryGuard busy_;
  bool needs_follower_ = false;  // there are edits to follow
  bool ran_ = false;
};

}  // namespace mesher::detail
