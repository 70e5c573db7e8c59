// Observations of plans, and limits that change them.
#include "program/fill_plans.hpp"

#include <bit>
#include <cmath>

#include "geometry/box.hpp"

namespace mesher::detail {

namespace {

template <int D>
std::uint64_t digest(const CellPlan<D>& plan) {
  std::uint64_t all = plan.parts ? 1 : 0;
  const auto take = [&](double x) { all = sac::mix(all) + std::bit_cast<std::uint64_t>(x); };
  for (const Candidate<D>& q : plan.candidates) {
    for (const double x : q.place) take(x);
    take(q.amid ? q.pitch : -q.pitch);
  }
  return all;
}

}  // namespace

template <int D>
CellPlan<D> FillPlans<sac::Scope, D>::plan(sac::Scope& s, const Cell<D>& c) {
  CellPlan<D> plan = plan_of(limits_, box_, c);
  const Point<D> middle = middle_of(plan.looked_at);
  const double reach = reach_of(plan.looked_at);
  const std::uint64_t answer = digest(plan);
  const auto same = [&](const PlanEdge& edge) {
    return edge.cell == c && edge.middle == middle && edge.reach == reach && edge.answer == answer;
  };
  if (s.template recall<PlanEdge>(id_, kPlan, same) != nullptr) return plan;
  auto& edge = s.template observe<PlanEdge>(id_, kPlan);
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

template <int D>
void FillPlans<sac::Scope, D>::limits_changed(const Box<D>& where) noexcept {
  looks_.visit_beside(where, [&](sac::Handle h) {
    const PlanEdge& edge = at(h);
    engine_.invalidate(engine_.call(edge.call), &edge);
  });
}

template <int D>
void FillPlans<sac::Scope, D>::retract(sac::Call&, sac::Edge& edge) noexcept {
  const auto& plan = static_cast<const PlanEdge&>(edge);
  if (plan.listed) looks_.erase(plan.middle, engine_.arena().handle_of(&plan));
}

template <int D>
void FillPlans<sac::Scope, D>::label(const sac::Call&, const sac::Edge& edge,
                                     sac::LabelSink& sink) const {
  sink.number(static_cast<const PlanEdge&>(edge).answer);
}

template <int D>
void FillPlans<sac::Scope, D>::print(const sac::Call&, const sac::Edge& edge,
                                     std::ostream& out) const {
  const CellPlan<D> plan = plan_of(limits_, box_, static_cast<const PlanEdge&>(edge).cell);
  if (plan.parts) {
    out << "is filled in parts";
  } else {
    out << plan.candidates.size() << " candidates";
  }
}

template <int D>
void FillPlans<sac::Scope, D>::check_invariants() const {
  looks_.check_invariants();
  looks_.visit_all([&](sac::Handle h) {
    const PlanEdge& edge = at(h);
    SAC_INVARIANT(edge.listed && !engine_.call(edge.call).dead());
    SAC_INVARIANT(edge.answer == digest(plan_of(limits_, box_, edge.cell)));
  });
}

template class FillPlans<sac::Scope, 2>;
#ifndef MESHER_PLANE_ONLY
template class FillPlans<sac::Scope, 3>;
#endif

}  // namespace mesher::detail
