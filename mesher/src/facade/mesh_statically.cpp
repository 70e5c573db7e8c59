// The static run: the program without the engine.
#include <algorithm>

#include "facade/meter.hpp"
#include "input.hpp"
#include "mesh/canonical.hpp"
#include "mesher/predicates.hpp"
#include "program/world_impl.hpp"

namespace mesher {

namespace {

using World = detail::World<sac::PlainScope>;
using detail::VertexHandle;

FeatureId id_of(std::size_t i, const std::vector<FeatureId>& ids) {
  return ids.empty() ? FeatureId{static_cast<std::int64_t>(i + 1)} : ids[i];
}

void add_points(const std::vector<Point<2>>& points, const Options<2>& options,
                const std::vector<FeatureId>& ids, World& world) {
  auto& features = world.features.tree();
  std::vector<VertexHandle> handles(points.size());
  for (const std::size_t i : detail::morton_order(points, world.box)) {
    const FeatureId id = id_of(i, ids);
    detail::check_point(points[i], options.domain, id);
    if (const auto* other = features.obstacle(points[i])) {
      const auto at = std::find(handles.begin(), handles.end(), other->self) - handles.begin();
      detail::fail_too_near(points[i], id, other->p, id_of(static_cast<std::size_t>(at), ids));
    }
    auto& v = world.vertices.add_input(points[i], true);
    handles[i] = v.self;
    features.insert_only(v);
  }
}

void post_all(World& world) {
  world.vertices.pool().for_each([&](detail::Vertex<2>& v) {
    if (!v.input) return;
    v.level = static_cast<std::int16_t>(world.features.tree().crowded_level(v));
    world.quadtree.post_from_outside<detail::locate>(detail::locate_key(world.box.fixed(v.p)),
                                                     detail::VertexRef<2>{&v});
  });
}

void watch(World& world, const RunControl& control, std::size_t points) {
  if (!detail::watches(control)) return;
  detail::RunMeter<sac::PlainScope> meter(world, control, points);
  world.plain.next_report = 1;
  world.plain.report = [meter](detail::PlainOutput& plain) mutable {
    if (!meter(plain.calls)) detail::fail_cancelled();
    plain.next_report = plain.calls + RunControl::kCallsBetween;
  };
}

}  // namespace

template <int D>
Mesh<D> mesh_statically(const std::vector<Point<D>>& points, const Options<D>& options,
                        const std::vector<FeatureId>& ids, MeshStats* stats,
                        const RunControl& control) {
  static_assert(D == 2);
  SAC_EXPECTS(ids.empty() || ids.size() == points.size());
  predicates::self_test();
  detail::require_unstopped(control);
  const detail::MeshBox<2> box = detail::mesh_box(options);
  sac::PlainScope scope;
  World world(options, box, scope);
  add_points(points, options, ids, world);
  post_all(world);
  watch(world, control, points.size());
  scope.run<detail::refine>();
  std::vector<VertexHandle> vertices;
  world.vertices.pool().for_each([&](detail::Vertex<2>& v) { vertices.push_back(v.self); });
  Mesh<2> mesh =
      detail::canonical(world.vertices.pool(), std::move(vertices), world.plain.triangles);
  if (stats != nullptr) *stats = detail::timed_stats(world, mesh);
  return mesh;
}

template Mesh<2> mesh_statically<2>(const std::vector<Point<2>>&, const Options<2>&,
                                    const std::vector<FeatureId>&, MeshStats*, const RunControl&);

}  // namespace mesher
