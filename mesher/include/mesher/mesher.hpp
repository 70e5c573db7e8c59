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
//   (1) every input point is a vertex, bit for bit; every line is a union of edges, every polygon a
//       union of faces, but for what lies outside of a mesh of what is enclosed;
//   (2) the triangulation of the box is Delaunay, ties decided by coordinates alone;
//   (3) no simplex has circumradius / shortest edge > rho, but at small angles of the input, and in
//       space where rho is below 2 beside features that are close (reports.hpp);
//   (4) mesh and regions are a function of the input and the options alone: not of the order of
//       edits, the ids, or the machine;
//   (5) what throws, for whatever reason, leaves mesh, regions, seeds and markers of the last
//       update: all edits of a batch come together or not at all.
// Between updates edits are only announced: mesh() is the mesh of the last update().
//
// Cost of an update: O(log L/s) calls per edited point [Theorem 4.3.8], and with regions (words as
// in domain.hpp) that of a region where lines join or part regions, or where a seed gives one
// another label. The first line (in space polygon) or seed that comes to a mesh of points alone
// costs all its simplices, once.
//
// Limits of size count in what is wanted alone: where lines enclose something, in what they
// enclose. So where there are limits, a second mesh, without, follows the input to tell what that
// is; an update costs that of both, and where a region becomes or ceases to be wanted, or gets
// another largest area, the vertices in it; where lines at which limits begin or end are edited,
// the vertices in the simplices of the second mesh that this changes. A seed that changes nothing
// but its area costs a look at all simplices of the second mesh.
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
  std::uint64_t reused = 0;    ///< calls that were asked for again and kept
  std::uint64_t created = 0;
  std::uint64_t discarded = 0;
  std::uint64_t edges = 0;   ///< edges (reads, writes, posts) made or removed
  std::uint64_t weight = 0;  ///< steps inside of calls; 0 unless Options::record_weights
};

/// A vertex that an update has kept, and that is now another kind: an input point came to a place
/// where there was a Steiner vertex, or left one where the mesh needs a vertex all the same.
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
  std::vector<LineEdge<D>> edges_added;  ///< of Mesh::edges; one that stays with another line's
                                         ///< id is in both lists
  std::vector<LineEdge<D>> edges_removed;
  std::vector<PolygonFace<D>> faces_added;  ///< of Mesh::faces, likewise; in the plane none
  std::vector<PolygonFace<D>> faces_removed;
  AngleNews angles;   ///< what small angles of the input did to what has come
  GuardReport guard;  ///< in space: which new simplices stay poor beside features (reports.hpp)
  CallCounts calls;
  SlotChange slots;  ///< the same by slots; empty unless the mesher keeps them: Mesher::live()
};

/// Triangles by their corners, as in Change, in lexicographic order.
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
  std::vector<Relabelled> relabelled;  ///< of the mesh before and after, kept or not
  std::uint64_t visited = 0;           ///< triangles looked at beyond the change itself
};

/// The slots of what DomainChange says is kept now, and what was, in the order there. What went
/// from the mesh is among the latter with the slot that it had.
struct KeptSlots {
  std::vector<Slot> added, removed;
  friend bool operator==(const KeptSlots&, const KeptSlots&) = default;
};

/// What an update did to the mesh, and to the domain.
template <int D>
struct DomainUpdate : Change<D> {
  DomainChange<D> domain;
  KeptSlots kept;  ///< empty unless slots are kept
};

/// A mesh maintained under insertion and removal of features. D is 2 or 3.
template <int D>
class Mesher {
 public:
  /// Throws: Error(bad_option) for an empty or non-finite domain, and for what no mesh can have.
  explicit Mesher(const Options<D>& options);
  Mesher(Mesher&&) noexcept;
  Mesher& operator=(Mesher&&) noexcept;
  ~Mesher();

  /// Announces a point that is not there; the mesh follows at the next update().
  /// Its place must be free: no point that is announced to be there may share its finest cell.
  /// `marker`: what its vertex gets in mesh(); the point keeps it when it moves.
  /// Throws: Error (repeated_id, duplicate_point, too_close, outside_domain, not_finite,
  /// magnitude). Cost: O(log n).
  void insert(PointId id, const Point<D>& point, std::int64_t marker = 0);
  /// Announces all of a graph. Throws: Error as the functions for its parts do, and then nothing of
  /// it is announced that was not before; edits announced before it are taken back as well.
  void insert(const Graph<D>& graph);
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
  void insert_segment(LineId id, PointId from, PointId to, std::int64_t marker = 0);
  /// Announces segments from point to point under one id. `points`: two or more; the first may be
  /// the last again. Throws: likewise, and Error(bad_option) for fewer. Cost: O(points).
  void insert_polyline(LineId id, const std::vector<PointId>& points, std::int64_t marker = 0);
  /// Announces that a segment or polyline goes. Throws: Error(unknown_id).
  void remove_line(LineId id);

