// mesh(): which algorithm, and where limits of size count.
#include "mesher/meshing.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "facade/graph_runs.hpp"
#include "facade/settled.hpp"
#include "geometry/input_point.hpp"
#include "graph/require_ids.hpp"
#include "space/space_budget.hpp"

namespace mesher {

namespace {

constexpr double kRadians = std::numbers::pi / 180;

// What may enclose something.
template <int D>
bool has_walls(const Graph<D>& graph) {
  if constexpr (D == 3) return !graph.polygons.empty();
  return has_features(graph);
}

template <int D>
bool has_limits(const Options<D>& o) {
  return o.max_measure != 0 || o.sizes != nullptr || !o.box_limits.empty();
}

template <int D>
bool limits_regions(const Graph<D>& graph, const Options<D>& o) {
  if (o.region_areas == RegionAreas::limits) return true;
  return has_limits(o) && o.extent == Extent::enclosed && has_walls(graph);
}

template <int D>
Options<D> with_region_limits(const Graph<D>& graph, Options<D> options) {
  if (limits_regions(graph, options)) {
    options.region_limits = region_limits(graph, options, options.extent, options.region_areas);
  }
  return options;
}

// The fastest that knows what is asked for. In the plane refine takes as long as svr, for fewer
// vertices; in space the triangulation of all points may be large.
template <int D>
Algorithm fastest(const Graph<D>& graph, const Options<D>& o) {
  const bool low = has_features(graph) && o.rho < Options<D>{}.rho;
  if (low || o.rule != Rule::radius_edge) {
    return Algorithm::gap_balls;
  }
  const bool refines = D == 2 || (!has_features(graph) && are_evenly_spread<D>(places_of(graph)));
  return refines ? Algorithm::refine : Algorithm::svr;
}

template <int D>
Mesh<D> run(Algorithm algorithm, const Graph<D>& graph, const Options<D>& options,
            RunReport& report, const RunControl& control, bool refinement) {
  report.algorithm = algorithm;
  report.refinement.reset();
  if (algorithm == Algorithm::gap_balls) {
    return mesh_statically(graph, with_region_limits(graph, options), &report.stats, control);
  }
  SvrStats stats;
  SvrStats* const wanted = refinement ? &stats : nullptr;
  Mesh<D> mesh = algorithm == Algorithm::svr
                     ? svr(graph, options, options.extent, {}, wanted, control)
                     : refine(graph, options, options.extent, {}, wanted, control);
  report.stats.vertices = mesh.vertices.size();
  report.stats.simplices = mesh.simplices.size();
  if (refinement) report.refinement = stats;
  return mesh;
}

// How many vertices gap-balls may make where the first choice has found features too close: in
// space it may go on and on there, for minutes.
template <int D>
std::size_t most_after(const Graph<D>& graph, const Options<D>& options) {
  if (D == 2 || !has_features(graph)) return options.max_vertices;
  const std::size_t most = 20 * graph.points.size() + 10000;
  return options.max_vertices == 0 ? most : std::min(most, options.max_vertices);
}

// What is tried in turn: where svr finds features too close, at tiny angles of some, refine may
// not, since it knows all points from the start.
template <int D>
std::vector<Algorithm> choices(const Graph<D>& graph, const Options<D>& options) {
  std::vector<Algorithm> all{fastest(graph, options)};
  if (D == 3 && has_features(graph) && all[0] == Algorithm::svr) all.push_back(Algorithm::refine);
  // It does not know limits of growth.
  if (options.growth == 0 && all[0] != Algorithm::gap_balls) all.push_back(Algorithm::gap_balls);
  return all;
}

template <int D>
Mesh<D> run_fastest(const Graph<D>& graph, const Options<D>& options, RunReport& report,
                    const RunControl& control, bool refinement) {
  const std::vector<Algorithm> all = choices(graph, options);
  for (std::size_t i = 0; i + 1 < all.size(); ++i) {
    try {
      return run(all[i], graph, options, report, control, refinement);
    } catch (const detail::SurelyTooMany&) {
      throw;
    } catch (const Error& error) {
      if (error.code() != ErrorCode::too_close && error.code() != ErrorCode::too_many) throw;
      if (report.gave_up) continue;
      report.tried = all[i];
      report.gave_up = error;
    }
  }
  const Algorithm last = all.back();
  Options<D> bounded = options;
  if (report.gave_up && last == Algorithm::gap_balls) {
    bounded.max_vertices = most_after(graph, options);
  }
  try {
    return run(last, graph, bounded, report, control, refinement);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::too_many) throw;
    if (bounded.max_vertices == options.max_vertices) throw;
    throw report.gave_up->with_message(report.gave_up->message() + "; gap-balls needs more than " +
                                       std::to_string(bounded.max_vertices) + " vertices there");
  }
}

}  // namespace

