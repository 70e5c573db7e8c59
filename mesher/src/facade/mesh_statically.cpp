// The static run: the program without the engine.
#include <algorithm>
#include <functional>
#include <map>
#include <string>
#include <unordered_map>

#include "facade/asking.hpp"
#include "geometry/input_point.hpp"
#include "geometry/place_hash.hpp"
#include "mesh/canonical.hpp"
#include "mesher/predicates.hpp"
#include "plane/lost_edge.hpp"
#include "plane/require_planar.hpp"
#include "program/checked_complex.hpp"
#include "program/meter.hpp"
#include "program/plane_input.hpp"
#include "program/space_input.hpp"
#include "program/timed_stats.hpp"
#include "program/world_impl.hpp"
#include "rules/mesh_box.hpp"
#include "space/parts_in_mesh.hpp"

namespace mesher {

namespace {

template <int D>
using World = detail::World<sac::PlainScope, D>;
using detail::VertexHandle;

PointId id_of(std::size_t i, const std::vector<PointId>& ids) {
  return ids.empty() ? PointId{static_cast<std::int64_t>(i + 1)} : ids[i];
}

// The handles of the points, in their order.
template <int D>
std::vector<VertexHandle> add_points(const std::vector<Point<D>>& points, const Options<D>& options,
                                     const std::vector<PointId>& ids, World<D>& world) {
  auto& features = world.features.tree();
  std::vector<VertexHandle> handles(points.size());
  for (const std::size_t i : detail::morton_order(points, world.box)) {
    const PointId id = id_of(i, ids);
    detail::check_point(points[i], options.domain, id);
    auto& v = world.vertices.add_input(points[i], true);
    if (const auto* other = features.insert_unless(v)) {
      const auto at = std::find(handles.begin(), handles.end(), other->self) - handles.begin();
      detail::fail_too_near(points[i], id, other->p, id_of(static_cast<std::size_t>(at), ids));
    }
    handles[i] = v.self;
  }
  return handles;
}

// What the features are called, by their handles.
class InputNames final : public detail::Names {
 public:
  InputNames(const std::vector<VertexHandle>& handles, const std::vector<PointId>& ids,
             std::size_t segments)
      : lines_(segments + 1) {
    for (std::size_t i = 0; i < handles.size(); ++i) {
      if (handles[i] >= points_.size()) points_.resize(std::size_t{handles[i]} + 1);
      points_[handles[i]] = id_of(i, ids);
    }
  }
  void name(const detail::Segment& s, LineId id) { lines_[s.self] = id; }
  [[nodiscard]] PointId point(VertexHandle v) const override { return points_[v]; }
  [[nodiscard]] LineId line(detail::SegmentHandle s) const override { return lines_[s]; }

 private:
  std::vector<PointId> points_;
  std::vector<LineId> lines_;
};

// Of a point by its id; 0 if there is none.
class HandlesById {
 public:
  HandlesById(const std::vector<VertexHandle>& handles, const std::vector<PointId>& ids) {
    for (std::size_t i = 0; i < handles.size(); ++i) by_id_.emplace(id_of(i, ids), handles[i]);
  }
  [[nodiscard]] VertexHandle operator()(PointId id) const {
    const auto it = by_id_.find(id);
    return it == by_id_.end() ? VertexHandle{0} : it->second;
  }
  // Nothing if there is no such point.
  template <int D>
  [[nodiscard]] std::optional<Point<D>> place(PointId id, const World<D>& world) const {
    const VertexHandle v = (*this)(id);
    return v == 0 ? std::nullopt : std::optional(world.vertices.pool()[v].p);
  }

