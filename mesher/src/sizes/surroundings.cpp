// Observations of the room that features leave, and what changes them.
#include "sizes/surroundings.hpp"

#include <algorithm>

#include "geometry/box.hpp"
#include "geometry/plane.hpp"

namespace mesher::detail {

namespace {

// Requires: candidates is not empty.
Box<2> extent_of(const Candidates& candidates) {
  Box<2> all{candidates.front().place, candidates.front().place};
  for (const auto& q : candidates) {
    const Box<2> one = around(q.place, kUndisturbed * q.pitch);
    grow(all, one.lo);
    grow(all, one.hi);
  }
  return all;
}

template <class S>
bool has_within(const Features<S>& features, const Point<2>& p, double distance) {
  return features.visit_features_in(around(p, distance), [&](const Vertex<2>& v) {
    return squared_distance(v.p, p) < distance * distance;
  });
}

template <class S>
std::vector<Room> rooms_of(const Candidates& candidates, const Features<S>& features) {
  std::vector<Room> rooms(candidates.size(), Room::ample);
  if (candidates.empty()) return rooms;
  const auto any = [](const Vertex<2>&) { return true; };
  if (!features.visit_features_in(extent_of(candidates), any)) return rooms;
  std::transform(candidates.begin(), candidates.end(), rooms.begin(), [&](const auto& q) {
    if (!has_within(features, q.place, kUndisturbed * q.pitch)) return Room::ample;
    return has_within(features, q.place, kClear * q.pitch) ? Room::none : Room::some;
  });
  return rooms;
}

std::uint64_t digest(const std::vector<Room>& rooms) {
  std::uint64_t all = rooms.size();
  for (const Room r : rooms) all = sac::mix(all) + static_cast<std::uint64_t>(r);
  return all;
}

}  // namespace

std::vector<Room> Surroundings<sac::PlainScope>::rooms(sac::PlainScope&, const Cell<2>&,
                                                       const Candidates& candidates) const {
  return rooms_of(candidates, features_);
}

using Traced = Surroundings<sac::Scope>;

std::vector<Room> Traced::rooms(sac::Scope& s, const Cell<2>& c, const Candidates& candidates) {
  std::vector<Room> rooms = rooms_of(candidates, features_);
  if (candidates.empty()) return rooms;
  const Box<2> extent = extent_of(candidates);
  const auto same = [&](const AskEdge& ask) { return ask.cell == c && ask.extent == extent; };
  if (auto* ask = s.recall<AskEdge>(id_, kAsk, same)) {
    ask->answer = digest(rooms);
    return rooms;
  }
  auto& ask = s.observe<AskEdge>(id_, kAsk);
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

void Traced::feature_changed(const Point<2>& p) noexcept {
  if (asks_.size() == 0) return;
  asks_.visit_at(p, [&](sac::Handle h) {
    const AskEdge& ask = at(h);
    if (contains(ask.extent, p)) engine_.doubt(engine_.call(ask.call));
  });
}

void Traced::retract(sac::Call&, sac::Edge& edge) noexcept {
  const auto& ask = static_cast<const AskEdge&>(edge);
  if (ask.listed) asks_.erase(middle_of(ask.extent), engine_.arena().handle_of(&ask));
}

std::uint64_t Traced::answer_now(const AskEdge& ask) const {
  return digest(rooms_of(plan_of(limits_, box_, ask.cell).candidates, features_));
}

bool Traced::unchanged(sac::Call&, sac::Edge& edge) {
  const auto& ask = static_cast<const AskEdge&>(edge);
  return ask.answer == answer_now(ask);
}

void Traced::label(const sac::Call&, const sac::Edge& edge, sac::LabelSink& sink) const {
  sink.number(static_cast<const AskEdge&>(edge).answer);
}

void Traced::print(const sac::Call&, const sac::Edge& edge, std::ostream& out) const {
  const auto& ask = static_cast<const AskEdge&>(edge);
  const Candidates candidates = plan_of(limits_, box_, ask.cell).candidates;
  const std::vector<Room> rooms = rooms_of(candidates, features_);
  out << candidates.size() << " candidates, " << std::count(rooms.begin(), rooms.end(), Room::none)
      << " beside features";
}

void Traced::check_invariants() const {
  asks_.check_invariants();
  asks_.visit_all([&](sac::Handle h) {
    const AskEdge& ask = at(h);
    SAC_INVARIANT(ask.listed && !engine_.call(ask.call).dead());
    SAC_INVARIANT(ask.answer == answer_now(ask));
  });
}

}  // namespace mesher::detail
