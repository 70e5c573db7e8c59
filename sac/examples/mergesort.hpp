// Mergesort of a list.
//
// Coins flipped by the ids of elements decide what is merged with what, as in a skip list: a group
// of the lowest level begins with an element that has kGroupBits heads in a row, and is sorted at
// once; a group of a higher level begins with a group whose first element has one more, and merges
// its members. So dividing costs O(n) in all, and an insertion changes the members of O(1) groups,
// small ones with high probability.
//
// Sorted lists are lists of chunks. A step of a merge makes the chunk that begins with the greater
// boundary of two chunks and ends at the next boundary of either list. A chunk is an object keyed
// by its boundary and by the list that is merged in; a modifiable names the two chunks that it is
// made of. If chunks were keyed by those, they would be new up to the last merge whenever a
// boundary below is added or removed: for each, twice as many on each level.
//
// From scratch O(n log n). An inserted or deleted element is in one chunk of each of O(log n)
// lists; the two or three steps that read the chunk run again. With probability 1/k it begins or
// ends a group of k elements, and the group is merged again: O(log n) calls expected.
// Source: [Aca05], which has a pass for each level of dividing, and no chunks.
#pragma once

#include <algorithm>
#include <span>
#include <tuple>
#include <utility>

#include "chunk.hpp"

