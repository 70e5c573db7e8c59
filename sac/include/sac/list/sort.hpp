// Sorts a list, stably.
//
// Mergesort. Coins flipped by the ids of elements decide what is merged with what, as in a skip
// list: a group of the lowest level begins with an element that has kGroupBits heads in a row, and
// is sorted at once; a group of a higher level begins with a group whose first element has one
// more, and merges its members from left to right.
//
// Sorted lists are lists of chunks. A chunk goes from one *boundary* to the next; boundaries are
// elements with kChunkBits heads in a row, so the cuts of a list depend only on its elements. One
// step of a merge makes the chunk that begins with the later boundary of two chunks and ends at the
// next boundary of either list. A chunk is an object keyed by its boundary and by the list that is
// merged in; a modifiable names the two chunks that it is made of. If chunks were keyed by those,
// they would be new up to the last merge whenever a boundary below is inserted or erased.
//
// Of equal elements the one of the left list comes first, which makes the sort stable. So the cut
// of a list at a boundary depends on the side that the boundary comes from.
//
// From scratch O(n log n). An inserted or deleted element is in one chunk of each of O(log n)
// lists; the two or three steps that read the chunk run again. With probability 1/k it begins or
// ends a group of k elements, and the group is merged again: O(log n) calls expected.
// Source: [Aca05, §8.3.2], which has a pass for each level of dividing, and no chunks.
#pragma once

#include <algorithm>
#include <iterator>
#include <span>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "sac/list/list.hpp"

namespace sac {

namespace detail {

// Logarithms of the mean number of elements of a chunk, and of a group that is sorted at once.
inline constexpr int kChunkBits = 4;
inline constexpr int kGroupBits = kChunkBits + 2;

// A chunk of a sorted list. Elements are nodes of the unsorted list.
template <class Node, class S>
struct SortedChunk {
  struct State {
    std::vector<const Node*> elements;
    const SortedChunk* next = nullptr;
    friend bool operator==(const State&, const State&) = default;
    friend void label_bytes(LabelSink& sink, const State& s) {
      label_arguments(sink, std::tie(s.elements, s.next));
    }
  };
  struct Source {
    const SortedChunk* left;
    const SortedChunk* right;
    bool from_right;  // the boundary is that of `right`, else of `left`
    friend bool operator==(const Source&, const Source&) = default;
    friend void label_bytes(LabelSink& sink, const Source& s) {
      label_arguments(sink, std::tie(s.left, s.right, s.from_right));
    }
  };
  const Node* boundary = nullptr;                // null: the chunk before the first boundary
  typename S::template CellType<Source> source;  // its two chunks, unless known from the key
  typename S::template CellType<State> state;
};

// A stretch of the list, sorted.
template <class Node, class S>
struct Sorted {
  using Chunk = SortedChunk<Node, S>;
  struct State {
    const Chunk* chunks;
    const Sorted* next;  // the stretch behind
    friend bool operator==(const State&, const State&) = default;
    friend void label_bytes(LabelSink& sink, const State& s) {
      label_arguments(sink, std::tie(s.chunks, s.next));
    }
  };
  int height = 0;  // the number of levels above that begin a group with it
  typename S::template CellType<State> state;
};

// --- Merging two lists -----------------------------------------------------------------------

// Fills `self` with the elements of two chunks from its boundary on, and makes the chunks behind.
template <auto less>
struct MergedChunk {
  static constexpr std::string_view kName = kOperationName<"sort_chunk", less>;

  template <class S, class Node>
  void operator()(S& s, SortedChunk<Node, S>& self, const Node* boundary,
                  const Sorted<Node, S>* added) const {
    self.boundary = boundary;
    merge(s, self, s.read(self.source), added);
  }

