// A quality Delaunay mesh that follows its input under edits [Hudson, Ch 4].
//
// Example:
//   mesher::Mesher<2> lake({.domain = {{0, 0}, {1, 1}}});
//   lake.insert(mesher::read<2>("lake.poly").graph);
//   lake.update();                                     // first run
//   lake.move(mesher::PointId{17}, {0.25, 0.5});
//   lake.insert_hole(2, {0.3, 0.7});
//   const auto change = lake.update();                 // work near the edits
//   ... change.domain.kept_added, change.domain.kept_removed ...
//   mesher::write_mesh(lake.mesh(), "lake.vtu");
//
// Guarantees, after every update():
//   (1) every input point is a vertex, bit for bit; every line is a union of edges, and every
//       polygon a union of faces, except for parts outside the mesh if it holds only what is
//       enclosed;
//   (2) the triangulation of the box is Delaunay, with ties decided by coordinates alone;
//   (3) no simplex has circumradius / shortest edge > rho, except at small angles of the input, and
//       in space, if rho is below 2, beside close features (reports.hpp);
//   (4) mesh and regions are a function of the input and the options alone: not of the order of
//       edits, the ids, or the machine;
//   (5) a function that throws, for whatever reason, leaves mesh, regions, seeds and markers as
//       after the last update: all edits of a batch are applied, or none.
// Edits are only announced between updates: mesh() is the mesh of the last update().
//
// Cost of an update: O(log L/s) calls per edited point [Theorem 4.3.8]. If there are regions (terms
// as in domain.hpp), also the size of each region that lines join or split, or to which a seed
// gives another label. The first line (in space polygon) or seed in a mesh of points alone costs
// all its simplices, once.
//
// Limits of size count only in the kept part: if lines enclose something, in what they enclose.
// So if there are limits, a second mesh without limits follows the input to find that part. An
// update then costs the sum for both meshes; the vertices in each region that becomes or ceases to
// be kept, or gets another largest area; and, if lines at which limits begin or end are edited,
// the vertices in the simplices of the second mesh that this changes. A seed that changes only its
// area costs a visit of all simplices of the second mesh.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "mesher/domain.hpp"
#include "mesher/error.hpp"
#include "mesher/graph.hpp"
#include "mesher/live_mesh.hpp"
#include "mesher/mesh.hpp"
#include "mesher/meshing.hpp"
#include "mesher/reports.hpp"

namespace sac {
class Engine;
}

namespace mesher {

/// Work done by one run or update, counted in calls of traced functions.
struct CallCounts {
  std::uint64_t executed = 0;  ///< calls whose body ran (new ones included)
  std::uint64_t reused = 0;    ///< calls that were requested again and kept
  std::uint64_t created = 0;
  std::uint64_t discarded = 0;
  std::uint64_t edges = 0;   ///< edges (reads, writes, posts) made or removed
  std::uint64_t weight = 0;  ///< steps inside calls; 0 unless Options::record_weights
};

/// A vertex that an update kept with another kind: an input point was added at the position of a
/// Steiner vertex, or was removed from a position where the mesh still needs a vertex.
template <int D>
struct KindChange {
  Point<D> vertex{};
  VertexKind before{};
  VertexKind after{};
  friend bool operator==(const KindChange&, const KindChange&) = default;
};

/// An edge of the mesh on a line of the input, or in space on an edge of its polygons; low < high
/// in lexicographic order.
template <int D>
struct LineEdge {
  Point<D> low{}, high{};
  Feature feature{};  ///< as in Mesh::Edge
  friend auto operator<=>(const LineEdge&, const LineEdge&) = default;
};

/// A face of the mesh in a polygon of the input; corners ascend in lexicographic order.
template <int D>
struct PolygonFace {
  std::array<Point<D>, 3> corners{};
  PolygonId polygon{};
  friend auto operator<=>(const PolygonFace&, const PolygonFace&) = default;
};

/// The exact difference between the mesh before and after an update.
/// Vertices, edges and faces in lexicographic order; each simplex by its corners, smallest first,
/// positively oriented.
template <int D>
struct Change {
  std::vector<Point<D>> vertices_added;
  std::vector<VertexKind> kinds_added;  ///< of vertices_added, one each
  std::vector<Point<D>> vertices_removed;
  std::vector<KindChange<D>> kinds_changed;
  std::vector<std::array<Point<D>, D + 1>> simplices_added;
  std::vector<std::array<Point<D>, D + 1>> simplices_removed;
  /// Of Mesh::edges; an edge that now has another line's id is in both lists.
  std::vector<LineEdge<D>> edges_added;
  std::vector<LineEdge<D>> edges_removed;
  std::vector<PolygonFace<D>> faces_added;  ///< of Mesh::faces, likewise; none in the plane
  std::vector<PolygonFace<D>> faces_removed;
  AngleNews angles;   ///< effects of small angles on new triangles
  GuardReport guard;  ///< in space: new simplices that stay poor beside features (reports.hpp)
  CallCounts calls;
  SlotChange slots;  ///< the same change by slots; empty unless slots are kept: Mesher::live()
};

/// The change of the domain in an update. Triangles (in space tetrahedra) are given by their
/// corners, as in Change, in lexicographic order.
template <int D>
struct DomainChange {
  using Corners = std::array<Point<D>, D + 1>;
  struct Relabelled {
    Corners corners{};
    RegionLabel before, after;
    friend bool operator==(const Relabelled&, const Relabelled&) = default;
  };
  std::vector<Corners> kept_added;     ///< kept now, and not before
  std::vector<Corners> kept_removed;   ///< kept before, and not now
  std::vector<Relabelled> relabelled;  ///< in the mesh before and after, kept or not
  std::uint64_t visited = 0;           ///< triangles visited beyond the change itself
};

/// The slots of DomainChange::kept_added and kept_removed, in their order. A simplex that left the
/// mesh is in `removed` with its former slot.
struct KeptSlots {
  std::vector<Slot> added, removed;
  friend bool operator==(const KeptSlots&, const KeptSlots&) = default;
};

/// The changes of an update to the mesh and to the domain.
template <int D>
struct DomainUpdate : Change<D> {
  DomainChange<D> domain;
  KeptSlots kept;  ///< empty unless slots are kept
};

/// A mesh that follows edits of its input. D is 2 or 3.
template <int D>
class Mesher {
 public:
  /// Throws: Error(bad_option) for an empty or non-finite domain, and for options that no mesh can
  /// satisfy.
  explicit Mesher(const Options<D>& options);
  Mesher(Mesher&&) noexcept;
  Mesher& operator=(Mesher&&) noexcept;
  ~Mesher();