namespace examples {

/// Log of the mean number of elements that are sorted at once.
inline constexpr int kGroupBits = kChunkBits + 2;

/// A chunk of a sorted list.
template <class S>
struct SortedChunk {
  struct State {
    std::vector<Element> elements;
    const SortedChunk* next = nullptr;
    friend bool operator==(const State&, const State&) = default;
    friend void label_bytes(sac::LabelSink& sink, const State& s) {
      sac::label_arguments(sink, std::tie(s.elements, s.next));
    }
  };
  struct Source {
    const SortedChunk* a;
    const SortedChunk* b;
    friend bool operator==(const Source&, const Source&) = default;
    friend void label_bytes(sac::LabelSink& sink, const Source& s) {
      sac::label_arguments(sink, std::tie(s.a, s.b));
    }
  };
  Element boundary;
  typename S::template CellType<Source> source;  // where it comes from, unless known from the key
  typename S::template CellType<State> state;
};

/// A stretch of the input, sorted.
template <class S>
struct Sorted {
  struct State {
    const SortedChunk<S>* chunks;
    const Sorted* next;  // the stretch behind
    friend bool operator==(const State&, const State&) = default;
    friend void label_bytes(sac::LabelSink& sink, const State& s) {
      sac::label_arguments(sink, std::tie(s.chunks, s.next));
    }
  };
  int height = 0;  // the number of levels above that begin a group with it
  typename S::template CellType<State> state;
};

// --- Merging two lists -----------------------------------------------------------------------

/// The chunk that begins with `boundary` where `added` is merged in, and those behind.
struct MergedChunk {
  static constexpr std::string_view kName = "merged_chunk";
  template <class S>
  void operator()(S& s, SortedChunk<S>& self, Element boundary, const Sorted<S>* added) const;
};
inline constexpr MergedChunk merged_chunk{};

/// Fills `self` with what `a` and `b` share from its boundary on, and makes the chunks behind.
template <class S>
void merge_into(S& s, SortedChunk<S>& self, const SortedChunk<S>* a, const SortedChunk<S>* b,
                const Sorted<S>* added) {
  const auto& in_a = s.read(a->state);
  const auto& in_b = s.read(b->state);
  const bool a_ends =
      in_a.next != nullptr && (in_b.next == nullptr || in_a.next->boundary < in_b.next->boundary);
  const SortedChunk<S>* const behind = a_ends ? in_a.next : in_b.next;
  const auto shared = [&](const std::vector<Element>& elements) {
    const auto begin = std::lower_bound(elements.begin(), elements.end(), self.boundary);
    const auto end = behind == nullptr ? elements.end()
                                       : std::lower_bound(begin, elements.end(), behind->boundary);
    return std::span(begin, end);
  };
  const auto from_a = shared(in_a.elements), from_b = shared(in_b.elements);
  typename SortedChunk<S>::State state;
  state.elements.resize(from_a.size() + from_b.size());
  s.weigh(state.elements.size());
  std::merge(from_a.begin(), from_a.end(), from_b.begin(), from_b.end(), state.elements.begin());
  if (behind != nullptr) {
    auto& next = s.template tail_make<SortedChunk<S>, merged_chunk>(behind->boundary, added);
    s.write(next.source, {a_ends ? behind : a, a_ends ? b : behind});
    state.next = &next;
  }
  s.write(self.state, std::move(state));
}

template <class S>
void MergedChunk::operator()(S& s, SortedChunk<S>& self, Element boundary,
                             const Sorted<S>* added) const {
  self.boundary = boundary;
  const auto [a, b] = s.read(self.source);
  merge_into(s, self, a, b, added);
}

/// The header of the merge of two lists, `b` being that of `added`, and the chunks behind.
struct Merge {
  static constexpr std::string_view kName = "merge";
  template <class S>
  void operator()(S& s, SortedChunk<S>& self, const SortedChunk<S>* a, const SortedChunk<S>* b,
                  const Sorted<S>* added) const {
    merge_into(s, self, a, b, added);
  }
};
inline constexpr Merge merge{};

// --- Groups ----------------------------------------------------------------------------------

/// A list of chunks with these elements, which are sorted. Chunks are keyed by `group` as well.
template <class S>
const SortedChunk<S>& make_chunks(S& s, const Node<S>* group,
                                  const std::vector<Element>& elements) {
  SortedChunk<S>& header = s.template make<SortedChunk<S>>(group);
  SortedChunk<S>* chunk = &header;
  typename SortedChunk<S>::State state;
  for (const Element& e : elements) {
    if (is_boundary(e.id)) {
      SortedChunk<S>& next = s.template make<SortedChunk<S>>(group, e);
      next.boundary = e;
      state.next = &next;
      s.write(chunk->state, std::exchange(state, {}));
      chunk = &next;
    }
    state.elements.push_back(e);
  }
  s.write(chunk->state, std::move(state));
  return header;
}

/// Sorts the lowest group, which begins with `first`, and those behind.
struct SortGroup {
  static constexpr std::string_view kName = "sort_group";
  template <class S>
  void operator()(S& s, Sorted<S>& self, const Node<S>* first) const;
};
inline constexpr SortGroup sort_group{};

template <class S>
void SortGroup::operator()(S& s, Sorted<S>& self, const Node<S>* first) const {
  self.height = heads(first->element.id) - kGroupBits;
  std::vector<Element> elements;
  const Node<S>* next = first;
  do {
    if (next->element.id != 0) elements.push_back(next->element);
    next = s.read(next->next);
  } while (next != nullptr && heads(next->element.id) < kGroupBits);
  std::sort(elements.begin(), elements.end());
  s.weigh(elements.size());
  const SortedChunk<S>& chunks = make_chunks(s, first, elements);
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
  std::uint64_t members = 1;
  for (; next != nullptr && next->height == 0; ++members) {
    const auto member = s.read(next->state);
    chunks = &s.template make<SortedChunk<S>, merge>(chunks, member.chunks, next);
    next = member.next;
  }
  s.weigh(members);
  s.write(
      self.state,
      {chunks, next == nullptr ? nullptr : &s.template tail_make<Sorted<S>, merge_group>(next)});
}

/// Links nodes for the elements of a list of chunks behind `before`.
struct LinkChunks {
  static constexpr std::string_view kName = "link_chunks";
  template <class S>
  void operator()(S& s, const SortedChunk<S>* chunk, Node<S>* before) const;
};
inline constexpr LinkChunks link_chunks{};

template <class S>
void LinkChunks::operator()(S& s, const SortedChunk<S>* chunk, Node<S>* before) const {
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
