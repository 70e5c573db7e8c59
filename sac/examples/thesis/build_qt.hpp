// BuildQT and BuildQT-Dyn [Fig 4.3, 4.4], line by line, in any dimension.
//
// Numbers in comments are lines of Fig 4.4, as the thesis's text counts them; Fig 4.3 is the same
// without line 3, the order of the queue, and the tags r.
//
// How the figure's queue is made of an agenda and the stack: "largest first" puts crowded cells,
// which come from a split of one twice their size, behind all that waits, in the order of their
// enqueuing (FIFO; the text asks for that, Fig 4.4 for any order): the agenda's order by level and
// the Z curve is this order. It puts an ill-graded cell, twice the size of the one split, before
// all that waits: what DeleteMin gives next are the cells just enqueued, one after the other, each
// with what it enqueues in turn ("BUILDQT-DYN is a recursive function: the priority queue serves as
// the stack"). They are calls of the call that enqueues them, the last thing that it does.
// A call's own reading comes before its calls, so the loop's body is two functions: Split up to the
// relocations, which are calls, and Enqueue behind them.
//
// Where the figures leave something open, or err:
// - Line 5 has |P| > 2; a cell is crowded by two points, so >= 2.
// - Lines 22-23 test pairs of cells, the text the union of all neighbours, by which two neighbours'
//   points crowd an empty cell between them: as in the figure, pairs.
// - Cells that touch are neighbours, though they may share a corner of one of them only.
// - A cell is not tested again when its turn comes: it is split though a larger neighbour that
//   crowded it has been split since.
#pragma once

#include <stdexcept>
#include <string_view>
#include <vector>

#include "refinement.hpp"

namespace examples::thesis {

/// Adds an input point to P of the root.
struct Associate {
  static constexpr std::string_view kName = "associate";
  template <class S, int D>
  void operator()(S& s, Point<D> p) const;
};
/// Enqueues the root.
struct Begin {
  static constexpr std::string_view kName = "begin";
  template <class S, int D>
  void operator()(S& s, Cell<D> root) const;
};
/// One turn of the main loop: the cell c is split, for the reason r.
struct Split {
  static constexpr std::string_view kName = "split";
  template <class S, int D>
  void operator()(S& s, Cell<D> c, Cell<D> r) const;
};
/// One turn of the loop over P(c), and by recursion the rest.
struct Relocate {
  static constexpr std::string_view kName = "relocate";
  template <class S, int D>
  void operator()(S& s, Entry<D> p, Cell<D> c, Cell<D> r) const;
};
/// The second half of the main loop: what the split of c makes ill-graded or leaves crowded.
struct Enqueue {
  static constexpr std::string_view kName = "enqueue";
  template <class S, int D>
  void operator()(S& s, Cell<D> c, Cell<D> r) const;
};
inline constexpr Associate associate{};
inline constexpr Begin begin{};
inline constexpr Split split{};
inline constexpr Relocate relocate{};
inline constexpr Enqueue enqueue{};

inline constexpr sac::Key kAssociateKey{.bucket = -2};  // in the order of the input
inline constexpr sac::Key kBeginKey{.bucket = -1};
/// Throws: std::length_error if c is a deepest cell.
template <int D>
[[nodiscard]] sac::Key split_key(const Cell<D>& c) {
  if (c.level < kDeepest) return {.bucket = c.level};
  throw std::length_error("two points are too near to each other for a quadtree");
}

template <class S, int D>
void Associate::operator()(S& s, Point<D> p) const {
  auto& w = environment<S, D>(s);
  w.P.put(s, Cell<D>{}, {p, Cell<D>{}});  // 4: add the association [0, L]^d -> P to P
  w.cells_of.put(s, p, Cell<D>{});
}

template <class S, int D>
void Begin::operator()(S& s, Cell<D> root) const {
  auto& w = environment<S, D>(s);
  if (w.hold_two(s, root, root)) {                                 // 5: if [0, L]^d is crowded then
    w.cells.template post<split>(s, split_key(root), root, root);  // 6
  }
}

template <class S, int D>
void Split::operator()(S& s, Cell<D> c, Cell<D> r) const {
  auto& w = environment<S, D>(s);
  w.mark_split(s, c);                     // 10: split c
  if (const auto p = w.P.first(s, c)) {   // 11: for each point p in P(c) do
    s.template call<relocate>(*p, c, r);  // 12, 13
  }
  s.template tail<enqueue>(c, r);
}

template <class S, int D>
void Relocate::operator()(S& s, Entry<D> p, Cell<D> c, Cell<D> r) const {
  auto& w = environment<S, D>(s);
  const Cell<D> part = w.cell(p.p, c.level + 1);  // 12: find the c_i that contains p
  w.P.put(s, part, {p.p, r});                     // 13: add p to P(c_i) with a tag of r
  w.cells_of.put(s, p.p, part);
  if (const auto next = w.P.behind(s, c, p)) s.template tail<relocate>(*next, c, r);
}

template <class S, int D>
void Enqueue::operator()(S& s, Cell<D> c, Cell<D> r) const {
  auto& w = environment<S, D>(s);
  w.P.forget(s, c);                                    // 15: delete the entry P(c)
  std::vector<Cell<D>> largest;                        // of Q: what DeleteMin gives next
  w.any_neighbour(s, c, [&](const Cell<D>& n) {        // 16: for every neighbour c' of c
    if (n.level == c.level - 1) largest.push_back(n);  // 17, 18: if ill-graded, enqueue (c', r)
    return false;
  });
  for (unsigned i = 0; i < 1u << D; ++i) {  // 21
    const Cell<D> part = child_of(c, i);
    w.any_neighbour(s, part, [&](const Cell<D>& n) {  // 22: for every neighbour c_i' of c_i
      if (!w.hold_two(s, part, n)) return false;      // 23: if c_i is crowded
      w.cells.template post<split>(s, split_key(part), part, part);  // 24: enqueue (c_i, c_i)
      return true;                                                   // 25: skip to the next child
    });
  }
  for (const Cell<D>& n : largest) s.template call<split>(n, r);  // 8, 9
}

/// The program: splits the root until the tree is graded and no leaf is crowded.
struct BuildQT {
  static constexpr std::string_view kName = "build_qt";
  template <class S, int D>
  void operator()(S& s, Cell<D> root) const {
    auto& w = environment<S, D>(s);
    w.cells.template post<begin>(s, kBeginKey, root);  // 5-7
    w.cells.drain(s);                                  // 8: while |Q| > 0 do
  }
};
inline constexpr BuildQT build_qt{};

}  // namespace examples::thesis
