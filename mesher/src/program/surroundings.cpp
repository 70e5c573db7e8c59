// Observations of the room that features leave, and what changes them.
#include "program/surroundings.hpp"

#include <algorithm>

#include "geometry/box.hpp"
#include "geometry/plane_vectors.hpp"

namespace mesher::detail {

namespace {

// Requires: candidates is not empty.
template <class S, int D>
Box<D> extent_of(const Candidates<D>& candidates) {
  Box<D> all{candidates.front().place, candidates.front().place};
  for (const auto& q : candidates) {
    const Box<D> one = around(q.place, Obstacles<S, D>::kReach * q.pitch);
    grow(all, one.lo);
    grow(all, one.hi);
  }
  return all;
}

template <class S, int D>
std::vector<Room> rooms_of(const Candidates<D>& candidates, const Obstacles<S, D>& obstacles) {
  std::vector<Room> rooms(candidates.size(), Room::ample);
  if (candidates.empty() || !obstacles.any_in(extent_of<S>(candidates))) return rooms;
  std::transform(candidates.begin(), candidates.end(), rooms.begin(),
                 [&](const auto& q) { return obstacles.room(q.place, q.pitch); });
  return rooms;
}

std::uint64_t digest(const std::vector<Room>& rooms) {
  std::uint64_t all = rooms.size();
  for (const Room r : rooms) all = sac::mix(all) + static_cast<std::uint64_t>(r);
  return all;
}

}  // namespace

template <int D>
std::vector<Room> Surroundings<sac::PlainScope, D>::rooms(sac::PlainScope&, const Cell<D>&,
                                                          const Candidates<D>& candidates) const {
  return rooms_of(candidates, obstacles_);
}

template <int D>
auto Surroundings<sac::Scope, D>::rooms(sac::Scope& s, const Cell<D>& c,
                                        const Candidates<D>& candidates) -> std::vector<Room> {
  std::vector<Room> rooms = rooms_of(candidates, obstacles_);
  if (candidates.empty()) return rooms;
  const Box<D> extent = extent_of<sac::Scope>(candidates);
  const auto same = [&](const AskEdge& ask) { return ask.cell == c && ask.extent == extent; };
  if (auto* ask = s.template recall<AskEdge>(id_, kAsk, same)) {
    ask->answer = digest(rooms);
    return rooms;
  }
  auto& ask = s.template observe<AskEdge>(id_, kAsk);
  ask.cell = c;
  ask.extent = extent;
  ask.answer = digest(rooms);
  ask.call = engine_.handle_of(s.self());
  ask.listed = false;  // nothing to take back, should listing fail
  s.guarded([&] {
    asks_.insert(middle_of(ask.extent), reach_of(ask.extent), engine_.arena().handle_of(&ask));
  });
  ask.listed = true;
  return rooms;
}

// Calls visit(ask) for the answers that a feature there may change.
template <int D>
template <class Visit>
void Surroundings<sac::Scope, D>::visit_near(const FeatureExtent<D>& where,
                                             Visit&& visit) const noexcept {
  if (asks_.size() == 0) return;
  Box<D> near = around(where.p, where.slack);
  const Box<D> end = around(where.q, where.slack);
  grow(near, end.lo), grow(near, end.hi);
  asks_.visit_near(where.p, where.q, where.slack, [&](sac::Handle h) {
    const AskEdge& ask = at(h);
    const bool beside = is_empty(common(ask.extent, near));
    if (!beside) visit(ask);
  });
}

template <int D>
void Surroundings<sac::Scope, D>::changed(const FeatureExtent<D>& where) noexcept {
  visit_near(where, [&](const AskEdge& ask) { engine_.doubt(engine_.call(ask.call)); });
}

template <int D>
bool Surroundings<sac::Scope, D>::concerned(const Point<D>& p) const noexcept {
  bool any = false;
  visit_near({p, p}, [&](const AskEdge&) { any = true; });
  return any;
}

template <int D>
void Surroundings<sac::Scope, D>::retract(sac::Call&, sac::Edge& edge) noexcept {
  const auto& ask = static_cast<const AskEdge&>(edge);
  if (ask.listed) asks_.erase(middle_of(ask.extent), engine_.arena().handle_of(&ask));
}

template <int D>
std::uint64_t Surroundings<sac::Scope, D>::answer_now(const AskEdge& ask) const {
  return digest(rooms_of(plan_of(limits_, box_, ask.cell).candidates, obstacles_));
}

template <int D>
bool Surroundings<sac::Scope, D>::unchanged(sac::Call&, sac::Edge& edge) {
  const auto& ask = static_cast<const AskEdge&>(edge);
  return ask.answer == answer_now(ask);
}

template <int D>
void Surroundings<sac::Scope, D>::label(const sac::Call&, const sac::Edge& edge,
                                        sac::LabelSink& sink) const {
  sink.number(static_cast<const AskEdge&>(edge).answer);
}

template <int D>
void Surroundings<sac::Scope, D>::print(const sac::Call&, const sac::Edge& edge,
                                        std::ostream& out) const {
  const auto& ask = static_cast<const AskEdge&>(edge);
  const Candidates<D> candidates = plan_of(limits_, box_, ask.cell).candidates;
  const std::vector<Room> rooms = rooms_of(candidates, obstacles_);
  out << candidates.size() << " candidates, " << std::count(rooms.begin(), rooms.end(), Room::none)
      << " beside features";
}

template <int D>
void Surroundings<sac::Scope, D>::check_invariants() const {
  asks_.check_invariants();
  asks_.visit_all([&](sac::Handle h) {
    const AskEdge& ask = at(h);
    SAC_INVARIANT(ask.listed && !engine_.call(ask.call).dead());
    SAC_INVARIANT(ask.answer == answer_now(ask));
  });
}

template class Surroundings<sac::PlainScope, 2>;
template class Surroundings<sac::Scope, 2>;
#ifndef MESHER_PLANE_ONLY
template class Surroundings<sac::PlainScope, 3>;
template class Surroundings<sac::Scope, 3>;
#endif

}  // namespace mesher::detail