 private:
  std::unordered_map<PointId, VertexHandle> by_id_;
};

// The segments' handles, in their order. `names`: InputNames, or SpaceInputNames.
template <int D, class AnyNames>
std::vector<detail::SegmentHandle> add_segments(const std::vector<Segment>& segments,
                                                const HandlesById& handle_of, World<D>& world,
                                                AnyNames& names) {
  std::vector<detail::SegmentHandle> added;
  for (const Segment& s : segments) {
    if (s.from == s.to) {
      detail::fail_zero_length(s.id, s.from, detail::places_of(handle_of.place(s.from, world)));
    }
    const auto end = [&](PointId id) {
      const VertexHandle v = handle_of(id);
      return v != 0 ? v : detail::fail_no_end(id, s.id);
    };
    const VertexHandle a = end(s.from), b = end(s.to);
    const auto& record = detail::add_segment(world, s.id, a, b, names);
    names.name(record, s.id);
    added.push_back(record.self);
  }
  return added;
}

// Throws: Error(cancelled) too.
std::function<void()> asking(const RunControl& control) {
  return detail::asking(control, Phase::quadtree, &detail::fail_cancelled);
}

void require_planar(World<2>& world, const std::vector<detail::SegmentHandle>& added,
                    const InputNames& names, const RunControl& control) {
  detail::PlanarityCheck(world.segments.store(), world.vertices.pool(), world.features,
                         asking(control))
      .require({added, {}}, names);
}

// Where leaves end, by place.
class LeafEnds {
 public:
  explicit LeafEnds(const World<2>& world) {
    world.vertices.pool().for_each([&](const detail::Vertex<2>& v) {
      if (v.input || v.on_segment) handles_.emplace(v.p, v.self);
    });
  }
  [[nodiscard]] VertexHandle at(const Point<2>& p) const { return handles_.at(p); }

 private:
  struct Hash {
    std::size_t operator()(const Point<2>& p) const noexcept { return detail::place_hash(p); }
  };
  std::unordered_map<Point<2>, VertexHandle, Hash> handles_;
};

detail::OnFeatures on_features(const World<2>& world, const InputNames& names) {
  detail::OnFeatures on;
  const LeafEnds ends(world);
  world.leaves.for_each([&](const detail::Leaf& leaf) {
    on.edges.push_back({ends.at(leaf.lo), ends.at(leaf.hi), names.line(leaf.piece.segment)});
  });
  return on;
}

// Of the leaves' edges, those that no triangle has are lost.
void require_edges(World<2>& world) {
  std::map<std::array<VertexHandle, 2>, const detail::Leaf*> leaves;
  const auto key = [](VertexHandle v, VertexHandle w) {
    return std::array{std::min(v, w), std::max(v, w)};
  };
  const LeafEnds ends(world);
  world.leaves.for_each(
      [&](const detail::Leaf& leaf) { leaves[key(ends.at(leaf.lo), ends.at(leaf.hi))] = &leaf; });
  world.for_each_simplex([&](const auto& t) {
    for (std::size_t i = 0; i < 3; ++i) leaves.erase(key(t[i], t[(i + 1) % 3]));
  });
  if (leaves.empty()) return;
  world.vertices.fill_tree();
  detail::LostEdge lost;
  for (const auto& [edge, leaf] : leaves) lost.look(*leaf, false);
  lost.require_none(world.vertices, world.segments.pool(), world.names);
}

template <int D>
void post_all(World<D>& world) {
  world.vertices.pool().for_each([&](detail::Vertex<D>& v) {
    if (!v.input) return;
    world.quadtree.template post_from_outside<detail::locate>(
        detail::locate_key(world.box.fixed(v.p)), detail::VertexRef<D>{&v});
  });
}

template <int D>
void watch(World<D>& world, const RunControl& control, std::size_t points) {
  if (!detail::watches(control)) return;
  detail::RunMeter<sac::PlainScope, D> meter(world, control, points);
  world.plain.next_report = 1;
  world.plain.report = [meter](detail::PlainOutput<D>& plain) mutable {
    if (!meter(plain.calls)) detail::fail_cancelled();
    plain.next_report = plain.calls + RunControl::kCallsBetween;
  };
}

// Whether a run goes on to a mesh, or ends when its input was found to be one.
enum class Purpose : bool { mesh, check };

// One static run.
template <int D>
class StaticRun {
 public:
  StaticRun(const std::vector<Point<D>>& points, const Options<D>& options,
            const std::vector<PointId>& ids, const RunControl& control, std::size_t segments,
            Purpose purpose = Purpose::mesh)
      : control_(control),
        box_((begin(points, ids, control), detail::mesh_box(options))),
        world_(options, box_for(purpose), scope_),
        handles_(add_points<D>(points, options, ids, world_)),
        names_(handles_, ids, segments) {
    world_.names = &names_;
  }

  [[nodiscard]] const detail::MeshBox<D>& box() const noexcept { return box_; }
  [[nodiscard]] World<D>& world() noexcept { return world_; }
  [[nodiscard]] const std::vector<VertexHandle>& handles() const noexcept { return handles_; }
  [[nodiscard]] InputNames& names() noexcept { return names_; }

