// The snippets of sac/README.md, docs/sequences.md and docs/events.md as one program; check()
// throws where a snippet is not true.
//
// tests/sac/readme_snippets_test.cpp runs it, and compares it with them line by line.
// clang-format off
#include <algorithm>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include <sac/event_log.hpp>
#include <sac/sac.hpp>

namespace readme {

void check(bool holds, int line = __builtin_LINE()) {
  if (!holds) throw std::logic_error("not true: line " + std::to_string(line));
}

// --- 1. Read and write -----------------------------------------------------------------------

void add(sac::Scope& s, sac::Mod<int> a, sac::Mod<int> b, sac::Mod<int> out) {
  s.write(out, s.read(a) + s.read(b));
}

void read_and_write() {
  sac::Engine e;
  const auto a = e.input(3), b = e.input(4);
  const auto sum = e.cell<int>();
  e.run<add>(a, b, sum);
  check(e.get(sum) == 7);
  e.set(a, 10);
  check(e.propagate().executed == 1);
  check(e.get(sum) == 14);
}

// --- 2. Calls that are reused ----------------------------------------------------------------

struct Node {
  int value = 0;
  sac::Cell<const Node*> next;  // null: the end
};

void square(sac::Scope& s, Node& self, const Node* node) {
  self.value = node->value * node->value;
  const Node* next = s.read(node->next);
  s.write(self.next, next == nullptr ? nullptr : &s.tail_make<Node, square>(next));
}

void squares(sac::Scope& s, const Node* list, sac::Mod<const Node*> out) {
  s.write(out, &s.tail_make<Node, square>(list));
}

int total(const sac::Engine& e, const Node* list) {
  int sum = 0;
  for (; list != nullptr; list = e.get(list->next)) sum += list->value;
  return sum;
}

void calls_that_are_reused() {
  sac::Engine e;
  std::vector<Node*> nodes(1000);
  for (int i = 999; i >= 0; --i) {
    nodes[i] = &e.make<Node>();
    nodes[i]->value = i % 10;
    e.set(nodes[i]->next, i < 999 ? nodes[i + 1] : nullptr);
  }
  const Node* first = nodes[0];
  const auto out = e.cell<const Node*>();
  e.propagate();
  e.run<squares>(first, out);
  check(total(e, e.get(out)) == 28500);

  Node& fresh = e.make<Node>();  // insert a 3 in the middle
  fresh.value = 3;
  e.set(fresh.next, e.get(nodes[500]->next));
  e.set(nodes[500]->next, &fresh);
  const sac::Counts work = e.propagate();
  check(total(e, e.get(out)) == 28509);
  check(work.executed == 2 && work.created == 1 && work.discarded == 0);
}

// --- 3. A modifiable written more than once --------------------------------------------------

void copy(sac::Scope& s, sac::Mod<int> from, sac::Mod<int> to) {
  s.write(to, s.read(from));
}

void twice(sac::Scope& s, sac::Mod<int> a, sac::Mod<int> b, sac::Mod<int> x,
           sac::Mod<int> first, sac::Mod<int> second) {
  s.call<copy>(a, x);
  s.call<copy>(x, first);  // sees a
  s.call<copy>(b, x);
  s.call<copy>(x, second);  // sees b
}

void written_more_than_once() {
  sac::Engine e;
  const auto a = e.input(1), b = e.input(2);
  const auto x = e.cell<int>(), first = e.cell<int>(), second = e.cell<int>();
  e.run<twice>(a, b, x, first, second);
  check(e.get(first) == 1 && e.get(second) == 2);
  e.set(a, 5);
  check(e.propagate().executed == 2);  // copy(a, x) and copy(x, first)
  check(e.get(first) == 5 && e.get(second) == 2);
}

// --- 4. A work queue -------------------------------------------------------------------------

struct Graph {
  std::vector<sac::Mod<std::vector<int>>> edges;  // inputs: where each vertex leads
  std::vector<sac::Mod<int>> hops;                // from vertex 0; 99: not reached
  sac::Agenda& queue;
};

void visit(sac::Scope& s, int v, int d) {
  auto& g = s.environment<Graph>();
  if (s.read(g.hops[v]) <= d) return;
  s.write(g.hops[v], d);
  for (const int w : s.read(g.edges[v])) g.queue.post<visit>(s, {.bucket = d + 1}, w, d + 1);
}

void search(sac::Scope& s) {
  auto& g = s.environment<Graph>();
  for (const auto hops : g.hops) s.write(hops, 99);
  g.queue.post<visit>(s, {.bucket = 0}, 0, 0);
  g.queue.drain(s);
}

void work_queue() {
  sac::Engine e;
  Graph g{{}, {}, e.make_agenda("visits")};
  for (const auto& to : std::vector<std::vector<int>>{{1}, {2}, {3}, {}}) {
    g.edges.push_back(e.input(to));
    g.hops.push_back(e.cell<int>());
  }
  e.set_environment(&g);
  e.run<search>();
  check(e.get(g.hops[3]) == 3);
  e.set(g.edges[0], {1, 3});
  e.propagate();
  check(e.get(g.hops[3]) == 1);
}

// --- 5. The same text without a trace --------------------------------------------------------

struct Cube {
  template <class S, class M>
  void operator()(S& s, M in, M out) const {
    const int x = s.read(in);
    s.write(out, x * x * x);
  }
};
inline constexpr Cube cube{};

template <class Host>
int cube_of(Host& host, int x) {
  const auto in = host.input(x);
  const auto out = host.template cell<int>();
  host.template run<cube>(in, out);
  return host.get(out);
}

void without_a_trace() {
  sac::Engine e;
  sac::PlainScope plain;
  check(cube_of(e, 3) == 27 && cube_of(plain, 3) == 27);
}

// --- Sequences -------------------------------------------------------------------------------

int tens(int x) { return x / 10; }
bool is_even(int x) { return x % 2 == 0; }

void report(sac::Scope& s, sac::List<int> in, sac::Mod<sac::List<int>> out, sac::Mod<int> sum) {
  const auto even = sac::filter<is_even>(s, sac::map<tens>(s, in));
  s.write(out, sac::sort<std::less<>{}>(s, even));
  s.write(sum, sac::fetch(s, sac::reduce<std::plus<>{}>(s, even, 0)));
}

std::vector<int> values(const sac::Engine& e, sac::List<int> list) {
  std::vector<int> all;
  for (const auto& element : list.view(e)) all.push_back(element.value());
  return all;
}

void sequences() {
  sac::Engine e;
  sac::Sequence<int> numbers(e, {62, 10, 45, 83});
  const auto out = e.cell<sac::List<int>>();
  const auto sum = e.cell<int>();
  e.run<report>(numbers.list(), out, sum);
  check(values(e, e.get(out)) == std::vector{4, 6, 8} && e.get(sum) == 18);

  const sac::ElementId id = numbers.insert_after(numbers.first(), 20);
  numbers.erase(numbers.last());
  e.propagate();
  check(values(e, e.get(out)) == std::vector{2, 4, 6} && e.get(sum) == 12);
  numbers.set(id, 0);
  e.propagate();
  check(values(e, e.get(out)) == std::vector{0, 4, 6} && e.get(sum) == 10);
}

struct Limits {
  sac::Mod<int> most;
};

bool fits(sac::Scope& s, int x) { return x <= s.read(s.environment<Limits>().most); }

void small(sac::Scope& s, sac::List<int> in, sac::Mod<sac::List<int>> out) {
  s.write(out, sac::filter<fits>(s, in));
}

void parameters() {
  sac::Engine e;
  sac::Sequence<int> numbers(e, {62, 10, 45, 83});
  const auto out = e.cell<sac::List<int>>();
  Limits limits{e.input(50)};
  e.set_environment(&limits);
  e.run<small>(numbers.list(), out);
  check(values(e, e.get(out)) == std::vector{10, 45});
  e.set(limits.most, 70);
  e.propagate();
  check(values(e, e.get(out)) == std::vector{62, 10, 45});
}

// --- Chunks and grids ------------------------------------------------------------------------

struct CommonSubsequence {
  using Across = int;  // by how much the length grows over a step down,
  using Down = int;    // and over one to the right
  static int left(int) { return 0; }
  static int above(int) { return 0; }
  static void block(sac::Scope&, int a, int b, int& left, int& above) {
    const int length = a == b ? 1 : std::max(left, above);  // less that of the corner
    const int below = length - left;
    left = length - above;
    above = below;
  }
  static int rise(int below) { return below; }
};

void compare(sac::Scope& s, sac::List<int> a, sac::List<int> b, sac::Mod<std::int64_t> length) {
  const auto columns = sac::grid<CommonSubsequence>(s, a, b);
  s.write(length, sac::fetch(s, sac::rise_of<CommonSubsequence>(s, columns)));
}

void grids() {
  sac::Engine e;
  sac::Sequence<int> a(e, {3, 1, 4, 1, 5, 9}), b(e, {1, 4, 1, 4, 2});
  const auto length = e.cell<std::int64_t>();
  e.run<compare>(a.list(), b.list(), length);
  check(e.get(length) == 3);  // 1, 4, 1
  a.insert_after(a.first(), 2);
  b.push_front(3);
  e.propagate();
  check(e.get(length) == 4);
}

// --- Why did it run again? -------------------------------------------------------------------

void why_again() {
  sac::Engine e;
  const auto a = e.input(3), b = e.input(4);
  const auto sum = e.cell<int>(), out = e.cell<int>();
  e.run<add>(a, b, sum);
  e.run<copy>(sum, out);
  sac::EventLog log(e);
  e.name(a, "price");
  e.set(a, 12);
  e.propagate();
  const std::string why = log.explain("copy");
  check(why.find(" ran again because modifiable 'price' (@") != why.npos);
}

void run_all() {
  read_and_write();
  calls_that_are_reused();
  written_more_than_once();
  work_queue();
  without_a_trace();
  sequences();
  parameters();
  grids();
  why_again();
}

}  // namespace readme

#ifndef SAC_README_WITHOUT_MAIN
int main() { readme::run_all(); }
#endif
