// The facade: announced edits on one side, the state that updates work on at the other.
#include "mesher/mesher.hpp"

#include <algorithm>
#include <string>

#include "facade/announced.hpp"
#include "facade/busy.hpp"
#include "facade/meter.hpp"
#include "facade/state.hpp"
#include "input.hpp"
#include "mesher/predicates.hpp"

namespace mesher {

namespace {

std::string text(FeatureId id) { return std::to_string(static_cast<std::int64_t>(id)); }

}  // namespace

template <>
struct Mesher<2>::Impl {
  explicit Impl(const Options<2>& o)
      : options(o), state(std::make_unique<detail::State>(o)), box(state->box()), announced(box) {
    predicates::self_test();
  }

  [[nodiscard]] detail::Announced::Place place(FeatureId id) const;
  void require_known(FeatureId id) const;
  void require_free(FeatureId id, const Point<2>& p) const;
  void require_apart(const std::vector<detail::Announced::Edit>& edits) const;
  void insert(FeatureId id, const Point<2>& p);
  [[nodiscard]] const detail::LinePoints& line(FeatureId id) const;
  void insert_line(FeatureId id, const detail::LinePoints& points);
  void remove_line(FeatureId id);
  [[nodiscard]] detail::AllLimits limits() const { return announced_limits.as_announced(options); }
  void limit(detail::AllLimits limits, const std::vector<Box<2>>& where);
  void discard_edits() noexcept;
  Change<2> run(const RunControl& control, const Accept& accept);
  Change<2> update(const RunControl& control, const Accept& accept);

