// The order-maintenance list alone.
//
//   timeline_bench [N]       default 1000000
//
// One JSON line per figure, medians of 5 rounds, nanoseconds per insertion, comparison or node
// erased. The nodes are there before the clock starts, side by side in the order in which they are
// inserted, and so are the random numbers: the list alone is measured. "Random" is uniform.
//
//   append              N nodes, each at the end
//   hotspot             N nodes, each right after the first node of the list
//   hotspot_middle      the same after the middle one of N appended nodes
//   run_middle          N nodes, each after the last one, from the middle of N appended nodes on
//   burst               N nodes into N appended ones, in runs of 100 at random places
//   burst_hotspot       the same with each of the 100 right after the place
//   random              N nodes into N appended ones, each after a random one of all there are
//   random_from_empty   N nodes, each after a random one of all there are, from an empty list on
//   compare_local       N appended nodes in order, each with the 7th after it
//   compare_random      random pairs of N appended nodes
//   compare_random_2n   random pairs of the 2 N nodes of `random`
//   erase_random        all of the 2 N nodes of `random`, in random order
//   bytes_...           bytes per node, its share of the groups' memory included
//
// Where the time goes. While all it touches is in the first-level cache an insertion is some 40
// instructions, 4 ns: append, hotspot. The rest is cache misses, on the place and, once that is
// there, on its successor: `random` takes 18 ns at N = 10^6 and 6 ns at 10^5, where the nodes fit
// into the second-level cache. At 10^6, `random_from_empty` has just chopped its first groups, of
// 27000 nodes each: walking these takes about half of its time. At 3 x 10^6 that is past.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "bench_help.hpp"
#include "sac/arena.hpp"
#include "sac/internal/timeline.hpp"
#include "sac/label.hpp"

namespace {

using sac::Place;
using sac::TimeNode;
using Clock = std::chrono::steady_clock;

constexpr std::size_t kBurst = 100;

volatile std::uint64_t sink;

struct Random {
  std::uint64_t state = 1;
  std::uint64_t next() { return sac::mix(state += 0x9e3779b97f4a7c15u); }
};

/// All figures of all rounds, printed in the order of their first appearance.
class Report {
 public:
  explicit Report(std::size_t n) : n_(n) {}

  void add(const std::string& figure, double value) {
    if (!values_.contains(figure)) order_.push_back(figure);
    values_[figure].push_back(value);
  }
  template <class Body>
  void time(const std::string& figure, std::size_t count, const Body& body) {
    const auto start = Clock::now();
    body();
    const double ns = std::chrono::duration<double, std::nano>(Clock::now() - start).count();
    add(figure, ns / static_cast<double>(count));
  }
  void print() {
    for (const auto& figure : order_) {
      auto& x = values_[figure];
      std::sort(x.begin(), x.end());
      std::printf("{\"bench\":\"timeline\",\"figure\":\"%s\",\"n\":%zu,\"%s\":%.2f}\n",
                  figure.c_str(), n_, figure.starts_with("bytes") ? "bytes" : "ns",
                  x[x.size() / 2]);
    }
  }

 private:
  std::size_t n_;
  std::vector<std::string> order_;
  std::map<std::string, std::vector<double>> values_;
};

/// A list, and memory for its nodes. The first of them is in the list already.
struct List {
  explicit List(std::size_t capacity) : block(arena.allocate((capacity + 1) * sizeof(TimeNode))) {
    std::fill_n(&arena[block], capacity + 1, TimeNode{});
    timeline.insert_after(timeline.front(), block);
  }

  /// The i-th node in order of insertion.
  [[nodiscard]] Place node(std::size_t i) const {
    return Place(block.handle() +
                 static_cast<sac::Handle>(i * sizeof(TimeNode) / sac::Arena::kGranule));
  }
  Place insert_after(Place place) {
    const Place h = node(++last);
    timeline.insert_after(place, h);
    return h;
  }
  void append(std::size_t n) {
    for (std::size_t i = 0; i < n; ++i) insert_after(timeline.back());
  }
  [[nodiscard]] std::uint64_t less(Place a, Place b) const {
    return timeline.precedes(arena[a], arena[b]) ? 1 : 0;
  }
  [[nodiscard]] double bytes_per_node() const {
    return static_cast<double>(timeline.bytes()) / static_cast<double>(timeline.size()) +
           sizeof(TimeNode);
  }

