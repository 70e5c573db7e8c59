// The mesh of the whole box, maintained under edits of points, lines and polygons: what a Mesher
// follows the domain in.
//
// Example:
//   mesher::Options<2> options{.domain = {{0, 0}, {1, 1}}};
//   mesher::BoxMesher<2> m(options);
//   m.insert(mesher::PointId{1}, {0.25, 0.5});
//   m.update();                                  // first run
//   m.insert(mesher::PointId{2}, {0.26, 0.5});
//   auto change = m.update();                    // work near the new point only
//
// Guarantees, after every update():
//   (1) every input point is a vertex, bit for bit;
//   (2) the triangulation is Delaunay, ties decided by coordinates alone;
//   (3) no triangle has circumradius / shortest edge > rho;
//   (4) the mesh is a function of the set of input points and the options alone: not of the order
//       of edits, the ids, or the machine;
//   (5) what throws, for whatever reason, leaves the mesh of the last update.
// Between updates edits are only announced: mesh() is the mesh of the last update().
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "mesher/graph.hpp"
#include "mesher/mesher.hpp"

namespace sac {
class Engine;
}

namespace mesher {

namespace detail {
template <int D>
class DomainState;
}

/// A mesh maintained under insertion and removal of features.
template <int D>
class BoxMesher {
 public:
  /// Throws: Error(bad_option) for an empty or non-finite domain or rho out of range.
  explicit BoxMesher(const Options<D>& options);
  BoxMesher(BoxMesher&&) noexcept;
  BoxMesher& operator=(BoxMesher&&) noexcept;
  ~BoxMesher();

  /// Announces a point that is not there; the mesh follows at the next update().
  /// Its place must be free: no point that is announced to be there may share its finest cell.
  /// Throws: Error (repeated_id, duplicate_point, too_close, outside_domain, not_finite,
  /// magnitude). Cost: O(log n).
  void insert(PointId id, const Point<D>& point);
  /// All of ids[i] at points[i], or none. Requires: ids.size() == points.size().
  void insert(const std::vector<PointId>& ids, const std::vector<Point<D>>& points);
  /// Announces that a point goes. Throws: Error(unknown_id). Cost: O(1).
  void remove(PointId id);
  /// Announces that a point moves; remove() and then insert() of one id is a move too. Its new
  /// place need not be free yet: where points have moved, update() judges the places that all of
  /// them end at, so that points swap places and moves chain in any order.
  /// Throws: Error (unknown_id, outside_domain, not_finite, magnitude). Cost: O(1).
  void move(PointId id, const Point<D>& point);

  /// Announces a segment between two points that shall be there; the next update() judges it, as
  /// part of all that is announced then. Lines, segments and polylines, have ids of their own.
  /// Throws: Error (repeated_id; zero_length: from one point to itself; bad_option unless
  /// options().rule is radius_edge). Cost: O(log n).
  void insert_segment(LineId id, PointId from, PointId to);
  /// Announces segments from point to point under one id. `points`: two or more; the first may be
  /// the last again. Throws: likewise, and Error(bad_option) for fewer. Cost: O(points).
  void insert_polyline(LineId id, const std::vector<PointId>& points);
  /// Announces that a line goes, with all its segments. Throws: Error(unknown_id).
  void remove_line(LineId id);

  /// Announces a polygon in space between points that shall be there; likewise. It brings its
  /// edges, and those that it declares to lie inside; they may be segments, or edges of others,
  /// too. Polygons have ids of their own. Throws: Error (repeated_id; bad_polygon: a loop of fewer
  /// than three points, or twice along one; zero_length: an edge from a point to itself; bad_option
  /// in the plane). Cost: O(points log points).
  void insert_polygon(const Polygon& polygon);
  /// Announces that it goes, with the edges that nobody else has. Throws: Error(unknown_id).
  void remove_polygon(PolygonId id);

  /// Announces limits of size in place of all that there were; none by default.
  /// Throws: Error(bad_option), as a mesher with these limits. Cost: O(1).
  void limit(const SizeLimits<D>& limits);
  /// The same in a closed box; elsewhere they stay, and are not looked at. options().box_limits say
  /// so afterwards: a box is forgotten where later ones have all of it, or it says what holds
  /// behind it. Cost: O(boxes); as much for each look at the limits in an update.
  void limit(const Box<D>& box, const SizeLimits<D>& limits);

