// Lists of chunks: several elements to a node, cut so that edits stay local.
//
// A chunk is a stretch of a list from one *boundary* to the next; boundaries are elements chosen by
// coins flipped with their ids, one in 16. In all lists of a program an element is either always a
// boundary or never; so the chunks of a list depend only on its elements, and an insertion changes
// one chunk, or divides one. A step of a program processes a chunk instead of an element: still
// O(1) work expected, at a sixteenth of the calls.
//
// A list is its header: the chunk of the elements before the first boundary.
// Source: the chunky decomposition of Pugh and Teitelbaum (POPL 1989).
#pragma once

#include <cstddef>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

#include "list.hpp"

namespace examples {

/// Log of the mean number of elements of a chunk.
inline constexpr int kChunkBits = 4;
/// Room for the elements of most chunks.
inline constexpr std::size_t kRoom = std::size_t{2} << kChunkBits;

[[nodiscard]] inline bool is_boundary(std::uint32_t id) noexcept { return heads(id) >= kChunkBits; }

template <class S, class T = Element>
struct Chunk {
  struct State {
    std::vector<T> elements;  // the boundary among them
    const Chunk* next = nullptr;
    friend bool operator==(const State&, const State&) = default;
    friend void label_bytes(sac::LabelSink& sink, const State& s) {
      sac::label_arguments(sink, std::tie(s.elements, s.next));
    }
  };
  T boundary;     // a header's is T{}
  int marks = 0;  // filters that have passed the boundary on as a mark; 0: it is an element
  typename S::template CellType<State> state;
};

/// Calls take(element) for `first`, unless it is a header, and for the elements behind it that are
/// no boundaries. Returns the boundary after them; null: the end.
template <class S, class T, class Take>
const Node<S, T>* read_to_boundary(S& s, const Node<S, T>* first, Take&& take) {
  if (first->element.id != 0) take(first->element);
  const Node<S, T>* node = s.read(first->next);
  std::uint64_t taken = 1;
  for (; node != nullptr && !is_boundary(node->element.id); node = s.read(node->next), ++taken) {
    take(node->element);
  }
  s.weigh(taken);
  return node;
}

/// The chunk that begins with `first`, and those behind.
struct CutIntoChunks {
  template <class S, class T>
  void operator()(S& s, Chunk<S, T>& self, const Node<S, T>* first) const;
};
inline constexpr CutIntoChunks cut_into_chunks{};

template <class S, class T>
void CutIntoChunks::operator()(S& s, Chunk<S, T>& self, const Node<S, T>* first) const {
  self.boundary = first->element;
  typename Chunk<S, T>::State state;
  state.elements.reserve(kRoom);
  const auto* next = read_to_boundary(s, first, [&](const T& e) { state.elements.push_back(e); });
  if (next != nullptr) state.next = &s.template tail_make<Chunk<S, T>, cut_into_chunks>(next);
  s.write(self.state, std::move(state));
}

// --- Filters ---------------------------------------------------------------------------------
//
// A filter drops elements, and boundaries with them; a chunk whose boundary is dropped is joined to
// the one before. But a filter that drops nearly all would join nearly all, and one call would read
// them at each edit. So some boundaries go on as *marks* that hold no element: one in 16, by a coin
// of its own in each filter, so that marks get fewer from filter to filter; and the next, where
// kMostJoined chunks have been joined. A call reads as many chunks at most.

inline constexpr int kMarkBits = 4;
inline constexpr int kMostJoined = 2 << kMarkBits;

/// What becomes of a chunk's boundary in a filter; C: Chunk, or a type like it.
template <class C>
[[nodiscard]] int marks_behind_filter(const C& chunk, bool keeps_boundary) noexcept {
  return chunk.marks == 0 && keeps_boundary ? 0 : chunk.marks + 1;
}

/// Says, for one chunk after the other, whether a filter joins it to those before.
class Joins {
 public:
  template <class C>
  bool operator()(const C& chunk, bool keeps_boundary) {
    const auto marks = static_cast<std::uint64_t>(marks_behind_filter(chunk, keeps_boundary));
    if (marks == 0 || ++joined_ == kMostJoined) return false;
    return sac::mix(marks << 32 | chunk.boundary.id) >> (64 - kMarkBits) != 0;
  }

 private:
  int joined_ = 0;
};

/// The node for `e` in the result of a program. A program that does not meet elements in the order
/// of its result gives the part in which it met this one as `part`: a label then is not in another
/// part, at another time, when a part is divided elsewhere.
template <class S, class T, class... Part>
Node<S, T>& node_of(S& s, const T& e, Part... part) {
  Node<S, T>& node = s.template make<Node<S, T>>(e, part...);
  node.element = e;
  return node;
}

/// Links nodes for `elements` behind `last`. Returns the last one.
template <class S, class T, class... Part>
Node<S, T>* link_behind(S& s, Node<S, T>* last, const std::vector<T>& elements, Part... part) {
  for (const T& e : elements) {
    Node<S, T>& node = node_of(s, e, part...);
    s.write(last->next, &node);
    last = &node;
  }
  s.weigh(elements.size());
  return last;
}

}  // namespace examples
