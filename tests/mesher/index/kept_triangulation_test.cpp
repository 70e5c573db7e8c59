// The triangulation that is kept in the place of stars: that of a run from scratch after any edits,
// and its news are the difference.
#include "index/kept_triangulation.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <iterator>
#include <set>
#include <vector>

#include "delaunay_case.hpp"
#include "failing_new.hpp"
#include "mesher/extra/generate.hpp"

namespace {

using mesher::Point;
using mesher::SplitMix64;
using mesher::detail::KeptTriangulation;
using mesher::detail::VertexHandle;
using mesher::detail::VertexPool;
using support::Kind;
using support::SimplexSet;

// Vertices of a kind within the corners of a box, which stay.
template <int D>
class Vertices {
 public:
  explicit Vertices(Kind kind, std::size_t n, SplitMix64& random) : kind_(kind), n_(n) {
    for (int corner = 0; corner < 1 << D; ++corner) {
      Point<D> p;
      for (std::size_t i = 0; i < D; ++i) p[i] = (corner >> i & 1) != 0 ? 64 : -64;
      add(p);
    }
    corners_ = live_.size();
    for (std::size_t i = 0; i < n; ++i) static_cast<void>(come(random));
  }

  // A vertex at a new place; 0 if the place is taken.
  VertexHandle come(SplitMix64& random) {
    const Point<D> p = support::point_of<D>(kind_, n_, random);
    return places_.count(p) != 0 ? 0 : add(p);
  }
  // One of those that were there before.
  VertexHandle go(SplitMix64& random, std::size_t of) {
    if (of <= corners_) return 0;
    const std::size_t at = corners_ + random.below(of - corners_);
    const VertexHandle v = live_[at];
    live_.erase(live_.begin() + static_cast<std::ptrdiff_t>(at));
    return v;
  }
  // From here on another may be at its place, with its handle.
  void release(VertexHandle v) {
    places_.erase(pool_[v].p);
    pool_.release(pool_[v]);
  }
  [[nodiscard]] VertexPool<D>& pool() { return pool_; }
  [[nodiscard]] const std::vector<VertexHandle>& live() const { return live_; }

 private:
  VertexHandle add(const Point<D>& p) {
    places_.insert(p);
    live_.push_back(pool_.create(p).self);
    return live_.back();
  }

