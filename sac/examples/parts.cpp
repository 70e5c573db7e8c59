// The snippets of docs/queries.md and docs/changes.md as one program; check() throws where a
// snippet is not true.
//
// tests/sac/parts_snippets_test.cpp runs it, and compares it with them line by line.
// clang-format off
#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include <sac/sac.hpp>

namespace parts {

void check(bool holds, int line = __builtin_LINE()) {
  if (!holds) throw std::logic_error("not true: line " + std::to_string(line));
}

// --- Queries ---------------------------------------------------------------------------------

struct Sheet {
  std::vector<sac::Mod<std::vector<int>>> terms;  // inputs: the cells that a cell adds up
  std::vector<sac::Mod<int>> constants;           // inputs
};

int value_of(sac::Scope& s, int cell) {
  auto& sheet = s.environment<Sheet>();
  int sum = s.read(sheet.constants[cell]);
  for (const int term : s.read(sheet.terms[cell])) sum += s.query<value_of>(term);
  return sum;
}

void show(sac::Scope& s, sac::Mod<int> out) { s.write(out, s.query<value_of>(0)); }

void queries() {
  sac::Engine e;
  Sheet sheet;
  for (int c = 0; c < 4; ++c) {
    sheet.constants.push_back(e.input(c));
    sheet.terms.push_back(e.input(std::vector<int>{}));
  }
  e.set(sheet.terms[0], {1, 2});
  e.set(sheet.terms[1], {3});
  e.set(sheet.terms[2], {3});
  e.set_environment(&sheet);
  const auto out = e.cell<int>();
  check(e.run<show>(out).executed == 5);  // show, and four cells: 3 is asked for twice
  check(e.get(out) == 9);

  e.set(sheet.constants[3], 4);
  check(e.propagate().executed == 5 && e.get(out) == 11);
  e.set(sheet.terms[3], {0});
  try {
    e.propagate();
  } catch (const sac::UsageError& error) {
    check(error.what() == std::string("a query needs its own result: value_of(0) asks for "
                                      "value_of(1) asks for value_of(3) asks for value_of(0)"));
  }
  check(e.get(out) == 11);  // the edit has been undone
}

// --- Fixed points ----------------------------------------------------------------------------

struct Net {
  std::vector<sac::Mod<std::map<int, int>>> lengths;  // inputs: to each neighbour
  std::vector<sac::Mod<int>> distances;               // from vertex 0
  sac::Agenda* rounds = nullptr;
};

struct Distance {
  static Net& net(sac::Scope& s) { return s.environment<Net>(); }
  static sac::Agenda& rounds(sac::Scope& s) { return *net(s).rounds; }
  static sac::Mod<int> value(sac::Scope& s, int v) { return net(s).distances[v]; }
  static int first(sac::Scope&, int v) { return v == 0 ? 0 : 1000000; }
  static int next(sac::Scope& s, int v) {
    int least = first(s, v);
    for (const auto& [w, length] : s.read(net(s).lengths[v])) {
      least = std::min(least, s.read(value(s, w)) + length);
    }
    return least;
  }
  static std::vector<int> dependents(sac::Scope& s, int v) {
    std::vector<int> all;
    for (const auto& [w, length] : s.read(net(s).lengths[v])) all.push_back(w);
    return all;
  }
};

void distances(sac::Scope& s) {
  const int n = static_cast<int>(Distance::net(s).distances.size());
  sac::iterate<Distance>(s, n);
}

void fixed_points() {
  sac::Engine e;
  Net net;
  net.rounds = &e.make_agenda("rounds");
  for (int v = 0; v < 3; ++v) {
    net.lengths.push_back(e.input(std::map<int, int>{}));
    net.distances.push_back(e.cell<int>());
  }
  const auto link = [&](int v, int w, int length) {
    for (const auto& [from, to] : {std::pair(v, w), std::pair(w, v)}) {
      auto lengths = e.get(net.lengths[from]);
      lengths[to] = length;
      e.set(net.lengths[from], lengths);
    }
  };
  link(0, 1, 5), link(0, 2, 2), link(1, 2, 1);
  e.set_environment(&net);
  e.run<distances>();
  check(e.get(net.distances[1]) == 3);
  link(1, 2, 7);
  e.propagate();
  check(e.get(net.distances[1]) == 5);
}

// --- Changes ---------------------------------------------------------------------------------

void halve(sac::Scope& s, sac::Mod<int> in, sac::Mod<int> out) { s.write(out, s.read(in) / 2); }

void watched() {
  sac::Engine e;
  const auto in = e.input(8);
  const auto out = e.cell<int>();
  e.run<halve>(in, out);

  std::vector<int> seen;
  e.on_change(out, [&](int x) { seen.push_back(x); });
  e.set(in, 9);  // a half of it is 4, as before
  e.propagate();
  check(!e.changed(out) && seen.empty());
  e.set(in, 20);
  e.propagate();
  check(e.changed(out) && seen == std::vector{10});
}

bool is_below(int x, int limit) { return x < limit; }

using Shown = sac::Output<sac::Placed<int>>;

void show_small(sac::Scope& s, sac::List<int> list, sac::Mod<int> limit) {
  sac::emit(s, sac::filter<is_below>(s, list, s.read(limit)), s.environment<Shown>());
}

void outputs() {
  sac::Engine e;
  Shown shown(e);
  e.set_environment(&shown);
  sac::Sequence<int> numbers(e, {5, 1, 8});
  const auto limit = e.input(6);
  e.run<show_small>(numbers.list(), limit);
  check(shown.added().size() == 2);

  const sac::ElementId last = numbers.push_back(3);
  e.propagate();
  check(shown.removed().empty() && shown.added().size() == 1);
  const auto [id, before, value] = shown.added()[0];
  check(id == last && value == 3);  // behind `before`, the 1
}

void run_all() {
  queries();
  fixed_points();
  watched();
  outputs();
}

}  // namespace parts

#ifndef SAC_PARTS_WITHOUT_MAIN
int main() { parts::run_all(); }
#endif
