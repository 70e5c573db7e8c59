// From points to a mesh, by way of their triangulation.
#include "refinement/refine.hpp"

#include "refinement/delaunay_refinement.hpp"
#include "refinement/from_points.hpp"

namespace mesher {

template <int D>
Mesh<D> refine(const std::vector<Point<D>>& points, const Options<D>& options,
               const RefineSettings& settings, const std::vector<PointId>& ids, RefineStats* stats,
               const RunControl& control) {
  SAC_EXPECTS(ids.empty() || ids.size() == points.size());
  predicates::self_test();
  detail::require_unstopped(control);
  detail::require_radius_edge(options, "refine");
  if (settings.strict) {
    return detail::mesh_points<detail::StrictRefinement, D>(points, options, {{}, settings.order},
                                                            ids, stats, control);
  }
  return detail::mesh_points<detail::BucketedRefinement, D>(points, options, {{}, settings.order},
                                                            ids, stats, control);
}

template Mesh<2> refine<2>(const std::vector<Point<2>>&, const Options<2>&, const RefineSettings&,
                           const std::vector<PointId>&, RefineStats*, const RunControl&);
#ifndef MESHER_PLANE_ONLY
template Mesh<3> refine<3>(const std::vector<Point<3>>&, const Options<3>&, const RefineSettings&,
                           const std::vector<PointId>&, RefineStats*, const RunControl&);
#endif

}  // namespace mesher
