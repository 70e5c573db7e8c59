// A spreadsheet: cells hold numbers and formulas, given as text, that may refer to any other cell.
//
// Idea: the order of evaluation depends on the formulas, so it is computed, by levels: a cell has
// level k if all cells it refers to have lower levels, and one has k - 1. A queue assigns the
// levels; a cell that gets one is evaluated in that level, and posts the cells that refer to it for
// the next. Cells on a cycle, and those that refer to them, never get a level: they keep their
// initial value, the error "cycle".
//
// Source: topological order by Kahn (1962).
// Cost of an update: a new number, the formulas that see it, up to values that stay what they were;
// each costs as many reads as it names cells. A new formula also costs those whose level changes.
// Stable because: calls are named by cell and level and ordered by them: common calls of two sheets
// come in one order. A cell is asked for once for each level among the cells it refers to; the last
// time it gets its own.
//
// The client's side keeps, with each cell, the cells that refer to it, as a graph keeps its edges.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "formula.hpp"
#include "sac/sac.hpp"

namespace examples::spreadsheet {

template <class S>
struct Sheet {
  template <class T>
  using Mod = typename S::template ModType<T>;

  int rows;
  std::vector<Mod<std::string>> texts;           // inputs
  std::vector<Mod<std::vector<int>>> refers_to;  // inputs: cells in the formula, ascending
  std::vector<Mod<std::vector<int>>> used_by;    // inputs: the converse
  std::vector<Mod<int>> levels;
  std::vector<Mod<Value>> values;
  typename S::AgendaType* queue = nullptr;

  /// A sheet of empty cells.
  template <class Host>
  Sheet(Host& host, int row_count) : rows(row_count), queue(&host.make_agenda("levels")) {
    for (int c = 0; c < rows * kColumns; ++c) {
      texts.push_back(host.input(std::string()));
      refers_to.push_back(host.input(std::vector<int>{}));
      used_by.push_back(host.input(std::vector<int>{}));
      levels.push_back(host.template cell<int>());
      values.push_back(host.template cell<Value>());
    }
    host.set_environment(this);
  }
  Sheet(const Sheet&) = delete;  // it is the environment
  Sheet& operator=(const Sheet&) = delete;

  /// Gives a cell a new text; an edit.
  template <class Host>
  void set(Host& host, int cell, std::string_view text);
};

template <class S>
template <class Host>
void Sheet<S>::set(Host& host, int cell, std::string_view text) {
  std::vector<int> now;
  const auto record = [&](int c) {
    now.push_back(c);
    return Value{};
  };
  if (value_of(text, rows, record).fault == Fault::syntax) {
    text = "?";  // one text for all that are no formula: none of their cells matters
    now.clear();
  }
  std::ranges::sort(now);
  now.erase(std::unique(now.begin(), now.end()), now.end());
  const std::vector<int> before = host.get(refers_to[cell]);
  for (const int c : before) {
    if (std::ranges::binary_search(now, c)) continue;
    std::vector<int> users = host.get(used_by[c]);
    std::erase(users, cell);
    host.set(used_by[c], std::move(users));
  }
  for (const int c : now) {
    if (std::ranges::binary_search(before, c)) continue;
    std::vector<int> users = host.get(used_by[c]);
    users.insert(std::ranges::lower_bound(users, cell), cell);
    host.set(used_by[c], std::move(users));
  }
  host.set(refers_to[cell], std::move(now));
  host.set(texts[cell], std::string(text));
}

inline constexpr int kNoLevel = std::numeric_limits<int>::max();

// Calls of a level: first what gets it, then what is evaluated in it. Levels beyond the last bucket
// share it, in order: evaluation asks for nothing.
inline sac::Key key_of(int level, unsigned phase, int cell) {
  return {.bucket = std::min(level, 32767),
          .phase = phase,
          .order = static_cast<std::uint64_t>(level) << 32 | static_cast<unsigned>(cell)};
}

struct Evaluate {
  static constexpr std::string_view kName = "evaluate";
  template <class S>
  void operator()(S& s, int cell, int /* level */) const {
    auto& sheet = s.template environment<Sheet<S>>();
    const std::string& text = s.read(sheet.texts[cell]);
    std::uint64_t steps = text.size();
    const auto read = [&](int c) -> const Value& { return ++steps, s.read(sheet.values[c]); };
    s.write(sheet.values[cell], value_of(text, sheet.rows, read));
    s.weigh(steps);
  }
};
struct Place {
  static constexpr std::string_view kName = "place";
  template <class S>
  void operator()(S& s, int cell, int level) const;
};
inline constexpr Evaluate evaluate{};
inline constexpr Place place{};

template <class S>
void Place::operator()(S& s, int cell, int level) const {
  auto& sheet = s.template environment<Sheet<S>>();
  const std::vector<int>& refers_to = s.read(sheet.refers_to[cell]);
  s.weigh(refers_to.size());
  for (const int c : refers_to) {
    if (s.read(sheet.levels[c]) >= level) return;
  }
  s.write(sheet.levels[cell], level);
  sheet.queue->template post<evaluate>(s, key_of(level, 1, cell), cell, level);
  const std::vector<int>& used_by = s.read(sheet.used_by[cell]);
  s.weigh(used_by.size());
  for (const int user : used_by) {
    sheet.queue->template post<place>(s, key_of(level + 1, 0, user), user, level + 1);
  }
}

struct Calculate {
  static constexpr std::string_view kName = "calculate";
  template <class S>
  void operator()(S& s) const {
    auto& sheet = s.template environment<Sheet<S>>();
    for (int c = 0; c < sheet.rows * kColumns; ++c) {
      s.write(sheet.levels[c], kNoLevel);
      s.write(sheet.values[c], Value{0, Fault::cycle});
      sheet.queue->template post<place>(s, key_of(0, 0, c), c, 0);
    }
    sheet.queue->drain(s);
  }
};
/// The program: evaluates the sheet of the environment.
inline constexpr Calculate calculate{};

}  // namespace examples::spreadsheet
