// The facade: announced edits on one side, the state that updates work on at the other.
#include "facade/box_mesher.hpp"

#include <algorithm>
#include <string>

#include "facade/announced_features.hpp"
#include "facade/announced_points.hpp"
#include "facade/reentry_guard.hpp"
#include "facade/state.hpp"
#include "facade/tiled_plane_state.hpp"
#ifndef MESHER_PLANE_ONLY
#include "facade/tiled_space_state.hpp"
#endif
#include "facade/tiled_state.hpp"
#include "facade/whole_change.hpp"
#include "geometry/input_point.hpp"
#include "live/live_arrays.hpp"
#include "mesher/predicates.hpp"
#include "mesher/reports.hpp"
#include "program/meter.hpp"
#include "program/space_input.hpp"
#include "rules/mesh_box.hpp"
#include "text/id_text.hpp"

namespace mesher {

namespace detail {

namespace {

/// For a first run with these edits.
template <int D>
std::unique_ptr<AnyState<D>> state_for(const Options<D>& options, const Edits<D>& edits) {
  if (may_be_tiled(options, edits)) return std::make_unique<TiledState<D>>(options);
  if constexpr (D == 2) {
    if (may_have_lines_tiled(options, edits)) return std::make_unique<TiledPlaneState>(options);
  }
#ifndef MESHER_PLANE_ONLY
  if constexpr (D == 3) {
    if (may_have_complexes_tiled(options, edits)) return std::make_unique<TiledSpaceState>(options);
  }
#endif
  return std::make_unique<State<D>>(options);
}

}  // namespace

}  // namespace detail

template <int D>
struct BoxMesher<D>::Impl {
  using State = detail::State<D>;

  explicit Impl(const Options<D>& o)
      : options(o),
        state(std::make_unique<State>(o)),
        box(detail::mesh_box(o)),
        points(o.domain, box),
        features(o.rule, points) {
    predicates::self_test();
  }

  void insert(PointId id, const Point<D>& p);
  void limit(detail::AllLimits<D> limits, const std::vector<Box<D>>& where);
  [[nodiscard]] Options<D> pending_options() const;
  void prepare_edits();
  void commit_edits() noexcept;
  void discard_edits() noexcept;
  using LastWord = typename State::Accept;
  Change<D> run_anew(const RunControl& control, const LastWord& accept, int threads);
  Change<D> run(const RunControl& control, const LastWord& accept);
  Change<D> run_or_alone(const RunControl& control, const LastWord& accept);
  Change<D> run_with_slots(const RunControl& control, const Accept& accept);
  Change<D> update(const RunControl& control, const Accept& accept);