  Options<2> options;                    // with the limits of the last update
  std::unique_ptr<detail::State> state;  // of the last update
  detail::MeshBox<2> box;
  detail::Announced announced;
  detail::AnnouncedLines announced_lines;
  detail::AnnouncedLimits announced_limits;
  detail::Busy busy;
  bool moved = false;  // a place was taken that was not looked at
};

// --- Edits -----------------------------------------------------------------------------------

detail::Announced::Place Mesher<2>::Impl::place(FeatureId id) const {
  const auto* edit = announced.find(id);
  return edit != nullptr ? edit->to : state->place(id);
}

void Mesher<2>::Impl::require_known(FeatureId id) const {
  if (place(id)) return;
  throw Error(ErrorCode::unknown_id, "point " + text(id) + " is not there", {}, {id});
}

void Mesher<2>::Impl::require_free(FeatureId id, const Point<2>& p) const {
  if (const auto* other = announced.arrival_near(p, id)) {
    detail::fail_too_near(p, id, *other->to, other->id);
  }
  const auto there = state->obstacle(p);
  if (!there || there->id == id || announced.find(there->id) != nullptr) return;
  detail::fail_too_near(p, id, there->p, there->id);
}

// The announced places, as they are when all edits are made.
void Mesher<2>::Impl::require_apart(const std::vector<detail::Announced::Edit>& edits) const {
  for (const auto& edit : edits) {
    if (edit.to) require_free(edit.id, *edit.to);
  }
}

void Mesher<2>::Impl::insert(FeatureId id, const Point<2>& p) {
  busy.require_idle();
  if (place(id)) {
    throw Error(ErrorCode::repeated_id, "point " + text(id) + " is there already", {}, {id});
  }
  detail::check_point(p, options.domain, id);
  const auto was = state->place(id);
  if (!was) require_free(id, p);
  moved |= was.has_value();
  announced.set(id, was, Point<2>{p[0] + 0.0, p[1] + 0.0});  // zero has no sign
}

const detail::LinePoints& Mesher<2>::Impl::line(FeatureId id) const {
  const auto* edit = announced_lines.find(id);
  return edit != nullptr ? edit->to : state->line(id);
}

void Mesher<2>::Impl::insert_line(FeatureId id, const detail::LinePoints& points) {
  busy.require_idle();
  if (options.rule != Rule::radius_edge) {
    throw Error(ErrorCode::bad_option, "segments need the rule radius_edge", {}, {id});
  }
  if (points.size() < 2) {
    throw Error(ErrorCode::bad_option, "line " + text(id) + " has fewer than two points", {}, {id});
  }
  if (!line(id).empty()) {
    throw Error(ErrorCode::repeated_id, "line " + text(id) + " is there already", {}, {id});
  }
  const auto same = std::adjacent_find(points.begin(), points.end());
  if (same != points.end()) detail::fail_zero_length(id, *same);
  announced_lines.set(id, state->line(id), points);
}

void Mesher<2>::Impl::remove_line(FeatureId id) {
  busy.require_idle();
  if (line(id).empty()) {
    throw Error(ErrorCode::unknown_id, "line " + text(id) + " is not there", {}, {id});
  }
  announced_lines.set(id, state->line(id), {});
}

// Limits that make no sense are refused at once.
void Mesher<2>::Impl::limit(detail::AllLimits limits, const std::vector<Box<2>>& where) {
  busy.require_idle();
  Options<2> all = options;
  detail::AllLimits(limits).apply_to(all);
  static_cast<void>(detail::Limits(all, box));
  announced_limits.set(std::move(limits), where, options);
}

void Mesher<2>::Impl::discard_edits() noexcept {
  announced_limits.clear();
  announced_lines.clear();
  announced.clear();
  moved = false;
}

// --- Updates ---------------------------------------------------------------------------------

Change<2> Mesher<2>::Impl::run(const RunControl& control, const Accept& accept) {
  detail::Edits edits{announced.sorted(), announced_lines.sorted(), announced_limits.edit(options)};
  if (moved) require_apart(edits.points);
  if (state->ran()) return state->propagate(edits, control, accept);
  auto fresh = std::make_unique<detail::State>(announced_limits.applied_to(options));
  Change<2> change = fresh->first_run(std::move(edits), control, accept);
  state = std::move(fresh);
  return change;
}

Change<2> Mesher<2>::Impl::update(const RunControl& control, const Accept& accept) {
  const detail::Busy::Run running(busy);
  detail::require_unstopped(control);
  try {
    Change<2> change = run(control, accept);
    announced_limits.commit(options);
    discard_edits();
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
  std::size_t done = 0;
  try {
    for (; done < ids.size(); ++done) impl_->insert(ids[done], points[done]);
  } catch (...) {
    while (done-- > 0) impl_->announced.set(ids[done], impl_->state->place(ids[done]), {});
    throw;
  }
}

template <int D>
void Mesher<D>::remove(FeatureId id) {
  impl_->busy.require_idle();
  impl_->require_known(id);
  impl_->announced.set(id, impl_->state->place(id), {});
}

template <int D>
void Mesher<D>::move(FeatureId id, const Point<D>& point) {
  impl_->busy.require_idle();
  impl_->require_known(id);
  detail::check_point(point, impl_->options.domain, id);
  impl_->moved = true;
  impl_->announced.set(id, impl_->state->place(id), Point<D>{point[0] + 0.0, point[1] + 0.0});
}

template <int D>
void Mesher<D>::insert_segment(FeatureId id, FeatureId from, FeatureId to) {
  impl_->insert_line(id, {from, to});
}

template <int D>
void Mesher<D>::insert_polyline(FeatureId id, const std::vector<FeatureId>& points) {
  impl_->insert_line(id, points);
}

template <int D>
void Mesher<D>::remove_segment(FeatureId id) {
  impl_->remove_line(id);
}

template <int D>
void Mesher<D>::limit(const SizeLimits<D>& limits) {
  impl_->limit({limits, {}, impl_->limits().regions}, {impl_->options.domain});
}

template <int D>
void Mesher<D>::limit(const Box<D>& box, const SizeLimits<D>& limits) {
  detail::AllLimits all = impl_->limits();
  all.set_within(box, limits);
  impl_->limit(std::move(all), {box});
}

template <int D>
void Mesher<D>::limit_regions(std::shared_ptr<const RegionLimits> regions,
                              const std::vector<Box<D>>& where) {
  detail::AllLimits all = impl_->limits();
  all.regions = std::move(regions);
  impl_->limit(std::move(all), where);
}

template <int D>
bool Mesher<D>::has_limits() const {
  return impl_->limits().any();
}

// In the other: lines go first, and points before others come to their places.
template <int D>
void Mesher<D>::announce_to(Mesher& other) const {
  const auto lines = impl_->announced_lines.sorted();
  for (const auto& edit : lines) {
    if (!edit.was.empty()) other.remove_segment(edit.id);
  }
  for (const auto& edit : impl_->announced.sorted()) {  // those that go are the first
    if (edit.was) edit.to ? other.move(edit.id, *edit.to) : other.remove(edit.id);
  }
  for (const auto& edit : impl_->announced.sorted()) {
    if (!edit.was) other.insert(edit.id, *edit.to);
  }
  for (const auto& edit : lines) {
    if (!edit.to.empty()) other.insert_polyline(edit.id, edit.to);
  }
}

template <int D>
bool Mesher<D>::contains_line(FeatureId id) const {
  return !impl_->line(id).empty();
}

template <int D>
void Mesher<D>::discard_edits() noexcept {
  if (impl_->busy.is_idle()) impl_->discard_edits();
}

template <int D>
Change<D> Mesher<D>::update(const RunControl& control) {
  return impl_->update(control, {});
}

template <int D>
Change<D> Mesher<D>::update(const RunControl& control, const Accept& accept) {
  return impl_->update(control, accept);
}

template <int D>
Mesh<D> Mesher<D>::mesh() const {
  impl_->busy.require_idle();
  return impl_->state->ran() ? impl_->state->mesh() : Mesh<D>();
}

template <int D>
std::vector<InputPoint<D>> Mesher<D>::points() const {
  impl_->busy.require_idle();
  return impl_->state->points();
}

template <int D>
std::vector<InputLine> Mesher<D>::lines() const {
  impl_->busy.require_idle();
  return impl_->state->lines();
}

template <int D>
std::size_t Mesher<D>::size() const {
  return impl_->state->size() + static_cast<std::size_t>(impl_->announced.growth());
}

template <int D>
bool Mesher<D>::contains(FeatureId id) const {
  return impl_->place(id).has_value();
}

template <int D>
MeshStats Mesher<D>::stats() const {
  return impl_->state->stats();
}

template <int D>
const Options<D>& Mesher<D>::options() const {
  return impl_->options;
}

template <int D>
const sac::Engine& Mesher<D>::engine() const {
  return impl_->state->engine();
}

template <int D>
void Mesher<D>::check_invariants() const {
  if (impl_->state->ran()) impl_->state->check_invariants();
}

template class Mesher<2>;

}  // namespace mesher
