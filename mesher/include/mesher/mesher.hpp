// A quality Delaunay mesh that follows its input [Hudson, Ch 4].
//
// Example:
//   mesher::Options<2> options{.domain = {{0, 0}, {1, 1}}};
//   mesher::Mesher<2> m(options);
//   m.insert(mesher::FeatureId{1}, {0.25, 0.5});
//   m.update();                                  // first run
//   m.insert(mesher::FeatureId{2}, {0.26, 0.5});
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
#include <stop_token>
#include <vector>

#include "mesher/angles.hpp"
#include "mesher/error.hpp"
#include "mesher/guard.hpp"
#include "mesher/live_mesh.hpp"
#include "mesher/mesh.hpp"

namespace sac {
class Engine;
}

namespace mesher {

namespace detail {
template <int D>
class DomainState;
}

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
  FeatureId line{};
  bool of_polygon = false;  ///< as in Mesh::Edge
  friend auto operator<=>(const LineEdge&, const LineEdge&) = default;
};

/// A face of the mesh in a polygon of the input; corners ascend in lexicographic order.
template <int D>
struct PolygonFace {
  std::array<Point<D>, 3> corners{};
  FeatureId polygon{};
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
  GuardReport guard;  ///< in space: which new simplices stay poor beside features (guard.hpp)
  CallCounts calls;
  SlotChange slots;  ///< the same by slots; empty unless the mesher keeps them: Mesher::live()
};

/// What a run is at: the three parts of a first or static run, in this order, or an update.
enum class Phase : std::uint8_t { quadtree, steiner, triangulate, update };

/// How far a run is, in calls of traced functions.
struct Progress {
  Phase phase = Phase::quadtree;
  std::uint64_t done = 0;  ///< calls of this phase that have run
  std::uint64_t of = 0;    ///< as many are known to be needed, which may grow; 0: not known
};

/// How to watch a run or an update, and how to stop it.
struct RunControl {
  /// Called every kCallsBetween calls (some thousand times a second); false stops. What it throws
  /// stops as well, and leaves update(). It must not use the mesher, which refuses edits, another
  /// update and to show its mesh by sac::UsageError.
  std::function<bool(const Progress&)> progress{};
  /// A request to stop, from any thread.
  std::stop_token stop{};

  static constexpr std::uint64_t kCallsBetween = 256;
};

/// A point of the input.
template <int D>
struct InputPoint {
  FeatureId id{};
  Point<D> at{};
  friend bool operator==(const InputPoint&, const InputPoint&) = default;
};

/// A line of the input: segments from point to point.
struct InputLine {
  FeatureId id{};
  std::vector<FeatureId> points;  ///< two or more
  friend bool operator==(const InputLine&, const InputLine&) = default;
};

/// How large a mesh and its trace are; times of the first run.
struct MeshStats {
  std::size_t vertices = 0;
  std::size_t simplices = 0;
  double seconds_quadtree = 0;
  double seconds_steiner = 0;
  double seconds_triangulate = 0;
  std::uint64_t calls = 0;        ///< live calls; 0 for a static mesh
  std::uint64_t edges = 0;        ///< live edges; 0 for a static mesh
  std::uint64_t trace_bytes = 0;  ///< memory of trace and indices
};

/// A mesh maintained under insertion and removal of features.
template <int D>
class Mesher {
 public:
  /// Throws: Error(bad_option) for an empty or non-finite domain or rho out of range.
  explicit Mesher(const Options<D>& options);
  Mesher(Mesher&&) noexcept;
  Mesher& operator=(Mesher&&) noexcept;
  ~Mesher();

  /// Announces a point that is not there; the mesh follows at the next update().
  /// Its place must be free: no point that is announced to be there may share its finest cell.
  /// Throws: Error (repeated_id, duplicate_point, too_close, outside_domain, not_finite,
  /// magnitude). Cost: O(log n).
  void insert(FeatureId id, const Point<D>& point);
  /// All of ids[i] at points[i], or none. Requires: ids.size() == points.size().
  void insert(const std::vector<FeatureId>& ids, const std::vector<Point<D>>& points);
  /// Announces that a point goes. Throws: Error(unknown_id). Cost: O(1).
  void remove(FeatureId id);
  /// Announces that a point moves; remove() and then insert() of one id is a move too. Its new
  /// place need not be free yet: where points have moved, update() judges the places that all of
  /// them end at, so that points swap places and moves chain in any order.
  /// Throws: Error (unknown_id, outside_domain, not_finite, magnitude). Cost: O(1).
  void move(FeatureId id, const Point<D>& point);