  void refine() {
    post_all(world_);
    watch(world_, control_, handles_.size());
    scope_.template run<detail::refine<D>>();
    if (world_.vertices.pool().size() > world_.most_vertices) {
      throw world_.too_many();
    }
  }
  [[nodiscard]] Mesh<D> mesh(const detail::OnFeatures& on, MeshStats* stats) {
    std::vector<Point<D>> places;
    std::vector<VertexKind> kinds;
    places.reserve(world_.vertices.pool().size());
    kinds.reserve(world_.vertices.pool().size());
    world_.vertices.pool().for_each([&](const detail::Vertex<D>& v) {
      SAC_EXPECTS(v.self == places.size() + 1);
      places.push_back(v.p);
      kinds.push_back(v.kind());
    });
    Mesh<D> mesh = detail::canonical<D>(places, kinds, 1, on,
                                        [&](auto&& visit) { world_.for_each_simplex(visit); });
    if (stats != nullptr) *stats = detail::timed_stats(world_, mesh);
    return mesh;
  }

 private:
  static void begin(const std::vector<Point<D>>& points, const std::vector<PointId>& ids,
                    const RunControl& control) {
    SAC_EXPECTS(ids.empty() || ids.size() == points.size());
    predicates::self_test();
    detail::require_unstopped(control);
  }
  // No vertices on its sides but the corners if none are needed.
  [[nodiscard]] detail::MeshBox<D> box_for(Purpose purpose) const {
    detail::MeshBox<D> box = box_;
    if (purpose == Purpose::check) box.boundary_steps = 1;
    return box;
  }

  const RunControl& control_;
  detail::MeshBox<D> box_;
  sac::PlainScope scope_;
  World<D> world_;
  std::vector<VertexHandle> handles_;
  InputNames names_;
};

// --- In space --------------------------------------------------------------------------------

#ifndef MESHER_PLANE_ONLY
// What features are called, in a run that adds them once.
class SpaceInputNames final : public detail::SpaceNames {
 public:
  explicit SpaceInputNames(const InputNames& points) : points_(points) {}
  void name(const detail::Edge& e, LineId id) { segments_[e.self] = id; }
  void name(const detail::Polygon& f, PolygonId id) { polygons_[f.self] = id; }
  [[nodiscard]] PointId point(VertexHandle v) const override { return points_.point(v); }
  [[nodiscard]] std::optional<LineId> segment(detail::EdgeHandle e) const override {
    const auto it = segments_.find(e);
    return it == segments_.end() ? std::nullopt : std::optional(it->second);
  }
  [[nodiscard]] PolygonId polygon(detail::PolygonHandle f) const override {
    return polygons_.at(f);
  }

