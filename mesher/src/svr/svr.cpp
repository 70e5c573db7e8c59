// From points to a mesh.
#include "mesher/svr.hpp"

#include <span>
#include <string>

#include "facade/meter.hpp"
#include "io/text.hpp"
#include "mesh/canonical.hpp"
#include "mesher/predicates.hpp"
#include "svr/distinct_order.hpp"
#include "svr/refinement.hpp"

namespace mesher {

namespace {

[[noreturn]] void refuse(const std::string& what) { throw Error(ErrorCode::bad_option, what); }

template <int D>
void check(const Options<D>& options, const SvrSettings& settings) {
  if (!(settings.k > 0) || !(settings.k < 1)) {
    refuse("k is " + text::to_text(settings.k) + ", it must be between 0 and 1");
  }
  if (options.rule != Rule::radius_edge) refuse("svr needs the rule radius-edge");
  if (options.max_area != 0 || options.sizes != nullptr || !options.box_limits.empty() ||
      options.region_limits != nullptr) {
    refuse("svr knows no limits of size");
  }
}

template <int D>
Mesh<D> mesh_of(const detail::Refinement<D>& refinement) {
  const auto& kernel = refinement.kernel();
  const auto& store = kernel.simplices();
  std::vector<typename Mesh<D>::Simplex> simplices;
  simplices.reserve(store.size());
  for (std::uint32_t s = 0; s < store.places(); ++s) {
    if (store.alive(s) && !kernel.is_ghost(s)) simplices.push_back(store.corners(s));
  }
  std::vector<Point<D>> places;
  places.reserve(kernel.places());
  for (std::uint32_t v = 1; v <= kernel.places(); ++v) places.push_back(kernel.place(v));
  return detail::canonical<D>(places, std::span(refinement.kinds()).subspan(1), 1, simplices);
}

}  // namespace

template <int D>
Mesh<D> svr(const std::vector<Point<D>>& points, const Options<D>& options,
            const SvrSettings& settings, const std::vector<FeatureId>& ids, SvrStats* stats,
            const RunControl& control) {
  SAC_EXPECTS(ids.empty() || ids.size() == points.size());
  predicates::self_test();
  detail::require_unstopped(control);
  check(options, settings);
  const detail::MeshBox<D> box = detail::mesh_box(options);
  typename detail::Refinement<D>::Settings how{
      .rho = options.rho,
      .k = settings.k,
      .most_vertices = options.max_vertices,
      .follow_degrees = stats != nullptr,
  };
  if (detail::watches(control)) {
    how.watch = [&](std::size_t vertices) {
      if (!detail::report(control, {.phase = Phase::steiner, .done = vertices})) {
        detail::fail_cancelled();
      }
    };
  }
  detail::Refinement<D> refinement(
      box, detail::in_distinct_order<D>(points, ids, options.domain, box), how);
  refinement.run();
  Mesh<D> mesh = mesh_of(refinement);
  if (stats != nullptr) {
    *stats = refinement.stats();
    stats->vertices = mesh.vertices.size();
    stats->simplices = mesh.simplices.size();
  }
  return mesh;
}

template Mesh<2> svr<2>(const std::vector<Point<2>>&, const Options<2>&, const SvrSettings&,
                        const std::vector<FeatureId>&, SvrStats*, const RunControl&);
template Mesh<3> svr<3>(const std::vector<Point<3>>&, const Options<3>&, const SvrSettings&,
                        const std::vector<FeatureId>&, SvrStats*, const RunControl&);

}  // namespace mesher
