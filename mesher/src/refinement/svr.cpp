// From points to a mesh.
#include "refinement/svr.hpp"

#include "refinement/ball_location.hpp"
#include "refinement/from_points.hpp"
#include "refinement/refinement.hpp"
#include "refinement/shell_lists.hpp"
#include "refinement/simplex_location.hpp"

namespace mesher {

namespace {

template <class Location>
struct With {
  template <int D>
  using Algorithm = detail::Refinement<D, detail::RefinedMesh<D>, Location>;
};

}  // namespace

template <int D>
Mesh<D> svr(const std::vector<Point<D>>& points, const Options<D>& options,
            const SvrSettings& settings, const std::vector<PointId>& ids, SvrStats* stats,
            const RunControl& control) {
  SAC_EXPECTS(ids.empty() || ids.size() == points.size());
  predicates::self_test();
  detail::require_unstopped(control);
  detail::require_k(settings.k);
  detail::require_radius_edge(options, "svr");
  const auto by = [&]<class Location>() {
    return detail::mesh_points<With<Location>::template Algorithm, D>(
        points, options, {{}, settings.k}, ids, stats, control);
  };
  using namespace detail;
  switch (settings.location) {
    case PointLocation::voronoi:
      return by.template operator()<VoronoiLocation<D, VoronoiLists<D>>>();
    case PointLocation::voronoi_shells:
      return by.template operator()<VoronoiLocation<D, ShellLists<D>>>();
    case PointLocation::simplex:
      return by.template operator()<SimplexLocation<D>>();
    case PointLocation::circumball:
      return by.template operator()<BallLocation<D>>();
  }
  throw Error(ErrorCode::bad_option, "no such structure for point location");
}

template Mesh<2> svr<2>(const std::vector<Point<2>>&, const Options<2>&, const SvrSettings&,
                        const std::vector<PointId>&, SvrStats*, const RunControl&);
#ifndef MESHER_PLANE_ONLY
template Mesh<3> svr<3>(const std::vector<Point<3>>&, const Options<3>&, const SvrSettings&,
                        const std::vector<PointId>&, SvrStats*, const RunControl&);
#endif

}  // namespace mesher
