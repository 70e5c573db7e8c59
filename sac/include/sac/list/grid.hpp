// Dynamic programming over the pairs of two lists: a block for each row and column, which takes
// what the blocks to its left and above hand over, and hands over to the right and below.
//
//   struct Paths {                                                  // in a grid with walls
//     using Across = int;                                           // over a border to the right
//     using Down = int;                                             // over a border below
//     static Across left(const Row&);                               // before the first column
//     static Down above(const Column&);                             // before the first row
//     static void block(auto& s, const Row&, const Column&, Across&, Down&);
//     static int rise(const Down&);                                 // if there is a band
//   };
//   const auto columns = sac::grid<Paths>(s, rows, columns);
//
// block() gets what comes from the left and from above, and replaces it by what goes to the right
// and below. It depends on its arguments, and on what it reads through the scope.
//
// An update runs the blocks whose row, column or borders have changed. So borders should hold
// *differences*, which are as they were a few blocks on, not totals, which a change shifts in all
// blocks behind. A block should be worth a call: make rows and columns of chunks (list/chunks.hpp).
//
// Idea: the loops of the textbook. Each column has one modifiable for the border below what has
// been done, each row one for the border to the right; a block reads both and writes both, and in
// the trace each read sees the write before it. No block knows its neighbours, so a row or column
// that is inserted renumbers nothing. Rows and columns are named by the ids of their elements: an
// element with another value is the same row, and its blocks run again.
//
// A *band* leaves out blocks far from the best: for programs that look for a least value, and whose
// borders below hold differences. rise() is by how much the value grows along a border below, from
// left to right, so the values at the corners of a row's upper border are known up to a constant.
// (1) A row consists of the columns from the first to the last one that has an upper corner whose
//     value is at most `band` above the least one. Looked at are the columns of the row above, and
//     those behind it up to the first that begins beyond that. No row ends before the one above:
//     otherwise a column could come back with a border of long ago.
// (2) Next to what is left out, borders are those of left() and above(). If along these the value
//     grows as it can at most, then values are never too small.
// (3) A row has as many columns as are within `band` of its least corner. If that is sharp, as
//     between strings that are alike, these are O(band); if values hardly differ, many more.
// (4) No row depends on positions or totals: the band goes where the least values are, and where an
//     edit has moved it, it is soon the same again.
//
// Cost, in calls. From scratch one for each block, two for each row. A row, column or border that
// changes: its blocks, one executed for each. A row that comes: its blocks are created; a column:
// so too, and one is executed for each row (with a band: for the rows that it is in). With a band
// also one for each row whose upper borders have changed, which reads them all.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "sac/check.hpp"
#include "sac/list/list.hpp"
#include "sac/list/operations.hpp"
#include "sac/list/reduce.hpp"

