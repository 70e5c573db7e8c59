// Rotating calipers: computes a value from the corners of two convex hulls in opposite directions.
//
// A line that turns clockwise by half a turn touches one hull in a corner p, and the parallel line
// on the other side of the other hull touches that one in q. A merge of the edges of the two hulls
// by direction visits the pairs (p, q) in order. A pair is an object keyed by its corners, and a
// member of a contraction (contraction.hpp), which folds the values of the pairs.
//
// From scratch O(corners); an added or removed corner costs O(1) pairs and O(log corners) folds.
// Source: Shamos 1978; Toussaint 1983.
//
// Op: Value, join; of(p, p2, q, q2), the value of a pair, where p2 and q2 are the next corners (p
// or q itself at the end of the half turn).
#pragma once

#include "quickhull.hpp"

namespace examples {

/// The pair (p, q) of half a turn that ends at (p_end, q_end), and those behind.
template <class Op>
struct Calipers {
  template <class S>
  void operator()(S& s, Group<S, Op>& self, bool first, const PointNode<S>* p,
                  const PointNode<S>* q, const PointNode<S>* p_end,
                  const PointNode<S>* q_end) const;
};
template <class Op>
inline constexpr Calipers<Op> calipers{};

template <class Op>
template <class S>
void Calipers<Op>::operator()(S& s, Group<S, Op>& self, bool first, const PointNode<S>* p,
                              const PointNode<S>* q, const PointNode<S>* p_end,
                              const PointNode<S>* q_end) const {
  using G = Group<S, Op>;
  const auto pair_id = static_cast<std::uint32_t>(sac::mix(p->element.id) + q->element.id);
  self.height = height_of(first ? 0 : pair_id);
  const PointNode<S>* const p2 = p == p_end ? p : s.read(p->next);
  const PointNode<S>* const q2 = q == q_end ? q : s.read(q->next);
  const G* next = nullptr;
  if (p != p_end || q != q_end) {
    // Turning clockwise, which edge comes first: p p2, or q q2 seen from the other side?
    const bool p_moves =
        q == q_end || (p != p_end && cross(p->element, p2->element, q2->element, q->element) <= 0);
    next = &s.template tail_make<G, calipers<Op>>(false, p_moves ? p2 : p, p_moves ? q : q2, p_end,
                                                  q_end);
  }
  s.write(self.state, {Op::of(p->element, p2->element, q->element, q2->element), next});
}

/// Writes the fold over the pairs of half a turn to `result`.
template <class Op>
struct FoldPairs {
  template <class S>
  void operator()(S& s, const PointNode<S>* p, const PointNode<S>* q, const PointNode<S>* p_end,
                  const PointNode<S>* q_end,
                  typename S::template ModType<typename Op::Value> result) const {
    using G = Group<S, Op>;
    const G* pairs = &s.template make<G, calipers<Op>>(true, p, q, p_end, q_end);
    s.template tail<contract_all<Op>>(pairs, result);
  }
};
template <class Op>
inline constexpr FoldPairs<Op> fold_pairs{};

}  // namespace examples
