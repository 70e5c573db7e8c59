// The gamma-bucketed queue [Fig 1.5] beside heaps, as the work queue of a refinement.
//
//   bucketed_queue_bench [N]...   default: 10^3, 10^5, 10^6 items at the beginning
//
// Items with keys of 20 octaves; then one after the other goes, and brings up to two more with keys
// of its own size, a quarter to 4 times it, until 4 N have gone. One JSON line a queue, in turns,
// the least of kRounds: nanoseconds an item, in and out. `inversions`: the share of items whose key
// is less than that of the one before and was there with it: 0 for heaps, what a bucketed queue
// gives up.
#include <algorithm>
#include <boost/heap/d_ary_heap.hpp>
#include <boost/heap/pairing_heap.hpp>
#include <cmath>
#include <cstdio>
#include <functional>
#include <queue>
#include <string>
#include <utility>
#include <vector>

#include "bench_help.hpp"
#include "mesher/extra/generate.hpp"
#include "refinement/bucketed_queue.hpp"
#include "sample.hpp"

namespace {

constexpr int kRounds = 5;

struct Item {
  double key = 0;
  std::uint32_t name = 0;
  bool operator>(const Item& other) const { return key > other.key; }
};

// Heaps as the others are called.
template <class Heap>
struct HeapQueue {
  Heap heap{};
  [[nodiscard]] bool empty() const { return heap.empty(); }
  void insert(double key, const Item& item) { heap.push({key, item.name}); }
  Item delete_min() {
    const Item item = heap.top();
    heap.pop();
    return item;
  }
};

using StandardQueue = std::priority_queue<Item, std::vector<Item>, std::greater<Item>>;
using BoostDary =
    boost::heap::d_ary_heap<Item, boost::heap::arity<4>, boost::heap::compare<std::greater<Item>>>;
using BoostPairing = boost::heap::pairing_heap<Item, boost::heap::compare<std::greater<Item>>>;

// What a run asks for, made before: an item's number of successors, and keys over its own.
struct Steps {
  explicit Steps(std::size_t n) : successors(4 * n) {
    mesher::SplitMix64 random(1);
    for (std::size_t i = 0; i < n; ++i) start.push_back(std::exp2(20 * random.unit()));
    for (auto& count : successors) count = static_cast<std::uint8_t>(random.below(3));
    for (int i = 0; i < 1024; ++i) factors.push_back(std::exp2(4 * random.unit() - 2));
  }
  std::vector<double> start;
  std::vector<std::uint8_t> successors;
  std::vector<double> factors;
};

struct Outcome {
  std::size_t gone = 0, inversions = 0;
};

template <class Queue>
Outcome run(const Steps& steps) {
  Queue queue;
  std::uint32_t name = 0;
  for (const double key : steps.start) queue.insert(key, {key, name++});
  Outcome outcome;
  double before = 0;
  std::uint32_t named_before = 0;
  for (; outcome.gone < steps.successors.size() && !queue.empty(); ++outcome.gone) {
    const Item item = queue.delete_min();
    outcome.inversions += item.key < before && item.name < named_before ? 1 : 0;
    before = item.key;
    named_before = name;
    for (int more = steps.successors[outcome.gone]; more > 0; --more) {
      const double key = item.key * steps.factors[name % steps.factors.size()];
      queue.insert(key, {key, name++});
    }
  }
  return outcome;
}

struct Contestant {
  const char* name;
  Outcome (*run)(const Steps&);
};
constexpr Contestant kContestants[] = {
    {"computed buckets, gamma 2", run<mesher::detail::ComputedBuckets<Item>>},
    {"computed buckets, gamma 1.25", run<mesher::detail::ComputedBuckets<Item, 2>>},
    {"walked buckets, gamma 2", run<mesher::detail::WalkedBuckets<Item>>},
    {"std::priority_queue", run<HeapQueue<StandardQueue>>},
    {"boost::heap::d_ary_heap<4>", run<HeapQueue<BoostDary>>},
    {"boost::heap::pairing_heap", run<HeapQueue<BoostPairing>>},
};

void run_all(std::size_t n) {
  const Steps steps(n);
  constexpr std::size_t kCount = std::size(kContestants);
  std::vector<double> least(kCount, HUGE_VAL);
  std::vector<Outcome> outcomes(kCount);
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t i = 0; i < kCount; ++i) {
      const double seconds = bench::seconds_of([&] { outcomes[i] = kContestants[i].run(steps); });
      least[i] = std::min(least[i], seconds);
    }
  }
  for (std::size_t i = 0; i < kCount; ++i) {
    const auto gone = static_cast<double>(outcomes[i].gone);
    std::printf(
        "{\"bench\":\"bucketed_queue\",\"input\":\"%zu items\",\"queue\":\"%s\","
        "\"ns_an_item\":%.1f,\"inversions\":%.3f}\n",
        n, kContestants[i].name, 1e9 * least[i] / gone,
        static_cast<double>(outcomes[i].inversions) / gone);
  }
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  if (bench::shows_help(argc, argv)) return 0;
  std::vector<std::size_t> sizes;
  for (int i = 1; i < argc; ++i) sizes.push_back(std::stoul(argv[i]));
  if (sizes.empty()) sizes = {1000, 100000, 1000000};
  for (const std::size_t n : sizes) run_all(n);
}
