// From a graph to the mesh of what it encloses.
//
// Example:
//   const PslgFile lake = read_pslg("lake.poly");
//   const Options<2> options{.domain = snapped_domain<2>(places_of(lake.pslg))};
//   const DomainMesh mesh =
//       domain_mesh(mesh_statically(lake.pslg, options), lake.pslg, Extent::enclosed);
//   write_mesh(mesh.kept, "lake.vtu");
//
// DomainMesher does the same for graphs that are edited. In space a complex takes the graph's
// place.
#pragma once

#include <type_traits>
#include <vector>

#include "mesher/domain.hpp"
#include "mesher/mesh_data.hpp"
#include "mesher/mesher.hpp"
#include "mesher/plc.hpp"
#include "mesher/pslg.hpp"
#include "mesher/refine.hpp"
#include "mesher/svr.hpp"

namespace mesher {

/// The part of a mesh that is wanted, and what was found of regions.
template <int D>
struct DomainMeshOf {
  MeshDataOf<D> kept;           ///< as `extract` gives it; without features if the graph is bare
  std::vector<Region> regions;  ///< of the whole mesh, as find_domain gives them
  std::vector<SeedFaultOf<D>> faults;  ///< likewise
  bool keeps_all = true;
};
using DomainMesh = DomainMeshOf<2>;

/// What a mesh is made of: a graph, or in space a complex.
template <int D>
using GraphOf = std::conditional_t<D == 2, Pslg, Plc>;

/// Whether there are no lines, polygons, seeds and markers: then meshes are meshes of points alone.
[[nodiscard]] bool is_bare(const Pslg& graph);
[[nodiscard]] bool is_bare(const Plc& complex);

[[nodiscard]] std::vector<Point<2>> places_of(const Pslg& graph);
[[nodiscard]] std::vector<Point<3>> places_of(const Plc& complex);
/// Segments with their ids, then the pieces of polylines with theirs.
[[nodiscard]] std::vector<Segment> segments_of(const Pslg& graph);
[[nodiscard]] std::vector<Segment> segments_of(const Plc& complex);
[[nodiscard]] std::vector<Polygon> polygons_of(const Plc& complex);
/// Holes, then regions.
[[nodiscard]] std::vector<Seed> seeds_of(const Pslg& graph);
[[nodiscard]] std::vector<SeedOf<3>> seeds_of(const Plc& complex);
/// Adds a hole or region, so that seeds_of has it.
void add_seed(Pslg& graph, const Seed& seed);
void add_seed(Plc& complex, const SeedOf<3>& seed);

/// The mesh of a graph's points and lines in the box. Throws: as mesh_statically of these.
[[nodiscard]] Mesh<2> mesh_statically(const Pslg& graph, const Options<2>& options,
                                      MeshStats* stats = nullptr, const RunControl& control = {});
[[nodiscard]] Mesh<3> mesh_statically(const Plc& complex, const Options<3>& options,
                                      MeshStats* stats = nullptr, const RunControl& control = {});

/// The same by other algorithms (mesher/refine.hpp, mesher/svr.hpp), good in `extent`.
[[nodiscard]] Mesh<2> refine(const Pslg& graph, const Options<2>& options,
                             Extent extent = Extent::box, const RefineSettings& settings = {},
                             RefineStats* stats = nullptr, const RunControl& control = {});
[[nodiscard]] Mesh<2> svr(const Pslg& graph, const Options<2>& options,
                          Extent extent = Extent::box, const SvrSettings& settings = {},
                          SvrStats* stats = nullptr, const RunControl& control = {});
[[nodiscard]] Mesh<3> refine(const Plc& complex, const Options<3>& options,
                             Extent extent = Extent::box, const RefineSettings& settings = {},
                             RefineStats* stats = nullptr, const RunControl& control = {});
[[nodiscard]] Mesh<3> svr(const Plc& complex, const Options<3>& options,
                          Extent extent = Extent::box, const SvrSettings& settings = {},
                          SvrStats* stats = nullptr, const RunControl& control = {});

/// A mesh of `graph` with origins, edges on lines, and the markers of the graph's points and lines.
/// Requires: `mesh` is that of its points and lines. Cost: O(m + n log n).
[[nodiscard]] MeshData with_features(Mesh<2> mesh, const Pslg& graph);
/// The same in space, with faces in polygons. An edge on no segment with a marker has the least of
/// the markers of polygons that it bounds or lies in.
[[nodiscard]] MeshDataOf<3> with_features(Mesh<3> mesh, const Plc& complex);

/// Finds the domain in a mesh of `graph`, and takes it out. Requires: as with_features.
/// Throws: Error as find_domain. Cost: as with_features, find_domain and extract.
[[nodiscard]] DomainMesh domain_mesh(Mesh<2> mesh, const Pslg& graph, Extent extent);
[[nodiscard]] DomainMeshOf<3> domain_mesh(Mesh<3> mesh, const Plc& complex, Extent extent);

/// Whether the largest areas, or volumes, of regions are limits of size.
enum class RegionAreas : std::uint8_t { ignored, limits };

/// For Options::region_limits: limits of size count in the part of the domain that is wanted, and
/// those of regions there, if that is asked for. They are found in the mesh that
/// `options` give the graph without limits: lines are unions of its edges, and polygons of its faces, as of all others'.
/// Throws: as mesh_statically and find_domain. Cost: that of this mesh.
[[nodiscard]] std::shared_ptr<const RegionLimits<2>> region_limits(
    const Pslg& graph, const Options<2>& options, Extent extent,
    RegionAreas areas = RegionAreas::ignored);
[[nodiscard]] std::shared_ptr<const RegionLimits<3>> region_limits(
    const Plc& complex, const Options<3>& options, Extent extent,
    RegionAreas areas = RegionAreas::ignored);

/// Announces all of `graph` to a DomainMesher, or to a Mesher<2>, which takes no seeds and markers.
/// Throws: Error as their functions do; what came before stays announced.
template <class Target>
void announce(const Pslg& graph, Target& target) {
  constexpr bool kTakesSeeds = requires { target.insert_seed(Seed()); };
  if constexpr (kTakesSeeds) {
    for (const auto& p : graph.points) target.insert(p.id, p.at, p.marker);
    for (const auto& s : graph.segments) target.insert_segment(s.id, s.from, s.to, s.marker);
    for (const auto& l : graph.polylines) target.insert_polyline(l.id, l.points, l.marker);
    for (const Seed& seed : seeds_of(graph)) target.insert_seed(seed);
  } else {
    for (const auto& p : graph.points) target.insert(p.id, p.at);
    for (const auto& s : graph.segments) target.insert_segment(s.id, s.from, s.to);
    for (const auto& l : graph.polylines) target.insert_polyline(l.id, l.points);
  }
}
/// The same of a complex, to a DomainMesherOf<3> or to a Mesher<3>.
template <class Target>
void announce(const Plc& complex, Target& target) {
  constexpr bool kTakesSeeds = requires { target.insert_seed(SeedOf<3>()); };
  if constexpr (kTakesSeeds) {
    for (const auto& p : complex.points) target.insert(p.id, p.at, p.marker);
    for (const auto& s : complex.segments) target.insert_segment(s.id, s.from, s.to, s.marker);
    for (const auto& f : complex.facets) target.insert_polygon(f.polygon, f.marker);
    for (const SeedOf<3>& seed : seeds_of(complex)) target.insert_seed(seed);
  } else {
    for (const auto& p : complex.points) target.insert(p.id, p.at);
    for (const auto& s : complex.segments) target.insert_segment(s.id, s.from, s.to);
    for (const auto& f : complex.facets) target.insert_polygon(f.polygon);
  }
}

}  // namespace mesher
