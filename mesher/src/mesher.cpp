// The facade: ids and edits on one side, the program's world on the other.
#include "mesher/mesher.hpp"

#include <algorithm>
#include <cstdlib>
#include <unordered_map>

#include "mesh/canonical.hpp"
#include "input.hpp"
#include "mesher/predicates.hpp"
#include "program/world_impl.hpp"

namespace mesher {

namespace {

using detail::Vertex;
using detail::VertexHandle;
using detail::VertexRef;
using Triangle = std::array<VertexHandle, 3>;

std::string text(FeatureId id) { return std::to_string(static_cast<std::int64_t>(id)); }

CallCounts call_counts(const sac::Counts& c) {
  return {c.executed, c.reused, c.created, c.discarded, c.edges_made + c.edges_removed,
          c.weight};
}

}  // namespace

template <>
struct Mesher<2>::Impl {
  explicit Impl(const Options<2>& o)
      : options(o),
        box(detail::mesh_box(o)),
        engine(std::make_unique<sac::Engine>()),
        world(std::make_unique<detail::World<sac::Scope>>(options, box, *engine)) {
    if (o.record_weights) engine->record_weights();
    predicates::self_test();
  }
  ~Impl() {
    engine.reset();  // before what its calls refer to
  }

  void insert(FeatureId id, const Point<2>& p);
  void remove(FeatureId id);
  void move(FeatureId id, const Point<2>& p);
  void check_new(FeatureId id, const Point<2>& p, FeatureId replaced) const;
  void add(FeatureId id, const Point<2>& p);
  void take(FeatureId id);
  Change<2> first_run();
  Change<2> propagate();
  [[nodiscard]] std::vector<Triangle> triangles() const;
  [[nodiscard]] std::vector<VertexHandle> live_vertices() const;
  [[nodiscard]] FeatureId id_of(VertexHandle h) const;
  [[nodiscard]] std::array<Point<2>, 3> corners(const Triangle& t) const;
  void report_stars(Change<2>& change) const;
  void check_invariants() const;

  auto& vertices() { return world->vertices; }
  const auto& pool() const { return world->vertices.pool(); }
  auto& features() { return world->features; }

