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
//   (3) no triangle with a vertex off the boundary grid has circumradius / shortest edge > rho;
//   (4) the mesh is a function of the set of input points and the options alone: not of the order
//       of edits, the ids, or the machine;
//   (5) an edit that throws changes nothing.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "mesher/error.hpp"
#include "mesher/mesh.hpp"

namespace sac {
class Engine;
}

namespace mesher {

/// Work done by one run or update, counted in calls of traced functions.
struct CallCounts {
  std::uint64_t executed = 0;   ///< calls whose body ran (new ones included)
  std::uint64_t reused = 0;     ///< calls that were asked for again and kept
  std::uint64_t created = 0;
  std::uint64_t discarded = 0;
  std::uint64_t edges = 0;      ///< edges (reads, writes, posts) made or removed
};

/// The exact difference between the mesh before and after an update.
/// Vertices in lexicographic order; each simplex by its corners, smallest first, positively
/// oriented.
template <int D>
struct Change {
  std::vector<Point<D>> vertices_added;
  std::vector<Point<D>> vertices_removed;
  std::vector<std::array<Point<D>, D + 1>> simplices_added;
  std::vector<std::array<Point<D>, D + 1>> simplices_removed;
  CallCounts calls;
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

  /// Announces an edit; the mesh follows at the next update().
  /// Throws: Error (repeated_id, unknown_id, duplicate_point, outside_domain, not_finite,
  /// magnitude, too_close) and then changes nothing. Cost: O(log n).
  void insert(FeatureId id, const Point<D>& point);
  /// All of ids[i] at points[i], or none: faster than one by one for large inputs.
  void insert(const std::vector<FeatureId>& ids, const std::vector<Point<D>>& points);
  void remove(FeatureId id);
  void move(FeatureId id, const Point<D>& point);

  /// Takes back every edit announced since the last update().
  void discard_edits();

  /// Brings the mesh up to date with the edits announced since the last call, as one batch.
  /// Throws: whatever stopped it (Error(too_close), std::bad_alloc); mesh and features are then as
  /// before those edits. Cost: O(log L/s) calls per edited point [Theorem 4.3.8], each O(log L/s).
  Change<D> update();

  /// The mesh in canonical form. Cost: O(m log m).
  [[nodiscard]] Mesh<D> mesh() const;

  [[nodiscard]] std::size_t size() const;  ///< number of input points
  [[nodiscard]] bool contains(FeatureId id) const;
  [[nodiscard]] MeshStats stats() const;
  [[nodiscard]] const Options<D>& options() const;

  /// The engine, for those who look at its trace. It may be another after discard_edits() or an
  /// update() that throws.
  [[nodiscard]] const sac::Engine& engine() const;

  /// Requires: no edit announced since the last update(). Throws std::logic_error naming the broken
  /// invariant. Cost: O(trace).
  void check_invariants() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// The same algorithms without the engine: the mesh that Mesher would have after inserting
/// `points`, bit for bit. `points`: n x D; ids are only used in errors (empty: 1..n).
template <int D>
[[nodiscard]] Mesh<D> mesh_statically(const std::vector<Point<D>>& points,
                                      const Options<D>& options,
                                      const std::vector<FeatureId>& ids = {},
                                      MeshStats* stats = nullptr);

}  // namespace mesher
