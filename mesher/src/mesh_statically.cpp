// The static run, and putting a mesh into canonical form.
#include <algorithm>
#include <numeric>

#include "mesh/canonical.hpp"
#include "input.hpp"
#include "mesher/predicates.hpp"
#include "program/world_impl.hpp"

namespace mesher {

using detail::VertexHandle;

template <int D>
Mesh<D> mesh_statically(const std::vector<Point<D>>& points, const Options<D>& options,
                        const std::vector<FeatureId>& ids, MeshStats* stats) {
  static_assert(D == 2);
  predicates::self_test();
  const detail::MeshBox<2> box = detail::mesh_box(options);
  sac::PlainScope scope;
  detail::World<sac::PlainScope> world(options, box, scope);
  auto& features = world.features.tree();
  std::vector<VertexHandle> handles(points.size());
  for (const std::size_t i : detail::morton_order(points, box)) {
    const FeatureId id = ids.empty() ? FeatureId{static_cast<std::int64_t>(i + 1)} : ids[i];
    detail::check_point(points[i], options.domain, id);
    if (const auto* other = features.obstacle(points[i])) {
      const auto h = std::find(handles.begin(), handles.end(), other->self) - handles.begin();
      detail::fail_too_near(points[i], id, other->p,
                            ids.empty() ? FeatureId{h + 1} : ids[static_cast<std::size_t>(h)]);
    }
    auto& v = world.vertices.add_input(points[i], true);
    handles[i] = v.self;
    features.insert_only(v);
  }
  world.vertices.pool().for_each([&](detail::Vertex<2>& v) {
    if (!v.input) return;
    v.level = static_cast<std::int16_t>(features.crowded_level(v));
    world.quadtree.post_from_outside<detail::locate>(detail::locate_key(box.fixed(v.p)),
                                                     detail::VertexRef<2>{&v});
  });
  scope.run<detail::refine>();
  std::vector<VertexHandle> vertices;
  world.vertices.pool().for_each([&](detail::Vertex<2>& v) { vertices.push_back(v.self); });
  Mesh<2> mesh =
      detail::canonical(world.vertices.pool(), std::move(vertices), world.plain.triangles);
  if (stats != nullptr) *stats = detail::timed_stats(world, mesh);
  return mesh;
}

template Mesh<2> mesh_statically<2>(const std::vector<Point<2>>&, const Options<2>&,
                                    const std::vector<FeatureId>&, MeshStats*);

}  // namespace mesher