  sac::Arena arena;
  sac::Timeline timeline{arena};
  Place block;
  std::size_t last = 0;
};

/// How many of the pairs (picks[2 i], picks[2 i + 1]) are in order.
std::uint64_t compare(const List& list, const std::vector<std::uint32_t>& picks) {
  std::uint64_t count = 0;
  for (std::size_t i = 0; i + 1 < picks.size(); i += 2) {
    count += list.less(list.node(picks[i]), list.node(picks[i + 1]));
  }
  return count;
}

void bench_one_place(Report& report, std::size_t n) {
  List b(n);
  report.time("append", n, [&] { b.append(n); });
  report.add("bytes_append", b.bytes_per_node());
  List c(n);
  report.time("hotspot", n, [&] {
    for (std::size_t i = 0; i < n; ++i) c.insert_after(c.node(0));
  });
  report.add("bytes_hotspot", c.bytes_per_node());
  List d(2 * n);
  d.append(n);
  report.time("hotspot_middle", n, [&] {
    for (std::size_t i = 0; i < n; ++i) d.insert_after(d.node(n / 2));
  });
  report.add("bytes_hotspot_middle", d.bytes_per_node());
  List e(2 * n);
  e.append(n);
  Place at = e.node(n / 2);
  report.time("run_middle", n, [&] {
    for (std::size_t i = 0; i < n; ++i) at = e.insert_after(at);
  });
  report.add("bytes_run_middle", e.bytes_per_node());
}

void bench_bursts(Report& report, std::size_t n) {
  Random r;
  std::vector<std::uint32_t> places(n / kBurst);
  for (auto& p : places) p = static_cast<std::uint32_t>(r.next() % n);
  List a(2 * n);
  a.append(n);
  report.time("burst", n, [&] {
    for (const auto p : places) {
      Place at = a.node(p);
      for (std::size_t i = 0; i < kBurst; ++i) at = a.insert_after(at);
    }
  });
  report.add("bytes_burst", a.bytes_per_node());
  List b(2 * n);
  b.append(n);
  report.time("burst_hotspot", n, [&] {
    for (const auto p : places) {
      for (std::size_t i = 0; i < kBurst; ++i) b.insert_after(b.node(p));
    }
  });
  report.add("bytes_burst_hotspot", b.bytes_per_node());
}

void bench_random(Report& report, std::size_t n) {
  Random r;
  std::vector<std::uint32_t> picks(2 * n);
  const auto pick_among = [&](std::size_t first) {
    for (std::size_t i = 0; i < n; ++i) {
      picks[i] = static_cast<std::uint32_t>(r.next() % (first + i));
    }
  };
  pick_among(1);
  List a(n);
  report.time("random_from_empty", n, [&] {
    for (std::size_t i = 0; i < n; ++i) a.insert_after(a.node(picks[i]));
  });
  report.add("bytes_random_from_empty", a.bytes_per_node());
  List b(2 * n);
  b.append(n);
  pick_among(n + 1);
  report.time("random", n, [&] {
    for (std::size_t i = 0; i < n; ++i) b.insert_after(b.node(picks[i]));
  });
  report.add("bytes_random", b.bytes_per_node());
  for (auto& p : picks) p = static_cast<std::uint32_t>(r.next() % (2 * n + 1));
  report.time("compare_random_2n", n, [&] { sink = compare(b, picks); });
  for (std::uint32_t i = 0; i < 2 * n; ++i) {
    const std::size_t j = r.next() % (i + 1);
    picks[i] = std::exchange(picks[j], i + 1);
  }
  report.time("erase_random", 2 * n, [&] {
    for (const auto p : picks) b.timeline.erase(b.node(p));
  });
}

void bench_compare_and_erase(Report& report, std::size_t n) {
  Random r;
  std::vector<std::uint32_t> picks(2 * n);
  for (auto& p : picks) p = static_cast<std::uint32_t>(r.next() % n);
  List a(n);
  a.append(n);
  report.time("compare_local", n, [&] {
    std::uint64_t count = 0;
    for (std::uint32_t i = 0; i + 7 < n; ++i) count += a.less(a.node(i), a.node(i + 7));
    sink = count;
  });
  report.time("compare_random", n, [&] { sink = compare(a, picks); });
}

}  // namespace

int main(int argc, char** argv) {
  if (bench::shows_help(argc, argv)) return 0;
  const std::size_t n = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1000000;
  Report report(n);
  for (int round = 0; round < 5; ++round) {
    bench_one_place(report, n);
    bench_bursts(report, n);
    bench_random(report, n);
    bench_compare_and_erase(report, n);
  }
  report.print();
}
