// The examples on maps (sac/examples): from scratch and under edits.
//
//   map_examples_bench [SCALE [EXAMPLE]]     default 1 and all; 0.1: with a tenth of the elements
//
// The figures are explained in measure_example.hpp.
#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "../examples/differences.hpp"
#include "../examples/leaders.hpp"
#include "../examples/range_counts.hpp"
#include "../examples/view.hpp"
#include "bench_help.hpp"
#include "measure_example.hpp"
#include "sac/sac.hpp"

namespace {

using namespace examples;
using bench::IntRandom;
using bench::ScopeOf;

// --- View: n orders of n / 10 customers in 1000 regions; an order changes ------------------------

struct View {
  static constexpr const char* kName = "view";
  static constexpr int kRegions = 1000;

  struct Input {
    std::vector<int> regions;
    std::vector<view::Order> orders;
    explicit Input(int n) {
      IntRandom random;
      for (int i = 0; i < n / 10; ++i) regions.push_back(random(kRegions));
      for (int i = 0; i < n; ++i) orders.push_back(random_order(random));
    }
    view::Order random_order(IntRandom& random) const {
      return {random(static_cast<int>(regions.size())), random(1000)};
    }
    std::uint64_t baseline() const {
      std::vector<view::Ranked> sums(kRegions);
      for (int r = 0; r < kRegions; ++r) sums[static_cast<std::size_t>(r)] = {0, r};
      for (const view::Order& o : orders) {
        if (o.amount < view::kLeast) continue;
        const int region = regions[static_cast<std::size_t>(o.customer)];
        sums[static_cast<std::size_t>(region)].first += o.amount;
      }
      std::partial_sort(sums.begin(), sums.begin() + view::kBest, sums.end(), std::greater<>());
      return checksum(std::vector(sums.begin(), sums.begin() + view::kBest));
    }
  };
  static std::uint64_t checksum(const std::vector<view::Ranked>& best) {
    std::uint64_t sum = 0;
    for (const auto& [amount, region] : best) {
      sum = 31 * sum + static_cast<std::uint64_t>(1000 * amount + region);
    }
    return sum;
  }

  template <class Host>
  struct World {
    using S = ScopeOf<Host>;
    Host& host;
    view::Tables<S> tables;
    typename S::template ModType<std::vector<view::Ranked>> best;

    World(Host& h, const Input& input)
        : host(h), tables(h), best(h.template cell<std::vector<view::Ranked>>()) {
      for (std::size_t i = 0; i < input.regions.size(); ++i) {
        tables.regions.set(static_cast<int>(i), input.regions[i]);
      }
      for (std::size_t i = 0; i < input.orders.size(); ++i) {
        tables.orders.set(static_cast<int>(i), input.orders[i]);
      }
    }
    void run() { host.template run<view::best_regions>(best); }
    std::uint64_t result() { return checksum(host.get(best)); }
    void edit(Input& input, IntRandom& random) {
      const int i = random(static_cast<int>(input.orders.size()));
      tables.orders.set(i, input.orders[static_cast<std::size_t>(i)] = input.random_order(random));
    }
  };
};

// --- Range counts: n points, n / 10 rectangles that hold 50 of them each; a point moves ----------

struct RangeCounts {
  static constexpr const char* kName = "range_counts";

  struct Input {
    int width, height;
    std::vector<std::pair<int, int>> points;
    std::vector<range_counts::Rectangle> rectangles;
    explicit Input(int n) : width(8 * range_counts::kWidth), height(n) {
      IntRandom random;
      for (int i = 0; i < n; ++i) points.push_back(random_point(random));
      for (int i = 0; i < n / 10; ++i) {
        const int x = random(width), y = random(height);
        rectangles.push_back({x, x + width / 2, y, y + 100});
      }
    }
    std::pair<int, int> random_point(IntRandom& random) const {
      return {random(width), random(height)};
    }
    // Of the points sorted by y, those in a rectangle's stretch.
    std::uint64_t baseline() const {
      std::vector<std::pair<int, int>> by_y;
      for (const auto& [x, y] : points) by_y.emplace_back(y, x);
      std::sort(by_y.begin(), by_y.end());
      std::uint64_t sum = 0;
      for (const auto& r : rectangles) {
        std::uint64_t count = 0;
        for (auto at = std::lower_bound(by_y.begin(), by_y.end(), std::pair(r.low, 0));
             at != by_y.end() && at->first < r.high; ++at) {
          count += at->second >= r.left && at->second < r.right;
        }
        sum = 31 * sum + count;
      }
      return sum;
    }
  };

  template <class Host>
  struct World {
    Host& host;
    range_counts::Plane<ScopeOf<Host>> plane;