  /// Announces a polygon between points that shall be there; likewise. It brings its edges, and
  /// those that it declares to lie inside; they may be segments, or edges of others, too.
  /// Throws: Error (repeated_id; bad_polygon: a loop of fewer than three points, or twice along
  /// one; zero_length: an edge from a point to itself). Cost: O(points log points).
  void insert_polygon(const Polygon& polygon) requires(D == 3);
  /// Announces that it goes, with the edges that nobody else has. Throws: Error(unknown_id).
  void remove_polygon(PolygonId id) requires(D == 3);

  /// Announces a seed that shall be there. It may be anywhere: one without a region of its own is
  /// one of faults(). A seed that is removed and inserted in one batch moves.
  /// Throws: Error (repeated_id, and as find_domain). Cost: O(log s).
  void insert_seed(const Seed<D>& seed);
  void insert_hole(std::int64_t number, const Point<D>& at) {
    insert_seed(hole_seed<D>(number, at));
  }
  void insert_region(std::int64_t number, const Point<D>& at, double attribute,
                     std::optional<double> max_measure = {}) {
    insert_seed(region_seed<D>(number, at, attribute, max_measure));
  }
  /// Announces that a seed goes. Throws: Error(unknown_id). Cost: O(log s).
  void remove_seed(const SeedId& id);
  void remove_hole(std::int64_t number) { remove_seed(hole_id(number)); }
  void remove_region(std::int64_t number) { remove_seed(region_id(number)); }

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

  /// Brings mesh and regions up to date with the edits announced since the last call, as one batch,
  /// or leaves them as they were.
  /// Throws: Error(cancelled) if `control` has stopped it: the edits stay announced, for another
  /// update() or discard_edits(). Error (duplicate_point, too_close: points that have moved onto
  /// others, or places too near to each other for the vertices that they need; crossing_segments,
  /// point_on_segment, overlapping_segments, repeated_segment; point_in_use: an end of a segment is
  /// removed; unknown_id: a segment's end is not there; of polygons bad_polygon, not_flat,
  /// repeated_polygon, point_on_polygon, segment_on_polygon, segment_through_polygon,
  /// crossing_polygons, overlapping_polygons), std::bad_alloc, or what control.progress throws: the
  /// edits are taken back as well.
  DomainUpdate<D> update(const RunControl& control = {});

  /// What is wanted of the mesh of the last update(), with features, whatever has been announced
  /// since, in canonical form: mesher::mesh(input(), options()). Empty before the first. Cost: O(m
  /// log m).
  [[nodiscard]] MeshData<D> mesh() const { return domain_mesh().mesh; }
  /// The same with its regions.
  [[nodiscard]] DomainMesh<D> domain_mesh() const;
  /// The mesh of all of the box, without features. Cost: O(m log m).
  [[nodiscard]] Mesh<D> box_mesh() const;

  /// The mesh of the box in arrays by slot, numbers that last: see live_mesh.hpp; keeps(slot) tells
  /// what is wanted. Empty before the first update(). The first call begins to keep slots, which
  /// cost memory and a part of each update. Cost: O(1); where slots begin, that of box_mesh().
  [[nodiscard]] LiveMesh<D> live() const;
  /// Whether slots are kept, and Change::slots filled.
  void keep_slots(bool keep);
  [[nodiscard]] bool keeps_slots() const noexcept;

  /// The graph of the last update(), ascending by id; a line of two points is a segment.
  /// Cost: O(n log n).
  [[nodiscard]] Graph<D> input() const;

  /// Requires: a simplex of the mesh, from any corner. Cost: O(1) for vertices of bounded degree.
  [[nodiscard]] RegionLabel label(const typename DomainChange<D>::Corners& simplex) const;
  [[nodiscard]] bool keeps(const typename DomainChange<D>::Corners& simplex) const;
  /// The same by its slot. Requires: live().is_simplex(simplex).
  [[nodiscard]] RegionLabel label(Slot simplex) const;
  [[nodiscard]] bool keeps(Slot simplex) const;
  /// Of the last update(); without the lines' ids. Cost: O(seeds).
  [[nodiscard]] std::vector<SeedFault<D>> faults() const;

  /// Whether it is announced to be there.
  [[nodiscard]] bool contains(PointId id) const;
  [[nodiscard]] bool contains(LineId id) const;
  [[nodiscard]] bool contains(PolygonId id) const requires(D == 3);
  [[nodiscard]] bool contains(const SeedId& id) const;

  /// Of box_mesh(); calls, edges and bytes of the second mesh, too, if there is one.
  /// Cost: O(1); with a second mesh, O(its simplices).
  [[nodiscard]] MeshStats stats() const;
  /// As given, but with rho in place of min_angle, Algorithm::gap_balls, and the limits of the last
  /// update: mesh(input(), options()) gives mesh().
  [[nodiscard]] const Options<D>& options() const;
  /// The engine of box_mesh(), whose trace can be recorded.
  [[nodiscard]] const sac::Engine& engine() const;

  /// Throws std::logic_error naming the broken invariant. Cost: O(trace + m log m).
  void check_invariants() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mesher
