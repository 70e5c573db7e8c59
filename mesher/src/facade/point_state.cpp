// The first run, and updates: edits made in the engine, propagated, and committed or taken back.
#include "facade/point_state.hpp"

#include <algorithm>
#include <functional>
#include <utility>

#include "facade/asking.hpp"
#include "facade/make_room.hpp"
#include "facade/point_report.hpp"
#include "facade/whole_change.hpp"
#include "program/meter.hpp"
#include "program/timed_stats.hpp"
#include "program/world_impl.hpp"
#include "rules/mesh_box.hpp"

namespace mesher::detail {

namespace {

CallCounts call_counts(const sac::Counts& c) {
  return {c.executed, c.reused, c.created, c.discarded, c.edges_made + c.edges_removed, c.weight};
}

// While it lives the engine reports to the meter.
template <class Meter>
class Watch {
 public:
  Watch(sac::Engine& engine, const RunControl& control, Meter& meter) : engine_(engine) {
    if (!watches(control)) return;
    engine_.set_progress([&meter](const sac::Progress& p) { return meter(p); },
                         RunControl::kCallsBetween);
  }
  ~Watch() { engine_.set_progress(nullptr); }
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

 private:
  sac::Engine& engine_;
};

}  // namespace

template <int D>
PointState<D>::PointState(const Options<D>& options)
    : box_(mesh_box(options)),
      engine_(std::make_unique<sac::Engine>()),
      world_(std::make_unique<World<sac::Scope, D>>(options, box_, *engine_)) {
  if (options.record_weights) engine_->record_weights();
}

template <int D>
PointState<D>::~PointState() {
  engine_.reset();  // before what its calls refer to
}

// --- Points ----------------------------------------------------------------------------------

template <int D>
auto PointState<D>::place(PointId id) const -> typename Pending<D>::Place {
  const auto it = ids_.find(id);
  return it == ids_.end() ? typename Pending<D>::Place() : pool()[it->second].p;
}

template <int D>
auto PointState<D>::obstacle(const Point<D>& p) const -> std::optional<Named> {
  const Vertex<D>* v = world_->features.point_at(p);
  return v == nullptr ? std::optional<Named>() : Named{names_[v->self], v->p};
}

template <int D>
PointId PointState<D>::name(VertexHandle v) const {
  const auto it = arrived_names_.find(v);
  return it == arrived_names_.end() ? names_[v] : it->second;
}

template <int D>
VertexHandle PointState<D>::point_with(PointId id) const {
  if (const auto it = arrived_.find(id); it != arrived_.end()) return it->second;
  const auto it = ids_.find(id);
  if (it == ids_.end()) return 0;
  return pool()[it->second].input && name(it->second) == id ? it->second : 0;
}

template <int D>
std::vector<VertexHandle> PointState<D>::arrivals() const {
  std::vector<std::pair<PointId, VertexHandle>> by_id(arrived_.begin(), arrived_.end());
  std::sort(by_id.begin(), by_id.end());
  std::vector<VertexHandle> points;
  points.reserve(by_id.size());
  for (const auto& [id, h] : by_id) points.push_back(h);
  return points;
}

// So that rename() cannot fail.
template <int D>
void PointState<D>::make_room() {
  make_room_for(ids_, arrived_);
  VertexHandle last = 0;
  for (const auto& [id, handle] : arrived_) last = std::max(last, handle);
  make_place(names_, last);
}

template <int D>
void PointState<D>::rename(const PointEdits<D>& edits) noexcept {
  for (const auto& edit : edits) ids_.erase(edit.id);
  for (const auto& [id, handle] : arrived_) names_[handle] = id;
  ids_.merge(arrived_);
}

// Tables that were large once are given back: to clear them again takes time in their size.
template <int D>
void PointState<D>::forget() noexcept {
  arrived_ = Ids();  // not {}, an empty list, for which a table keeps its size
  arrived_names_ = decltype(arrived_names_)();
  discard_news();
}

// --- The first run ---------------------------------------------------------------------------

template <int D>
void PointState<D>::add_first(const typename Pending<D>::Edit& edit) {
  Vertex<D>& v = vertices().add_input(*edit.to, true);
  features().insert_first(v);
  ids_.emplace(edit.id, v.self);
  names_.resize(v.self + std::size_t{1});
  names_[v.self] = edit.id;
}

template <int D>
void PointState<D>::post_all() {
  pool().for_each([&](Vertex<D>& v) {
    if (!v.input) return;
    vertices().touch(v);
    world_->quadtree.template post_from_outside<locate>(locate_key(box_.fixed(v.p)),
                                                        VertexRef<D>{&v});
  });
}

template <int D>
void PointState<D>::begin_first(Edits<D>& edits, const RunControl& control) {
  ids_.reserve(edits.points.size());
  ask_ = asking(control, Phase::quadtree, &fail_stopped);
  for (const auto& edit : edits.points) add_first(edit);
  edits.points = PointEdits<D>();  // the run needs the memory
  add_features_first(edits);
}

template <int D>
Change<D> PointState<D>::first_run(Edits<D> edits, const RunControl& control,
                                   const Accept& accept) {
  begin_first(edits, control);
  post_all();
  RunMeter<sac::Scope, D> phases(*world_, control, ids_.size());
  const auto meter = [&](const sac::Progress& p) { return phases(p.executed); };
  const Watch watch(*engine_, control, meter);
  const CallCounts calls = call_counts(engine_->template run<refine<D>>());
  if (!phases.end(calls.executed)) fail_stopped();
  commit();
  require_room(pool().size() - vertices().trials());
  require_features();
  Change<D> change = first_change();
  change.calls = calls;
  if (accept) accept(change);
  return change;
}

template <int D>
Change<D> PointState<D>::first_change() {
  ran_ = true;
  const std::vector<Simplex> come = simplices();
  const OnFeatures parts = on_features(come);
  const Mesh<D> mesh = canonical(pool(), vertices().live_vertices(), come, parts);
  remember(parts);
  stats_ = timed_stats(*world_, mesh);
  Change<D> change = whole_change(mesh);
  find_angles(come, change);
  return change;
}

// --- Updates ---------------------------------------------------------------------------------

template <int D>
void PointState<D>::commit() noexcept {
  free_features();  // which refer to vertices
  vertices().commit();
}

// The record of an input point to be, listed so that commit() frees it if nothing comes of it.
template <int D>
Vertex<D>& PointState<D>::claim(const Point<D>& p) {
  Vertex<D>& v = vertices().add_input(p, false);
  v.input = false;
  vertices().touch(v);
  return v;
}

template <int D>
Vertex<D>& PointState<D>::add(const Point<D>& p) {
  engine_->begin_edit();
  Vertex<D>& v = claim(p);
  engine_->on_rollback([&v] { v.input = false; });
  v.input = true;
  features().insert(v);
  if (!world_->locates) return v;
  world_->quadtree.template post_from_outside<locate>(locate_key(box_.fixed(p)), VertexRef<D>{&v});
  return v;
}

template <int D>
void PointState<D>::take(Vertex<D>& v) {
  engine_->begin_edit();
  vertices().touch(v);
  engine_->on_rollback([&v] { v.input = true; });
  v.input = false;
  features().erase(v);
  if (!world_->locates) return;
  world_->quadtree.template retract_from_outside<locate>(VertexRef<D>{&v});
}

template <int D>
void PointState<D>::make_points(const PointEdits<D>& edits) {
  for (const auto& edit : edits) {
    if (edit.was) take(pool()[ids_.at(edit.id)]);
  }
  for (const auto& edit : edits) {
    if (!edit.to) continue;
    const VertexHandle v = add(*edit.to).self;
    arrived_.emplace(edit.id, v);
    arrived_names_[v] = edit.id;
  }
}

template <int D>
void PointState<D>::make(const Edits<D>& edits) {
  try {
    engine_->edit_together([&] { make_edits(edits); });
  } catch (...) {
    settle();
    forget();
    throw;
  }
}

// Edits have been taken back: a propagation of nothing frees the calls that were made for them.
// Without the memory for that they stay until the next one.
template <int D>
void PointState<D>::settle() noexcept {
  try {
    engine_->propagate();
    commit();
  } catch (...) {
    vertices().give_up();
  }
}

template <int D>
void PointState<D>::require_room(std::size_t now) const {
  if (now > world_->most_vertices) {
    throw world_->too_many();
  }
}

template <int D>
Change<D> PointState<D>::propagate(const Edits<D>& edits, const RunControl& control,
                                   const Accept& accept) {
  const auto meter = [&](const sac::Progress& p) {
    return detail::report(control, {Phase::update, p.executed, p.executed + p.queued});
  };
  Change<D> change;
  const std::function<void()> last = [&] {  // what needs memory, while all can be undone
    make_room();
    prepare_names();
    report(change);
    if (accept) accept(change);
  };
  ask_ = asking(control, Phase::update, &fail_stopped);
  make(edits);
  // While it is under way, there may be vertices that come as well as those that go.
  world_->most_records =
      std::max(world_->most_vertices, pool().size() - vertices().trials() + world_->most_vertices);
  try {
    const Watch watch(*engine_, control, meter);
    change.calls = call_counts(engine_->propagate(last));
  } catch (...) {
    commit();
    forget();
    throw;
  }
  end_update(edits.points, change);
  return change;
}

template <int D>
void PointState<D>::report(Change<D>& change) {
  const Log log = vertices().log();
  require_features(log);
  report_vertices(log, change);
  report_features(log, change);
  report_simplices(log, change);
  find_angles(log.simplices_come, change);
  require_room(stats_.vertices + change.vertices_added.size() - change.vertices_removed.size());
}

template <int D>
void PointState<D>::end_update(const PointEdits<D>& edits, const Change<D>& change) noexcept {
  rename(edits);
  commit_names();
  forget();
  commit();
  stats_.vertices += change.vertices_added.size() - change.vertices_removed.size();
  stats_.simplices += change.simplices_added.size() - change.simplices_removed.size();
}

template class PointState<2>;
#ifndef MESHER_PLANE_ONLY
template class PointState<3>;
#endif

}  // namespace mesher::detail
