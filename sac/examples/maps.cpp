// The snippets of sac/docs/maps.md as one program; check() throws where a snippet is not true.
//
// tests/sac/maps_snippets_test.cpp runs it, and compares text and output with the document.
// clang-format off
#include <cstdint>
#include <ostream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <sac/sac.hpp>

namespace maps {

void check(bool holds, int line = __builtin_LINE()) {
  if (!holds) throw std::logic_error("not true: line " + std::to_string(line));
}

// --- A view ------------------------------------------------------------------------------------

struct Order {
  int customer, amount;
  friend bool operator==(const Order&, const Order&) = default;
};
using Ranked = std::pair<long, std::string>;  // sum, city

struct Shop {
  explicit Shop(sac::Engine& e)
      : cities(e, "cities"), orders(e, "orders"), sums(e, "sums"), ranks(e, "ranks") {}
  sac::Map<int, std::string> cities;           // by customer
  sac::Map<int, Order> orders;
  sac::Map<std::string, long, sac::Sum> sums;  // by city
  sac::Map<Ranked, bool> ranks;
};

void add_order(sac::Scope& s, int, const Order& order) {
  auto& shop = s.environment<Shop>();
  const auto city = shop.cities.find(s, order.customer);           // join
  if (city && order.amount >= 10)                                  // filter
    shop.sums.add(s, *city, order.amount);                         // group and sum
}
void rank_city(sac::Scope& s, const std::string& city, long sum) {
  s.environment<Shop>().ranks.put(s, {sum, city}, true);
}
void best_cities(sac::Scope& s, sac::Mod<std::string> best) {
  auto& shop = s.environment<Shop>();
  shop.orders.for_each<add_order>(s);
  shop.sums.for_each<rank_city>(s);
  std::string text;
  for (const auto& [ranked, yes] : shop.ranks.top(s, 2)) text += ranked.second + ' ';
  s.write(best, text);
}

void view() {
  sac::Engine e;
  Shop shop(e);
  e.set_environment(&shop);
  shop.cities.set(1, "Rome");
  shop.cities.set(2, "Oslo");
  shop.cities.set(3, "Lima");
  for (int i = 0; i < 30; ++i) shop.orders.set(i, {1 + i % 3, 10 + i % 3});
  const auto best = e.cell<std::string>();
  e.run<best_cities>(best);
  check(e.get(best) == "Lima Oslo ");
  check(*shop.sums.find("Oslo") == 110);

  shop.orders.set(4, {2, 500});
  check(e.propagate().executed == 3);  // the order's call, that of its city, and best_cities
  check(e.get(best) == "Oslo Lima ");
  shop.orders.erase(4);
  shop.cities.set(3, "Rome");  // a customer moves: its ten orders are looked at again
  e.propagate();
  check(e.get(best) == "Rome Oslo ");
}

// --- Intervals and folds -----------------------------------------------------------------------

struct Highest {
  using Value = int;
  static int none() { return 0; }
  static int of(int, int temperature) { return temperature; }
  static int join(int a, int b) { return a > b ? a : b; }
};

struct Station {
  explicit Station(sac::Engine& e)
      : readings(e, "readings"), count(e.cell<std::uint64_t>()), highest(e.cell<int>()) {}
  sac::Map<int, int, Highest> readings;  // by time
  sac::Mod<std::uint64_t> count;
  sac::Mod<int> highest;
};

void summarize(sac::Scope& s) {
  auto& station = s.environment<Station>();
  s.write(station.count, station.readings.count(s, {.from = 10, .below = 20}));
  s.write(station.highest, station.readings.fold<Highest>(s, {.from = 10, .below = 20}));
}

void intervals() {
  sac::Engine e;
  Station station(e);
  e.set_environment(&station);
  for (const int time : {5, 11, 17, 23}) station.readings.set(time, 2 * time);
  e.run<summarize>();
  check(e.get(station.count) == 2 && e.get(station.highest) == 34);
  station.readings.set(24, 99);
  check(e.propagate().executed == 0);  // outside of the interval
  station.readings.set(12, 7);
  check(e.propagate().executed == 1);
  check(e.get(station.count) == 3 && e.get(station.highest) == 34);
}

// --- The best of each group --------------------------------------------------------------------

struct Players {
  explicit Players(sac::Engine& e) : index(e, "index"), best(e, "best") {}
  sac::Map<std::pair<int, int>, std::string> index;  // by team and points
  sac::Map<int, std::string> best;                   // by team
};
void best_of_team(sac::Scope& s, int team) {
  auto& players = s.environment<Players>();
  const sac::Interval<std::pair<int, int>> own{.from = {{team, 0}}, .below = {{team + 1, 0}}};
  if (const auto last = players.index.last(s, own)) players.best.put(s, team, last->second);
}
void best_of_all(sac::Scope& s) {
  for (int team = 0; team < 3; ++team) s.call<best_of_team>(team);
}

void groups() {
  sac::Engine e;
  Players players(e);
  e.set_environment(&players);
  players.index.set({0, 7}, "Ada");
  players.index.set({0, 9}, "Bo");
  players.index.set({2, 4}, "Cy");
  e.run<best_of_all>();
  check(*players.best.find(0) == "Bo" && players.best.find(1) == nullptr);
  players.index.erase({0, 9});
  check(e.propagate().executed == 1);
  check(*players.best.find(0) == "Ada");
}

// --- An order of keys --------------------------------------------------------------------------

struct Steps {
  explicit Steps(sac::Engine& e) : tasks(e, "tasks"), ready(e, "ready") {}
  sac::Map<int, int> tasks;             // to how long it takes
  sac::Map<int, int, Highest> ready;    // to when it is done
};
void do_task(sac::Scope& s, int task, int takes) {
  auto& steps = s.environment<Steps>();
  const int start = steps.ready.fold<Highest>(s, {.from = task - 3, .below = task});
  steps.ready.put(s, task, start + takes);
}
void do_tasks(sac::Scope& s) { s.environment<Steps>().tasks.for_each<do_task>(s); }

void late_put(sac::Scope& s) {
  s.call<do_tasks>();
  s.environment<Steps>().ready.put(s, 5, 100);
}

void in_order(std::ostream& print) {
  sac::Engine e;
  Steps steps(e);
  e.set_environment(&steps);
  for (const int task : {1, 2, 4, 9}) steps.tasks.set(task, task);
  e.run<do_tasks>();
  check(*steps.ready.find(4) == 7 && *steps.ready.find(9) == 9);

  sac::Engine other;
  Steps more(other);
  other.set_environment(&more);
  for (const int task : {1, 2, 6}) more.tasks.set(task, task);
  try {
    other.run<late_put>();
  } catch (const sac::UsageError& error) {
    print << error.what() << '\n';
  }
}

// --- As lists ----------------------------------------------------------------------------------

using Entry = std::pair<int, int>;
bool is_warm(const Entry& reading) { return reading.second > 25; }
void warm_times(sac::Scope& s, sac::Mod<sac::List<Entry>> out) {
  s.write(out, sac::filter<is_warm>(s, s.environment<Station>().readings.list(s)));
}

struct Histogram {
  explicit Histogram(sac::Engine& e) : counts(e, "counts") {}
  sac::Map<int, long, sac::Sum> counts;
};
int tens(int x) { return x / 10; }
long one(int) { return 1; }
void count_tens(sac::Scope& s, sac::List<int> numbers) {
  sac::group_by<tens, one>(s, numbers, s.environment<Histogram>().counts);
}

void lists() {
  sac::Engine e;
  Station station(e);
  e.set_environment(&station);
  for (const int time : {5, 11, 17, 23}) station.readings.set(time, 2 * time);
  const auto out = e.cell<sac::List<Entry>>();
  e.run<warm_times>(out);
  station.readings.set(11, 30);
  e.propagate();
  int sum = 0;
  for (const auto& element : e.get(out).view(e)) sum += element.value().first;
  check(sum == 11 + 17 + 23);

  Histogram histogram(e);
  e.set_environment(&histogram);
  sac::Sequence<int> numbers(e, {12, 15, 31});
  e.run<count_tens>(numbers.list());
  numbers.push_back(19);
  e.propagate();
  check(*histogram.counts.find(1) == 3 && *histogram.counts.find(3) == 1);
}

/// Prints what the document shows.
void run_all(std::ostream& print) {
  view();
  intervals();
  groups();
  in_order(print);
  lists();
}

}  // namespace maps
