// Lists of observations, and of what came since.
#include "index/observers.hpp"

#include <algorithm>

namespace mesher::detail {

template <int D>
void Observers<D>::link(Observation& o) noexcept {
  Vertex<D>& v = pool_[o.center];
  ++live_;
  o.arrivals = 0;
  o.next = v.queries;
  v.queries = engine_.arena().handle_of(&o);
  if (v.reach.covers(o.reach)) return;
  v.reach.include(o.reach);
  tree_.raise_reach(v);
}

template <int D>
void Observers<D>::unlink(Observation& o) noexcept {
  Vertex<D>& v = pool_[o.center];
  --live_;
  const sac::Handle self = engine_.arena().handle_of(&o);
  sac::Handle* link = &v.queries;
  while (*link != self) link = &at(*link).next;
  *link = o.next;
  v.reach = {};
  for (sac::Handle h = v.queries; h != 0; h = at(h).next) v.reach.include(at(h).reach);
}

template <int D>
std::span<const std::uint32_t> Observers<D>::seen(const Observation& o) const noexcept {
  if (o.kind == kNearest) return {&static_cast<const NearestSeen&>(o).nearest, 1};
  const auto& cell = static_cast<const CellSeen&>(o);
  return {cell.codes(), cell.count};
}

template <int D>
void Observers<D>::expect_arrivals() {
  if (arrivals_.capacity() - arrivals_.size() >= kRoom) return;
  arrivals_.reserve(2 * arrivals_.capacity() + kRoom);
}

template <int D>
void Observers<D>::note_arrival(Observation& o, VertexHandle w) noexcept {
  if (o.arrivals == kUnknown) return;
  if (arrivals_.size() == arrivals_.capacity()) {
    o.arrivals = kUnknown;
    return;
  }
  arrivals_.push_back({w, o.arrivals});
  o.arrivals = static_cast<std::uint32_t>(arrivals_.size() - 1);
}

template <int D>
void Observers<D>::check_invariants(const Vertex<D>& v) const {
  SAC_INVARIANT(arrivals_.size() == 1);
  Reach<D> reach;
  for (sac::Handle h = v.queries; h != 0; h = at(h).next) {
    const Observation& o = at(h);
    SAC_INVARIANT(o.center == v.self && o.arrivals == 0);
    SAC_INVARIANT(!engine_.call(o.call).dead());
    reach.include(o.reach);
  }
  SAC_INVARIANT(v.reach == reach);
}

template class Observers<2>;
#ifndef MESHER_PLANE_ONLY
template class Observers<3>;
template class Observers<4>;
#endif

}  // namespace mesher::detail
