// The static run: the program without the engine.
#include <algorithm>
#include <map>
#include <string>
#include <unordered_map>

#include "facade/meter.hpp"
#include "input.hpp"
#include "mesh/canonical.hpp"
#include "mesher/predicates.hpp"
#include "program/world_impl.hpp"
#include "segments/lost_edge.hpp"

namespace mesher {

namespace {

using World = detail::World<sac::PlainScope>;
using detail::VertexHandle;

FeatureId id_of(std::size_t i, const std::vector<FeatureId>& ids) {
  return ids.empty() ? FeatureId{static_cast<std::int64_t>(i + 1)} : ids[i];
}

// The handles of the points, in their order.
std::vector<VertexHandle> add_points(const std::vector<Point<2>>& points, const Options<2>& options,
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
  return handles;
}

// What the features are called, by their handles.
class InputNames final : public detail::Names {
 public:
  InputNames(const std::vector<VertexHandle>& handles, const std::vector<FeatureId>& ids,
             std::size_t segments)
      : lines_(segments + 1) {
    for (std::size_t i = 0; i < handles.size(); ++i) {
      if (handles[i] >= points_.size()) points_.resize(std::size_t{handles[i]} + 1);
      points_[handles[i]] = id_of(i, ids);
    }
  }
  void name(detail::SegmentHandle s, FeatureId id) { lines_[s] = id; }
  [[nodiscard]] FeatureId point(VertexHandle v) const override { return points_[v]; }
  [[nodiscard]] FeatureId line(detail::SegmentHandle s) const override { return lines_[s]; }

 private:
  std::vector<FeatureId> points_, lines_;
};

// The segments' handles, in their order.
std::vector<detail::SegmentHandle> add_segments(const std::vector<Segment>& segments,
                                                const std::vector<FeatureId>& ids,
                                                const std::vector<VertexHandle>& handles,
                                                World& world, InputNames& names) {
  std::unordered_map<FeatureId, VertexHandle> by_id;
  for (std::size_t i = 0; i < handles.size(); ++i) by_id.emplace(id_of(i, ids), handles[i]);
  std::vector<detail::SegmentHandle> added;
  for (const Segment& s : segments) {
    if (s.from == s.to) detail::fail_zero_length(s.id, s.from);
    const auto end = [&](FeatureId id) {
      const auto it = by_id.find(id);
      return it != by_id.end() ? it->second : detail::fail_no_end(id, s.id);
    };
    const VertexHandle a = end(s.from), b = end(s.to);
    if (const auto* same = world.segments.store().find(a, b)) {
      detail::fail_repeated(s.id, names.line(same->self), *same);
    }
    const detail::PieceRef all = world.segments.insert(a, b);
    added.push_back(all.piece.segment);
    names.name(added.back(), s.id);
    world.splits.post_from_outside<detail::split_segment>(detail::split_segment_key(world.box, all),
                                                          all);
  }
  return added;
}

void require_planar(World& world, const std::vector<detail::SegmentHandle>& added,
                    const InputNames& names) {
  auto& store = world.segments.store();
  for (const detail::SegmentHandle h : added) {
    const auto conflict = detail::conflict_of(store[h], store, world.features);
    if (conflict) detail::fail(*conflict, names);
  }
}

std::vector<detail::LineEdge> line_edges(const World& world, const InputNames& names) {
  std::vector<detail::LineEdge> edges;
  const auto& tree = world.vertices.tree();
  world.leaves.for_each([&](const detail::Leaf& leaf) {
    edges.push_back(
        {tree.find(leaf.lo)->self, tree.find(leaf.hi)->self, names.line(leaf.piece.segment)});
  });
  return edges;
}

// Of the leaves' edges, those that no triangle has are lost.
void require_edges(const World& world) {
  std::map<std::array<VertexHandle, 2>, const detail::Leaf*> leaves;
  const auto key = [](VertexHandle v, VertexHandle w) {
    return std::array{std::min(v, w), std::max(v, w)};
  };
  const auto& tree = world.vertices.tree();
  world.leaves.for_each([&](const detail::Leaf& leaf) {
    leaves[key(tree.find(leaf.lo)->self, tree.find(leaf.hi)->self)] = &leaf;
  });
  for (const auto& t : world.plain.triangles) {
    for (std::size_t i = 0; i < 3; ++i) leaves.erase(key(t[i], t[(i + 1) % 3]));
  }
  detail::LostEdge lost;
  for (const auto& [ends, leaf] : leaves) lost.look(*leaf, false);
  lost.require_none(world.vertices, world.segments.pool(), world.names);
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
  InputNames names(handles, ids, segments.size());
  world.names = &names;
  if (!segments.empty()) {
    require_planar(world, add_segments(segments, ids, handles, world, names), names);
  }
  post_all(world);
  watch(world, control, points.size());
  scope.run<detail::refine>();
  if (world.vertices.pool().size() > world.most_vertices) {
    throw detail::too_many_vertices(world.vertices, world.names, world.most_vertices);
  }
  if (world.leaves.may_lose()) require_edges(world);
  std::vector<VertexHandle> vertices;
  world.vertices.pool().for_each([&](detail::Vertex<2>& v) { vertices.push_back(v.self); });
  Mesh<2> mesh = detail::canonical(world.vertices.pool(), std::move(vertices),
                                   world.plain.triangles, line_edges(world, names));
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
