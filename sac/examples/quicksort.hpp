// Quicksort of a list.
//
// The list is cut into chunks (chunk.hpp). The pivot is the median of the first three boundaries;
// two filters make the lists of smaller and of greater elements, as objects keyed by the pivot and
// the chunk that they come from. Sorting a part is a call (part, node before, node after): the
// nodes are those of pivots, so nothing is appended, and an insertion into one part leaves the
// labels of all others as they are. A list with fewer boundaries is sorted at once. A part that is
// small beside the one it comes from may begin with many marks: if no boundary is among the first
// chunks, it is thinned out first.
//
// For a random order of the elements: from scratch O(n log n). An inserted or deleted element is in
// O(log n) parts, in one chunk of each, which two calls read: O(log n) calls. With probability
// O(1/k) it changes the pivot of a part of k elements, which is sorted anew: O(log^2 n) expected.
// Source: [Aca05], there without chunks, and with the first element as the pivot.
#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>

#include "chunk.hpp"

namespace examples {

/// Fills `self` with those elements of `from`, and of the chunks that are joined to it, for which
/// keeps(element), and makes the chunks behind by kBody(chunk, key...).
template <auto kBody, class S, class Keeps, class... Key>
void filter_chunk(S& s, Chunk<S>& self, const Chunk<S>* from, Keeps&& keeps, Key... key) {
  self.boundary = from->boundary;
  self.marks = marks_behind_filter(*from, keeps(from->boundary));
  typename Chunk<S>::State kept;
  kept.elements.reserve(kRoom);
  std::uint64_t seen = 0;
  const Chunk<S>* chunk = from;
  Joins joins;
  do {
    const auto& state = s.read(chunk->state);
    std::copy_if(state.elements.begin(), state.elements.end(), std::back_inserter(kept.elements),
                 keeps);
    seen += state.elements.size() + 1;
    chunk = state.next;
  } while (chunk != nullptr && joins(*chunk, keeps(chunk->boundary)));
  s.weigh(seen);
  if (chunk != nullptr) kept.next = &s.template tail_make<Chunk<S>, kBody>(chunk, key...);
  s.write(self.state, std::move(kept));
}

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
  filter_chunk<part<kLess>>(s, self, from, belongs, pivot);
}

/// The same elements with fewer marks among the boundaries.
struct Thinned {
  static constexpr std::string_view kName = "thinned";
  template <class S>
  void operator()(S& s, Chunk<S>& self, const Chunk<S>* from) const;
};
inline constexpr Thinned thinned{};

template <class S>
void Thinned::operator()(S& s, Chunk<S>& self, const Chunk<S>* from) const {
  filter_chunk<thinned>(s, self, from, [](const Element&) { return true; });
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
  elements.reserve(2 * kRoom);
  const Chunk<S>* chunk = list;
  for (int seen = 0; chunk != nullptr && boundaries.size() < 3 && seen < kMostJoined; ++seen) {
    const auto& state = s.read(chunk->state);
    elements.insert(elements.end(), state.elements.begin(), state.elements.end());
    chunk = state.next;
    if (chunk != nullptr && chunk->marks == 0) boundaries.push_back(chunk->boundary);
  }
  s.weigh(elements.size());
  if (chunk == nullptr) {
    std::sort(elements.begin(), elements.end());
    return s.write(link_behind(s, before, elements, list)->next, after);
  }
  if (boundaries.empty()) {
    const Chunk<S>& fewer = s.template make<Chunk<S>, thinned>(list);
    return s.template tail<quicksort_part>(&fewer, before, after);
  }
  std::sort(boundaries.begin(), boundaries.end());
  const Element pivot = boundaries[boundaries.size() / 2];
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
