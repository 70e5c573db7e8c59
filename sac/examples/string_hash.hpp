// A hash of a long string under edits at any position: a tree of chunks whose boundaries the
// content determines.
//
// Idea: a list of items with hashes is cut into chunks at its valleys, where hashes stop falling
// and start to rise; each chunk is an item of a shorter list, cut in turn, until one is left.
// Whether an item is a boundary depends only on the items around it, so an edit changes O(1)
// expected chunks of each list. A chunk has three items on average, and at least two except for the
// last.
//
// Source: locally consistent parsing, Mehlhorn, Sundar, Uhrig, *Maintaining dynamic sequences under
// equality tests in polylogarithmic time* (1997), with valleys of hashes for their coin tossing,
// and chunks as in Muthitacharoen, Chen, Mazières, *A low-bandwidth network file system* (2001).
// Cost of an update: O(log n) expected; within a run of equal letters the run's length, since that
// is one chunk. Periods are cut regularly and become a run one list higher.
// Stable because: a chunk is named by its first item, and chunks are made from left to right. Equal
// strings have equal hashes, whatever edits led to them.
#pragma once

#include <cstdint>
#include <string_view>
#include <tuple>

#include "sac/sac.hpp"

namespace examples::string_hash {

template <class S>
struct Item;

/// What a string is a list of.
template <class S>
struct Content {
  std::uint64_t hash = 0;
  const Item<S>* next = nullptr;
  friend bool operator==(const Content&, const Content&) = default;
  friend void label_bytes(sac::LabelSink& sink, const Content& c) {
    sac::label_arguments(sink, std::tie(c.hash, c.next));
  }
};

/// A letter (an input: edits set its content), or a chunk of a list of items.
template <class S>
struct Item {
  typename S::template CellType<Content<S>> content;
};

/// What the client gives a letter as its hash.
[[nodiscard]] inline std::uint64_t hash_of(char letter) noexcept {
  return sac::mix(static_cast<unsigned char>(letter) + std::uint64_t{1});
}

// The body of a chunk: `first` and what follows, up to the next valley.
struct Chunk {
  static constexpr std::string_view kName = "chunk";
  template <class S>
  void operator()(S& s, Item<S>& self, const Item<S>* first) const;
};
inline constexpr Chunk chunk{};

template <class S>
void Chunk::operator()(S& s, Item<S>& self, const Item<S>* first) const {
  Content<S> last = s.read(first->content);
  std::uint64_t sum = sac::mix(last.hash);
  bool falling = false;
  std::uint64_t items = 1;
  const Item<S>* next = last.next;
  while (next != nullptr) {
    const Content<S> item = s.read(next->content);
    if (item.hash > last.hash && falling) break;
    if (item.hash < last.hash) falling = true;
    sum = sac::mix(sum + item.hash);
    last = item;
    next = item.next;
    ++items;
  }
  s.weigh(items);
  const Item<S>* behind = next == nullptr ? nullptr : &s.template tail_make<Item<S>, chunk>(next);
  s.write(self.content, {sum, behind});
}

struct Levels {
  static constexpr std::string_view kName = "levels";
  template <class S>
  void operator()(S& s, const Item<S>* list, typename S::template ModType<std::uint64_t> out) const;
};
inline constexpr Levels levels{};

template <class S>
void Levels::operator()(S& s, const Item<S>* list,
                        typename S::template ModType<std::uint64_t> out) const {
  const Content<S>& first = s.read(list->content);
  if (first.next == nullptr) return s.write(out, first.hash);
  const Item<S>* chunks = &s.template make<Item<S>, chunk>(list);
  s.template tail<levels>(chunks, out);
}

/// The program: the hash of the string that starts at `head`; 0 if there is none.
struct Hash {
  static constexpr std::string_view kName = "hash";
  template <class S>
  void operator()(S& s, typename S::template ModType<const Item<S>*> head,
                  typename S::template ModType<std::uint64_t> out) const {
    const Item<S>* list = s.read(head);
    if (list == nullptr) return s.write(out, 0);
    s.template tail<levels>(list, out);
  }
};
inline constexpr Hash hash{};

}  // namespace examples::string_hash