 private:
  const InputNames& points_;
  std::unordered_map<detail::EdgeHandle, LineId> segments_;
  std::unordered_map<detail::PolygonHandle, PolygonId> polygons_;
};
#endif

}  // namespace

template <int D>
Mesh<D> mesh_statically(const std::vector<Point<D>>& points, const Options<D>& options,
                        const std::vector<PointId>& ids, MeshStats* stats,
                        const RunControl& control) {
  StaticRun<D> run(points, options, ids, control, 0);
  run.refine();
  return run.mesh({}, stats);
}

template Mesh<2> mesh_statically<2>(const std::vector<Point<2>>&, const Options<2>&,
                                    const std::vector<PointId>&, MeshStats*, const RunControl&);
#ifndef MESHER_PLANE_ONLY
template Mesh<3> mesh_statically<3>(const std::vector<Point<3>>&, const Options<3>&,
                                    const std::vector<PointId>&, MeshStats*, const RunControl&);
#endif

namespace {

struct GraphRun : StaticRun<2> {
  GraphRun(const std::vector<Point<2>>& points, const std::vector<Segment>& segments,
           const Options<2>& options, const std::vector<PointId>& ids, const RunControl& control)
      : StaticRun<2>(points, options, ids, control, segments.size()) {
    if (segments.empty()) return;
    const HandlesById handle_of(handles(), ids);
    require_planar(world(), add_segments<2>(segments, handle_of, world(), names()), names(),
                   control);
  }
};

}  // namespace

struct detail::CheckedGraph::Run : GraphRun {
  using GraphRun::GraphRun;
};

detail::CheckedGraph::CheckedGraph(const std::vector<Point<2>>& points,
                                   const std::vector<mesher::Segment>& segments,
                                   const Options<2>& options, const std::vector<PointId>& ids,
                                   const RunControl& control)
    : run_(std::make_unique<Run>(points, segments, options, ids, control)) {}
detail::CheckedGraph::~CheckedGraph() = default;
World<2>& detail::CheckedGraph::store() const { return run_->world(); }

Mesh<2> mesh_statically(const std::vector<Point<2>>& points, const std::vector<Segment>& segments,
                        const Options<2>& options, const std::vector<PointId>& ids,
                        MeshStats* stats, const RunControl& control) {
  if (options.rule != Rule::radius_edge) {
    throw Error(ErrorCode::bad_option, "segments need the rule radius-edge");
  }
  GraphRun run(points, segments, options, ids, control);
  run.refine();
  if (run.world().leaves.may_lose()) require_edges(run.world());
  return run.mesh(on_features(run.world(), run.names()), stats);
}

#ifndef MESHER_PLANE_ONLY
namespace {

// The segments and polygons put into a run.
SpaceInputNames add_features(const std::vector<Segment>& segments,
                             const std::vector<Polygon>& polygons, const std::vector<PointId>& ids,
                             StaticRun<3>& run, const RunControl& control) {
  const HandlesById handle_of(run.handles(), ids);
  SpaceInputNames names(run.names());
  const auto edges_come = add_segments<3>(segments, handle_of, run.world(), names);
  std::vector<detail::PolygonHandle> polygons_come;
  for (const Polygon& polygon : polygons) {
    detail::require_loops(polygon, [&](PointId p) { return handle_of.place(p, run.world()); });
    const detail::Polygon& f =
        detail::add_polygon(run.world(), polygon.id, detail::parts_of(polygon, handle_of), names);
    names.name(f, polygon.id);
    polygons_come.push_back(f.self);
  }
  detail::require_fit(run.world(), edges_come, polygons_come, names, asking(control));
  return names;
}

}  // namespace

struct detail::CheckedComplex::Run {
  Run(const std::vector<Point<3>>& points, const std::vector<mesher::Segment>& segments,
      const std::vector<mesher::Polygon>& polygons, const Options<3>& options,
      const std::vector<PointId>& ids, const RunControl& control)
      : run(points, options, ids, control, 0, Purpose::check),
        names(add_features(segments, polygons, ids, run, control)) {}

  StaticRun<3> run;
  SpaceInputNames names;
};

detail::CheckedComplex::CheckedComplex(const std::vector<Point<3>>& points,
                                       const std::vector<mesher::Segment>& segments,
                                       const std::vector<mesher::Polygon>& polygons,
                                       const Options<3>& options, const std::vector<PointId>& ids,
                                       const RunControl& control)
    : run_(std::make_unique<Run>(points, segments, polygons, options, ids, control)) {}
detail::CheckedComplex::~CheckedComplex() = default;
const detail::MeshBox<3>& detail::CheckedComplex::box() const { return run_->run.box(); }
detail::FeatureStore& detail::CheckedComplex::store() const {
  return run_->run.world().plc.store();
}
const detail::SpaceNames& detail::CheckedComplex::names() const { return run_->names; }

void detail::require_complex(const std::vector<Point<3>>& points,
                             const std::vector<mesher::Segment>& segments,
                             const std::vector<mesher::Polygon>& polygons,
                             const Options<3>& options, const std::vector<PointId>& ids) {
  const RunControl control;
  StaticRun<3> run(points, options, ids, control, 0, Purpose::check);
  static_cast<void>(add_features(segments, polygons, ids, run, control));
}

Mesh<3> mesh_statically(const std::vector<Point<3>>& points, const std::vector<Segment>& segments,
                        const std::vector<Polygon>& polygons, const Options<3>& options,
                        const std::vector<PointId>& ids, MeshStats* stats,
                        const RunControl& control) {
  if (options.rule != Rule::radius_edge) {
    throw Error(ErrorCode::bad_option, "segments and polygons need the rule radius-edge");
  }
  StaticRun<3> run(points, options, ids, control, 0);
  const SpaceInputNames names = add_features(segments, polygons, ids, run, control);
  World<3>& world = run.world();
  world.feature_names = &names;
  run.refine();
  const auto& vertices = world.vertices;
  const detail::PolygonsAt all = detail::polygons_at(world.plc.store());
  std::vector<std::array<VertexHandle, 4>> simplices;
  world.for_each_simplex([&](const auto& simplex) { simplices.push_back(simplex); });
  return run.mesh(
      detail::on_features(simplices,
                          {vertices.pool(), vertices.roles(), world.plc.store(), names, {&all}}),
      stats);
}

#endif

}  // namespace mesher
