// From a graph or a complex to a mesh.
#include <algorithm>
#include <unordered_map>

#include "program/checked_complex.hpp"
#include "refinement/delaunay_refinement.hpp"
#include "refinement/from_points.hpp"
#include "refinement/refine.hpp"
#include "refinement/refinement.hpp"
#include "refinement/svr.hpp"

namespace mesher {

namespace {

#ifndef MESHER_PLANE_ONLY
// What edges are called: as in the meshes of mesh_statically.
class EdgeNames {
 public:
  EdgeNames(const detail::FeatureStore& store, const detail::SpaceNames& names) : names_(names) {
    store.polygons().for_each([&](const detail::Polygon& f) {
      if (!f.alive) return;
      const PolygonId id = names.polygon(f.self);
      for (const detail::EdgeHandle e : f.all_edges) {
        const auto [it, is_new] = least_.try_emplace(e, id);
        if (!is_new && id < it->second) it->second = id;
      }
    });
  }
  [[nodiscard]] detail::LineEdge operator()(const detail::Subedges::Piece& p) const {
    const auto [low, high] = std::minmax(p.a, p.b);
    if (const auto id = names_.segment(p.edge)) return {low, high, *id, p.edge};
    return {low, high, least_.at(p.edge), p.edge};
  }

 private:
  const detail::SpaceNames& names_;
  std::unordered_map<detail::EdgeHandle, PolygonId> least_;
};

detail::OnFeatures parts_of(const detail::Conformity& all, const detail::FeatureStore& store,
                            const detail::SpaceNames& names) {
  detail::OnFeatures on;
  const EdgeNames name(store, names);
  for (std::uint32_t i = 0; i < all.pieces().size(); ++i) {
    on.edges.push_back(name(all.pieces()[i]));
  }
  all.tiles().for_each([&](const detail::Tiles::Tile& tile) {
    on.faces.push_back({tile.face, names.polygon(all.polygon_of(tile).self)});
  });
  return on;
}

const auto& points_of(const detail::FeatureStore& store) { return store.points(); }
#endif

detail::OnFeatures parts_of(const detail::PlaneConformity& all,
                            const detail::PlaneConformity::Store&, const detail::Names& names) {
  detail::OnFeatures on;
  for (std::uint32_t i = 0; i < all.pieces().size(); ++i) {
    const auto& piece = all.pieces()[i];
    on.edges.push_back({piece.a, piece.b, names.line(piece.edge)});
  }
  return on;
}

// Below these only the guard of mesh_statically bounds what vertices on features ask of each other.
template <int D>
void require_simple(const Options<D>& options, const std::string& name) {
  detail::require_radius_edge(options, name);
  if (options.rho >= Options<D>().rho) return;
  const char* what = D == 2 ? " of segments needs a rho of 1.4142 or more"
                            : " of segments and polygons needs a rho of 2 or more";
  throw Error(ErrorCode::bad_option, name + what);
}

// The check is that of gap-balls, which does not know all options.
template <int D>
Options<D> checked_options(Options<D> options) {
  options.min_dihedral = {};
  options.growth = 0;
  return options;
}

const auto& points_of(const detail::PlaneConformity::Store& store) { return store.vertices.pool(); }

// What an Algorithm makes of what was checked. `settings`: but for what is in the others.
template <class Algorithm, int D, class Checked, class Stats>
Mesh<D> run(const Checked& checked, const Options<D>& options, const RefinedExtent<D>& extent,
            typename Algorithm::Settings settings, Stats* stats, const RunControl& control) {
  settings.store = &checked.store();
  if constexpr (D == 3) settings.names = &checked.names();
  settings.thorough = false;
  settings.only_enclosed = extent.only_enclosed;
  settings.holes = extent.holes;
  settings.regions = extent.regions;
  for (const auto& region : extent.regions) {
    settings.least_limit = std::min(settings.least_limit, region.max_measure);
  }
  std::vector<Point<D>> places;
  points_of(checked.store()).for_each([&](const detail::Vertex<D>& v) {
    if (!v.input) return;
    places.push_back(v.p);
    settings.handles.push_back(v.self);
  });
  detail::set_common(settings, options, checked.box(), stats != nullptr, control);
  return detail::refined_in<Algorithm, D>(
      checked.box(), places, settings, [&](const Algorithm& algorithm) {
        if constexpr (D == 3) algorithm.conformity().require_whole();
        Mesh<D> mesh = detail::mesh_of<D>(
            algorithm, parts_of(algorithm.conformity(), checked.store(), checked.names()));
        detail::set_stats(stats, algorithm, mesh);
        return mesh;
      });
}

}  // namespace

Mesh<2> refine(const std::vector<Point<2>>& points, const std::vector<Segment>& segments,
               const Options<2>& options, const RefinedExtent<2>& extent,
               const RefineSettings& settings, const std::vector<PointId>& ids, RefineStats* stats,
               const RunControl& control) {
  if (segments.empty()) return refine<2>(points, options, settings, ids, stats, control);
  require_simple(options, "refine");
  const detail::CheckedGraph graph(points, segments, checked_options(options), ids, control);
  return run<detail::ComplexRefinement<2>>(graph, options, extent, {{}, settings.order}, stats,
                                           control);
}

Mesh<2> svr(const std::vector<Point<2>>& points, const std::vector<Segment>& segments,
            const Options<2>& options, const RefinedExtent<2>& extent, const SvrSettings& settings,
            const std::vector<PointId>& ids, SvrStats* stats, const RunControl& control) {
  if (segments.empty()) return svr<2>(points, options, settings, ids, stats, control);
  require_simple(options, "svr");
  detail::require_k(settings.k);
  const detail::CheckedGraph graph(points, segments, checked_options(options), ids, control);
  return run<detail::ComplexSvr<2>>(graph, options, extent, {{}, settings.k}, stats, control);
}

#ifndef MESHER_PLANE_ONLY
Mesh<3> refine(const std::vector<Point<3>>& points, const std::vector<Segment>& segments,
               const std::vector<Polygon>& polygons, const Options<3>& options,
               const RefinedExtent<3>& extent, const RefineSettings& settings,
               const std::vector<PointId>& ids, RefineStats* stats, const RunControl& control) {
  require_simple(options, "refine");
  const detail::CheckedComplex complex(points, segments, polygons, checked_options(options), ids,
                                       control);
  return run<detail::ComplexRefinement<3>>(complex, options, extent, {{}, settings.order}, stats,
                                           control);
}

Mesh<3> svr(const std::vector<Point<3>>& points, const std::vector<Segment>& segments,
            const std::vector<Polygon>& polygons, const Options<3>& options,
            const RefinedExtent<3>& extent, const SvrSettings& settings,
            const std::vector<PointId>& ids, SvrStats* stats, const RunControl& control) {
  require_simple(options, "svr");
  detail::require_k(settings.k);
  const detail::CheckedComplex complex(points, segments, polygons, checked_options(options), ids,
                                       control);
  return run<detail::ComplexSvr<3>>(complex, options, extent, {{}, settings.k}, stats, control);
}
#endif

}  // namespace mesher