std::string_view name_of(Algorithm algorithm) noexcept {
  switch (algorithm) {
    case Algorithm::refine:
      return "refine";
    case Algorithm::svr:
      return "svr";
    case Algorithm::gap_balls:
      return "gap-balls";
    case Algorithm::automatic:
      break;
  }
  return "auto";
}

template <int D>
double radius_edge_bound(const Options<D>& options) {
  return options.min_angle > 0 ? 1 / (2 * std::sin(options.min_angle * kRadians)) : options.rho;
}

template <int D>
Options<D> detail::settled(Options<D> options) {
  if (!(options.min_angle >= 0 && options.min_angle <= kLargestMinAngle)) {
    throw Error(ErrorCode::bad_option, "min_angle must be 0, for none, or up to 29.6 degrees");
  }
  if constexpr (D == 3) {
    if (!(options.min_dihedral >= 0 && options.min_dihedral <= kLargestMinDihedral)) {
      throw Error(ErrorCode::bad_option, "min_dihedral must be 0, for none, or up to 20 degrees");
    }
  }
  if (options.growth != 0 && !(options.growth >= kLeastGrowth && options.growth <= kMostGrowth)) {
    throw Error(ErrorCode::bad_option, "growth must be 0, for any, or from 1.05 to 100");
  }
  options.rho = radius_edge_bound(options);
  options.min_angle = 0;
  return options;
}

template <int D>
Mesh<D> box_mesh(const Graph<D>& graph, const Options<D>& options, RunReport* report,
                 const RunControl& control, bool refinement) {
  Options<D> settled = detail::settled(options);
  detail::require_ids(graph);
  if (settled.domain == Box<D>{}) {
    for (const auto& p : graph.points) detail::check_coordinates(p.at, p.id);
    settled.domain = snapped_domain<D>(places_of(graph));
  }
  settled.region_limits.reset();  // those of a Mesher's options are of another graph
  RunReport made;
  Mesh<D> mesh = settled.algorithm == Algorithm::automatic
                     ? run_fastest(graph, settled, made, control, refinement)
                     : run(settled.algorithm, graph, settled, made, control, refinement);
  if (report != nullptr) *report = std::move(made);
  return mesh;
}

template <int D>
Meshed<D> mesh(const Graph<D>& graph, const Options<D>& options, const RunControl& control) {
  Meshed<D> made;
  Mesh<D> all = box_mesh(graph, options, &made.report, control);
  static_cast<DomainMesh<D>&>(made) = domain_mesh(std::move(all), graph, options.extent);
  return made;
}

#define MESHER_INSTANTIATE(D)                                                                  \
  template double radius_edge_bound(const Options<D>&);                                        \
  template Options<D> detail::settled(Options<D>);                                             \
  template Mesh<D> box_mesh(const Graph<D>&, const Options<D>&, RunReport*, const RunControl&, \
                            bool);                                                             \
  template Meshed<D> mesh(const Graph<D>&, const Options<D>&, const RunControl&)

MESHER_INSTANTIATE(2);
#ifndef MESHER_PLANE_ONLY
MESHER_INSTANTIATE(3);
#endif
#undef MESHER_INSTANTIATE

}  // namespace mesher