  /// Announces a segment between two points that shall be there; the next update() judges it, as
  /// part of all that is announced then. Lines, segments and polylines, have ids of their own.
  /// Throws: Error (repeated_id; zero_length: from one point to itself; bad_option unless
  /// options().rule is radius_edge). Cost: O(1).
  void insert_segment(FeatureId id, FeatureId from, FeatureId to);
  /// Announces segments from point to point under one id. `points`: two or more; the first may be
  /// the last again. Throws: likewise, and Error(bad_option) for fewer. Cost: O(points).
  void insert_polyline(FeatureId id, const std::vector<FeatureId>& points);
  /// Announces that a line goes, with all its segments. Throws: Error(unknown_id).
  void remove_segment(FeatureId id);
  void remove_polyline(FeatureId id) { remove_segment(id); }

  /// Announces a polygon in space between points that shall be there; likewise. It brings its edges,
  /// and those that it declares to lie inside; they may be segments, or edges of others, too.
  /// Polygons have ids of their own. Throws: Error (repeated_id; bad_polygon: a loop of fewer than
  /// three points, or twice along one; zero_length: an edge from a point to itself; bad_option in
  /// the plane). Cost: O(points log points).
  void insert_polygon(const Polygon& polygon);
  /// Announces that it goes, with the edges that nobody else has. Throws: Error(unknown_id).
  void remove_polygon(FeatureId id);

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
  [[nodiscard]] std::vector<InputPoint<D>> points() const;
  [[nodiscard]] std::vector<InputLine> lines() const;
  [[nodiscard]] std::vector<Polygon> polygons() const;

  /// Number of input points that are announced to be there.
  [[nodiscard]] std::size_t size() const;
  /// Whether the line is announced to be there.
  [[nodiscard]] bool contains_line(FeatureId id) const;
  /// Whether the polygon is.
  [[nodiscard]] bool contains_polygon(FeatureId id) const;
  /// Whether the point is announced to be there.
  [[nodiscard]] bool contains(FeatureId id) const;
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
  void announce_to(Mesher& other) const;
  // In the mesh of the last update, while another runs. Requires: keeps_slots().
  [[nodiscard]] Slot last_slot(const std::array<Point<D>, D + 1>& simplex) const;
  void limit_regions(std::shared_ptr<const RegionLimits<D>> regions,
                     const std::vector<Box<D>>& where);
  [[nodiscard]] bool has_limits() const;

  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// The same algorithms without the engine: the mesh that Mesher would have after inserting
/// `points`, bit for bit. `points`: n x D; `ids`: as many, only used in errors (empty: 1..n).
/// Requires: ids.empty() || ids.size() == points.size().
/// Throws: Error (bad_option, cancelled, and as Mesher::insert and update), std::bad_alloc, what
/// control.progress throws.
template <int D>
[[nodiscard]] Mesh<D> mesh_statically(const std::vector<Point<D>>& points,
                                      const Options<D>& options,
                                      const std::vector<FeatureId>& ids = {},
                                      MeshStats* stats = nullptr, const RunControl& control = {});

/// The same with segments between the points, named by their ids: every segment is a union of edges
/// of the mesh. Throws also: Error(bad_option) unless options.rule is radius_edge;
/// Error(unknown_id).
[[nodiscard]] Mesh<2> mesh_statically(const std::vector<Point<2>>& points,
                                      const std::vector<Segment>& segments,
                                      const Options<2>& options,
                                      const std::vector<FeatureId>& ids = {},
                                      MeshStats* stats = nullptr, const RunControl& control = {});

/// The same in space, with polygons.
[[nodiscard]] Mesh<3> mesh_statically(const std::vector<Point<3>>& points,
                                      const std::vector<Segment>& segments,
                                      const std::vector<Polygon>& polygons,
                                      const Options<3>& options,
                                      const std::vector<FeatureId>& ids = {},
                                      MeshStats* stats = nullptr, const RunControl& control = {});

}  // namespace mesher