  Options<2> options;
  detail::MeshBox<2> box;
  std::unique_ptr<sac::Engine> engine;
  std::unique_ptr<detail::World<sac::Scope>> world;
  std::unordered_map<FeatureId, VertexHandle> ids;
  bool ran = false;
  MeshStats stats;
};

// --- Edits -----------------------------------------------------------------------------------

FeatureId Mesher<2>::Impl::id_of(VertexHandle h) const {
  const auto it =
      std::find_if(ids.begin(), ids.end(), [&](const auto& e) { return e.second == h; });
  return it == ids.end() ? FeatureId{} : it->first;
}

void Mesher<2>::Impl::check_new(FeatureId id, const Point<2>& p, FeatureId replaced) const {
  detail::check_point(p, options.domain, id);
  const Vertex<2>* other = world->features.tree().obstacle(p);
  if (other == nullptr) return;
  const FeatureId other_id = id_of(other->self);
  if (other_id != replaced || !ids.contains(replaced))
    detail::fail_too_near(p, id, other->p, other_id);
}

void Mesher<2>::Impl::add(FeatureId id, const Point<2>& p) {
  if (ids.size() + 1 > ids.bucket_count()) ids.reserve(2 * ids.size() + 16);
  if (!ran) {
    Vertex<2>& v = vertices().add_input(p, true);
    features().tree().insert_only(v);
    ids.emplace(id, v.self);
    return;
  }
  engine->begin_edit();
  Vertex<2>& v = vertices().add_input(p, false);
  vertices().touch(v);
  engine->on_rollback([this, &v, id] {
    v.input = false;
    ids.erase(id);
  });
  ids.emplace(id, v.self);
  features().insert(v);
  world->quadtree.post_from_outside<detail::locate>(detail::locate_key(box.fixed(p)),
                                                    VertexRef<2>{&v});
}

void Mesher<2>::Impl::take(FeatureId id) {
  Vertex<2>& v = world->vertices.pool()[ids.at(id)];
  if (!ran) {
    features().tree().erase(v, [](Vertex<2>&) {});
    ids.erase(id);
    vertices().tree().erase(v);
    vertices().pool().release(v);
    return;
  }
  engine->begin_edit();
  vertices().touch(v);
  engine->on_rollback([this, &v, id] {
    v.input = true;
    ids.emplace(id, v.self);
  });
  ids.erase(id);
  v.input = false;
  features().erase(v);
  world->quadtree.retract_from_outside<detail::locate>(VertexRef<2>{&v});
}

void Mesher<2>::Impl::insert(FeatureId id, const Point<2>& p) {
  if (ids.contains(id))
    throw Error(ErrorCode::repeated_id, "point " + text(id) + " is there already");
  check_new(id, p, id);
  add(id, p);
}

void Mesher<2>::Impl::remove(FeatureId id) {
  if (!ids.contains(id)) throw Error(ErrorCode::unknown_id, "point " + text(id) + " is not there");
  take(id);
}

void Mesher<2>::Impl::move(FeatureId id, const Point<2>& p) {
  if (!ids.contains(id)) throw Error(ErrorCode::unknown_id, "point " + text(id) + " is not there");
  check_new(id, p, id);
  if (pool()[ids.at(id)].p == p) return;
  take(id);
  add(id, p);
}

// --- Updates ---------------------------------------------------------------------------------

std::array<Point<2>, 3> Mesher<2>::Impl::corners(const Triangle& t) const {
  return detail::smallest_first(std::array{pool()[t[0]].p, pool()[t[1]].p, pool()[t[2]].p});
}

std::vector<VertexHandle> Mesher<2>::Impl::live_vertices() const {
  std::vector<VertexHandle> all;
  pool().for_each([&](const Vertex<2>& v) {
    if (v.alive) all.push_back(v.self);
  });
  return all;
}

std::vector<Triangle> Mesher<2>::Impl::triangles() const {
  std::vector<Triangle> all;
  pool().for_each([&](const Vertex<2>& v) {
    const auto ring = world->vertices.ring(v);
    detail::for_each_own_triangle(pool(), v, ring.handles, ring.size,
                                  [&](const Triangle& t) { all.push_back(t); });
  });
  return all;
}

Change<2> Mesher<2>::Impl::first_run() {
  std::vector<Vertex<2>*> inputs;
  pool().for_each([&](Vertex<2>& v) {
    if (v.input) inputs.push_back(&v);
  });
  for (Vertex<2>* v : inputs) {
    vertices().touch(*v);
    v->level = static_cast<std::int16_t>(features().tree().crowded_level(*v));
    world->quadtree.post_from_outside<detail::locate>(detail::locate_key(box.fixed(v->p)),
                                                      VertexRef<2>{v});
  }
  Change<2> change;
  change.calls = call_counts(engine->run<detail::refine>());
  ran = true;
  vertices().commit();
  vertices().set_logging(true);
  const Mesh<2> mesh = detail::canonical(pool(), live_vertices(), triangles());
  stats = detail::timed_stats(*world, mesh);
  change.vertices_added = mesh.vertices;
  change.simplices_added.reserve(mesh.simplices.size());
  for (const auto& s : mesh.simplices) {
    change.simplices_added.push_back(
        {mesh.vertices[s[0]], mesh.vertices[s[1]], mesh.vertices[s[2]]});
  }
  return change;
}

// Triangles of stars that went or came, without those that did both.
void Mesher<2>::Impl::report_stars(Change<2>& change) const {
  const auto own = [&](const auto& records) {
    std::vector<Triangle> all;
    for (const auto& r : records) {
      detail::for_each_own_triangle(
          pool(), pool()[r.center], r.ring.data(), static_cast<int>(r.ring.size()),
          [&](const Triangle& t) { all.push_back(detail::smallest_first(t)); });
    }
    std::sort(all.begin(), all.end());
    return all;
  };
  const std::vector<Triangle> gone = own(world->vertices.log().stars_gone);
  const std::vector<Triangle> come = own(world->vertices.log().stars_come);
  const auto report = [&](const auto& these, const auto& those, auto& out) {
    std::vector<Triangle> rest;
    std::set_difference(these.begin(), these.end(), those.begin(), those.end(),
                        std::back_inserter(rest));
    for (const Triangle& t : rest) out.push_back(corners(t));
    std::sort(out.begin(), out.end());
  };
  report(come, gone, change.simplices_added);
  report(gone, come, change.simplices_removed);
}

Change<2> Mesher<2>::Impl::propagate() {
  Change<2> change;
  try {
    change.calls = call_counts(engine->propagate());
  } catch (...) {
    vertices().commit();
    throw;
  }
  report_stars(change);
  for (const VertexHandle h : world->vertices.log().touched) {
    const Vertex<2>& v = pool()[h];
    if (v.alive && !v.committed) change.vertices_added.push_back(v.p);
    if (!v.alive && v.committed) change.vertices_removed.push_back(v.p);
  }
  std::sort(change.vertices_added.begin(), change.vertices_added.end());
  std::sort(change.vertices_removed.begin(), change.vertices_removed.end());
  vertices().commit();
  stats.vertices += change.vertices_added.size() - change.vertices_removed.size();
  stats.simplices += change.simplices_added.size() - change.simplices_removed.size();
  return change;
}

void Mesher<2>::Impl::check_invariants() const {
  if (!ran) return;
  engine->check_invariants();
  world->vertices.check_invariants();
  SAC_INVARIANT(world->features.tree().size() == ids.size());
  for (const auto& [id, h] : ids) {
    const Vertex<2>& v = pool()[h];
    SAC_INVARIANT(v.alive && v.input);
    SAC_INVARIANT(v.level == world->features.tree().crowded_level(v));
  }
  SAC_INVARIANT(stats.vertices == live_vertices().size());
  SAC_INVARIANT(stats.simplices == triangles().size());
}

// --- The facade ------------------------------------------------------------------------------

template <int D>
Mesher<D>::Mesher(const Options<D>& options) : impl_(std::make_unique<Impl>(options)) {}
template <int D>
Mesher<D>::Mesher(Mesher&&) noexcept = default;
template <int D>
Mesher<D>& Mesher<D>::operator=(Mesher&&) noexcept = default;
template <int D>
Mesher<D>::~Mesher() = default;

template <int D>
void Mesher<D>::insert(FeatureId id, const Point<D>& point) {
  impl_->insert(id, point);
}

template <int D>
void Mesher<D>::insert(const std::vector<FeatureId>& ids, const std::vector<Point<D>>& points) {
  SAC_EXPECTS(ids.size() == points.size());
  std::vector<FeatureId> done;
  done.reserve(ids.size());
  try {
    for (const std::size_t i : detail::morton_order(points, impl_->box)) {
      impl_->insert(ids[i], points[i]);
      done.push_back(ids[i]);
    }
  } catch (...) {
    for (const FeatureId id : done) impl_->remove(id);
    throw;
  }
}

template <int D>
void Mesher<D>::remove(FeatureId id) {
  impl_->remove(id);
}

template <int D>
void Mesher<D>::move(FeatureId id, const Point<D>& point) {
  impl_->move(id, point);
}

template <int D>
void Mesher<D>::discard_edits() {
  if (!impl_->ran) {
    impl_ = std::make_unique<Impl>(Options<D>(impl_->options));
    return;
  }
  impl_->engine->undo_edits();
  impl_->propagate();  // nothing changes; what the edits had announced is let go
}

template <int D>
Change<D> Mesher<D>::update() {
  if (impl_->ran) return impl_->propagate();
  try {
    return impl_->first_run();
  } catch (...) {
    impl_ = std::make_unique<Impl>(Options<D>(impl_->options));
    throw;
  }
}

template <int D>
Mesh<D> Mesher<D>::mesh() const {
  return detail::canonical(impl_->pool(), impl_->live_vertices(), impl_->triangles());
}

template <int D>
std::size_t Mesher<D>::size() const {
  return impl_->ids.size();
}

template <int D>
bool Mesher<D>::contains(FeatureId id) const {
  return impl_->ids.contains(id);
}

template <int D>
MeshStats Mesher<D>::stats() const {
  MeshStats s = impl_->stats;
  s.calls = impl_->engine->live_calls();
  s.edges = impl_->engine->live_edges();
  s.trace_bytes = impl_->engine->bytes() + impl_->pool().bytes() +
                  impl_->world->vertices.tree().bytes() + impl_->world->features.tree().bytes();
  return s;
}

template <int D>
const Options<D>& Mesher<D>::options() const {
  return impl_->options;
}

template <int D>
const sac::Engine& Mesher<D>::engine() const {
  return *impl_->engine;
}

template <int D>
void Mesher<D>::check_invariants() const {
  impl_->check_invariants();
}

template class Mesher<2>;

}  // namespace mesher