  template <class S, class Node>
  static void merge(S& s, SortedChunk<Node, S>& self,
                    const typename SortedChunk<Node, S>::Source& from,
                    const Sorted<Node, S>* added) {
    const auto& left = s.read(from.left->state);
    const auto& right = s.read(from.right->state);
    const auto before = [&s](const Node* a, const Node* b) {
      return apply_two<less>(s, a->value(), b->value());
    };
    const bool left_ends =
        left.next != nullptr &&
        (right.next == nullptr || !before(right.next->boundary, left.next->boundary));
    const auto* const behind = left_ends ? left.next : right.next;
    // The elements of `chunk` from the boundary of `self` to that of `behind`.
    const auto shared = [&](const std::vector<const Node*>& chunk, bool of_right) {
      const auto cut = [&](const Node* at, bool at_of_right) {
        if (at_of_right == of_right) return chunk.end();
        return of_right ? std::lower_bound(chunk.begin(), chunk.end(), at, before)
                        : std::upper_bound(chunk.begin(), chunk.end(), at, before);
      };
      const bool is_own = self.boundary == nullptr || from.from_right == of_right;
      const auto begin = is_own ? chunk.begin() : cut(self.boundary, from.from_right);
      const auto end = behind == nullptr ? chunk.end() : cut(behind->boundary, !left_ends);
      return std::span(begin, end);
    };
    const auto from_left = shared(left.elements, false);
    const auto from_right = shared(right.elements, true);
    typename SortedChunk<Node, S>::State state;
    state.elements.reserve(from_left.size() + from_right.size());
    std::merge(from_left.begin(), from_left.end(), from_right.begin(), from_right.end(),
               std::back_inserter(state.elements), before);
    if (behind != nullptr) {
      auto& next =
          s.template tail_make<SortedChunk<Node, S>, MergedChunk{}>(behind->boundary, added);
      s.write(next.source,
              {left_ends ? behind : from.left, left_ends ? from.right : behind, !left_ends});
      state.next = &next;
    }
    s.write(self.state, std::move(state));
  }
};

// The first chunk of the merge of two lists, `right` being that of `added`, and those behind.
template <auto less>
struct Merge {
  static constexpr std::string_view kName = kOperationName<"sort_merge", less>;
  template <class S, class Node>
  void operator()(S& s, SortedChunk<Node, S>& self, const SortedChunk<Node, S>* left,
                  const SortedChunk<Node, S>* right, const Sorted<Node, S>* added) const {
    MergedChunk<less>::merge(s, self, {left, right, false}, added);
  }
};

// --- Groups ----------------------------------------------------------------------------------

// A chunk of a lowest group, which begins with `group`; its maker fills it.
template <auto less>
struct FirstChunk {
  static constexpr std::string_view kName = kOperationName<"sort_first_chunk", less>;
  template <class S, class Node>
  void operator()(S&, SortedChunk<Node, S>& self, const Node*, const Node* boundary) const {
    self.boundary = boundary;
  }
};

// Sorts the lowest group, which begins with `first`, and those behind.
template <auto less>
struct SortGroup {
  static constexpr std::string_view kName = kOperationName<"sort_group", less>;

  template <class S, class Node>
  void operator()(S& s, Sorted<Node, S>& self, const Node* first) const {
    self.height = heads(*first) - kGroupBits;
    std::vector<const Node*> elements;
    const Node* next = first;
    do {
      if (next->holds()) elements.push_back(next);
      next = s.read(next->next);
    } while (next != nullptr && heads(*next) < kGroupBits);
    std::stable_sort(elements.begin(), elements.end(), [&s](const Node* a, const Node* b) {
      return apply_two<less>(s, a->value(), b->value());
    });
    const auto* const chunks = &cut(s, first, elements);
    s.write(self.state,
            {chunks, next == nullptr ? nullptr
                                     : &s.template tail_make<Sorted<Node, S>, SortGroup{}>(next)});
  }

