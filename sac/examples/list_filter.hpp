// The elements of a list for which a predicate holds.
//
// Each node of the result is an object keyed by the node it is a copy of. Its body looks for the
// next element that is kept; elements that are not are passed over by one call each, (kept, node),
// which depends on the kept node before it only.
//
// From scratch O(n). An insertion or deletion costs O(1) calls, and one for each element passed
// over behind a kept element that is inserted or deleted: O(1) expected if a constant fraction of
// the elements is kept. Source: [Aca05], where calls carry the destination of the next node.
#pragma once

#include "list.hpp"

namespace examples {

[[nodiscard]] inline bool is_kept(const Element& e) noexcept { return e.value % 2 == 0; }

struct FilterNode {
  static constexpr std::string_view kName = "filter_node";
  template <class S>
  void operator()(S& s, Node<S>& self, const Node<S>* in) const;
};
inline constexpr FilterNode filter_node{};

/// Links `kept` to the copy of the first node behind `at` that is kept.
struct FilterBehind {
  static constexpr std::string_view kName = "filter_behind";
  template <class S>
  void operator()(S& s, Node<S>* kept, const Node<S>* at) const;
};
inline constexpr FilterBehind filter_behind{};

template <class S>
void FilterBehind::operator()(S& s, Node<S>* kept, const Node<S>* at) const {
  const Node<S>* const next = s.read(at->next);
  if (next == nullptr) {
    s.write(kept->next, nullptr);
  } else if (is_kept(next->element)) {
    s.write(kept->next, &s.template tail_make<Node<S>, filter_node>(next));
  } else {
    s.template tail<filter_behind>(kept, next);
  }
}

template <class S>
void FilterNode::operator()(S& s, Node<S>& self, const Node<S>* in) const {
  self.element = in->element;
  filter_behind(s, &self, in);
}

/// Writes the header of the kept part of `list` to `result`.
struct FilterList {
  static constexpr std::string_view kName = "filter_list";
  template <class S>
  void operator()(S& s, const Node<S>* list, NodeMod<S> result) const {
    s.write(result, &s.template make<Node<S>, filter_node>(list));
  }
};
inline constexpr FilterList filter_list{};

}  // namespace examples