  /// Announces a new point; the mesh follows at the next update(). Its position must be free: no
  /// other point that exists after the edits announced so far may be in its finest cell. `marker`:
  /// the marker of its vertex in mesh(); the point keeps it when it moves.
  /// Throws: Error (repeated_id, duplicate_point, too_close, outside_domain, not_finite,
  /// magnitude). Cost: O(log n).
  void insert(PointId id, const Point<D>& point, std::int64_t marker = 0);
  /// Announces all features of a graph. Throws: Error as the functions for its parts. In that case
  /// all edits announced since the last update() are discarded, including those before this call.
  void insert(const Graph<D>& graph);
  /// Announces the removal of a point. Throws: Error(unknown_id). Cost: O(1).
  void remove(PointId id);
  /// Announces that a point moves; remove() and then insert() of one id is a move too. Its new
  /// position need not be free yet: update() judges the final positions of all moved points, so
  /// points can swap positions, and moves can chain in any order.
  /// Throws: Error (unknown_id, outside_domain, not_finite, magnitude). Cost: O(1).
  void move(PointId id, const Point<D>& point);

  /// Announces a new segment between two points; the next update() judges it together with
  /// everything announced by then. Lines, i.e. segments and polylines, have ids of their own.
  /// Throws: Error (repeated_id; zero_length: from a point to itself; bad_option unless
  /// options().rule is radius_edge). Cost: O(log n).
  void insert_segment(LineId id, PointId from, PointId to, std::int64_t marker = 0);
  /// Announces new segments from point to point under one id. `points`: two or more; the last may
  /// be the first again. Throws: as insert_segment, and Error(bad_option) for fewer points. Cost:
  /// O(points).
  void insert_polyline(LineId id, const std::vector<PointId>& points, std::int64_t marker = 0);
  /// Announces the removal of a segment or polyline. Throws: Error(unknown_id).
  void remove_line(LineId id);

  /// Announces a new polygon between points; the next update() judges it. Its edges become edges of
  /// the input, and so do edges that it declares to lie inside; they may also be segments, or edges
  /// of other polygons.
  /// Throws: Error (repeated_id; bad_polygon: a loop of fewer than three points, or with one edge
  /// twice; zero_length: an edge from a point to itself). Cost: O(points log points).
  void insert_polygon(const Polygon& polygon) requires(D == 3);
  /// Announces the removal of a polygon, with the edges that no other feature has. Throws:
  /// Error(unknown_id).
  void remove_polygon(PolygonId id) requires(D == 3);

  /// Announces a new seed. It may be anywhere: a seed without a region of its own is listed in
  /// faults(). A seed that is removed and inserted in one batch moves.
  /// Throws: Error (repeated_id, and as find_domain). Cost: O(log s).
  void insert_seed(const Seed<D>& seed);
  void insert_hole(std::int64_t number, const Point<D>& at) {
    insert_seed(hole_seed<D>(number, at));
  }
  void insert_region(std::int64_t number, const Point<D>& at, double attribute,
                     std::optional<double> max_measure = {}) {
    insert_seed(region_seed<D>(number, at, attribute, max_measure));
  }
  /// Announces the removal of a seed. Throws: Error(unknown_id). Cost: O(log s).
  void remove_seed(const SeedId& id);
  void remove_hole(std::int64_t number) { remove_seed(hole_id(number)); }
  void remove_region(std::int64_t number) { remove_seed(region_id(number)); }

