// Searches against all items, after every edit.
#include "records/reach_tree.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "failing_new.hpp"
#include "mesher/extra/generate.hpp"

namespace {

using mesher::Box;
using mesher::Point;
using mesher::SplitMix64;
using mesher::detail::FromSegment;
using mesher::detail::MeshBox;
using mesher::detail::ReachTree;

const MeshBox<2> kBox{.lo = {-1.5, -1.5}, .side = 4};
const MeshBox<3> kCube{.lo = {-1.5, -1.5, -1.5}, .side = 4};
template <int D>
const MeshBox<D>& box_of() {
  if constexpr (D == 2) {
    return kBox;
  } else {
    return kCube;
  }
}

template <int D>
struct DiscOf {
  Point<D> place{};
  double reach = 0;
  int name = 0;
};

using Disc = DiscOf<2>;

// Places on a lattice, anywhere, and near others down to the finest cells; reaches of all sizes.
template <int D>
class SourceOf {
 public:
  explicit SourceOf(std::uint64_t seed) : random_(seed) {}
  SplitMix64& random() { return random_; }
  Point<D> point(const std::vector<DiscOf<D>>& all) {
    const auto kind = random_.below(5);
    Point<D> p;
    for (double& x : p) x = kind == 1 ? lattice() : random_.unit();
    if (kind < 2 || all.empty()) return p;
    p = all[random_.below(all.size())].place;
    if (kind == 2) return p;
    for (double& x : p) {
      x = std::clamp(x + (random_.unit() - 0.5) * power(54), 0.0, 1.0);
    }
    return p;
  }
  double reach() {
    const auto kind = random_.below(4);
    return kind == 0 ? 0 : random_.unit() * power(30);
  }

 private:
  double power(std::uint64_t most) {
    return std::ldexp(1.0, -static_cast<int>(random_.below(most)));
  }
  double lattice() { return static_cast<double>(random_.below(9)) / 8; }
  SplitMix64 random_;
};
using Source = SourceOf<2>;

template <class Search>
std::vector<int> found(Search&& search) {
  std::vector<int> names;
  search([&](int name) { names.push_back(name); });
  std::sort(names.begin(), names.end());
  return names;
}

// All that must be found is, once, and what is found besides is as good as at the border.
template <class Disc, class Gap>
void require_found(const std::vector<Disc>& all, const std::vector<int>& names, Gap&& gap) {
  REQUIRE(std::adjacent_find(names.begin(), names.end()) == names.end());
  for (const Disc& d : all) {
    const bool is_found = std::binary_search(names.begin(), names.end(), d.name);
    const bool wrong = is_found ? gap(d) > 1e-6 * d.reach + 1e-12 : gap(d) <= 0;
    if (wrong) FAIL("disc " << d.name << ": gap " << gap(d));
  }
}

template <int D>
void require_searches_right(const ReachTree<int, D>& tree, const std::vector<DiscOf<D>>& all,
                            SourceOf<D>& source) {
  const Point<D> p = source.point(all);
  const Point<D> q = source.random().below(2) == 0 ? p : source.point(all);
  const double slack = source.random().below(2) == 0 ? 0 : source.reach();
  const FromSegment<D> segment(p, q);
  require_found(all, found([&](auto visit) { tree.visit_near(p, q, slack, visit); }),
                [&](const auto& d) { return segment.distance(d.place) - d.reach - slack; });
  require_found(all, found([&](auto visit) { tree.visit_at(p, visit); }), [&](const auto& d) {
    double sum = 0;
    for (int i = 0; i < D; ++i) sum += (d.place[i] - p[i]) * (d.place[i] - p[i]);
    return std::sqrt(sum) - d.reach;
  });
  Box<D> box;
  for (int i = 0; i < D; ++i) {
    box.lo[i] = std::min(p[i], q[i]);
    box.hi[i] = std::max(p[i], q[i]);
  }
  const auto beside = [&](const Point<D>& x, double reach) {
    double most = -1;
    for (int i = 0; i < D; ++i) {
      most = std::max({most, box.lo[i] - x[i] - reach, x[i] - reach - box.hi[i]});
    }
    return most;
  };
  require_found(all, found([&](auto visit) { tree.visit_in(box, visit); }),
                [&](const auto& d) { return beside(d.place, 0); });
  require_found(all, found([&](auto visit) { tree.visit_beside(box, visit); }),
                [&](const auto& d) { return beside(d.place, d.reach); });
}

}  // namespace

