// Linked lists with modifiable links, and what else the list examples share.
//
// A list is its header: the node before the first. So that an edit is always at the link of some
// node, and a program need not treat the beginning apart. Elements have ids of their own, all
// different; a program that flips coins takes them from the id [Aca05, §8.1]: not from places,
// which insertions move, and not from addresses, which differ from run to run.
#pragma once

#include <bit>
#include <compare>
#include <cstdint>
#include <ostream>
#include <vector>

#include "sac/sac.hpp"

namespace examples {

/// What lists hold: ordered by value, equal values by id.
struct Element {
  int value = 0;
  std::uint32_t id = 0;  ///< 0: a header, which holds nothing
  friend auto operator<=>(const Element&, const Element&) = default;
  friend std::uint64_t hash_value(const Element& e) noexcept {
    return sac::mix(std::uint64_t{e.id} << 32 | static_cast<std::uint32_t>(e.value));
  }
  friend std::ostream& operator<<(std::ostream& out, const Element& e) {
    return out << e.value << '#' << e.id;
  }
};

template <class S>
struct Node {
  Element element;
  typename S::template CellType<const Node*> next;  // null: the end
};

template <class S>
using NodeMod = typename S::template ModType<const Node<S>*>;

/// How many of the levels above the list an element reaches: k with probability 7/8^(k+1). A
/// header reaches all.
[[nodiscard]] inline int height(const Element& e) noexcept {
  if (e.id == 0) return 255;
  return std::countr_zero(sac::mix(e.id) | std::uint64_t{1} << 63) / 3;
}

/// The elements behind `node`, read by the host (sac::Engine, sac::PlainScope).
template <class Host, class N>
[[nodiscard]] std::vector<Element> elements_behind(Host& host, const N* node) {
  std::vector<Element> elements;
  while ((node = host.get(node->next)) != nullptr) elements.push_back(node->element);
  return elements;
}

}  // namespace examples
