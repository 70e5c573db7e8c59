// The order-maintenance list against std::list.
#include "sac/timeline.hpp"

#include <catch2/catch.hpp>
#include <list>
#include <vector>

#include "sac/check.hpp"
#include "sac/label.hpp"

namespace {

using sac::Handle;
using sac::TimeNode;

struct Fixture {
  sac::Arena arena;
  sac::Timeline timeline{arena};
  std::list<Handle> oracle{timeline.front()};
  std::vector<std::list<Handle>::iterator> places{oracle.begin()};
  std::uint64_t state = 7;

  std::size_t random(std::size_t n) {
    state = sac::mix(state + 0x9e3779b97f4a7c15u);
    return state % n;
  }
  TimeNode& at(Handle h) { return *arena.at<TimeNode>(h); }
  void insert(std::size_t i) {
    const Handle node = arena.allocate(sizeof(TimeNode));
    ::new (arena.at<void>(node)) TimeNode;
    if (node % 3 == 0) at(node).mark();
    timeline.insert_after(*places[i], node);
    places.push_back(oracle.insert(std::next(places[i]), node));
  }
  void erase(std::size_t i) {
    const Handle node = *places[i];
    timeline.erase(node);
    arena.release(node, sizeof(TimeNode));
    oracle.erase(places[i]);
    places[i] = places.back();
    places.pop_back();
  }
  void check() {
    timeline.check_invariants();
    REQUIRE(timeline.size() == oracle.size());
    Handle node = timeline.front();
    const TimeNode* previous = nullptr;
    for (const Handle expected : oracle) {
      REQUIRE(node == expected);
      REQUIRE((previous == nullptr || timeline.precedes(*previous, at(node))));
      REQUIRE((previous == nullptr || !timeline.precedes(at(node), *previous)));
      REQUIRE((node == timeline.front() || at(node).marked() == (node % 3 == 0)));
      previous = &at(node);
      node = at(node).next;
    }
    REQUIRE(node == 0);
    REQUIRE(timeline.back() == oracle.back());
  }
};

TEST_CASE("appending keeps the order") {
  Fixture f;
  for (int i = 0; i < 20000; ++i) f.insert(f.places.size() - 1);
  f.check();
}

TEST_CASE("inserting at one place over and over keeps the order through all relabellings") {
  Fixture f;
  for (int i = 0; i < 10; ++i) f.insert(f.places.size() - 1);
  for (int i = 0; i < 50000; ++i) {
    f.insert(5);
    if (i % 10000 == 0) f.check();
  }
  f.check();
}

TEST_CASE("inserting right before one node over and over keeps the order") {
  Fixture f;
  f.insert(0);
  for (int i = 0; i < 50000; ++i) f.insert(i == 0 ? 0 : f.places.size() - 1);
  f.check();
}

TEST_CASE("random insertions, bursts at one place and erasures keep the order of std::list") {
  Fixture f;
  for (int step = 0; step < 60; ++step) {
    const std::size_t hotspot = f.random(f.places.size());
    switch (f.random(4)) {
      case 0:
        for (int i = 0; i < 300; ++i) f.insert(hotspot);
        break;
      case 1:
        for (int i = 0; i < 300; ++i) f.insert(f.random(f.places.size()));
        break;
      case 2:
        for (int i = 0; i < 300; ++i) f.insert(f.places.size() - 1);
        break;
      default:
        for (int i = 0; i < 400 && f.places.size() > 1; ++i)
          f.erase(1 + f.random(f.places.size() - 1));
    }
    f.check();
    for (int i = 0; i < 100; ++i) {
      const auto a = f.random(f.places.size()), b = f.random(f.places.size());
      const auto rank = [&](std::size_t k) { return std::distance(f.oracle.begin(), f.places[k]); };
      REQUIRE(f.timeline.precedes(f.at(*f.places[a]), f.at(*f.places[b])) == (rank(a) < rank(b)));
    }
  }
}

TEST_CASE("erase_between takes out what lies strictly between, or all that follows") {
  Fixture f;
  for (int i = 0; i < 3000; ++i) f.insert(f.random(f.places.size()));
  auto from = std::next(f.oracle.begin(), 100);
  auto to = std::next(f.oracle.begin(), 2000);
  f.timeline.erase_between(*from, *to);
  f.oracle.erase(std::next(from), to);
  f.check();
  f.timeline.erase_between(*from, 0);
  f.oracle.erase(std::next(from), f.oracle.end());
  f.check();
}

}  // namespace
