// Crowded levels against their definition, for all points after every edit.
#include "index/feature_tree.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>
#include <vector>

#include "mesher/extra/generate.hpp"

namespace {

using mesher::Point;
using mesher::SplitMix64;
using mesher::detail::FeatureTree;
using mesher::detail::kLevels;
using mesher::detail::MeshBox;
using mesher::detail::Vertex;
using mesher::detail::VertexPool;

const MeshBox<2> kBox{.lo = {-1.5, -1.5}, .side = 4};

// The cells of a level around v hold u.
bool crowds(const Vertex<2>& v, const Vertex<2>& u, int level) {
  const auto f = kBox.fixed(v.p), g = kBox.fixed(u.p);
  const auto apart = [&](std::size_t i) {
    const int shift = kLevels - level;
    return std::abs(static_cast<long long>(f[i] >> shift) - static_cast<long long>(g[i] >> shift));
  };
  return apart(0) <= 1 && apart(1) <= 1;
}

// The deepest level at which another point lies in the block of 3 x 3 cells around v, as far as
// levels go; -1 if there is none.
int crowded_by_definition(const Vertex<2>& v, const std::vector<Vertex<2>*>& all) {
  for (int level = kLevels; level >= 0; --level) {
    for (const auto* u : all) {
      if (u != &v && crowds(v, *u, level)) return std::min(level, kLevels - 1);
    }
  }
  return -1;
}

class Source {
 public:
  explicit Source(std::uint64_t seed) : random_(seed) {}
  SplitMix64& random() { return random_; }
  Point<2> point(const std::vector<Vertex<2>*>& all) {
    const auto kind = random_.below(4);
    if (kind == 0 || all.empty()) return {random_.unit(), random_.unit()};
    if (kind == 1) return {lattice(), lattice()};
    Point<2> p = all[random_.below(all.size())]->p;  // near another, down to neighbouring cells
    for (double& x : p) {
      const int exponent = -static_cast<int>(random_.below(54));
      x = std::clamp(x + (random_.unit() - 0.5) * std::ldexp(1.0, exponent), 0.0, 1.0);
      if (kind == 3) x = std::clamp(std::round(x * 0x1p48) * 0x1p-48, 0.0, 1.0);
    }
    return p;
  }

 private:
  double lattice() { return static_cast<double>(random_.below(9)) / 8; }
  SplitMix64 random_;
};

}  // namespace

TEST_CASE("the tree's crowded levels are those of the definition, and every change is said") {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    INFO("seed " << seed);
    Source source(seed);
    VertexPool<2> pool;
    FeatureTree<2> tree(kBox, pool);
    std::vector<Vertex<2>*> all;
    const std::size_t most = 2 + source.random().below(60);
    for (int edit = 0; edit < 200; ++edit) {
      std::vector<int> before;
      std::set<const Vertex<2>*> said;
      const auto changed = [&](Vertex<2>& v) { said.insert(&v); };
      const bool insertion = all.empty() || (all.size() < most && source.random().below(5) < 3);
      Vertex<2>* fresh = nullptr;
      std::vector<Vertex<2>*> others = all;
      if (insertion) {
        const Point<2> p = source.point(all);
        const auto f = kBox.fixed(p);
        const auto* obstacle = tree.obstacle(p);
        const auto same = std::find_if(all.begin(), all.end(),
                                       [&](const Vertex<2>* u) { return kBox.fixed(u->p) == f; });
        REQUIRE(obstacle == (same == all.end() ? nullptr : *same));
        if (obstacle != nullptr) continue;
        fresh = &pool.create(p);
        for (const auto* u : others) before.push_back(u->level);
        tree.insert(*fresh, changed);
        all.push_back(fresh);
      } else {
        const auto i = source.random().below(all.size());
        Vertex<2>& gone = *all[i];
        all.erase(all.begin() + static_cast<std::ptrdiff_t>(i));
        others = all;
        for (const auto* u : others) before.push_back(u->level);
        tree.erase(gone, changed);
        pool.release(gone);
      }
      REQUIRE(tree.size() == all.size());
      for (const auto* u : all) {
        REQUIRE(u->level == crowded_by_definition(*u, all));
        REQUIRE(u->level == tree.crowded_level(*u));
        const Vertex<2>* other = tree.crowder(u->p);
        REQUIRE((other == nullptr) == (u->level < 0));
        REQUIRE((other == nullptr || (other != u && crowds(*u, *other, u->level))));
      }
      for (std::size_t i = 0; i < others.size(); ++i) {
        REQUIRE(said.contains(others[i]) == (others[i]->level != before[i]));
      }
      REQUIRE_FALSE(said.contains(fresh));
    }
  }
}

TEST_CASE(
    "a tree from which all points went is the empty tree, and keeps no memory for old shapes") {
  Source source(77);
  VertexPool<2> pool;
  FeatureTree<2> tree(kBox, pool);
  std::size_t bytes = 0;
  for (int round = 0; round < 20; ++round) {
    std::vector<Vertex<2>*> all;
    for (int i = 0; i < 100; ++i) {
      const Point<2> p{std::ldexp(1.0, -i % 40), std::ldexp(i, -12)};
      if (tree.obstacle(p) != nullptr) continue;
      all.push_back(&pool.create(p));
      tree.insert(*all.back(), [](Vertex<2>&) {});
    }
    for (auto* v : all) {
      tree.erase(*v, [](Vertex<2>&) {});
      pool.release(*v);
    }
    CHECK(tree.size() == 0);
    CHECK(tree.obstacle({0.5, 0.5}) == nullptr);
    if (round == 0) bytes = tree.bytes();
    CHECK(tree.bytes() == bytes);
  }
}
