// The static run: the program without the engine.
#include <algorithm>
#include <string>
#include <unordered_map>

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

// The handles of the points, in their order.
std::vector<VertexHandle> add_points(const std::vector<Point<2>>& points,
                                     const Options<2>& options, const std::vector<FeatureId>& ids,
                                     World& world) {
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
  return handles;
}

using Lines = std::vector<FeatureId>;  // ids by the handles of segments

Lines add_segments(const std::vector<Segment>& segments, const std::vector<FeatureId>& ids,
                   const std::vector<VertexHandle>& handles, World& world) {
  std::unordered_map<FeatureId, VertexHandle> by_id;
  for (std::size_t i = 0; i < handles.size(); ++i) by_id.emplace(id_of(i, ids), handles[i]);
  const auto find = [&](FeatureId id) {
    const auto it = by_id.find(id);
    if (it != by_id.end()) return it->second;
    throw Error(ErrorCode::unknown_id,
                "point " + std::to_string(static_cast<std::int64_t>(id)) + " is not there", {}, {id});
  };
  Lines lines(segments.size() + 1);
  for (const Segment& s : segments) {
    const detail::PieceRef all = world.segments.insert(find(s.from), find(s.to));
    lines[all.piece.segment] = s.id;
    world.splits.post_from_outside<detail::split_segment>(
        detail::split_segment_key(world.box, all), all);
  }
  return lines;
}

std::vector<detail::LineEdge> line_edges(const World& world, const Lines& lines) {
  std::vector<detail::LineEdge> edges;
  const auto& tree = world.vertices.tree();
  world.leaves.for_each([&](const detail::Leaf& leaf) {
    edges.push_back(
        {tree.find(leaf.lo)->self, tree.find(leaf.hi)->self, lines[leaf.piece.segment]});
  });
  return edges;
}

void post_all(World& world) {
  world.vertices.pool().for_each([&](detail::Vertex<2>& v) {
    if (!v.input) return;
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

Mesh<2> run(const std::vector<Point<2>>& points, const std::vector<Segment>& segments,
            const Options<2>& options, const std::vector<FeatureId>& ids, MeshStats* stats,
            const RunControl& control) {
  SAC_EXPECTS(ids.empty() || ids.size() == points.size());
  predicates::self_test();
  detail::require_unstopped(control);
  const detail::MeshBox<2> box = detail::mesh_box(options);
  sac::PlainScope scope;
  World world(options, box, scope);
  const std::vector<VertexHandle> handles = add_points(points, options, ids, world);
  Lines lines;
  if (!segments.empty()) lines = add_segments(segments, ids, handles, world);
  post_all(world);
  watch(world, control, points.size());
  scope.run<detail::refine>();
  std::vector<VertexHandle> vertices;
  world.vertices.pool().for_each([&](detail::Vertex<2>& v) { vertices.push_back(v.self); });
  Mesh<2> mesh = detail::canonical(world.vertices.pool(), std::move(vertices),
                                   world.plain.triangles, line_edges(world, lines));
  if (stats != nullptr) *stats = detail::timed_stats(world, mesh);
  return mesh;
}

}  // namespace

template <int D>
Mesh<D> mesh_statically(const std::vector<Point<D>>& points, const Options<D>& options,
                        const std::vector<FeatureId>& ids, MeshStats* stats,
                        const RunControl& control) {
  static_assert(D == 2);
  return run(points, {}, options, ids, stats, control);
}

template Mesh<2> mesh_statically<2>(const std::vector<Point<2>>&, const Options<2>&,
                                    const std::vector<FeatureId>&, MeshStats*, const RunControl&);

Mesh<2> mesh_statically(const std::vector<Point<2>>& points, const std::vector<Segment>& segments,
                        const Options<2>& options, const std::vector<FeatureId>& ids,
                        MeshStats* stats, const RunControl& control) {
  if (options.rule != Rule::radius_edge) {
    throw Error(ErrorCode::bad_option, "segments need the rule radius_edge");
  }
  return run(points, segments, options, ids, stats, control);
}

}  // namespace mesher
