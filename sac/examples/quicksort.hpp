// Quicksort of a list.
//
// The list is cut into chunks (chunk.hpp). The pivot is the median of the first three boundaries;
// two passes make the lists of what is less and of what is greater, as objects keyed by the chunk
// that they come from and the pivot. Sorting a part is a call (part, node before, node after): the
// nodes are those of pivots, so nothing is appended, and an insertion into one part leaves the
// labels of all others as they are. A list of up to three chunks is sorted at once.
//
// For a random order of the elements: from scratch O(n log n). An inserted or deleted element is in
// O(log n) parts, in one chunk of each, which two calls read: O(log n) calls. With probability
// O(1/k) it changes the pivot of a part of k elements, which is sorted anew: O(log^2 n) expected.
// Source: [Aca05], there without chunks, and with the first element as the pivot.
#pragma once

#include <algorithm>
#include <iterator>

#include "chunk.hpp"

namespace examples {

/// The elements of `from`, and of the chunks behind it, that are less than the pivot (kLess) or
/// greater.
template <bool kLess>
struct Part {
  template <class S>
  void operator()(S& s, Chunk<S>& self, const Chunk<S>* from, Element pivot) const;
};
template <bool kLess>
inline constexpr Part<kLess> part{};

template <bool kLess>
template <class S>
void Part<kLess>::operator()(S& s, Chunk<S>& self, const Chunk<S>* from, Element pivot) const {
  const auto belongs = [&](const Element& e) { return kLess ? e < pivot : pivot < e; };
  self.boundary = from->boundary;
  typename Chunk<S>::State part_state;
  part_state.elements.reserve(kRoom);
  const Chunk<S>* chunk = from;
  do {  // chunks whose boundary does not belong are joined to the one before
    const auto& state = s.read(chunk->state);
    std::copy_if(state.elements.begin(), state.elements.end(),
                 std::back_inserter(part_state.elements), belongs);
    chunk = state.next;
  } while (chunk != nullptr && !belongs(chunk->boundary));
  if (chunk != nullptr) {
    part_state.next = &s.template tail_make<Chunk<S>, part<kLess>>(chunk, pivot);
  }
  s.write(self.state, std::move(part_state));
}

/// Links nodes for the elements of `list`, sorted, between two nodes.
struct QuicksortPart {
  static constexpr std::string_view kName = "quicksort_part";
  template <class S>
  void operator()(S& s, const Chunk<S>* list, Node<S>* before, const Node<S>* after) const;
};
inline constexpr QuicksortPart quicksort_part{};

template <class S>
void QuicksortPart::operator()(S& s, const Chunk<S>* list, Node<S>* before,
                               const Node<S>* after) const {
  std::vector<Element> elements;
  std::vector<Element> boundaries;
  for (const Chunk<S>* chunk = list; chunk != nullptr && boundaries.size() < 3;) {
    const auto& state = s.read(chunk->state);
    elements.insert(elements.end(), state.elements.begin(), state.elements.end());
    chunk = state.next;
    if (chunk != nullptr) boundaries.push_back(chunk->boundary);
  }
  if (boundaries.size() < 3) {
    std::sort(elements.begin(), elements.end());
    return s.write(link_behind(s, before, elements, list)->next, after);
  }
  std::sort(boundaries.begin(), boundaries.end());
  const Element pivot = boundaries[1];
  const Chunk<S>& less = s.template make<Chunk<S>, part<true>>(list, pivot);
  const Chunk<S>& greater = s.template make<Chunk<S>, part<false>>(list, pivot);
  Node<S>& middle = node_of(s, pivot, list);
  s.template call<quicksort_part>(&less, before, static_cast<const Node<S>*>(&middle));
  s.template tail<quicksort_part>(&greater, &middle, after);
}

/// Writes the header of `list` sorted to `result`.
struct Quicksort {
  static constexpr std::string_view kName = "quicksort";
  template <class S>
  void operator()(S& s, const Node<S>* list, NodeMod<S> result) const {
    const Chunk<S>& chunks = s.template make<Chunk<S>, cut_into_chunks>(list);
    Node<S>& header = node_of(s, Element{});
    s.write(result, &header);
    s.template tail<quicksort_part>(&chunks, &header, static_cast<const Node<S>*>(nullptr));
  }
};
inline constexpr Quicksort quicksort{};

}  // namespace examples
