// A function of every element of a list.
//
// Each node of the result is an object keyed by the node that it is the image of; its body reads
// one link and writes one. An inserted element so costs two calls: its own, and that of the node
// before it, whose link has changed. Everything behind is requested with the same key and reused.
//
// From scratch O(n); an insertion or deletion O(1). Source: [Aca05].
#pragma once

#include "list.hpp"

namespace examples {

[[nodiscard]] inline Element image(const Element& e) noexcept {
  return {e.value / 3 + e.value / 7 + e.value / 9, e.id};
}

struct MapNode {
  static constexpr std::string_view kName = "map_node";
  template <class S>
  void operator()(S& s, Node<S>& self, const Node<S>* in) const;
};
inline constexpr MapNode map_node{};

template <class S>
void MapNode::operator()(S& s, Node<S>& self, const Node<S>* in) const {
  self.element = image(in->element);
  const Node<S>* const next = s.read(in->next);
  s.write(self.next, next == nullptr ? nullptr : &s.template tail_make<Node<S>, map_node>(next));
}

/// Writes the header of the image of `list` to `result`.
struct MapList {
  static constexpr std::string_view kName = "map_list";
  template <class S>
  void operator()(S& s, const Node<S>* list, NodeMod<S> result) const {
    s.write(result, &s.template make<Node<S>, map_node>(list));
  }
};
inline constexpr MapList map_list{};

}  // namespace examples
