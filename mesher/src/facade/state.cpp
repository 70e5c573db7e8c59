// The first run, and updates: edits made in the engine, propagated, and committed or taken back.
#include "facade/state.hpp"

#include <algorithm>
#include <functional>
#include <utility>

#include "facade/meter.hpp"
#include "mesh/canonical.hpp"
#include "program/world_impl.hpp"
#include "segments/vertex_budget.hpp"

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

State::State(const Options<2>& options)
    : box_(mesh_box(options)),
      engine_(std::make_unique<sac::Engine>()),
      world_(std::make_unique<World<sac::Scope>>(options, box_, *engine_)) {
  world_->names = this;
  if (options.record_weights) engine_->record_weights();
}

State::~State() {
  engine_.reset();  // before what its calls refer to
}

// --- Points ----------------------------------------------------------------------------------

Announced::Place State::place(FeatureId id) const {
  const auto it = ids_.find(id);
  return it == ids_.end() ? Announced::Place() : pool()[it->second].p;
}

std::optional<State::Named> State::obstacle(const Point<2>& p) const {
  const Vertex<2>* v = world_->features.point_at(p);
  return v == nullptr ? std::optional<Named>() : Named{names_[v->self], v->p};
}

// So that rename() cannot fail.
void State::make_room(const Ids& arrived) {
  const std::size_t most = ids_.size() + arrived.size();
  if (most > ids_.max_load_factor() * static_cast<float>(ids_.bucket_count())) {
    ids_.reserve(2 * most + 16);
  }
  VertexHandle last = 0;
  for (const auto& [id, handle] : arrived) last = std::max(last, handle);
  if (last >= names_.capacity()) names_.reserve(2 * std::size_t{last} + 16);
  if (last >= names_.size()) names_.resize(std::size_t{last} + 1);
}

void State::rename(const std::vector<Announced::Edit>& edits, Ids& arrived) noexcept {
  for (const auto& edit : edits) ids_.erase(edit.id);
  for (const auto& [id, handle] : arrived) names_[handle] = id;
  ids_.merge(arrived);
}

// --- The first run ---------------------------------------------------------------------------

void State::add_first(const Announced::Edit& edit) {
  Vertex<2>& v = vertices().add_input(*edit.to, true);
  features().insert_first(v);
  ids_.emplace(edit.id, v.self);
  names_.resize(v.self + std::size_t{1});
  names_[v.self] = edit.id;
}

void State::post_all() {
  pool().for_each([&](Vertex<2>& v) {
    if (!v.input) return;
    vertices().touch(v);
    world_->quadtree.post_from_outside<locate>(locate_key(box_.fixed(v.p)), VertexRef<2>{&v});
  });
}

Change<2> State::whole(const Mesh<2>& mesh) const {
  Change<2> change;
  change.vertices_added = mesh.vertices;
  change.simplices_added.reserve(mesh.simplices.size());
  for (const auto& s : mesh.simplices) {
    change.simplices_added.push_back(
        {mesh.vertices[s[0]], mesh.vertices[s[1]], mesh.vertices[s[2]]});
  }
  for (const auto& e : mesh.edges) {
    change.edges_added.push_back({mesh.vertices[e.low], mesh.vertices[e.high], e.line});
  }
  return change;
}

void State::add_all_first(const Edits& edits) {
  ids_.reserve(edits.points.size());
  for (const auto& edit : edits.points) add_first(edit);
  if (edits.lines.empty()) return;
  for (const Part& part : take_lines({{}, edits.lines})) add_part(part, {});
  require_planar({});
  Lines lines;
  make_room_for_lines(edits.lines, lines);
  rename_lines(edits.lines, lines);
  forget_news();
}

Change<2> State::first_run(Edits edits, const RunControl& control, const Accept& accept) {
  add_all_first(edits);
  edits = Edits();  // the run needs the memory
  post_all();
  RunMeter<sac::Scope> phases(*world_, control, ids_.size());
  const auto meter = [&](const sac::Progress& p) { return phases(p.executed); };
  const Watch watch(*engine_, control, meter);
  const CallCounts calls = call_counts(engine_->run<refine<2>>());
  commit();
  require_room(pool().size());
  vertices().set_logging(true);
  ran_ = true;
  const Mesh<2> all = mesh();
  stats_ = timed_stats(*world_, all);
  Change<2> change = whole(all);
  change.calls = calls;
  if (accept) accept(change);
  return change;
}

