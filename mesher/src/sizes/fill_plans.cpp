// Observations of plans, and limits that change them.
#include "sizes/fill_plans.hpp"

#include <bit>
#include <cmath>

#include "geometry/box.hpp"

namespace mesher::detail {

namespace {

std::uint64_t digest(const CellPlan& plan) {
  std::uint64_t all = plan.parts ? 1 : 0;
  const auto take = [&](double x) { all = sac::mix(all) + std::bit_cast<std::uint64_t>(x); };
  for (const Candidate& q : plan.candidates) {
    take(q.place[0]), take(q.place[1]);
    take(q.amid ? q.pitch : -q.pitch);
  }
  return all;
}

}  // namespace

using Traced = FillPlans<sac::Scope>;

CellPlan Traced::plan(sac::Scope& s, const Cell<2>& c) {
  CellPlan plan = plan_of(limits_, box_, c);
  const Point<2> middle = middle_of(plan.looked_at);
  const double reach = reach_of(plan.looked_at);
  const std::uint64_t answer = digest(plan);
  const auto same = [&](const PlanEdge& edge) {
    return edge.cell == c && edge.middle == middle && edge.reach == reach && edge.answer == answer;
  };
  if (s.recall<PlanEdge>(id_, kPlan, same) != nullptr) return plan;
  auto& edge = s.observe<PlanEdge>(id_, kPlan);
  edge.cell = c;
  edge.middle = middle;
  edge.reach = reach;
  edge.answer = answer;
  edge.call = engine_.handle_of(s.self());
  edge.listed = false;  // nothing to take back, should listing fail
  s.guarded([&] { looks_.insert(middle, reach, engine_.arena().handle_of(&edge)); });
  edge.listed = true;
  return plan;
}

void Traced::limits_changed(const Box<2>& where) noexcept {
  looks_.visit_beside(where, [&](sac::Handle h) {
    const PlanEdge& edge = at(h);
    engine_.invalidate(engine_.call(edge.call), &edge);
  });
}

void Traced::retract(sac::Call&, sac::Edge& edge) noexcept {
  const auto& plan = static_cast<const PlanEdge&>(edge);
  if (plan.listed) looks_.erase(plan.middle, engine_.arena().handle_of(&plan));
}

void Traced::label(const sac::Call&, const sac::Edge& edge, sac::LabelSink& sink) const {
  sink.number(static_cast<const PlanEdge&>(edge).answer);
}

void Traced::print(const sac::Call&, const sac::Edge& edge, std::ostream& out) const {
  const CellPlan plan = plan_of(limits_, box_, static_cast<const PlanEdge&>(edge).cell);
  if (plan.parts) {
    out << "is filled in parts";
  } else {
    out << plan.candidates.size() << " candidates";
  }
}

void Traced::check_invariants() const {
  looks_.check_invariants();
  looks_.visit_all([&](sac::Handle h) {
    const PlanEdge& edge = at(h);
    SAC_INVARIANT(edge.listed && !engine_.call(edge.call).dead());
    SAC_INVARIANT(edge.answer == digest(plan_of(limits_, box_, edge.cell)));
  });
}

}  // namespace mesher::detail
