// The order-maintenance list against std::list.
#include "sac/internal/timeline.hpp"

#include <catch2/catch.hpp>
#include <list>
#include <new>
#include <unordered_map>
#include <utility>
#include <vector>

#include "failing_new.hpp"
#include "sac/check.hpp"
#include "sac/label.hpp"

namespace {

using sac::Place;
using sac::TimeNode;
using support::memory_is_out;

struct Fixture {
  sac::Arena arena;
  sac::Timeline timeline{arena};
  std::list<Place> oracle{timeline.front()};
  std::vector<std::list<Place>::iterator> places{oracle.begin()};  // the last one is the latest
  std::uint64_t state = 7;

  std::size_t random(std::size_t n) {
    state = sac::mix(state + 0x9e3779b97f4a7c15u);
    return state % n;
  }
  static TimeNode::Kind kind_of(Place node) {
    constexpr TimeNode::Kind kKinds[] = {TimeNode::Kind::end, TimeNode::Kind::call,
                                         TimeNode::Kind::segment};
    return kKinds[node.handle() % 3];
  }
  TimeNode& at(Place h) { return arena[h]; }
  Place fresh() {
    const Place node = arena.make<TimeNode>();
    at(node).set_kind(kind_of(node));
    return node;
  }
  void insert(std::size_t i) { insert(i, fresh()); }
  void insert(std::size_t i, Place node) {
    timeline.insert_after(*places[i], node);
    places.push_back(oracle.insert(std::next(places[i]), node));
  }
  void insert_after_latest(int count) {
    for (int i = 0; i < count; ++i) insert(places.size() - 1);
  }
  void insert_at_random(int count) {
    for (int i = 0; i < count; ++i) insert(random(places.size()));
  }
  void erase(std::size_t i) {
    const Place node = *places[i];
    timeline.erase(node);
    arena.release(node);
    oracle.erase(places[i]);
    places[i] = places.back();
    places.pop_back();
  }
  /// Takes out the `count` nodes behind `from`, or as many as there are.
  void erase_range(std::list<Place>::iterator from, std::size_t count) {
    auto to = std::next(from);
    for (; count > 0 && to != oracle.end(); --count, ++to) {
      timeline.erase(*to);
      arena.release(*to);
    }
    oracle.erase(std::next(from), to);
    places.clear();
    for (auto it = oracle.begin(); it != oracle.end(); ++it) places.push_back(it);
  }
  void check() {
    timeline.check_invariants();
    REQUIRE(timeline.size() == oracle.size());
    Place node = timeline.front();
    const TimeNode* previous = nullptr;
    bool same = true;
    for (const Place expected : oracle) {
      same = same && node == expected &&
             (previous == nullptr || timeline.precedes(*previous, at(node))) &&
             (previous == nullptr || !timeline.precedes(at(node), *previous)) &&
             (node == timeline.front() || at(node).kind() == kind_of(node));
      previous = &at(node);
      node = at(node).next;
    }
    REQUIRE(same);
    REQUIRE(node == nullptr);
    REQUIRE(timeline.back() == oracle.back());
  }
  /// Random pairs are in the order of their positions.
  void check_pairs(int count) {
    std::unordered_map<sac::Handle, std::size_t> rank;
    for (const Place h : oracle) rank.emplace(h.handle(), rank.size());
    bool same = true;
    for (int i = 0; i < count; ++i) {
      const Place a = *places[random(places.size())], b = *places[random(places.size())];
      same = same && timeline.precedes(at(a), at(b)) == (rank.at(a.handle()) < rank.at(b.handle()));
    }
    REQUIRE(same);
  }
};

TEST_CASE("a group number has 30 bits and leaves the kind alone") {
  TimeNode n;
  n.group_and_kind = 0x3ffffffeu;
  CHECK(n.is_call());
  for (const auto kind : {TimeNode::Kind::segment, TimeNode::Kind::end, TimeNode::Kind::call}) {
    n.set_kind(kind);
    CHECK(n.kind() == kind);
    CHECK(n.group() == 0x3ffffffeu);
  }
}

TEST_CASE("appending keeps the order") {
  Fixture f;
  f.insert_after_latest(20000);
  f.check();
  CHECK(f.timeline.bytes() < f.timeline.size());
}

TEST_CASE("inserting at one place over and over keeps the order through all relabellings") {
  const std::size_t before = GENERATE(0, 5, 700, 1500);
  Fixture f;
  f.insert_after_latest(2000);
  for (int i = 0; i < 50000; ++i) {
    f.insert(before);
    if (i % 10000 == 0) f.check();
  }
  f.check();
  CHECK(f.timeline.bytes() < f.timeline.size());
}

TEST_CASE("inserting right before one node over and over keeps the order") {
  const std::size_t before = GENERATE(0, 5, 700, 1500);
  Fixture f;
  f.insert_after_latest(2000);
  f.insert(before);
  f.insert_after_latest(50000);
  f.check();
  CHECK(f.timeline.bytes() < f.timeline.size());
}

TEST_CASE("inserting on both sides of one node in turns keeps the order") {
  Fixture f;
  f.insert_after_latest(100);
  for (int i = 0; i < 20000; ++i) {
    const Place place = i % 2 == 0 ? *f.places[50] : f.at(*f.places[50]).prev;
    const Place node = f.fresh();
    f.timeline.insert_after(place, node);
    f.oracle.insert(i % 2 == 0 ? std::next(f.places[50]) : f.places[50], node);
  }
  f.check();
}

/// Counts the nodes whose stamps change.
struct Watcher {
  explicit Watcher(Fixture& fixture) : f(fixture) { look(), written = 0; }