  /// Takes back every edit announced since the last update(); nothing while an update runs.
  /// Cost: O(edits).
  void discard_edits() noexcept;

  /// Brings the mesh up to date with the edits announced since the last call, as one batch, or
  /// leaves the mesh as it was.
  /// Throws: Error(cancelled) if `control` has stopped it: the edits stay announced, for another
  /// update() or discard_edits(). Error (duplicate_point, too_close: points that have moved onto
  /// others, or places too near to each other for the vertices that they need; crossing_segments,
  /// point_on_segment, overlapping_segments, repeated_segment; point_in_use: an end of a segment is
  /// removed; unknown_id: a segment's end is not there; of polygons bad_polygon, not_flat,
  /// repeated_polygon, point_on_polygon, segment_on_polygon, segment_through_polygon,
  /// crossing_polygons, overlapping_polygons), std::bad_alloc, or
  /// what control.progress throws: the edits are taken back as well.
  /// Cost: O(log L/s) calls per edited point [Theorem 4.3.8], each O(log L/s), the first time per
  /// vertex; per vertex that was or is on lines that come, go or have a point that moves, and where
  /// limits of size are edited; stopped or failed, as much again to take back what was done.
  Change<D> update(const RunControl& control = {});
  /// The same, with a last word on the change before it is final: what `accept` throws leaves
  /// update(), and the mesh stays as it was. It must not use the mesher.
  using Accept = std::function<void(const Change<D>&)>;
  Change<D> update(const RunControl& control, const Accept& accept);

  /// The mesh of the last update() in canonical form, whatever has been announced since; empty
  /// before the first. Cost: O(m log m).
  [[nodiscard]] Mesh<D> mesh() const;

  /// The mesh of the last update() in arrays by slot, numbers that last: see live_mesh.hpp. Empty
  /// before the first. The first call begins to keep slots. Cost: O(1); where slots begin, that of
  /// mesh().
  [[nodiscard]] LiveMesh<D> live() const;
  /// Whether slots are kept, and Change::slots filled: not by default, since they cost memory and a
  /// part of each update. They begin with the numbers of mesh().
  /// Cost: that of mesh() to begin.
  void keep_slots(bool keep);
  [[nodiscard]] bool keeps_slots() const noexcept;

  /// The points, lines and polygons of the last update(), ascending by id. Cost: O(n log n).
  [[nodiscard]] std::vector<GraphPoint<D>> points() const;
  [[nodiscard]] std::vector<Polyline> lines() const;
  [[nodiscard]] std::vector<Polygon> polygons() const;
  /// One of them, if it is there. Cost: O(log n), and of its points.
  [[nodiscard]] std::optional<GraphPoint<D>> point(PointId id) const;
  [[nodiscard]] std::optional<Polyline> line(LineId id) const;
  [[nodiscard]] std::optional<Polygon> polygon(PolygonId id) const;

  /// Number of input points that are announced to be there.
  [[nodiscard]] std::size_t size() const;
  /// Whether the line is announced to be there.
  [[nodiscard]] bool contains_line(LineId id) const;
  /// Whether the polygon is.
  [[nodiscard]] bool contains_polygon(PolygonId id) const;
  /// Whether the point is announced to be there.
  [[nodiscard]] bool contains(PointId id) const;
  /// Of the last update(); times of the first. Cost: O(1).
  [[nodiscard]] MeshStats stats() const;
  /// With the limits of size of the last update().
  [[nodiscard]] const Options<D>& options() const;

  /// The engine, for those who look at its trace. The first update() puts another in its place.
  [[nodiscard]] const sac::Engine& engine() const;

  /// Throws std::logic_error naming the broken invariant. Cost: O(trace).
  void check_invariants() const;

 private:
  friend class detail::DomainState<D>;  // which keeps the limits of regions up to date
  void announce_to(BoxMesher& other) const;
  // In the mesh of the last update, while another runs. Requires: keeps_slots().
  [[nodiscard]] Slot last_slot(const std::array<Point<D>, D + 1>& simplex) const;
  void limit_regions(std::shared_ptr<const RegionLimits<D>> regions,
                     const std::vector<Box<D>>& where);
  [[nodiscard]] bool has_limits() const;

  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mesher
