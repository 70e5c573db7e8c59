// The snippets of sac/docs/dynamize.md as one program; check() throws where a snippet is not true.
//
// tests/sac/dynamize_snippets_test.cpp runs it, and compares text and output with the document.
// clang-format off
#include <algorithm>
#include <bit>
#include <cstdint>
#include <ostream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <sac/sac.hpp>

namespace dynamize {

void check(bool holds, int line = __builtin_LINE()) {
  if (!holds) throw std::logic_error("not true: line " + std::to_string(line));
}

// --- Step 0: static --------------------------------------------------------------------------

namespace once {

struct Item {
  std::int64_t value;
  const Item* next;
};

std::int64_t sum(const Item* item) {
  std::int64_t total = 0;
  for (; item != nullptr; item = item->next) total += item->value;
  return total;
}

}  // namespace once

// --- Step 1: what changes goes into modifiables, loops become calls --------------------------

struct Item;
struct State {
  std::int64_t value = 0;
  const Item* next = nullptr;  // null: the end
  friend bool operator==(const State&, const State&) = default;
};
struct Item {
  int id = 0;  // all different; 0: the header, which stands before the first
  sac::Cell<State> state;
};

using Sum = sac::Mod<std::int64_t>;

void add_up(sac::Scope& s, const Item* item, std::int64_t total, Sum out) {
  const auto [value, next] = s.read(item->state);
  if (next == nullptr) return s.write(out, total + value);
  s.tail<add_up>(next, total + value, out);
}
void sum_by_steps(sac::Scope& s, const Item* header, Sum out) {
  s.tail<add_up>(header, std::int64_t{0}, out);
}

const Item& insert_behind(sac::Engine& e, const Item& before, int id, std::int64_t value) {
  Item& item = e.make<Item>();
  item.id = id;
  const State old = e.get(before.state);
  e.set(item.state, {value, old.next});
  e.set(before.state, {old.value, &item});
  return item;
}

std::uint64_t work(const sac::Counts& c) { return c.created + c.discarded + c.executed; }

void make_list(sac::Engine& e, const Item& header, int n) {
  e.set(header.state, {});
  const Item* last = &header;
  for (int id = 1; id <= n; ++id) last = &insert_behind(e, *last, id, id % 100);
}

// Mean W of 20 insertions behind the k-th item of n; 0: the header.
template <auto Program>
std::uint64_t mean_work(sac::Engine& e, int n, int k) {
  constexpr int kUpdates = 20;
  const Item* const header = &e.make<Item>();
  make_list(e, *header, n);
  const Sum out = e.cell<std::int64_t>();
  e.run<Program>(header, out);
  const Item* place = header;
  for (; k > 0; --k) place = e.get(place->state).next;
  std::uint64_t total = 0;
  for (int id = n + 1; id <= n + kUpdates; ++id) {
    const std::int64_t old = e.get(out);
    insert_behind(e, *place, id, id % 100);
    total += work(e.propagate());
    check(e.get(out) == old + id % 100);
  }
  e.check_invariants();
  return total / kUpdates;
}

void print_audit(std::ostream& print, const sac::AuditReport& audit) {
  print << "audit: " << audit.duplicates << " duplicates";
  if (audit.duplicates > 0) print << ", first " << audit.first_duplicate;
  print << "; " << audit.reordered << " reordered";
  if (audit.reordered > 0) print << ", first " << audit.first_reordered;
  print << '\n';
}

template <auto Program>
void measure(std::ostream& print, std::string_view name) {
  sac::Engine small, large, other;
  small.set_audit(true);
  print << name << ": W = " << mean_work<Program>(small, 1000, 0) << " in front of 1000, "
        << mean_work<Program>(large, 4000, 0) << " in front of 4000, "
        << mean_work<Program>(other, 1000, 1000) << " near the end\n";
  print_audit(print, small.audit());
}

// --- Step 2: no chain through all items ------------------------------------------------------

void pair_up(sac::Scope& s, Item& self, const Item* first) {
  auto [value, next] = s.read(first->state);
  if (next != nullptr) {
    const State second = s.read(next->state);
    value += second.value;
    next = second.next;
  }
  s.write(self.state, {value, next == nullptr ? nullptr : &s.tail_make<Item, pair_up>(next)});
}

void sum_by_pairs(sac::Scope& s, const Item* header, Sum out) {
  const auto [value, next] = s.read(header->state);
  if (next == nullptr) return s.write(out, value);
  const Item* const up = &s.make<Item, pair_up>(header);
  s.tail<sum_by_pairs>(up, out);
}

void new_value_runs_few_calls() {
  sac::Engine e;
  const Item* const header = &e.make<Item>();
  make_list(e, *header, 1000);
  const Sum out = e.cell<std::int64_t>();
  e.run<sum_by_pairs>(header, out);
  const Item* const first = e.get(header->state).next;
  e.set(first->state, {5, e.get(first->state).next});
  const sac::Counts counts = e.propagate();
  check(e.get(out) == 49'504);
  check(counts.executed == 20 && counts.created == 0 && counts.discarded == 0);
}

// --- Step 3: coins ---------------------------------------------------------------------------

int height(int id) {
  return id == 0 ? 64 : std::countr_zero(sac::mix(static_cast<std::uint64_t>(id)));
}

void fill(sac::Scope& s, const Item* first, int level, Item* group) {
  group->id = first->id;
  auto [value, next] = s.read(first->state);
  while (next != nullptr && height(next->id) == level) {
    const State member = s.read(next->state);
    value += member.value;
    next = member.next;
  }
  if (next == nullptr) return s.write(group->state, {value, nullptr});
  Item* const behind = &s.make<Item>(level, s.read(next->state).value);  // a bad key
  s.write(group->state, {value, behind});
  s.tail<fill>(next, level, behind);
}

void fill_all(sac::Scope& s, const Item* header, int level, Sum out) {
  const auto [value, next] = s.read(header->state);
  if (next == nullptr) return s.write(out, value);
  Item* const up = &s.make<Item>(level, value);
  s.call<fill>(header, level, up);
  s.tail<fill_all>(static_cast<const Item*>(up), level + 1, out);
}
void sum_by_values(sac::Scope& s, const Item* header, Sum out) {
  s.tail<fill_all>(header, 0, out);
}

// --- Step 4: keys that differ ----------------------------------------------------------------

void contract(sac::Scope& s, Item& self, const Item* first, int level) {
  self.id = first->id;
  auto [value, next] = s.read(first->state);
  while (next != nullptr && height(next->id) == level) {
    const State member = s.read(next->state);
    value += member.value;
    next = member.next;
  }
  s.write(self.state,
          {value, next == nullptr ? nullptr : &s.tail_make<Item, contract>(next, level)});
}

void contract_all(sac::Scope& s, const Item* header, int level, Sum out) {
  const auto [value, next] = s.read(header->state);
  if (next == nullptr) return s.write(out, value);
  const Item* const up = &s.make<Item, contract>(header, level);
  s.tail<contract_all>(up, level + 1, out);
}
void sum_by_groups(sac::Scope& s, const Item* header, Sum out) {
  s.tail<contract_all>(header, 0, out);
}

// --- Step 5: results that many read ----------------------------------------------------------

constexpr std::int64_t kBudget = 40'000;

struct Mark;
struct MarkState {
  bool marked = false;
  const Mark* next = nullptr;
  friend bool operator==(const MarkState&, const MarkState&) = default;
};
struct Mark {
  sac::Cell<MarkState> state;
};

void mark_by_sum(sac::Scope& s, Mark& self, const Item* item, Sum sum) {
  const auto [value, next] = s.read(item->state);
  const bool marked = s.read(sum) > kBudget && value > 90;
  s.write(self.state,
          {marked, next == nullptr ? nullptr : &s.tail_make<Mark, mark_by_sum>(next, sum)});
}

void compare(sac::Scope& s, Sum sum, sac::Mod<bool> over) {
  s.write(over, s.read(sum) > kBudget);
}

void mark(sac::Scope& s, Mark& self, const Item* item, sac::Mod<bool> over) {
  const auto [value, next] = s.read(item->state);
  const bool marked = s.read(over) && value > 90;
  s.write(self.state, {marked, next == nullptr ? nullptr : &s.tail_make<Mark, mark>(next, over)});
}

using Marks = sac::Mod<const Mark*>;

void mark_slowly(sac::Scope& s, const Item* header, Sum sum, Marks marks) {
  s.call<sum_by_groups>(header, sum);
  s.write(marks, &s.make<Mark, mark_by_sum>(header, sum));
}

void mark_all(sac::Scope& s, const Item* header, Sum sum, Marks marks) {
  const auto over = s.cell<bool>();
  s.call<sum_by_groups>(header, sum);
  s.call<compare>(sum, over);
  s.write(marks, &s.make<Mark, mark>(header, over));
}

int count_marked(const sac::Engine& e, Marks marks) {
  int count = 0;
  for (const Mark* m = e.get(marks); m != nullptr; m = e.get(m->state).next) {
    if (e.get(m->state).marked) ++count;
  }
  return count;
}

template <auto Program>
std::uint64_t work_of_marks() {
  sac::Engine e;
  const Item* const header = &e.make<Item>();
  make_list(e, *header, 1000);
  const Sum sum = e.cell<std::int64_t>();
  const Marks marks = e.cell<const Mark*>();
  e.run<Program>(header, sum, marks);
  check(e.get(sum) == 49'500 && count_marked(e, marks) == 90);
  insert_behind(e, *header, 1001, 95);
  const sac::Counts counts = e.propagate();
  check(e.get(sum) == 49'595 && count_marked(e, marks) == 91);
  e.check_invariants();
  return work(counts);
}

void flip_runs_marks_in_place() {
  sac::Engine e;
  const Item* const header = &e.make<Item>();
  make_list(e, *header, 1000);
  const Sum sum = e.cell<std::int64_t>();
  const Marks marks = e.cell<const Mark*>();
  e.run<mark_all>(header, sum, marks);
  e.set(header->state, {-10'000, e.get(header->state).next});
  const sac::Counts counts = e.propagate();
  check(e.get(sum) == 39'500 && count_marked(e, marks) == 0);
  check(counts.executed > 1000 && counts.created == 0 && counts.discarded == 0);
}

// --- When a program is not stable ------------------------------------------------------------

struct Tasks {
  std::vector<sac::Mod<int>> priority;
  std::vector<sac::Mod<bool>> done;
  sac::Agenda& agenda;
};

void serve(sac::Scope& s, int task) { s.write(s.environment<Tasks>().done[task], true); }

void serve_sorted(sac::Scope& s) {
  const auto& tasks = s.environment<Tasks>();
  std::vector<std::pair<int, int>> order;
  for (int i = 0; i < static_cast<int>(tasks.priority.size()); ++i) {
    order.emplace_back(s.read(tasks.priority[i]), i);
  }
  std::sort(order.begin(), order.end());
  for (const auto& [priority, task] : order) s.call<serve>(task);
}

void serve_at(sac::Scope& s, int /*priority*/, int task) {
  s.write(s.environment<Tasks>().done[task], true);
}

void announce(sac::Scope& s, int task) {
  auto& tasks = s.environment<Tasks>();
  const int priority = s.read(tasks.priority[task]);
  tasks.agenda.post<serve_at>(s, {.bucket = priority}, priority, task);
}

void serve_all(sac::Scope& s) {
  auto& tasks = s.environment<Tasks>();
  for (int i = 0; i < static_cast<int>(tasks.priority.size()); ++i) s.call<announce>(i);
  tasks.agenda.drain(s);
}

template <auto Program>
void measure_tasks(std::ostream& print, std::string_view name) {
  sac::Engine e;
  e.set_audit(true);
  Tasks tasks{{}, {}, e.make_agenda("tasks")};
  for (int i = 0; i < 100; ++i) {
    tasks.priority.push_back(e.input(10 + i));
    tasks.done.push_back(e.cell<bool>());
  }
  e.set_environment(&tasks);
  e.run<Program>();
  e.set(tasks.priority[99], 1);  // the last of 100 comes first
  const sac::Counts counts = e.propagate();
  e.check_invariants();
  print << name << ": W = " << work(counts) << '\n';
  print_audit(print, e.audit());
}

void square(sac::Scope& s, sac::Mod<int> in, sac::Mod<int> out) {
  const int x = s.read(in);
  s.write(out, x * x);
}

void sum_of_squares(sac::Scope& s, sac::Mod<int> out) {
  const auto& inputs = s.environment<std::vector<sac::Mod<int>>>();
  int sum = 0;
  for (int i = 0; i < static_cast<int>(inputs.size()); ++i) {
    const auto squared = s.cell<int>(i);
    s.call<square>(inputs[i], squared);
    sum += s.read(squared);
  }
  s.write(out, sum);
}

void results_of_children() {
  sac::Engine e;
  std::vector<sac::Mod<int>> inputs{e.input(1), e.input(2), e.input(3)};
  e.set_environment(&inputs);
  const auto out = e.cell<int>();
  e.run<sum_of_squares>(out);
  check(e.get(out) == 14);
  e.set(inputs[1], 5);
  check(e.propagate().executed == 2 && e.get(out) == 35);
  e.set(inputs[1], -5);
  check(e.propagate().executed == 1);
}

/// Prints what the document shows.
void run_all(std::ostream& print) {
  const once::Item last{3, nullptr}, first{4, &last};
  check(once::sum(&first) == 7);
  measure<sum_by_steps>(print, "sum_by_steps");
  measure<sum_by_pairs>(print, "sum_by_pairs");
  measure<sum_by_values>(print, "sum_by_values");
  measure<sum_by_groups>(print, "sum_by_groups");
  new_value_runs_few_calls();
  flip_runs_marks_in_place();
  print << "mark_slowly: W = " << work_of_marks<mark_slowly>() << '\n'
        << "mark_all: W = " << work_of_marks<mark_all>() << '\n';
  measure_tasks<serve_sorted>(print, "serve_sorted");
  measure_tasks<serve_all>(print, "serve_all");
  results_of_children();
}

}  // namespace dynamize
