// Segments found by ends, at points, and by place, against all of them.
#include "plane/segment_store.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <vector>

#include "failing_new.hpp"
#include "geometry/space_distances.hpp"
#include "mesher/extra/generate.hpp"

namespace {

using mesher::Point;
using mesher::SplitMix64;
using mesher::detail::MeshBox;
using mesher::detail::Segment;
using mesher::detail::SegmentHandle;
using mesher::detail::SegmentOf;
using mesher::detail::SegmentStore;
using mesher::detail::SegmentStoreOf;
using mesher::detail::VertexHandle;
using mesher::detail::VertexPool;

const MeshBox<2> kBox{.lo = {-1.5, -1.5}, .side = 4};

template <int D>
MeshBox<D> box_of() {
  MeshBox<D> box{.side = 4};
  box.lo.fill(-1.5);
  return box;
}

// Points, some close together, so that segments are of all lengths.
template <int D>
std::vector<VertexHandle> make_points(VertexPool<D>& pool, SplitMix64& random, int n) {
  std::vector<VertexHandle> points;
  for (int i = 0; i < n; ++i) {
    Point<D> p;
    for (double& x : p) x = random.unit();
    if (i > 0 && random.below(3) == 0) {
      const Point<D>& q = pool[points[random.below(points.size())]].p;
      const double d = std::ldexp(1.0, -static_cast<int>(random.below(30)));
      for (int k = 0; k < D; ++k) p[k] = q[k] + d * (p[k] - 0.5);
    }
    points.push_back(pool.create(p).self);
  }
  return points;
}

template <int D>
class SourceOf {
 public:
  explicit SourceOf(std::uint64_t seed) : random_(seed) {
    points_ = make_points(pool_, random_, 3 + static_cast<int>(random_.below(40)));
  }
  // Puts or takes a segment between two points.
  void edit(SegmentStoreOf<D>& store) {
    VertexHandle a = some(), b = some();
    if (pool_[a].p == pool_[b].p) return;
    auto& s = store.record(a, b);
    s.alive ? store.take(s) : store.put(s);
  }
  VertexHandle some() { return points_[random_.below(points_.size())]; }
  const Point<D>& some_place() { return pool_[some()].p; }
  SplitMix64& random() { return random_; }
  const VertexPool<D>& pool() const { return pool_; }
  const std::vector<VertexHandle>& points() const { return points_; }

 private:
  SplitMix64 random_;
  VertexPool<D> pool_;
  std::vector<VertexHandle> points_;
};

using Source = SourceOf<2>;

// Every live segment that meets the disc has been visited.
template <int D>
void require_found(SegmentStoreOf<D>& store, const Point<D>& p, const Point<D>& q, double slack) {
  std::vector<SegmentHandle> found;
  store.visit_near(p, q, slack, [&](const SegmentOf<D>& s) {
    found.push_back(s.self);
    return false;
  });
  store.pool().for_each([&](const SegmentOf<D>& s) {
    if (!s.alive) return;
    const double d2 = mesher::detail::distance2(p, q, s.place_a, s.place_b);
    const bool is_found = std::find(found.begin(), found.end(), s.self) != found.end();
    if (d2 <= slack * slack && !is_found) FAIL("segment " << s.self << " is not found");
  });
}

}  // namespace

TEMPLATE_TEST_CASE_SIG(
    "segments are found by their ends, at their ends, and by all that is near them", "",
    ((int D), D), 2, 3) {
  const MeshBox<D> box = box_of<D>();
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    INFO("seed " << seed);
    SourceOf<D> source(seed);
    SegmentStoreOf<D> store(box, source.pool());
    for (int edit = 0; edit < 120; ++edit) {
      source.edit(store);
      const double slack =
          std::ldexp(source.random().unit(), -static_cast<int>(source.random().below(30)));
      require_found<D>(store, source.some_place(), source.some_place(), slack);
      const Point<D> p = source.some_place();
      require_found<D>(store, p, p, slack);
      if (source.random().below(4) == 0) store.commit();
      store.check_invariants();
    }
    std::map<VertexHandle, std::size_t> degree;
    store.pool().for_each([&](const SegmentOf<D>& s) {
      if (!s.alive) return;
      ++degree[s.a], ++degree[s.b];
      REQUIRE(store.find(s.a, s.b) == &s);
      REQUIRE(store.find(s.b, s.a) == &s);
    });
    for (const VertexHandle v : source.points()) {
      std::size_t count = 0;
      store.visit_at(v, [&](const SegmentOf<D>&) { ++count; });
      REQUIRE(count == degree[v]);
    }
  }
}

TEST_CASE("among long parallel segments a search for what is near visits few, after a while") {
  VertexPool<2> pool;
  SegmentStore store(kBox, pool);
  constexpr int kLines = 1000;
  for (int i = 0; i < kLines; ++i) {
    const double y = (i + 0.5) / kLines;
    store.put(store.record(pool.create({0.01, y}).self, pool.create({0.99, y}).self));
  }
  SplitMix64 random(1);
  const auto visited = [&] {
    std::size_t count = 0;
    for (int i = 0; i < 1000; ++i) {
      const Point<2> p{random.unit(), random.unit()};
      store.visit_near(p, p, 1.0 / kLines, [&](const Segment&) {
        ++count;
        return false;
      });
    }
    return count / 1000;
  };
  for (int round = 0; round < 30; ++round) static_cast<void>(visited());
  CHECK(visited() < 20);
  store.check_invariants();
  CHECK(store.bytes() < kLines * std::size_t{100'000});
}

TEST_CASE("a segment for which there is no memory is not there") {
  Source source(3);
  SegmentStore store(kBox, source.pool());
  for (int edit = 0; edit < 100; ++edit) {
    const VertexHandle a = source.some(), b = source.some();
    if (source.pool()[a].p == source.pool()[b].p || store.find(a, b) != nullptr) continue;
    Segment& s = store.record(a, b);
    for (std::uint64_t count = 1; !s.alive; ++count) {
      support::allocation_fuse.left = count;
      try {
        store.put(s);
      } catch (const std::bad_alloc&) {
        REQUIRE(!s.alive);
      }
      support::allocation_fuse.left = 0;
      store.check_invariants();
    }
  }
  CHECK(store.live() > 10);
}
