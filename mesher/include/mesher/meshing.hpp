// From a graph to the mesh of what it encloses.
//
// Example:
//   const mesher::GraphFile<2> lake = mesher::read<2>("lake.poly");
//   const auto made = mesher::mesh(lake.graph, {.min_angle = 25});
//   mesher::write_mesh(made.mesh, "lake.vtu");
//
// A Mesher (mesher.hpp) keeps such a mesh under edits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <stop_token>
#include <string_view>
#include <vector>

#include "mesher/domain.hpp"
#include "mesher/error.hpp"
#include "mesher/graph.hpp"
#include "mesher/mesh.hpp"

namespace mesher {

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

/// What happened in a run of Algorithm::refine.
struct RefineStats {
  std::size_t vertices = 0;
  std::size_t simplices = 0;
  std::size_t made = 0;            ///< simplices that refinement made; most of them went again
  std::size_t most_simplices = 0;  ///< the most that there ever were, the hull's facets counted
  std::size_t on_sides = 0;        ///< new vertices that were moved onto a side of the box
  double worst_radius_edge = 0;    ///< of any simplex that there was since refinement began
  std::size_t largest_degree = 0;  ///< the most neighbours that a vertex ever had since then
};

/// What happened in a run of Algorithm::svr, or of refine; it begins with the first point's
/// insertion.
struct SvrStats : RefineStats {
  std::size_t warped = 0;   ///< input points inserted in the place of a new vertex
  std::size_t crowded = 0;  ///< input points inserted since they crowded a vertex
  /// How many times a waiting point was looked at, for one that is near a new vertex, and to see
  /// where it waits from now on.
  std::uint64_t looked_at_to_find = 0, looked_at_to_move = 0;
};

/// The part of a mesh that is wanted, and what was found of regions.
template <int D>
struct DomainMesh {
  MeshData<D> mesh;             ///< as `extract` gives it; without features if the graph is bare
  std::vector<Region> regions;  ///< of the mesh of the box, as find_domain gives them
  std::vector<SeedFault<D>> faults;  ///< likewise
  bool keeps_all = true;
};

/// "auto", "refine", "svr", "gap-balls".
[[nodiscard]] std::string_view name_of(Algorithm algorithm) noexcept;

/// How a mesh was made.
struct RunReport {
  Algorithm algorithm = Algorithm::automatic;  ///< the one that made it
  Algorithm tried = Algorithm::automatic;      ///< by Algorithm::automatic, if another one gave up,
  std::optional<Error> gave_up{};              ///< and why
  MeshStats stats;                             ///< times by gap_balls alone
  std::optional<SvrStats> refinement{};        ///< of refine and svr, if asked for
};

/// What mesh() makes.
template <int D>
struct Meshed : DomainMesh<D> {
  RunReport report;
};

/// The mesh of what a graph encloses (or of the box: options.extent), less the holes, and all of it
/// if nothing is enclosed. Of it holds what holds of a Mesher's (mesher.hpp), by whatever
/// algorithm. Throws: Error: what is wrong with the graph, as Mesher::insert and update;
/// bad_option; too_many; cancelled; std::bad_alloc; what control.progress throws. Cost: by refine
/// and svr O(n log(spread) + m) for points and m vertices that are not too unevenly spread; by
/// gap_balls O(m log L/s).
template <int D>
[[nodiscard]] Meshed<D> mesh(const Graph<D>& graph, const Options<D>& options = {},
                             const RunControl& control = {});

/// The two steps of mesh(): the mesh of the box, without features, and what is wanted of it.
/// `refinement`: whether the report is to have RunReport::refinement, at some 10% of the time.
template <int D>
[[nodiscard]] Mesh<D> box_mesh(const Graph<D>& graph, const Options<D>& options,
                               RunReport* report = nullptr, const RunControl& control = {},
                               bool refinement = false);
/// Requires: `mesh` is the box_mesh of `graph`. Throws: Error as find_domain.
/// Cost: O(m + n log n), and that of find_domain and extract.
template <int D>
[[nodiscard]] DomainMesh<D> domain_mesh(Mesh<D> mesh, const Graph<D>& graph, Extent extent);

}  // namespace mesher