TEMPLATE_TEST_CASE_SIG(
    "searches visit every disc that meets them, once, and others only for rounding", "",
    ((int D), D), 2, 3) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    INFO("seed " << seed);
    SourceOf<D> source(seed);
    ReachTree<int, D> tree(box_of<D>());
    std::vector<DiscOf<D>> all;
    const std::size_t most = 1 + source.random().below(120);
    for (int edit = 0; edit < 300; ++edit) {
      INFO("edit " << edit);
      if (all.empty() || (all.size() < most && source.random().below(5) < 3)) {
        all.push_back({source.point(all), source.reach(), edit});
        tree.insert(all.back().place, all.back().reach, edit);
      } else {
        std::swap(all[source.random().below(all.size())], all.back());
        tree.erase(all.back().place, all.back().name);
        all.pop_back();
      }
      tree.check_invariants();
      REQUIRE(tree.size() == all.size());
      require_searches_right(tree, all, source);
    }
  }
}

TEST_CASE("an item that is there twice is taken from the place that is named") {
  ReachTree<int> tree(kBox);
  tree.insert({0.5, 0.5}, 0.25, 1);
  tree.insert({0.500001, 0.5}, 0.125, 1);
  tree.erase({0.5, 0.5}, 1);
  tree.check_invariants();
  CHECK_FALSE(tree.visit_at({0.25, 0.5}, [](int) { return true; }));
  tree.erase({0.500001, 0.5}, 1);
  CHECK(tree.size() == 0);
}

TEST_CASE("a search ends with the first item that its visitor accepts") {
  ReachTree<int> tree(kBox);
  for (int i = 0; i < 50; ++i) tree.insert({0.01 * i, 0.5}, 1, i);
  int visited = 0;
  CHECK(tree.visit_at({0.2, 0.5}, [&](int) { return ++visited == 3; }));
  CHECK(visited == 3);
  CHECK_FALSE(tree.visit_at({0.2, 0.5}, [](int) { return false; }));
  CHECK_FALSE(tree.visit_at({0.2, 0.5}, [](int) {}));
}

TEST_CASE("a search among small discs visits few blocks, though some discs are large") {
  Source source(7);
  ReachTree<int> tree(kBox);
  for (int i = 0; i < 20000; ++i)
    tree.insert({source.random().unit(), source.random().unit()}, 1e-3, i);
  for (int i = 0; i < 10; ++i)
    tree.insert({source.random().unit(), source.random().unit()}, 0.5, -1 - i);
  std::size_t visited = 0;
  for (int i = 0; i < 1000; ++i) {
    tree.visit_at({source.random().unit(), source.random().unit()}, [&](int) { ++visited; });
  }
  CHECK(visited < 10 * 1000);
}

TEST_CASE("memory is linear in the items, however close together they lie") {
  ReachTree<int> tree(kBox);
  for (int i = 0; i < 1000; ++i) {
    const double x = std::ldexp(1.0, -(i % 50));
    tree.insert({x, 0.5 * x}, 0, i);
    tree.insert({x, 0.5 * x + 0x1p-49}, 0, 1000 + i);
  }
  CHECK(tree.bytes() < 2000 * 200);
  tree.check_invariants();
}

TEST_CASE("an insertion that finds no memory changes nothing") {
  Source source(3);
  ReachTree<int> tree(kBox);
  std::vector<Disc> all;
  for (int i = 0; i < 200; ++i) {
    const Disc d{source.point(all), source.reach(), i};
    support::memory_is_out = true;
    bool failed = false;
    try {
      tree.insert(d.place, d.reach, d.name);
    } catch (const std::bad_alloc&) {
      failed = true;
    }
    support::memory_is_out = false;
    tree.check_invariants();
    REQUIRE(tree.size() == all.size() + (failed ? 0u : 1u));
    if (failed) tree.insert(d.place, d.reach, d.name);
    all.push_back(d);
    require_searches_right(tree, all, source);
  }
}