  void look() {
    for (Place h = f.timeline.front(); h != nullptr; h = f.at(h).next) {
      const std::uint64_t stamp = std::uint64_t{f.at(h).group()} << 32 | f.at(h).label;
      if (stamps.size() <= h.handle()) stamps.resize(h.handle() + 1);
      written += std::exchange(stamps[h.handle()], stamp) != stamp ? 1 : 0;
    }
  }

  Fixture& f;
  std::vector<std::uint64_t> stamps;
  std::size_t written = 0;
};

TEST_CASE("inserting into the narrowest gap relabels fewer than two other nodes on average") {
  Fixture f;
  f.insert_after_latest(1500);
  Watcher watcher(f);
  for (int i = 0; i < 4000; ++i) {
    std::size_t narrowest = 0;
    std::uint32_t least = 0xffffffffu;
    for (std::size_t p = 0; p < f.places.size(); ++p) {
      const TimeNode& n = f.at(*f.places[p]);
      if (n.next == 0 || f.at(n.next).group() != n.group()) continue;
      const std::uint32_t gap = f.at(n.next).label - n.label;
      if (gap < least) least = gap, narrowest = p;
    }
    f.insert(narrowest);
    watcher.look();
  }
  f.check();
  CHECK(watcher.written < 3 * 4000);
}

TEST_CASE("after a while at one place, insertions relabel next to nothing") {
  const std::size_t place = GENERATE(0, 5, 700, 1500);
  const bool run = GENERATE(false, true);
  Fixture f;
  f.insert_after_latest(2000);
  for (int i = 0; i < 1000; ++i) f.insert(run && i > 0 ? f.places.size() - 1 : place);
  Watcher watcher(f);
  for (int i = 0; i < 2000; ++i) {
    f.insert(run ? f.places.size() - 1 : place);
    watcher.look();
  }
  CHECK(watcher.written < 2000 + 100);
}

TEST_CASE("a run of 400 nodes between two appended ones relabels nothing") {
  Fixture f;
  f.insert_after_latest(2000);
  Watcher watcher(f);
  f.insert(1000);
  f.insert_after_latest(399);
  watcher.look();
  CHECK(watcher.written == 400);
}

TEST_CASE("insertions, bursts and erasures of all kinds keep the order of std::list") {
  const std::uint64_t seed = GENERATE(range(1, 7));
  INFO("seed " << seed);
  Fixture f;
  f.state = seed;
  for (int step = 0; step < 100; ++step) {
    const std::size_t spot = f.random(f.places.size());
    switch (f.random(10)) {
      case 0:
        for (int i = 0; i < 2000; ++i) f.insert(spot);
        break;
      case 1:
        f.insert(spot);
        f.insert_after_latest(2000);
        break;
      case 2:
        f.insert_at_random(1000);
        break;
      case 3:
        for (int burst = 0; burst < 20; ++burst) {
          f.insert_at_random(1);
          f.insert_after_latest(50);
        }
        break;
      case 4:
        for (int burst = 0; burst < 20; ++burst) {
          const std::size_t place = f.random(f.places.size());
          for (int i = 0; i < 50; ++i) f.insert(place);
        }
        break;
      case 5:  // a subtree of the trace that is replaced by one of another size
        f.erase_range(f.places[spot], f.random(2000));
        f.insert(f.random(f.places.size()));
        f.insert_after_latest(static_cast<int>(f.random(2000)));
        break;
      case 6:
        f.erase_range(f.places[spot], f.random(f.places.size()));
        break;
      case 7:
        if (f.random(4) == 0) f.timeline.shrink();
        break;
      default:
        for (int i = 0; i < 700 && f.places.size() > 1; ++i) {
          const std::size_t place = f.random(f.places.size());
          if (f.places[place] != f.oracle.begin()) f.erase(place);
        }
    }
    f.check();
    f.check_pairs(200);
  }
}

TEST_CASE("many random insertions from an empty list on keep the order") {
  Fixture f;
  f.insert_at_random(100000);
  f.check();
  f.check_pairs(100000);
  CHECK(f.timeline.bytes() < f.timeline.size());
}

TEST_CASE("what lies in a row is taken out, in the middle or up to the end") {
  Fixture f;
  f.insert_at_random(3000);
  f.insert_after_latest(5000);
  f.erase_range(std::next(f.oracle.begin(), 100), 1900);
  f.check();
  f.erase_range(std::next(f.oracle.begin(), 1000), 0);
  f.check();
  f.erase_range(std::next(f.oracle.begin(), 100), f.oracle.size());
  f.check();
  CHECK(f.timeline.size() == 101);
  f.insert_after_latest(5000);
  f.check();
}

TEST_CASE("groups that are no more are used again") {
  Fixture f;
  f.insert_after_latest(20000);
  const std::size_t bytes = f.timeline.bytes();
  for (int round = 0; round < 20; ++round) {
    f.erase_range(std::next(f.oracle.begin(), 3000), 15000);
    while (f.places.size() > 2000) f.erase(f.places.size() - 1);
    f.insert_after_latest(18000);
  }
  f.check();
  CHECK(f.timeline.bytes() <= bytes);
}

TEST_CASE("shrink gives the memory of dropped groups back and keeps order and marks") {
  Fixture f;
  f.insert_at_random(30000);
  f.insert_after_latest(100000);
  const std::size_t bytes = f.timeline.bytes();
  f.erase_range(std::next(f.oracle.begin(), 2000), f.oracle.size());
  CHECK(f.timeline.bytes() == bytes);
  f.timeline.shrink();
  CHECK(f.timeline.bytes() < 100);
  f.check();
  f.insert_at_random(5000);
  f.insert_after_latest(5000);
  f.check();
}

TEST_CASE("an insertion that finds no memory changes nothing and can be done again") {
  Fixture f;
  int failures = 0;
  const auto insert = [&](std::size_t place) {
    const Place node = f.fresh();
    memory_is_out = true;
    try {
      f.timeline.insert_after(*f.places[place], node);
      memory_is_out = false;
      f.places.push_back(f.oracle.insert(std::next(f.places[place]), node));
    } catch (const std::bad_alloc&) {
      memory_is_out = false;
      ++failures;
      f.check();
      f.insert(place, node);
      f.check();
    }
  };
  for (int i = 0; i < 10000; ++i) insert(f.random(f.places.size()));
  const int in_chops = failures;
  for (int i = 0; i < 50000; ++i) insert(f.places.size() - 1);
  for (int i = 0; i < 50000; ++i) insert(5);
  CHECK(in_chops >= 3);
  CHECK(failures - in_chops >= 2);
  memory_is_out = true;
  CHECK_THROWS_AS(f.timeline.shrink(), std::bad_alloc);
  memory_is_out = false;
  f.check();
}

}  // namespace
