// Linked lists with modifiable links, and other common parts of the list examples.
//
// A list is its header: the node before the first. So that an edit is always at the link of some
// node, and a program need not treat the beginning apart. Elements have ids of their own, all
// different; a program that flips coins takes them from the id [Aca05]: not from places,
// which insertions move, and not from addresses, which differ from run to run.
#pragma once

#include <bit>
#include <compare>
#include <cstdint>
#include <limits>
#include <ostream>
#include <vector>

#include "sac/sac.hpp"

namespace examples {

/// What lists hold: ordered by value, equal values by id.
struct Element {
  int value = std::numeric_limits<int>::min();  // a header's comes before all others
  std::uint32_t id = 0;                         ///< 0: a header, which holds nothing
  friend auto operator<=>(const Element&, const Element&) = default;
  friend std::uint64_t hash_value(const Element& e) noexcept {
    return sac::mix(std::uint64_t{e.id} << 32 | static_cast<std::uint32_t>(e.value));
  }
  friend std::ostream& operator<<(std::ostream& out, const Element& e) {
    return out << e.value << '#' << e.id;
  }
};

template <class S, class T = Element>
struct Node {
  T element;
  typename S::template CellType<const Node*> next;  // null: the end
};

template <class S, class T = Element>
using NodeMod = typename S::template ModType<const Node<S, T>*>;

/// How often the coin of an element fell on heads in a row: k with probability 1/2^(k+1). A
/// header's always does.
[[nodiscard]] inline int heads(std::uint32_t id) noexcept {
  return id == 0 ? 1000 : std::countr_zero(sac::mix(id));
}

/// The elements behind `node`, read by the host (sac::Engine, sac::PlainScope).
template <class Host, class N>
[[nodiscard]] auto elements_behind(Host& host, const N* node) {
  std::vector<decltype(node->element)> elements;
  while ((node = host.get(node->next)) != nullptr) elements.push_back(node->element);
  return elements;
}

}  // namespace examples
