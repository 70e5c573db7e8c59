// From points to a mesh.
#include "mesher/svr.hpp"

#include "svr/from_points.hpp"
#include "svr/refinement.hpp"

namespace mesher {

template <int D>
Mesh<D> svr(const std::vector<Point<D>>& points, const Options<D>& options,
            const SvrSettings& settings, const std::vector<FeatureId>& ids, SvrStats* stats,
            const RunControl& control) {
  SAC_EXPECTS(ids.empty() || ids.size() == points.size());
  predicates::self_test();
  detail::require_unstopped(control);
  detail::require_k(settings.k);
  detail::require_no_limits(options, "svr");
  return detail::mesh_points<detail::PointRefinement, D>(points, options, {{}, settings.k}, ids, stats,
                                                    control);
}

template Mesh<2> svr<2>(const std::vector<Point<2>>&, const Options<2>&, const SvrSettings&,
                        const std::vector<FeatureId>&, SvrStats*, const RunControl&);
template Mesh<3> svr<3>(const std::vector<Point<3>>&, const Options<3>&, const SvrSettings&,
                        const std::vector<FeatureId>&, SvrStats*, const RunControl&);

}  // namespace mesher
