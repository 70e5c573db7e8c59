// Makes the mesh of what a graph encloses.
//
// Example:
//   const mesher::GraphFile<2> lake = mesher::read<2>("lake.poly");
//   const auto made = mesher::mesh(lake.graph, {.min_angle = 25});
//   mesher::write_mesh(made.mesh, "lake.vtu");
//
// A Mesher (mesher.hpp) updates such a mesh under edits.
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

/// The phase of a run: one of the three parts of a first or static run, in this order, or an
/// update.
enum class Phase : std::uint8_t { quadtree, steiner, triangulate, update };

/// The progress of a run, in calls of traced functions.
struct Progress {
  Phase phase = Phase::quadtree;
  std::uint64_t done = 0;  ///< calls of this phase that have run
  std::uint64_t of = 0;    ///< calls known to be needed, which may grow; 0: not known
};

/// Functions that watch a run or an update, and that stop it.
struct RunControl {
  /// Called every kCallsBetween calls (some thousand times a second). If it returns false, the run
  /// stops. If it throws, the run stops and update() passes the exception on. It must not use the
  /// mesher: edits, another update and access to the mesh throw sac::UsageError.
  std::function<bool(const Progress&)> progress{};
  /// Stops the run when stop is requested, from any thread.
  std::stop_token stop{};

  static constexpr std::uint64_t kCallsBetween = 256;
};

/// Sizes of a mesh and its trace; times of the first run.
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

/// Counts of a run of Algorithm::refine.
struct RefineStats {
  std::size_t vertices = 0;
  std::size_t simplices = 0;
  std::size_t made = 0;  ///< simplices that refinement made, most of which it removed again
  std::size_t most_simplices = 0;  ///< the largest number at any time, with the hull's facets
  std::size_t on_sides = 0;        ///< new vertices that were moved onto a side of the box
  double worst_radius_edge = 0;    ///< of any simplex since refinement began
  std::size_t largest_degree = 0;  ///< the largest number of neighbours of a vertex since then
  std::size_t slivers_split = 0;   ///< by Options::min_dihedral; more vertices may follow
  std::size_t slivers_left = 0;    ///< tetrahedra below it that no vertex would have made better
};

/// Counts of a run of Algorithm::svr or refine, from the insertion of the first point on.
struct SvrStats : RefineStats {
  std::size_t warped = 0;   ///< input points inserted instead of a new vertex
  std::size_t crowded = 0;  ///< input points inserted because they crowded a vertex
  /// How many times a waiting point was visited: in searches for a point near a new vertex, and to
  /// update where it waits.
  std::uint64_t looked_at_to_find = 0, looked_at_to_move = 0;
};

/// The kept part of a mesh, with regions and faults of seeds.
template <int D>
struct DomainMesh {
  MeshData<D> mesh;                  ///< as from `extract`; without features if the graph is bare
  std::vector<Region> regions;       ///< regions of the mesh of the box, as from find_domain
  std::vector<SeedFault<D>> faults;  ///< as from find_domain
  bool keeps_all = true;
};

/// The name on the command line: "auto", "refine", "svr" or "gap-balls".
[[nodiscard]] std::string_view name_of(Algorithm algorithm) noexcept;

/// How a mesh was made.
struct RunReport {
  Algorithm algorithm = Algorithm::automatic;  ///< the algorithm that made the mesh
  Algorithm tried = Algorithm::automatic;  ///< the one that automatic chose first, if it gave up
  std::optional<Error> gave_up{};          ///< why it gave up
  MeshStats stats;                         ///< times only by gap_balls
  std::optional<SvrStats> refinement{};    ///< of refine and svr, if requested
};

/// The result of mesh().
template <int D>
struct Meshed : DomainMesh<D> {
  RunReport report;
};

/// Makes the mesh of what a graph encloses, without its holes; of everything if it encloses
/// nothing; or of the whole box (options.extent). The guarantees of a Mesher (mesher.hpp) hold for
/// the mesh of each algorithm.
/// Throws: Error for mistakes in the graph, as Mesher::insert and update; Error (bad_option,
/// too_many, cancelled); std::bad_alloc; exceptions of control.progress.
/// Cost: by refine and svr O(n log(spread) + m) for n points and m vertices that are not too
/// unevenly spread; by gap_balls O(m log L/s).
template <int D>
[[nodiscard]] Meshed<D> mesh(const Graph<D>& graph, const Options<D>& options = {},
                             const RunControl& control = {});

/// The first step of mesh(): makes the mesh of the box, without features.
/// `refinement`: whether to fill in RunReport::refinement, which costs about 10% of the time.
template <int D>
[[nodiscard]] Mesh<D> box_mesh(const Graph<D>& graph, const Options<D>& options,
                               RunReport* report = nullptr, const RunControl& control = {},
                               bool refinement = false);
/// The second step of mesh(): extracts the kept part of the box's mesh.
/// Requires: `mesh` is the box_mesh of `graph`. Throws: Error as find_domain.
/// Cost: O(m + n log n), and that of find_domain and extract.
template <int D>
[[nodiscard]] DomainMesh<D> domain_mesh(Mesh<D> mesh, const Graph<D>& graph, Extent extent);

}  // namespace mesher
