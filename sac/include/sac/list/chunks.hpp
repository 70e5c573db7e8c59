// Cuts a list into chunks, so that edits of the list change few of them.
//
//   const auto words = sac::chunks(s, letters, 64);  // a List<std::vector<char>>
//
// Behind the first `least` elements of a chunk, where least = (most + 1) / 2, the next chunk begins
// with the one among the following up to the `most`-th whose lot, a hash of its id, is least. So a
// cut depends only on ids, and on where the chunk begins; and from two beginnings near to each
// other the cuts soon are the same. A list of equal values is cut like any other.
//
// (1) A chunk has from `least` to `most` elements, the last one from 1 to `most`. The chunks in
//     order are the list; of an empty list there are none.
// (2) The id of a chunk is that of its first element. A chunk with other elements is another node,
//     as in all lists.
// (3) An edit changes its chunk, and with probability O(1 / most) a few behind. In calls: two
//     executed, two created and two discarded for each chunk that changes, and one executed for the
//     chunk before, if it looked so far. From scratch two for each chunk. A call reads `most`
//     links.
//
// Source: local minima as cuts, as in Bjørner, Blass, Gurevich, *Content-dependent chunking for
// differential compression, the local maximum approach* (2010), of ids instead of contents.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "sac/check.hpp"
#include "sac/list/list.hpp"

namespace sac {

namespace detail {

// How early in a chunk's range an element is to begin the next one; independent of heads().
template <class T>
[[nodiscard]] std::uint64_t lot(const Element<T>& e) noexcept {
  return mix(~e.id().value);
}

// A chunk; its maker links it.
struct MakeChunk {
  static constexpr std::string_view kName = "chunk";
  template <class S, class T>
  void operator()(S&, ListNode<std::vector<T>, S>& self, const ListNode<T, S>* first,
                  const std::vector<T>& elements) const {
    if (!self.holds()) self.hold(first->id(), elements);
  }
};

// Links the chunk that begins with `first`, and those behind, behind `before`.
struct ChunksBehind {
  static constexpr std::string_view kName = "chunks_behind";
  template <class S, class T>
  void operator()(S& s, const ListNode<T, S>* first, ListNode<std::vector<T>, S>* before,
                  int most) const {
    if (first == nullptr) return s.write(before->next, nullptr);
    const auto room = static_cast<std::size_t>(most);
    std::vector<const ListNode<T, S>*> nodes;
    nodes.reserve(room + 1);
    for (const auto* e = first; e != nullptr; e = s.read(e->next)) {
      nodes.push_back(e);
      if (nodes.size() > room) break;
    }
    s.weigh(nodes.size());
    auto cut = nodes.end();
    if (nodes.size() > room) {
      cut = std::min_element(nodes.begin() + (most + 1) / 2, nodes.end(),
                             [](const auto* a, const auto* b) { return lot(*a) < lot(*b); });
    }
    const auto* const next = cut == nodes.end() ? nullptr : *cut;
    std::vector<T> elements;
    elements.reserve(static_cast<std::size_t>(cut - nodes.begin()));
    std::for_each(nodes.begin(), cut, [&](const auto* e) { elements.push_back(e->value()); });
    auto& chunk =
        s.template make<ListNode<std::vector<T>, S>, MakeChunk{}>(first, std::move(elements));
    s.write(before->next, &chunk);
    s.template tail<ChunksBehind{}>(next, &chunk, most);
  }
};

struct Chunks {
  static constexpr std::string_view kName = "chunks";
  template <class S, class T>
  void operator()(S& s, ListNode<std::vector<T>, S>& self, const ListNode<T, S>* list,
                  int most) const {
    s.template tail<ChunksBehind{}>(s.read(list->next), &self, most);
  }
};

}  // namespace detail

/// The list cut into chunks of at most `most` elements. T must be hashable, as an argument.
/// Throws: UsageError unless most >= 1.
template <class S, class T>
[[nodiscard]] List<std::vector<T>, S> chunks(S& s, List<T, S> list, int most) {
  if (most < 1) throw UsageError("chunks: at least one element to a chunk");
  return List<std::vector<T>, S>(
      s.template make<ListNode<std::vector<T>, S>, detail::Chunks{}>(list.header(), most));
}

}  // namespace sac