  /// Announces limits of size that replace all earlier ones. A mesher starts with those of its
  /// options; by default there are none.
  /// Throws: Error(bad_option), as a mesher with these limits. Cost: O(1).
  void limit(const SizeLimits<D>& limits);
  /// Announces limits of size in a closed box; elsewhere the limits stay and are not re-examined.
  /// options().box_limits then holds them; a box is dropped if a later box contains it, or if it
  /// repeats the limits that already hold there.
  /// Cost: O(boxes); each evaluation of the limits in an update costs as much.
  void limit(const Box<D>& box, const SizeLimits<D>& limits);

  /// Discards all edits announced since the last update(); does nothing while an update runs.
  /// Cost: O(edits).
  void discard_edits() noexcept;

  /// Applies the edits announced since the last call to mesh and regions, as one batch, or leaves
  /// both as they were.
  /// Throws: Error(cancelled) if `control` stops it: the edits stay announced, for another update()
  /// or discard_edits().
  /// Otherwise the edits are discarded, and it throws Error (duplicate_point, too_close: points
  /// that have moved onto others, or are too close together for the vertices that they need;
  /// crossing_segments, point_on_segment, overlapping_segments, repeated_segment; point_in_use:
  /// removal of a point that is an end of a segment; unknown_id: an end of a segment does not
  /// exist; for polygons bad_polygon, not_flat, repeated_polygon, point_on_polygon,
  /// segment_on_polygon, segment_through_polygon, crossing_polygons, overlapping_polygons),
  /// std::bad_alloc, or an exception of control.progress.
  DomainUpdate<D> update(const RunControl& control = {});

  /// The kept part of the mesh of the last update(), with features, in canonical form: equal to
  /// mesher::mesh(input(), options()). Edits announced since do not count. Empty before the first
  /// update. Cost: O(m log m).
  [[nodiscard]] MeshData<D> mesh() const { return domain_mesh().mesh; }
  /// mesh() with its regions and the faults of seeds.
  [[nodiscard]] DomainMesh<D> domain_mesh() const;
  /// The mesh of the whole box, kept or not, with the edges and faces on features but without
  /// markers and regions. Cost: O(m log m).
  [[nodiscard]] Mesh<D> box_mesh() const;

  /// The mesh of the box in arrays by slot: see live_mesh.hpp. keeps(slot) tells whether a simplex
  /// is kept. Empty before the first update(). The mesher keeps slots from the first call on,
  /// which costs memory and a part of each update. Cost: O(1); of the first call, that of
  /// box_mesh().
  [[nodiscard]] LiveMesh<D> live() const;
  /// Turns slots, and with them Change::slots, on or off.
  void keep_slots(bool keep);
  [[nodiscard]] bool keeps_slots() const noexcept;

  /// The graph of the last update(), ascending by id; a line of two points is a segment.
  /// Cost: O(n log n).
  [[nodiscard]] Graph<D> input() const;
  /// A feature of input(); nothing if it does not have it. Edits announced since do not count.
  /// Cost: O(log n), and of its points.
  [[nodiscard]] std::optional<GraphPoint<D>> point(PointId id) const;
  [[nodiscard]] std::optional<Polyline> line(LineId id) const;  ///< of two points, if a segment
  [[nodiscard]] std::optional<Polygon> polygon(PolygonId id) const requires(D == 3);
  [[nodiscard]] std::optional<Seed<D>> seed(const SeedId& id) const;

  /// The region label of a simplex, and whether it is kept. Requires: a simplex of the mesh,
  /// starting at any corner. Cost: O(1) for vertices of bounded degree.
  [[nodiscard]] RegionLabel label(const typename DomainChange<D>::Corners& simplex) const;
  [[nodiscard]] bool keeps(const typename DomainChange<D>::Corners& simplex) const;
  /// The same for a slot. Requires: live().is_simplex(simplex).
  [[nodiscard]] RegionLabel label(Slot simplex) const;
  [[nodiscard]] bool keeps(Slot simplex) const;
  /// The faults of seeds in the last update(), without the ids of lines. Cost: O(seeds).
  [[nodiscard]] std::vector<SeedFault<D>> faults() const;

  /// Whether the feature exists, counting announced edits.
  [[nodiscard]] bool contains(PointId id) const;
  [[nodiscard]] bool contains(LineId id) const;
  [[nodiscard]] bool contains(PolygonId id) const requires(D == 3);
  [[nodiscard]] bool contains(const SeedId& id) const;

  /// Sizes of box_mesh() and its trace, including calls, edges and bytes of the second mesh if
  /// there is one.
  /// Cost: O(1); with a second mesh, O(its simplices).
  [[nodiscard]] MeshStats stats() const;
  /// The options as given, with these changes: rho replaces min_angle, the algorithm is gap_balls,
  /// and limits are those of the last update. mesh(input(), options()) equals mesh().
  [[nodiscard]] const Options<D>& options() const;
  /// The engine of box_mesh(), of its first tile if there are several; its trace can be recorded.
  [[nodiscard]] const sac::Engine& engine() const;

  /// Checks all invariants. Throws: std::logic_error naming a broken invariant. Cost: O(trace + m
  /// log m).
  void check_invariants() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mesher