  Options<D> options;                          // with the limits of the last update
  std::unique_ptr<detail::AnyState<D>> state;  // of the last update
  detail::MeshBox<D> box;
  detail::AnnouncedPoints<D> points;
  detail::AnnouncedFeatures<D> features;
  detail::PendingLimits<D> pending_limits;
  std::unique_ptr<detail::LiveArrays<D>> live;  // null: slots are not kept
  detail::ReentryGuard busy;
};

// --- Edits -----------------------------------------------------------------------------------

template <int D>
void BoxMesher<D>::Impl::insert(PointId id, const Point<D>& p) {
  busy.require_idle();
  points.insert(*state, id, p);
}

// --- Limits ----------------------------------------------------------------------------------

template <int D>
void BoxMesher<D>::Impl::limit(detail::AllLimits<D> limits, const std::vector<Box<D>>& where) {
  busy.require_idle();
  pending_limits.set(std::move(limits), where, options, box);
}

template <int D>
Options<D> BoxMesher<D>::Impl::pending_options() const {
  return pending_limits.applied_to(options);
}

// --- Updates ---------------------------------------------------------------------------------

// So that commit_edits() needs no memory.
template <int D>
void BoxMesher<D>::Impl::prepare_edits() {
  features.prepare();
}

template <int D>
void BoxMesher<D>::Impl::commit_edits() noexcept {
  pending_limits.commit(options);
  features.commit();
  discard_edits();
}

template <int D>
void BoxMesher<D>::Impl::discard_edits() noexcept {
  pending_limits.clear();
  features.discard();
  points.clear();
}

// A state by another means, from the start: of all, with as many threads.
template <int D>
Change<D> BoxMesher<D>::Impl::run_anew(const RunControl& control, const LastWord& accept,
                                       int threads) {
  Options<D> now = pending_options();
  now.threads = threads;
  const auto every_line = detail::all_of(features.lines());
  const auto every_polygon = detail::all_of(features.polygons());
  detail::Edits<D> edits{points.all(*state), every_line, every_polygon};
  std::unique_ptr<detail::AnyState<D>> fresh = detail::state_for(now, edits);
  const Mesh<D> before = state->ran() ? state->mesh() : Mesh<D>();
  Change<D> change = fresh->first_run(std::move(edits), control, [&](Change<D>& c) {
    detail::count_from(before, c);
    if constexpr (D == 2) {
      if (!before.vertices.empty()) c.angles = angle_news(fresh->mesh(), now, c.simplices_added);
    } else if (!before.vertices.empty()) {
      fresh->judge_new(c);
    }
    if (accept) accept(c);
  });
  state = std::move(fresh);
  return change;
}

template <int D>
Change<D> BoxMesher<D>::Impl::run(const RunControl& control, const LastWord& accept) {
  points.require_apart(*state);
  if (state->ran()) {
    const detail::Edits<D> edits{points.pending().sorted(), features.lines(), features.polygons(),
                                 pending_limits.edit(options)};
    if (!state->takes(edits)) return run_anew(control, accept, options.threads);
    if (!state->is_sooner_anew(edits)) return state->propagate(edits, control, accept);
    try {
      return run_anew(control, accept, options.threads);
    } catch (const Error&) {  // it is said in the words of an update
      return state->propagate(edits, control, accept);
    }
  }
  const Options<D> now = pending_options();
  detail::Edits<D> edits{points.pending().sorted(), features.lines(), features.polygons()};
  std::unique_ptr<detail::AnyState<D>> fresh = detail::state_for(now, edits);
  Change<D> change = fresh->first_run(std::move(edits), control, accept);
  state = std::move(fresh);
  return change;
}

template <int D>
Change<D> BoxMesher<D>::Impl::run_or_alone(const RunControl& control, const LastWord& accept) {
  try {
    return run(control, accept);
  } catch (const detail::NotInTilesYet&) {
    try {
      return run_anew(control, accept, options.threads);
    } catch (const detail::NotInTiles&) {
      return run_anew(control, accept, 1);
    }
  } catch (const detail::NotInTiles&) {
    return run_anew(control, accept, 1);
  }
}

template <int D>
Change<D> BoxMesher<D>::Impl::run_with_slots(const RunControl& control, const Accept& accept) {
  const LastWord last_word = [&](Change<D>& change) {
    if (live) change.slots = live->plan(change);
    if (accept) accept(change);
  };
  try {
    Change<D> change = run_or_alone(control, last_word);
    if (live) live->keep();
    return change;
  } catch (...) {
    if (live) live->drop();
    throw;
  }
}

template <int D>
Change<D> BoxMesher<D>::Impl::update(const RunControl& control, const Accept& accept) {
  const detail::ReentryGuard::Run running(busy);
  detail::require_unstopped(control);
  try {
    prepare_edits();
    Change<D> change = run_with_slots(control, accept);
    commit_edits();
    return change;
  } catch (const sac::Cancelled&) {
    detail::fail_cancelled();
  } catch (...) {
    discard_edits();
    throw;
  }
}

// --- The facade ------------------------------------------------------------------------------

template <int D>
BoxMesher<D>::BoxMesher(const Options<D>& options) : impl_(std::make_unique<Impl>(options)) {}
template <int D>
BoxMesher<D>::BoxMesher(BoxMesher&&) noexcept = default;
template <int D>
BoxMesher<D>& BoxMesher<D>::operator=(BoxMesher&&) noexcept = default;
template <int D>
BoxMesher<D>::~BoxMesher() = default;

template <int D>
void BoxMesher<D>::insert(PointId id, const Point<D>& point) {
  impl_->insert(id, point);
}

template <int D>
void BoxMesher<D>::insert(const std::vector<PointId>& ids, const std::vector<Point<D>>& points) {
  SAC_EXPECTS(ids.size() == points.size());
  std::size_t done = 0;
  try {
    for (; done < ids.size(); ++done) impl_->insert(ids[done], points[done]);
  } catch (...) {
    while (done-- > 0) impl_->points.take_back(*impl_->state, ids[done]);
    throw;
  }
}

template <int D>
void BoxMesher<D>::remove(PointId id) {
  impl_->busy.require_idle();
  impl_->points.remove(*impl_->state, id);
}

template <int D>
void BoxMesher<D>::move(PointId id, const Point<D>& point) {
  impl_->busy.require_idle();
  impl_->points.move(*impl_->state, id, point);
}

template <int D>
void BoxMesher<D>::insert_segment(LineId id, PointId from, PointId to) {
  impl_->busy.require_idle();
  impl_->features.insert_line(*impl_->state, id, {from, to});
}

template <int D>
void BoxMesher<D>::insert_polyline(LineId id, const std::vector<PointId>& points) {
  impl_->busy.require_idle();
  impl_->features.insert_line(*impl_->state, id, points);
}

template <int D>
void BoxMesher<D>::remove_line(LineId id) {
  impl_->busy.require_idle();
  impl_->features.remove_line(id);
}

template <int D>
void BoxMesher<D>::insert_polygon(const Polygon& polygon) {
  impl_->busy.require_idle();
  impl_->features.insert_polygon(*impl_->state, polygon);
}

template <int D>
void BoxMesher<D>::remove_polygon(PolygonId id) {
  impl_->busy.require_idle();
  impl_->features.remove_polygon(id);
}

template <int D>
void BoxMesher<D>::limit(const SizeLimits<D>& limits) {
  const auto all = impl_->pending_limits.as_pending(impl_->options);
  impl_->limit({limits, {}, all.regions}, {impl_->options.domain});
}
template <int D>
void BoxMesher<D>::limit(const Box<D>& box, const SizeLimits<D>& limits) {
  auto all = impl_->pending_limits.as_pending(impl_->options);
  all.set_within(box, limits);
  impl_->limit(std::move(all), {box});
}
template <int D>
void BoxMesher<D>::limit_regions(std::shared_ptr<const RegionLimits<D>> regions,
                                 const std::vector<Box<D>>& where) {
  auto all = impl_->pending_limits.as_pending(impl_->options);
  all.regions = std::move(regions);
  impl_->limit(std::move(all), where);
}
template <int D>
bool BoxMesher<D>::has_limits() const {
  return impl_->pending_limits.as_pending(impl_->options).any();
}

// In the other: lines go first, and points before others come to their places.
template <int D>
void BoxMesher<D>::announce_to(BoxMesher& other) const {
  const auto& lines = impl_->features.lines();
  const auto& polygons = impl_->features.polygons();
  polygons.for_each_edit([&](PolygonId id, const Polygon* was, const Polygon*) {
    if (was != nullptr) other.remove_polygon(id);
  });
  lines.for_each_edit([&](LineId id, const detail::LinePoints* was, const detail::LinePoints*) {
    if (was != nullptr) other.remove_line(id);
  });
  for (const auto& edit : impl_->points.pending().sorted()) {  // those that go are the first
    if (edit.was) edit.to ? other.move(edit.id, *edit.to) : other.remove(edit.id);
  }
  for (const auto& edit : impl_->points.pending().sorted()) {
    if (!edit.was) other.insert(edit.id, *edit.to);
  }
  lines.for_each_edit([&](LineId id, const detail::LinePoints*, const detail::LinePoints* is) {
    if (is != nullptr) other.insert_polyline(id, *is);
  });
  polygons.for_each_edit([&](PolygonId, const Polygon*, const Polygon* is) {
    if (is != nullptr) other.insert_polygon(*is);
  });
}

template <int D>
bool BoxMesher<D>::contains_line(LineId id) const {
  return impl_->features.lines().find(id) != nullptr;
}

template <int D>
bool BoxMesher<D>::contains_polygon(PolygonId id) const {
  return impl_->features.polygons().find(id) != nullptr;
}

template <int D>
void BoxMesher<D>::discard_edits() noexcept {
  if (impl_->busy.is_idle()) impl_->discard_edits();
}

template <int D>
Change<D> BoxMesher<D>::update(const RunControl& control) {
  return impl_->update(control, {});
}

template <int D>
Change<D> BoxMesher<D>::update(const RunControl& control, const Accept& accept) {
  return impl_->update(control, accept);
}

template <int D>
Mesh<D> BoxMesher<D>::mesh() const {
  impl_->busy.require_idle();
  return impl_->state->ran() ? impl_->state->mesh() : Mesh<D>();
}

template <int D>
LiveMesh<D> BoxMesher<D>::live() const {
  impl_->busy.require_idle();
  if (!impl_->live) impl_->live = std::make_unique<detail::LiveArrays<D>>(mesh());
  return LiveMesh<D>(*impl_->live);
}

template <int D>
void BoxMesher<D>::keep_slots(bool keep) {
  if (keep) {
    static_cast<void>(live());
  } else {
    impl_->busy.require_idle();
    impl_->live.reset();
  }
}

template <int D>
bool BoxMesher<D>::keeps_slots() const noexcept {
  return impl_->live != nullptr;
}

template <int D>
Slot BoxMesher<D>::last_slot(const std::array<Point<D>, D + 1>& simplex) const {
  return impl_->live->find_simplex(simplex);
}

template <int D>
std::vector<GraphPoint<D>> BoxMesher<D>::points() const {
  impl_->busy.require_idle();
  return impl_->state->points();
}

template <int D>
std::vector<Polyline> BoxMesher<D>::lines() const {
  impl_->busy.require_idle();
  std::vector<Polyline> all;
  for (const auto& [id, points] : impl_->features.lines().committed()) all.push_back({id, points});
  return all;
}

template <int D>
std::vector<Polygon> BoxMesher<D>::polygons() const {
  impl_->busy.require_idle();
  std::vector<Polygon> all;
  for (const auto& [id, polygon] : impl_->features.polygons().committed()) all.push_back(polygon);
  return all;
}

template <int D>
std::optional<GraphPoint<D>> BoxMesher<D>::point(PointId id) const {
  impl_->busy.require_idle();
  const auto at = impl_->state->place(id);
  return at ? std::optional(GraphPoint<D>{id, *at}) : std::nullopt;
}

template <int D>
std::optional<Polyline> BoxMesher<D>::line(LineId id) const {
  impl_->busy.require_idle();
  const auto it = impl_->features.lines().committed().find(id);
  return it == impl_->features.lines().committed().end() ? std::nullopt
                                                         : std::optional(Polyline{id, it->second});
}

template <int D>
std::optional<Polygon> BoxMesher<D>::polygon(PolygonId id) const {
  impl_->busy.require_idle();
  const auto it = impl_->features.polygons().committed().find(id);
  return it == impl_->features.polygons().committed().end() ? std::nullopt
                                                            : std::optional(it->second);
}

template <int D>
std::size_t BoxMesher<D>::size() const {
  return impl_->state->size() + static_cast<std::size_t>(impl_->points.pending().growth());
}

template <int D>
bool BoxMesher<D>::contains(PointId id) const {
  return impl_->points.place(*impl_->state, id).has_value();
}

template <int D>
MeshStats BoxMesher<D>::stats() const {
  return impl_->state->stats();
}

template <int D>
const Options<D>& BoxMesher<D>::options() const {
  return impl_->options;
}

template <int D>
const sac::Engine& BoxMesher<D>::engine() const {
  return impl_->state->engine();
}

template <int D>
void BoxMesher<D>::check_invariants() const {
  if (impl_->state->ran()) impl_->state->check_invariants();
  if (!impl_->live) return;
  impl_->live->check_invariants();
  SAC_INVARIANT(impl_->live->compact().mesh == mesh());
}

template class BoxMesher<2>;
#ifndef MESHER_PLANE_ONLY
template class BoxMesher<3>;
#endif

}  // namespace mesher
