// From a complex to a mesh.
#include <algorithm>
#include <unordered_map>

#include "facade/checked_complex.hpp"
#include "mesher/refine.hpp"
#include "mesher/svr.hpp"
#include "svr/complex_refinement.hpp"
#include "svr/from_points.hpp"
#include "svr/refinement.hpp"

namespace mesher {

namespace {

// What edges are called: as in the meshes of mesh_statically.
class EdgeNames {
 public:
  EdgeNames(const detail::FeatureStore& store, const detail::SpaceNames& names) : names_(names) {
    store.polygons().for_each([&](const detail::Polygon& f) {
      if (!f.alive) return;
      const FeatureId id = names.polygon(f.self);
      for (const detail::EdgeHandle e : f.all_edges) {
        const auto [it, is_new] = least_.try_emplace(e, id);
        if (!is_new && id < it->second) it->second = id;
      }
    });
  }
  [[nodiscard]] detail::LineEdge operator()(const detail::Subedges::Piece& p) const {
    const auto [low, high] = std::minmax(p.a, p.b);
    if (const auto id = names_.segment(p.edge)) return {low, high, *id, false, p.edge};
    return {low, high, least_.at(p.edge), true, p.edge};
  }

 private:
  const detail::SpaceNames& names_;
  std::unordered_map<detail::EdgeHandle, FeatureId> least_;
};

detail::OnFeatures parts_of(const detail::Conformity& all, const detail::FeatureStore& store,
                            const detail::SpaceNames& names) {
  detail::OnFeatures on;
  const EdgeNames name(store, names);
  for (std::uint32_t i = 0; i < all.pieces().size(); ++i) {
    on.edges.push_back(name(all.pieces()[i]));
  }
  all.crossings().for_each([&](const detail::Crossings::Crossing& tile) {
    on.faces.push_back({tile.face, names.polygon(all.polygon_of(tile).self)});
  });
  return on;
}

template <class Algorithm, class Stats>
Mesh<3> run(Algorithm& algorithm, const detail::CheckedComplex& complex, Stats* stats) {
  algorithm.run();
  algorithm.conformity().require_whole();
  Mesh<3> mesh = detail::mesh_of<3>(
      algorithm, parts_of(algorithm.conformity(), complex.store(), complex.names()));
  detail::set_stats(stats, algorithm, mesh);
  return mesh;
}

// Below 2 only the guard of mesh_statically bounds what vertices on features ask of each other.
void require_simple(const Options<3>& options, const std::string& name) {
  detail::require_no_limits(options, name);
  if (options.rho >= 2) return;
  throw Error(ErrorCode::bad_option, name + " of segments and polygons needs a rho of 2 or more");
}

template <class Settings>
void set_complex(Settings& all, const detail::CheckedComplex& complex,
                 const RefinedExtent& extent) {
  all.store = &complex.store();
  all.only_enclosed = extent.only_enclosed;
  all.holes = extent.holes;
}

}  // namespace

Mesh<3> refine(const std::vector<Point<3>>& points, const std::vector<Segment>& segments,
               const std::vector<Polygon>& polygons, const Options<3>& options,
               const RefinedExtent& extent, const RefineSettings& settings,
               const std::vector<FeatureId>& ids, RefineStats* stats, const RunControl& control) {
  require_simple(options, "refine");
  const detail::CheckedComplex complex(points, segments, polygons, options, ids, control);
  detail::ComplexRefinement::Settings all;
  all.order = settings.order;
  set_complex(all, complex, extent);
  detail::set_common(all, options, stats != nullptr, control);
  detail::ComplexRefinement algorithm(complex.box(), all);
  return run(algorithm, complex, stats);
}

Mesh<3> svr(const std::vector<Point<3>>& points, const std::vector<Segment>& segments,
            const std::vector<Polygon>& polygons, const Options<3>& options,
            const RefinedExtent& extent, const SvrSettings& settings,
            const std::vector<FeatureId>& ids, SvrStats* stats, const RunControl& control) {
  require_simple(options, "svr");
  detail::require_k(settings.k);
  const detail::CheckedComplex complex(points, segments, polygons, options, ids, control);
  detail::ComplexSvr::Settings all;
  all.k = settings.k;
  set_complex(all, complex, extent);
  detail::set_common(all, options, stats != nullptr, control);
  std::vector<Point<3>> places;
  complex.store().points().for_each([&](const detail::Vertex<3>& v) {
    if (!v.input) return;
    places.push_back(v.p);
    all.handles.push_back(v.self);
  });
  detail::ComplexSvr algorithm(complex.box(), places, all);
  return run(algorithm, complex, stats);
}

}  // namespace mesher