// --- Updates ---------------------------------------------------------------------------------

// Leaves' records refer to those of segments, and these to those of vertices.
void State::commit() noexcept {
  world_->leaves.commit();
  world_->segments.commit();
  vertices().commit();
}

// The record of an input point to be, listed so that commit() frees it if nothing comes of it.
Vertex<2>& State::claim(const Point<2>& p) {
  Vertex<2>& v = vertices().add_input(p, false);
  v.input = false;
  vertices().touch(v);
  return v;
}

Vertex<2>& State::add(const Point<2>& p) {
  engine_->begin_edit();
  Vertex<2>& v = claim(p);
  engine_->on_rollback([&v] { v.input = false; });
  v.input = true;
  features().insert(v);
  world_->quadtree.post_from_outside<locate>(locate_key(box_.fixed(p)), VertexRef<2>{&v});
  return v;
}

void State::take(Vertex<2>& v) {
  engine_->begin_edit();
  vertices().touch(v);
  engine_->on_rollback([&v] { v.input = true; });
  v.input = false;
  features().erase(v);
  world_->quadtree.retract_from_outside<locate>(VertexRef<2>{&v});
}

// `named`: what comes is asked for its name before the update is done.
void State::make_points(const std::vector<Announced::Edit>& edits, bool named, Ids& arrived) {
  for (const auto& edit : edits) {
    if (edit.was) take(pool()[ids_.at(edit.id)]);
  }
  for (const auto& edit : edits) {
    if (!edit.to) continue;
    const VertexHandle v = add(*edit.to).self;
    arrived.emplace(edit.id, v);
    if (named) new_names_[v] = edit.id;
  }
}

bool State::has_lines() const noexcept {
  return segments().store().live() != 0 || !new_segments_.empty();
}

void State::make(const Edits& edits, Ids& arrived) {
  const auto all = [&] {
    const std::vector<Part> parts = take_lines(edits);
    require_unused(edits.points);
    make_points(edits.points, has_lines() || !parts.empty(), arrived);
    for (const Part& part : parts) add_part(part, arrived);
    if (has_lines()) require_planar(arrived);
  };
  try {
    engine_->edit_together(all);
  } catch (...) {
    vertices().give_up();
    forget_news();
    throw;
  }
}

void State::require_room(std::size_t now) const {
  if (now > world_->most_vertices) {
    throw too_many_vertices(vertices(), world_->names, world_->most_vertices);
  }
}

Change<2> State::propagate(const Edits& edits, const RunControl& control, const Accept& accept) {
  const auto meter = [&](const sac::Progress& p) {
    return detail::report(control, {Phase::update, p.executed, p.executed + p.queued});
  };
  Change<2> change;
  Ids arrived;
  Lines lines;
  const std::function<void()> report = [&] {  // what needs memory, while all can be undone
    make_room(arrived);
    make_room_for_lines(edits.lines, lines);
    Log log = vertices().log();
    report_vertices(log, change);
    report_stars(std::move(log), change);
    report_edges(change);
    require_room(stats_.vertices + change.vertices_added.size() - change.vertices_removed.size());
    if (accept) accept(change);
  };
  make(edits, arrived);
  // While it is under way, there may be vertices that come as well as those that go.
  world_->most_records = std::max(world_->most_vertices, pool().size() + world_->most_vertices);
  try {
    const Watch watch(*engine_, control, meter);
    change.calls = call_counts(engine_->propagate(report));
  } catch (...) {
    commit();
    forget_news();
    throw;
  }
  rename(edits.points, arrived);
  rename_lines(edits.lines, lines);
  forget_news();
  commit();
  stats_.vertices += change.vertices_added.size() - change.vertices_removed.size();
  stats_.simplices += change.simplices_added.size() - change.simplices_removed.size();
  return change;
}

}  // namespace mesher::detail
