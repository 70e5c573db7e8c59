// Lists of chunks: several elements to a node, cut so that edits stay local.
//
// A chunk is a stretch of a list from one *boundary* to the next; boundaries are elements chosen by
// coins flipped with their ids, one in 16. Wherever an element goes in the course of a program, it
// is a boundary or it is not; so the chunks of a list depend on its elements alone, and an
// insertion changes one chunk, or divides one. A step of a program takes a chunk instead of an
// element: still O(1) work expected, at a sixteenth of the calls.
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
  T boundary;  // a header's is T{}
  typename S::template CellType<State> state;
};

/// Calls take(element) for `first`, unless it is a header, and for the elements behind it that are
/// no boundaries. Returns the boundary after them; null: the end.
template <class S, class T, class Take>
const Node<S, T>* read_to_boundary(S& s, const Node<S, T>* first, Take&& take) {
  if (first->element.id != 0) take(first->element);
  const Node<S, T>* node = s.read(first->next);
  for (; node != nullptr && !is_boundary(node->element.id); node = s.read(node->next)) {
    take(node->element);
  }
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
  return last;
}

}  // namespace examples