namespace sac {

/// A row or column of a grid: one for each element of a list, which stays the same if the element
/// gets another value.
template <class T, class Border, class S = Scope>
struct GridLine {
  typename S::template ModType<const T*> value;  ///< of the element
  typename S::template ModType<Border> border;   ///< what has been handed over last
  friend bool operator==(const GridLine&, const GridLine&) = default;
};

namespace detail {

// What the lines of a grid are: rows, or columns.
template <class Rule, bool kRows>
struct GridLines {
  using Border = std::conditional_t<kRows, typename Rule::Across, typename Rule::Down>;
  static constexpr std::string_view kName = kRows ? "grid_row" : "grid_column";
  static constexpr std::string_view kListName = kRows ? "grid_rows" : "grid_columns";
  static constexpr std::string_view kBehindName =
      kRows ? "grid_rows_behind" : "grid_columns_behind";
  template <class T>
  static Border before_first(const T& value) {
    if constexpr (kRows) {
      return Rule::left(value);
    } else {
      return Rule::above(value);
    }
  }
};

// The modifiables of a line.
template <class Kind, class T, class S>
struct LineCells {
  typename S::template CellType<const T*> value;
  typename S::template CellType<typename Kind::Border> border;
};

// The node of a line; its maker links it.
template <class Kind>
struct MakeLine {
  static constexpr std::string_view kName = Kind::kName;
  template <class S, class Line>
  void operator()(S&, ListNode<Line, S>& self, ElementId id, const Line& line) const {
    if (!self.holds()) self.hold(id, line);
  }
};

// Links lines for the elements behind `at` behind `before`. They are keyed by the ids of the
// elements, and by their list.
template <class Kind>
struct LinesBehind {
  static constexpr std::string_view kName = Kind::kBehindName;
  template <class S, class T, class Line>
  void operator()(S& s, const ListNode<T, S>* at, ListNode<Line, S>* before,
                  const ListNode<T, S>* list) const {
    const auto* const next = s.read(at->next);
    if (next == nullptr) return s.write(before->next, nullptr);
    const auto& cells = s.template make<LineCells<Kind, T, S>>(list, next->id());
    const Line line{cells.value, cells.border};
    auto& node = s.template make<ListNode<Line, S>, MakeLine<Kind>{}>(next->id(), line);
    s.write(line.value, &next->value());
    s.write(line.border, Kind::before_first(next->value()));
    s.write(before->next, &node);
    s.template tail<LinesBehind{}>(next, &node, list);
  }
};

template <class Kind>
struct Lines {
  static constexpr std::string_view kName = Kind::kListName;
  template <class S, class T, class Line>
  void operator()(S& s, ListNode<Line, S>& self, const ListNode<T, S>* list) const {
    s.template tail<LinesBehind<Kind>{}>(list, &self, list);
  }
};

template <class Kind, class S, class T>
auto lines(S& s, List<T, S> list) {
  using Line = GridLine<T, typename Kind::Border, S>;
  return List<Line, S>(s.template make<ListNode<Line, S>, Lines<Kind>{}>(list.header()));
}

template <class Rule, class S, class R, class C>
void run_block(S& s, const R& row, const C& column) {
  auto across = s.read(row.border);
  auto down = s.read(column.border);
  const auto* const row_value = s.read(row.value);
  Rule::block(s, *row_value, *s.read(column.value), across, down);
  s.write(row.border, std::move(across));
  s.write(column.border, std::move(down));
}

template <class Rule>
struct Rise {
  static constexpr std::string_view kName = "rise";
  template <class S, class Line>
  std::int64_t operator()(S& s, const Line& line) const {
    return Rule::rise(s.read(line.border));
  }
};

// --- The whole grid --------------------------------------------------------------------------

// The block of a row in a column, and those behind.
template <class Rule>
struct BlocksFrom {
  static constexpr std::string_view kName = "grid_block";
  template <class S, class R, class C>
  void operator()(S& s, const ListNode<R, S>* row, const ListNode<C, S>* column) const {
    const auto* const next = s.read(column->next);
    if (column->holds()) run_block<Rule>(s, row->value(), column->value());
    if (next != nullptr) s.template tail<BlocksFrom{}>(row, next);
  }
};

template <class Rule>
struct RowsFrom {
  static constexpr std::string_view kName = "grid_blocks";
  template <class S, class R, class C>
  void operator()(S& s, const ListNode<R, S>* row, const ListNode<C, S>* columns) const {
    const auto* const next = s.read(row->next);
    if (row->holds()) s.template call<BlocksFrom<Rule>{}>(row, columns);
    if (next != nullptr) s.template tail<RowsFrom{}>(next, columns);
  }
};

// --- A band of it ----------------------------------------------------------------------------

template <class Rule>
struct BandBlock {
  static constexpr std::string_view kName = "band_block";
  template <class S, class R, class C>
  void operator()(S& s, const ListNode<R, S>* row, const ListNode<C, S>* column) const {
    run_block<Rule>(s, row->value(), column->value());
  }
};

// The columns of a row, the first and the last; `above`: of the row above, no last one if there is
// no such row.
template <class Column, class S>
struct Stretch {
  const ListNode<Column, S>* first;
  const ListNode<Column, S>* last;
  friend bool operator==(const Stretch&, const Stretch&) = default;
};

template <class Rule>
struct StretchBelow {
  static constexpr std::string_view kName = "band_stretch";
  template <class S, class R, class C>
  Stretch<C, S> operator()(S& s, const ListNode<R, S>*, const Stretch<C, S>& above,
                           std::int64_t band) const {
    std::vector<const ListNode<C, S>*> columns;
    std::vector<std::int64_t> corners{0};  // left of each column, and behind the last
    std::int64_t least = 0;
    bool may_end = above.last == nullptr;
    for (const auto* c = above.first; c != nullptr; c = s.read(c->next)) {
      if (may_end && corners.back() > least + band) break;
      columns.push_back(c);
      corners.push_back(corners.back() + Rule::rise(s.read(c->value().border)));
      least = std::min(least, corners.back());
      may_end = may_end || c == above.last;
    }
    const auto is_far = [&](std::size_t i) {
      return std::min(corners[i], corners[i + 1]) > least + band;
    };
    std::size_t first = 0, last = columns.size() - 1;
    while (is_far(last) && columns[last] != above.last) --last;
    while (is_far(first)) ++first;
    s.weigh(columns.size());
    return {columns[first], columns[last]};
  }
};

template <class Rule>
struct BandRows {
  static constexpr std::string_view kName = "band_row";
  template <class S, class R, class C>
  void operator()(S& s, const ListNode<R, S>* row, const Stretch<C, S>& above,
                  std::int64_t band) const {
    const auto* const next = s.read(row->next);
    const Stretch<C, S> own = s.template call<StretchBelow<Rule>{}>(row, above, band);
    std::vector<const ListNode<C, S>*> columns{own.first};
    while (columns.back() != own.last) columns.push_back(s.read(columns.back()->next));
    for (const auto* column : columns) s.template call<BandBlock<Rule>{}>(row, column);
    s.weigh(columns.size());
    if (next != nullptr) s.template tail<BandRows{}>(next, own, band);
  }
};

template <class Rule>
struct Band {
  static constexpr std::string_view kName = "band";
  template <class S, class R, class C>
  void operator()(S& s, const ListNode<R, S>* rows, const ListNode<C, S>* columns,
                  std::int64_t band) const {
    const auto* const row = s.read(rows->next);
    const auto* const column = s.read(columns->next);
    if (row == nullptr || column == nullptr) return;
    s.template tail<BandRows<Rule>{}>(row, Stretch<C, S>{column, nullptr}, band);
  }
};

}  // namespace detail

/// A band that is no band: the whole grid.
inline constexpr int kNoBand = std::numeric_limits<int>::max();

/// Runs the blocks of a grid, row by row, or those within a band. Returns the columns: the border
/// of each is now that below the last row (or the last block of the column in the band), and can be
/// read by later calls and by the functions of later operations. Throws: UsageError if the band is
/// negative.
template <class Rule, class S, class R, class C>
[[nodiscard]] auto grid(S& s, List<R, S> rows, List<C, S> columns, std::int64_t band = kNoBand) {
  if (band < 0) throw UsageError("grid: a band is not negative");
  const auto row_lines = detail::lines<detail::GridLines<Rule, true>>(s, rows);
  const auto column_lines = detail::lines<detail::GridLines<Rule, false>>(s, columns);
  if (band >= kNoBand) {
    s.template call<detail::RowsFrom<Rule>{}>(row_lines.header(), column_lines.header());
  } else if constexpr (requires(const typename Rule::Down& border) { Rule::rise(border); }) {
    s.template call<detail::Band<Rule>{}>(row_lines.header(), column_lines.header(), band);
  } else {
    throw UsageError("grid: a rule without rise() has no band");
  }
  return column_lines;
}

/// A modifiable with the sum of rise() of the columns' borders.
template <class Rule, class S, class Line>
[[nodiscard]] auto rise_of(S& s, List<Line, S> columns) {
  return map_reduce<detail::Rise<Rule>{}, std::plus<>{}>(s, columns, std::int64_t{0});
}

}  // namespace sac
