// Reverses a list.
//
// A node of the result is an object keyed by its original. The call for the node before it links
// it, since that call has both nodes: so no call has the rest of the result, which changes at an
// insertion, as an argument. [Aca05] passes it along, and makes one more call anew.
//
// From scratch O(n); an insertion or deletion O(1).
#pragma once

#include "list.hpp"

namespace examples {

/// The copy of `in`, whose link the caller writes; the copy of the last node goes to `result`.
struct ReverseNode {
  static constexpr std::string_view kName = "reverse_node";
  template <class S>
  void operator()(S& s, Node<S>& self, const Node<S>* in, NodeMod<S> result) const;
};
inline constexpr ReverseNode reverse_node{};

template <class S>
void ReverseNode::operator()(S& s, Node<S>& self, const Node<S>* in, NodeMod<S> result) const {
  self.element = in->element;
  const Node<S>* const next = s.read(in->next);
  if (next == nullptr) return s.write(result, &self);
  Node<S>& before = s.template tail_make<Node<S>, reverse_node>(next, result);
  s.write(before.next, &self);
}

/// Writes the first node of `list` backwards to `result`; null if it is empty.
struct ReverseList {
  static constexpr std::string_view kName = "reverse_list";
  template <class S>
  void operator()(S& s, const Node<S>* list, NodeMod<S> result) const {
    const Node<S>* const first = s.read(list->next);
    if (first == nullptr) return s.write(result, nullptr);
    Node<S>& last = s.template tail_make<Node<S>, reverse_node>(first, result);
    s.write(last.next, nullptr);
  }
};
inline constexpr ReverseList reverse_list{};

}  // namespace examples
