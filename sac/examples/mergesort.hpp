// Mergesort of a list.
//
// What is merged with what is decided by coins flipped with the elements' ids, as in a skip list: a
// group of the lowest level begins with a boundary (chunk.hpp) and is sorted at once; a group of
// the level above begins with a group whose first element has one more head in a row, and merges
// its members. So dividing costs O(n) in all, and an insertion changes the members of O(1) groups,
// small ones with high probability.
//
// Sorted lists are lists of chunks. A step of a merge makes the chunk that begins with the greater
// boundary of two chunks a and b and ends at the next boundary of either list: an object keyed by
// (a, b).
//
// From scratch O(n log n). An inserted or deleted element is in one chunk of each of O(log n)
// lists; the two or three steps that read the chunk run again: O(log n) calls expected.
// Source: [Aca05, §8.3.2], there with a pass for each level of dividing, and without chunks.
#pragma once

#include <algorithm>
#include <span>

#include "chunk.hpp"

namespace examples {

/// The chunk that `a` and `b` share, and those behind.
struct Merge {
  static constexpr std::string_view kName = "merge";
  template <class S>
  void operator()(S& s, Chunk<S>& self, const Chunk<S>* a, const Chunk<S>* b) const;
};
inline constexpr Merge merge{};

template <class S>
void Merge::operator()(S& s, Chunk<S>& self, const Chunk<S>* a, const Chunk<S>* b) const {
  self.boundary = std::max(a->boundary, b->boundary);
  const auto& in_a = s.read(a->state);
  const auto& in_b = s.read(b->state);
  const bool a_ends =
      in_a.next != nullptr && (in_b.next == nullptr || in_a.next->boundary < in_b.next->boundary);
  const Chunk<S>* const behind = a_ends ? in_a.next : in_b.next;
  const auto shared = [&](const std::vector<Element>& elements) {
    const auto begin = std::lower_bound(elements.begin(), elements.end(), self.boundary);
    const auto end = behind == nullptr
                         ? elements.end()
                         : std::lower_bound(begin, elements.end(), behind->boundary);
    return std::span(begin, end);
  };
  const auto from_a = shared(in_a.elements), from_b = shared(in_b.elements);
  typename Chunk<S>::State state;
  state.elements.resize(from_a.size() + from_b.size());
  std::merge(from_a.begin(), from_a.end(), from_b.begin(), from_b.end(), state.elements.begin());
  if (behind != nullptr) {
    state.next = &s.template tail_make<Chunk<S>, merge>(a_ends ? behind : a, a_ends ? b : behind);
  }
  s.write(self.state, std::move(state));
}

/// A stretch of the input, sorted.
template <class S>
struct Sorted {
  struct State {
    const Chunk<S>* chunks;
    const Sorted* next;  // the stretch behind
    friend bool operator==(const State&, const State&) = default;
  };
  int height = 0;  // the number of levels above that begin a group with it
  typename S::template CellType<State> state;
};

/// Sorts the lowest group, which begins with `first`, and those behind.
struct SortGroup {
  static constexpr std::string_view kName = "sort_group";
  template <class S>
  void operator()(S& s, Sorted<S>& self, const Node<S>* first) const;
};
inline constexpr SortGroup sort_group{};

template <class S>
void SortGroup::operator()(S& s, Sorted<S>& self, const Node<S>* first) const {
  self.height = heads(first->element.id) - kChunkBits;
  typename Chunk<S>::State low, high;  // before and behind the only boundary
  const Node<S>* const next = read_to_boundary(
      s, first, [&](const Element& e) { (e < first->element ? low : high).elements.push_back(e); });
  if (first->element.id == 0) std::swap(low, high);  // a header is no boundary
  std::sort(low.elements.begin(), low.elements.end());
  std::sort(high.elements.begin(), high.elements.end());
  Chunk<S>& chunks = s.template make<Chunk<S>>(first);
  if (first->element.id != 0) {
    Chunk<S>& behind = s.template make<Chunk<S>>(first->element);
    behind.boundary = first->element;
    low.next = &behind;
    s.write(behind.state, std::move(high));
  }
  s.write(chunks.state, std::move(low));
  s.write(
      self.state,
      {&chunks, next == nullptr ? nullptr : &s.template tail_make<Sorted<S>, sort_group>(next)});
}

/// Merges the group that begins with `first`, and those behind.
struct MergeGroup {
  static constexpr std::string_view kName = "merge_group";
  template <class S>
  void operator()(S& s, Sorted<S>& self, const Sorted<S>* first) const;
};
inline constexpr MergeGroup merge_group{};

template <class S>
void MergeGroup::operator()(S& s, Sorted<S>& self, const Sorted<S>* first) const {
  self.height = first->height - 1;
  auto [chunks, next] = s.read(first->state);
  while (next != nullptr && next->height == 0) {
    const auto member = s.read(next->state);
    chunks = &s.template make<Chunk<S>, merge>(chunks, member.chunks);
    next = member.next;
  }
  s.write(
      self.state,
      {chunks, next == nullptr ? nullptr : &s.template tail_make<Sorted<S>, merge_group>(next)});
}

/// Links nodes for the elements of a list of chunks behind `before`.
struct LinkChunks {
  static constexpr std::string_view kName = "link_chunks";
  template <class S>
  void operator()(S& s, const Chunk<S>* chunk, Node<S>* before) const;
};
inline constexpr LinkChunks link_chunks{};

template <class S>
void LinkChunks::operator()(S& s, const Chunk<S>* chunk, Node<S>* before) const {
  const auto& state = s.read(chunk->state);
  Node<S>* const last = link_behind(s, before, state.elements);
  if (state.next == nullptr) return s.write(last->next, nullptr);
  s.template tail<link_chunks>(state.next, last);
}

/// Merges groups until one is left, and links nodes for its elements behind `header`.
struct MergeAll {
  static constexpr std::string_view kName = "merge_all";
  template <class S>
  void operator()(S& s, const Sorted<S>* first, Node<S>* header) const;
};
inline constexpr MergeAll merge_all{};

template <class S>
void MergeAll::operator()(S& s, const Sorted<S>* first, Node<S>* header) const {
  const auto [chunks, next] = s.read(first->state);
  if (next == nullptr) return s.template tail<link_chunks>(chunks, header);
  const Sorted<S>* const up = &s.template make<Sorted<S>, merge_group>(first);
  s.template tail<merge_all>(up, header);
}

/// Writes the header of `list` sorted to `result`.
struct Mergesort {
  static constexpr std::string_view kName = "mergesort";
  template <class S>
  void operator()(S& s, const Node<S>* list, NodeMod<S> result) const {
    const Sorted<S>* const groups = &s.template make<Sorted<S>, sort_group>(list);
    Node<S>& header = node_of(s, Element{});
    s.write(result, &header);
    s.template tail<merge_all>(groups, &header);
  }
};
inline constexpr Mergesort mergesort{};

}  // namespace examples