    World(Host& h, const Input& input) : host(h), plane(h) {
      for (std::size_t i = 0; i < input.points.size(); ++i) set(input, static_cast<int>(i));
      for (std::size_t i = 0; i < input.rectangles.size(); ++i) {
        plane.rectangles.set(static_cast<int>(i), input.rectangles[i]);
      }
    }
    void set(const Input& input, int i) {
      const auto [x, y] = input.points[static_cast<std::size_t>(i)];
      plane.points.set(plane.place_of(x, y, i), x);
    }
    void run() { host.template run<range_counts::count_all>(); }
    std::uint64_t result() {
      std::uint64_t sum = 0;
      for (const auto& [key, count] : plane.counts.entries()) {
        sum = 31 * sum + static_cast<std::uint64_t>(count);
      }
      return sum;
    }
    void edit(Input& input, IntRandom& random) {
      const int i = random(static_cast<int>(input.points.size()));
      auto& point = input.points[static_cast<std::size_t>(i)];
      plane.points.erase(plane.place_of(point.first, point.second, i));
      point = input.random_point(random);
      set(input, i);
    }
  };
};

// --- Differences: two versions of n rows, one row in 100 differs; a row changes ------------------

struct Differences {
  static constexpr const char* kName = "differences";

  struct Input {
    std::vector<int> left, right;
    explicit Input(int n) {
      IntRandom random;
      for (int i = 0; i < n; ++i) {
        left.push_back(random(1000));
        right.push_back(random(100) == 0 ? random(1000) : left.back());
      }
    }
    std::uint64_t baseline() const {
      std::uint64_t sum = 0;
      for (std::size_t i = 0; i < left.size(); ++i) {
        if (left[i] != right[i]) sum = 31 * sum + i;
      }
      return sum;
    }
  };

  template <class Host>
  struct World {
    using S = ScopeOf<Host>;
    Host& host;
    differences::Versions<S> versions;
    typename S::template ModType<std::size_t> size;
    typename S::template ModType<std::uint64_t> checksum;

    World(Host& h, const Input& input)
        : host(h),
          versions(h),
          size(h.template cell<std::size_t>()),
          checksum(h.template cell<std::uint64_t>()) {
      for (std::size_t i = 0; i < input.left.size(); ++i) {
        versions.left.set(static_cast<int>(i), input.left[i]);
        versions.right.set(static_cast<int>(i), input.right[i]);
      }
    }
    void run() { host.template run<differences::compare_all>(size, checksum); }
    std::uint64_t result() { return host.get(checksum); }
    void edit(Input& input, IntRandom& random) {
      const int i = random(static_cast<int>(input.left.size()));
      const auto place = static_cast<std::size_t>(i);
      input.right[place] = random(2) == 0 ? input.left[place] : random(1000);
      versions.right.set(i, input.right[place]);
    }
  };
};

// --- Leaders: n players in n / 20 teams; a player changes ----------------------------------------

struct Leaders {
  static constexpr const char* kName = "leaders";

  struct Input {
    int teams;
    std::vector<leaders::Player> players;
    explicit Input(int n) : teams(n / 20) {
      IntRandom random;
      for (int i = 0; i < n; ++i) players.push_back(random_player(random));
    }
    leaders::Player random_player(IntRandom& random) const { return {random(teams), random(1000)}; }
    std::uint64_t baseline() const {
      std::vector<std::pair<int, int>> best(static_cast<std::size_t>(teams), {-1, -1});
      for (std::size_t i = 0; i < players.size(); ++i) {
        auto& leader = best[static_cast<std::size_t>(players[i].team)];
        leader = std::max(leader, {players[i].points, static_cast<int>(i)});
      }
      std::uint64_t sum = 0;
      for (std::size_t t = 0; t < best.size(); ++t) {
        if (best[t].second >= 0) sum = 31 * sum + static_cast<std::uint64_t>(best[t].second);
      }
      return sum;
    }
  };

  template <class Host>
  struct World {
    Host& host;
    leaders::League<ScopeOf<Host>> league;

    World(Host& h, const Input& input) : host(h), league(h) {
      for (std::size_t i = 0; i < input.players.size(); ++i) {
        league.players.set(static_cast<int>(i), input.players[i]);
      }
    }
    void run() { host.template run<leaders::lead_all>(); }
    std::uint64_t result() {
      std::uint64_t sum = 0;
      for (const auto& [team, player] : league.leaders.entries()) {
        sum = 31 * sum + static_cast<std::uint64_t>(player);
      }
      return sum;
    }
    void edit(Input& input, IntRandom& random) {
      const int i = random(static_cast<int>(input.players.size()));
      league.players.set(i,
                         input.players[static_cast<std::size_t>(i)] = input.random_player(random));
    }
  };
};

}  // namespace

int main(int argc, char** argv) {
  if (bench::shows_help(argc, argv)) return 0;
  const bench::Selection selection(argc, argv);
  selection.run<View>(100000, 10000);
  selection.run<RangeCounts>(100000, 10000);
  selection.run<Differences>(100000, 10000);
  selection.run<Leaders>(100000, 10000);
}
