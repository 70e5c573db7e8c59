// What is refused when it is announced, and what is judged with everything else.
#include "facade/announced_points.hpp"

#include "geometry/input_point.hpp"
#include "text/id_text.hpp"

namespace mesher::detail {

namespace {

// Zero has no sign.
template <std::size_t N>
std::array<double, N> unsigned_zero(std::array<double, N> p) {
  for (double& x : p) x += 0.0;
  return p;
}

}  // namespace

template <int D>
auto AnnouncedPoints<D>::place(const State& state, PointId id) const -> Place {
  const auto* edit = pending_.find(id);
  return edit != nullptr ? edit->to : state.place(id);
}

template <int D>
void AnnouncedPoints<D>::require_known(const State& state, PointId id) const {
  if (place(state, id)) return;
  throw Error(ErrorCode::unknown_id, "point " + id_text(id) + " is not there", {},
              {mesher::Feature(id)});
}

template <int D>
void AnnouncedPoints<D>::require_free(const State& state, PointId id, const Point<D>& p) const {
  if (const auto* other = pending_.arrival_near(p, id)) {
    fail_too_near(p, id, *other->to, other->id);
  }
  const auto there = state.obstacle(p);
  if (!there || there->id == id || pending_.find(there->id) != nullptr) return;
  fail_too_near(p, id, there->p, there->id);
}

// The announced places, as they are when all edits are made.
template <int D>
void AnnouncedPoints<D>::require_apart(const State& state) const {
  if (!moved_) return;
  for (const auto& edit : pending_.sorted()) {
    if (edit.to) require_free(state, edit.id, *edit.to);
  }
}

template <int D>
void AnnouncedPoints<D>::insert(const State& state, PointId id, const Point<D>& p, Judged when) {
  if (place(state, id)) {
    throw Error(ErrorCode::repeated_id, "point " + id_text(id) + " is there already", {},
                {mesher::Feature(id)});
  }
  check_point(p, domain_, id);
  const auto was = state.place(id);
  const bool waits = was || when == Judged::at_the_end;
  if (!waits) require_free(state, id, p);
  moved_ |= waits;
  pending_.set(id, was, unsigned_zero(p));
}

template <int D>
void AnnouncedPoints<D>::remove(const State& state, PointId id) {
  require_known(state, id);
  pending_.set(id, state.place(id), {});
}

template <int D>
void AnnouncedPoints<D>::move(const State& state, PointId id, const Point<D>& p) {
  require_known(state, id);
  check_point(p, domain_, id);
  moved_ = true;
  pending_.set(id, state.place(id), unsigned_zero(p));
}

template <int D>
PointEdits<D> AnnouncedPoints<D>::all(const State& state) const {
  Pending<D> all(box_);
  for (const GraphPoint<D>& p : state.points()) {
    if (const Place to = place(state, p.id)) all.set(p.id, {}, to);
  }
  for (const auto& edit : pending_.sorted()) {
    if (!edit.was) all.set(edit.id, {}, edit.to);
  }
  return all.sorted();
}

template <int D>
void AnnouncedPoints<D>::clear() noexcept {
  pending_.clear();
  moved_ = false;
}

template class AnnouncedPoints<2>;
#ifndef MESHER_PLANE_ONLY
template class AnnouncedPoints<3>;
#endif

}  // namespace mesher::detail