 private:
  // A list of chunks with these elements.
  template <class S, class Node>
  static const auto& cut(S& s, const Node* group, const std::vector<const Node*>& elements) {
    const auto make = [&](const Node* boundary) -> SortedChunk<Node, S>& {
      return s.template make<SortedChunk<Node, S>, FirstChunk<less>{}>(group, boundary);
    };
    auto& header = make(nullptr);
    auto* chunk = &header;
    typename SortedChunk<Node, S>::State state;
    for (const Node* e : elements) {
      if (heads(*e) >= kChunkBits) {
        auto& next = make(e);
        state.next = &next;
        s.write(chunk->state, std::exchange(state, {}));
        chunk = &next;
      }
      state.elements.push_back(e);
    }
    s.write(chunk->state, std::move(state));
    return header;
  }
};

// Merges the group that begins with `first`, and those behind.
template <auto less>
struct MergeGroup {
  static constexpr std::string_view kName = kOperationName<"sort_merge_group", less>;
  template <class S, class Node>
  void operator()(S& s, Sorted<Node, S>& self, const Sorted<Node, S>* first) const {
    self.height = first->height - 1;
    auto [chunks, next] = s.read(first->state);
    while (next != nullptr && next->height == 0) {
      const auto member = s.read(next->state);
      chunks = &s.template make<SortedChunk<Node, S>, Merge<less>{}>(chunks, member.chunks, next);
      next = member.next;
    }
    s.write(self.state,
            {chunks, next == nullptr ? nullptr
                                     : &s.template tail_make<Sorted<Node, S>, MergeGroup{}>(next)});
  }
};

// --- The result ------------------------------------------------------------------------------

// The copy of a node; its maker links it.
template <auto less>
struct SortedNode {
  static constexpr std::string_view kName = kOperationName<"sort_node", less>;
  template <class S, class Node>
  void operator()(S&, Node& self, const Node* in) const {
    if (!self.holds()) self.hold(in->id(), in->value());
  }
};

// Links copies of the elements of a list of chunks behind `last`.
template <auto less>
struct LinkChunks {
  static constexpr std::string_view kName = kOperationName<"sort_link", less>;
  template <class S, class Node>
  void operator()(S& s, const SortedChunk<Node, S>* chunk, Node* last) const {
    const auto& state = s.read(chunk->state);
    for (const Node* in : state.elements) {
      Node& node = s.template make<Node, SortedNode<less>{}>(in);
      s.write(last->next, &node);
      last = &node;
    }
    if (state.next == nullptr) return s.write(last->next, nullptr);
    s.template tail<LinkChunks{}>(state.next, last);
  }
};

// Merges groups until one is left, and links copies of its elements behind `header`.
template <auto less>
struct MergeAll {
  static constexpr std::string_view kName = kOperationName<"sort_level", less>;
  template <class S, class Node>
  void operator()(S& s, const Sorted<Node, S>* first, Node* header) const {
    const auto [chunks, next] = s.read(first->state);
    if (next == nullptr) return s.template tail<LinkChunks<less>{}>(chunks, header);
    const auto* const up = &s.template make<Sorted<Node, S>, MergeGroup<less>{}>(first);
    s.template tail<MergeAll{}>(up, header);
  }
};

template <auto less>
struct Sort {
  static constexpr std::string_view kName = kOperationName<"sort", less>;
  template <class S, class Node>
  void operator()(S& s, Node& self, const Node* list) const {
    const auto* const groups = &s.template make<Sorted<Node, S>, SortGroup<less>{}>(list);
    s.template tail<MergeAll<less>{}>(groups, &self);
  }
};

}  // namespace detail

/// The sorted list: less(a, b) or less(scope, a, b) is true if a comes before b; equal elements
/// keep their order. Requires: less is a strict weak order.
template <auto less, class S, class T>
[[nodiscard]] List<T, S> sort(S& s, List<T, S> list) {
  return List<T, S>(s.template make<ListNode<T, S>, detail::Sort<less>{}>(list.header()));
}

}  // namespace sac
