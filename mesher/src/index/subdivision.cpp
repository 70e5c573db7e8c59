// Marks are recalled where the same call splits again, and taken back with it.
#include "index/subdivision.hpp"

namespace mesher::detail {

template <int D>
void Subdivision<sac::Scope, D>::split(sac::Scope& s, const Cell<D>& cell) {
  const auto done = [](const SplitEdge& edge) { return edge.node != SplitEdge::kNone; };
  if (s.recall<SplitEdge>(id_, kSplit, done) != nullptr) return;
  auto& edge = s.effect<SplitEdge>(id_, kSplit);
  edge.node = SplitEdge::kNone;  // nothing to take back, should marking fail
  edge.node = tree_.mark(cell);
}

template <int D>
void Subdivision<sac::Scope, D>::retract(sac::Call&, sac::Edge& edge) noexcept {
  const auto node = static_cast<SplitEdge&>(edge).node;
  if (node != SplitEdge::kNone) tree_.unmark(node);
}

template class Subdivision<sac::Scope, 2>;
#ifndef MESHER_PLANE_ONLY
template class Subdivision<sac::Scope, 3>;
template class Subdivision<sac::Scope, 4>;
#endif

}  // namespace mesher::detail