  Kind kind_;
  std::size_t n_, corners_ = 0;
  VertexPool<D> pool_;
  std::vector<VertexHandle> live_;
  std::set<Point<D>> places_;
};

template <int D>
SimplexSet<D> simplices_of(const KeptTriangulation<D>& kept) {
  std::vector<std::array<VertexHandle, D + 1>> all;
  kept.for_each_simplex([&](const auto& s) { all.push_back(s); });
  return support::as_set<D>(all);
}

template <int D>
int orientation_of(const VertexPool<D>& pool, const std::array<VertexHandle, D + 1>& s) {
  std::array<Point<D>, D + 1> places;
  for (std::size_t i = 0; i <= D; ++i) places[i] = pool[s[i]].p;
  return support::orientation(places);
}

// It is the triangulation of these vertices, as a whole and around each of them.
template <int D>
void require_right(const KeptTriangulation<D>& kept, Vertices<D>& vertices) {
  kept.check_invariants();
  const SimplexSet<D> all = simplices_of(kept);
  REQUIRE(all == simplices_of(KeptTriangulation<D>(vertices.pool(), vertices.live())));
  std::vector<std::array<VertexHandle, D + 1>> around;
  for (const VertexHandle v : vertices.live()) {
    REQUIRE(kept.has(v));
    kept.for_each_simplex_at(v, [&](const auto& s) {
      REQUIRE(s[0] == v);
      REQUIRE(orientation_of<D>(vertices.pool(), s) > 0);
      around.push_back(s);
    });
  }
  REQUIRE(around.size() == (D + 1) * all.size());
  REQUIRE(support::as_set<D>(around) == all);
}

template <int D>
void require_news(KeptTriangulation<D>& kept, Vertices<D>& vertices, const SimplexSet<D>& before) {
  const SimplexSet<D> now = simplices_of(kept);
  const auto news = kept.news();
  const auto without = [](const SimplexSet<D>& some, const SimplexSet<D>& others) {
    SimplexSet<D> rest;
    std::set_difference(some.begin(), some.end(), others.begin(), others.end(),
                        std::inserter(rest, rest.end()));
    return rest;
  };
  REQUIRE(support::as_set<D>(news.gone) == without(before, now));
  REQUIRE(support::as_set<D>(news.come) == without(now, before));
  for (const auto* list : {&news.gone, &news.come}) {
    REQUIRE(std::is_sorted(list->begin(), list->end()));
    REQUIRE(std::adjacent_find(list->begin(), list->end()) == list->end());
    for (const auto& s : *list) REQUIRE(orientation_of<D>(vertices.pool(), s) > 0);
  }
}

// Batches of edits, some of which take most vertices out; now and then two before a commit.
template <int D>
void change_at_random(Kind kind, std::size_t n, std::uint64_t seed) {
  INFO(D << " " << support::name(kind) << " seed " << seed);
  SplitMix64 random(seed);
  Vertices<D> vertices(kind, n, random);
  KeptTriangulation<D> kept(vertices.pool(), vertices.live());
  require_right(kept, vertices);
  SimplexSet<D> before = simplices_of(kept);
  std::vector<VertexHandle> released;
  for (int batch = 0; batch < 12; ++batch) {
    const std::size_t was = vertices.live().size();
    const std::size_t leave = batch % 4 == 3 ? was : random.below(5);
    std::vector<VertexHandle> come, gone;
    for (std::size_t i = 0; i < leave; ++i) {
      const VertexHandle v = vertices.go(random, was - gone.size());
      if (v != 0) gone.push_back(v);
    }
    for (std::uint64_t i = random.below(batch % 4 == 0 ? n : 6); i > 0; --i) {
      const VertexHandle v = vertices.come(random);
      if (v != 0) come.push_back(v);
    }
    released.insert(released.end(), gone.begin(), gone.end());
    const auto near = [&](VertexHandle, VertexHandle last) {
      return last != 0 && random.below(2) == 0 ? last : vertices.live().front();
    };
    kept.change(vertices.pool(), come, gone, near);
    require_right(kept, vertices);
    require_news(kept, vertices, before);
    if (random.below(3) == 0) continue;
    kept.commit();
    before = simplices_of(kept);
    for (const VertexHandle v : released) vertices.release(v);
    released.clear();
  }
}

}  // namespace

TEMPLATE_TEST_CASE_SIG(
    "a triangulation that is kept is that of its vertices, and says what changed",
    "[kept_triangulation_test]", ((int D), D), 2, 3) {
  for (const Kind kind : support::kKinds) {
    for (std::uint64_t seed = 1; seed <= 6; ++seed) change_at_random<D>(kind, 40, seed);
  }
}

TEMPLATE_TEST_CASE_SIG("what fails to change is changed when it is asked again",
                       "[kept_triangulation_test]", ((int D), D), 2, 3) {
  for (std::uint64_t k = 1;; ++k) {
    INFO("allocation " << k);
    SplitMix64 random(9);
    Vertices<D> vertices(Kind::grid, 30, random);
    KeptTriangulation<D> kept(vertices.pool(), vertices.live());
    std::vector<VertexHandle> come, gone;
    for (int i = 0; i < 2; ++i) gone.push_back(vertices.go(random, vertices.live().size()));
    while (come.size() < 3) {
      if (const VertexHandle v = vertices.come(random)) come.push_back(v);
    }
    const auto at_corner = [&](VertexHandle, VertexHandle) { return vertices.live().front(); };
    bool burnt = false;
    if (!support::fails(k, burnt, [&] { kept.change(vertices.pool(), come, gone, at_corner); })) {
      if (!burnt) break;  // there were not so many
    }
    kept.check_invariants();
    const auto done = [&](bool is_there) {
      return [&, is_there](VertexHandle v) { return kept.has(v) == is_there; };
    };
    come.erase(std::remove_if(come.begin(), come.end(), done(true)), come.end());
    gone.erase(std::remove_if(gone.begin(), gone.end(), done(false)), gone.end());
    kept.change(vertices.pool(), come, gone, at_corner);
    require_right(kept, vertices);
  }
}
