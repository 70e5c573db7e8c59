// The queues of [Fig 1.5], against a sorted reference.
#include "refinement/bucketed_queue.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "failing_new.hpp"
#include "mesher/extra/generate.hpp"

namespace {

using mesher::SplitMix64;
using mesher::detail::ComputedBuckets;
using mesher::detail::WalkedBuckets;

constexpr double kLeast = std::numeric_limits<double>::min();
constexpr double kMost = std::numeric_limits<double>::max();

struct Item {
  double key = 0;
  int name = 0;
  auto operator<=>(const Item&) const = default;
};

// A queue beside all that is in it.
template <class Queue>
class Checked {
 public:
  Checked(Queue queue, double gamma) : queue_(std::move(queue)), gamma_(gamma) {}

  void insert(double key) {
    queue_.insert(key, {key, named_});
    in_it_.insert({key, named_++});
    CHECK(queue_.size() == in_it_.size());
  }
  // Returns: its key.
  double delete_min() {
    const double least = in_it_.begin()->key;
    const Item item = queue_.delete_min();
    REQUIRE(in_it_.erase(item) == 1);
    // Bounds are products that were rounded.
    CHECK(item.key / gamma_ <= least * (1 + 0x1p-50));
    CHECK(queue_.size() == in_it_.size());
    return item.key;
  }
  void drain() {
    while (!in_it_.empty()) delete_min();
    CHECK(queue_.empty());
  }
  [[nodiscard]] bool empty() const { return in_it_.empty(); }

 private:
  Queue queue_;
  double gamma_;
  std::set<Item> in_it_;
  int named_ = 0;
};

// Calls run(checked queue) for each kind of queue.
template <class Run>
void for_each_queue(Run&& run) {
  const auto run_with = [&](auto queue, double gamma) {
    INFO("gamma " << gamma);
    Checked checked(std::move(queue), gamma);
    run(checked);
    checked.drain();
  };
  INFO("computed");
  run_with(ComputedBuckets<Item>(), 2);
  run_with(ComputedBuckets<Item, 1>(), 1.5);
  run_with(ComputedBuckets<Item, 6>(), 1 + 1.0 / 64);
  INFO("walked");
  for (const double gamma : {1.1, 1.5, 2.0, 3.7, 1000.0})
    run_with(WalkedBuckets<Item>(gamma), gamma);
}

}  // namespace

TEST_CASE("what comes out is less than gamma times the smallest key, whatever went in") {
  for (const std::uint64_t seed : {1, 2, 3}) {
    INFO("seed " << seed);
    for_each_queue([&](auto& queue) {
      SplitMix64 random(seed);
      for (int round = 0; round < 1500; ++round) {
        if (!queue.empty() && random.below(2) == 0) {
          queue.delete_min();
        } else {
          queue.insert(std::exp2(60 * random.unit() - 30));
        }
      }
    });
  }
}

TEST_CASE("so it is for items near the one that came out last, as in a refinement") {
  for_each_queue([&](auto& queue) {
    SplitMix64 random(7);
    for (int i = 0; i < 200; ++i) queue.insert(std::exp2(8 * random.unit()));
    for (int round = 0; round < 1500 && !queue.empty(); ++round) {
      const double key = queue.delete_min();
      for (auto more = random.below(3); more > 0; --more) {
        queue.insert(key * std::exp2(4 * random.unit() - 2));
      }
    }
  });
}

TEST_CASE("so it is where only far larger keys are left and a small one comes, and the reverse") {
  for_each_queue([&](auto& queue) {
    for (const double far : {0x1p100, 0x1p-100}) {
      for (const double first : {1.0, 1.9, 3.0}) {
        queue.insert(first);
        queue.insert(far);
        queue.delete_min();
        for (const double next : {first, first / 2.5, first * 2.5, far, first * 1.0001}) {
          queue.insert(next);
        }
        queue.delete_min();
        queue.insert(far * 0.999);
        queue.drain();
        queue.insert(first);  // begins again where it likes
      }
    }
  });
}

TEST_CASE("so it is for the extreme sizes, between which there are all others") {
  for_each_queue([&](auto& queue) {
    for (const double key : {kMost, kLeast, 1.0, std::nextafter(kLeast, 1),
                             std::nextafter(kMost, 1), kLeast * 1.5, kMost / 1.5, kMost, kLeast}) {
      queue.insert(key);
    }
    queue.delete_min();
    queue.delete_min();
    queue.insert(kLeast);
    queue.insert(kMost);
  });
}

TEST_CASE("so it is at the bounds of buckets, a last bit to each side") {
  for_each_queue([&](auto& queue) {
    for (const double gamma : {1.1, 1.5, 2.0, 3.7}) {
      double bound = 1;
      for (int i = 0; i < 20; ++i, bound *= gamma) {
        for (const double key : {std::nextafter(bound, 0), bound, std::nextafter(bound, kMost)}) {
          queue.insert(key);
          queue.insert(1 / key);
        }
      }
      for (int i = 0; i < 30; ++i) queue.delete_min();
    }
  });
}

TEST_CASE("of one bucket the last that went in comes out first") {
  const auto check = [](auto queue) {
    for (int i = 0; i < 5; ++i) queue.insert(1 + i / 8.0, {1 + i / 8.0, i});
    for (int i = 5; i-- > 0;) CHECK(queue.delete_min().name == i);
  };
  check(ComputedBuckets<Item>());
  check(WalkedBuckets<Item>());
}

TEST_CASE("what is no key, and an empty queue, are refused, and nothing changes") {
  const auto check = [](auto queue) {
    CHECK_THROWS_AS(static_cast<void>(queue.delete_min()), sac::UsageError);
    for (const double key : {0.0, -1.0, kLeast / 2, std::numeric_limits<double>::infinity(),
                             std::numeric_limits<double>::quiet_NaN()}) {
      CHECK_THROWS_AS(queue.insert(key, {}), sac::UsageError);
    }
    CHECK(queue.empty());
    queue.insert(2, {2, 7});
    CHECK(queue.delete_min().name == 7);
    CHECK_THROWS_AS(static_cast<void>(queue.delete_min()), sac::UsageError);
  };
  check(ComputedBuckets<Item>());
  check(WalkedBuckets<Item>());
  for (const double gamma : {1.0, 0.5, 0x1p21, std::numeric_limits<double>::quiet_NaN()}) {
    CHECK_THROWS_AS(WalkedBuckets<Item>(gamma), sac::UsageError);
  }
}

TEST_CASE("an insertion without memory changes nothing") {
  const auto check = [](const auto& fresh) {
    const auto fill = [&](auto& queue, bool failing) {
      std::vector<int> names;
      for (int i = 0; i < 300; ++i) {
        const double key = std::exp2((i * 37) % 100);
        bool burnt = failing;
        for (std::uint64_t count = 1; burnt; ++count) {
          bool done = false;
          const std::size_t size = queue.size();
          const bool failed = support::fails(count, burnt, [&] {
            queue.insert(key, {key, i});
            done = true;
          });
          CHECK(failed != done);
          CHECK(queue.size() == size + (done ? 1 : 0));
          if (done) break;
        }
        if (!failing) queue.insert(key, {key, i});
        if (i % 3 == 0) names.push_back(queue.delete_min().name);
      }
      while (!queue.empty()) names.push_back(queue.delete_min().name);
      return names;
    };
    auto one = fresh, other = fresh;
    CHECK(fill(one, true) == fill(other, false));
  };
  check(ComputedBuckets<Item>());
  check(WalkedBuckets<Item>(1.5));
}
