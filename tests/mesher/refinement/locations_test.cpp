// The structures that say where points wait, against a look at everything.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <type_traits>
#include <vector>

#include "mesher/extra/generate.hpp"
#include "mesher/predicates.hpp"
#include "refinement/ball_location.hpp"
#include "refinement/shell_lists.hpp"
#include "refinement/simplex_location.hpp"
#include "refinement/voronoi_lists.hpp"
#include "refinement/voronoi_location.hpp"

namespace {

using mesher::Point;
using mesher::PointKind;
using mesher::detail::BallLocation;
using mesher::detail::Found;
using mesher::detail::kInfinite;
using mesher::detail::kNone;
using mesher::detail::RefinedKernel;
using mesher::detail::ShellLists;
using mesher::detail::SimplexLocation;
using mesher::detail::VoronoiLists;
using mesher::detail::VoronoiLocation;

template <int D>
double distance2(const Point<D>& a, const Point<D>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < D; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
}

// A box with a grid on its sides and points in it, of which some become vertices, as do other
// places.
template <int D, class Location>
class Scene {
 public:
  Scene(const std::vector<Point<D>>& points, double scale)
      : points_(points), location_(points), scale_(scale) {
    std::vector<Point<D>> corners;
    for (int i = 0; i < (1 << D); ++i) {
      Point<D> p;
      for (std::size_t k = 0; k < D; ++k) p[k] = (i >> k & 1) != 0 ? 3 * scale : -2 * scale;
      corners.push_back(p);
    }
    std::array<std::uint32_t, D + 1> first{};
    for (const auto& p : corners) add(p);
    for (std::size_t k = 0; k <= D; ++k) first[k] = k == 0 ? 1 : 1 + (1u << (k - 1));
    kernel_.start(first);
    for (std::uint32_t v = 1; v <= corners.size(); ++v) {
      if (!kernel_.has(v)) kernel_.insert(v);
    }
    const std::uint32_t v = add(points[0]);
    kernel_.insert(v);
    location_.start(kernel_, v, 0, [](std::uint32_t) {});
    waits_.assign(points.size(), true);
    waits_[0] = false;
  }

  // Of the points, or another place.
  void insert(mesher::SplitMix64& random) {
    const std::size_t k = random.below(points_.size());
    Point<D> p;
    for (double& x : p) x = scale_ * random.unit();
    if (random.below(2) == 0 && waits_[k]) p = points_[k];
    const std::uint32_t v = add(p);
    const std::uint32_t s = kernel_.walk(p, kernel_.made().front());
    for (const std::uint32_t w : kernel_.simplices().corners(s)) {
      if (w != kInfinite && kernel_.place(w) == p) {
        kernel_.drop_place();
        location_.drop_vertex();
        return;
      }
    }
    kernel_.dig(v, s);
    const std::uint32_t point = location_.take(kernel_, v);
    kernel_.fill(v);
    location_.give(kernel_, v, [&](std::uint32_t w) { CHECK(location_.is_crowded(w)); });
    if (point == kNone) return;
    CHECK(points_[point] == p);
    CHECK(waits_[point]);
    waits_[point] = false;
  }

  // Every point that waits is found: at the vertex nearest to it, and by queries around it.
  void check() {
    CHECK(location_.left() ==
          static_cast<std::size_t>(std::count(waits_.begin(), waits_.end(), true)));
    for (std::uint32_t k = 0; k < points_.size(); ++k) {
      if (!waits_[k]) continue;
      const Point<D>& p = points_[k];
      const std::uint32_t s = kernel_.walk(p, kernel_.made().front());
      const auto is_k = [&](std::uint32_t point) { return point == k; };
      if constexpr (kByVertices) {
        CHECK(waits_near(p));
      } else {
        CHECK(location_.find_early(kernel_, s, p, 0, is_k).point == k);
      }
      if constexpr (std::is_same_v<Location, BallLocation<D>>) CHECK(waits_at_all(k));
    }
    check_vertices();
  }
  // What a query finds is in the ball; by simplices it finds a point if there is one.
  void query(mesher::SplitMix64& random) {
    const auto& store = kernel_.simplices();
    std::uint32_t s = static_cast<std::uint32_t>(random.below(store.places()));
    if (!store.alive(s) || kernel_.is_ghost(s)) return;
    const Point<D>& c = store.ball(s).centre;
    const double r = 0.9 * std::sqrt(distance2<D>(c, kernel_.place(store.corners(s)[0])));
    for (const double x : c) {
      if (!(x > -2 * scale_ && x < 3 * scale_)) return;
    }
    bool expected = false;
    for (std::uint32_t k = 0; k < points_.size(); ++k) {
      expected |=
          waits_[k] && distance2<D>(points_[k], c) <= r * r && kernel_.conflicts(s, points_[k]);
    }
    const auto takes = [&](std::uint32_t point) { return kernel_.conflicts(s, points_[point]); };
    Found found = location_.find_early(kernel_, s, c, r, takes);
    if (found.point == kNone) {
      const std::uint32_t v = add(c);
      kernel_.dig(v, s);
      found = location_.find_late(kernel_, s, c, r, takes);
      kernel_.undo_dig();
      kernel_.drop_place();
      location_.drop_vertex();
    }
    if (found.point == kNone) {
      // The vertex nearest to a point in the ball need not be a neighbour of what would be at c.
      CHECK((kByVertices || !expected));
      return;
    }
    CHECK(expected);
    CHECK(waits_[found.point]);
    CHECK(distance2<D>(points_[found.point], c) <= r * r);
    CHECK(takes(found.point));
  }

 private:
  static constexpr bool kByVertices =
      !std::is_same_v<Location, SimplexLocation<D>> && !std::is_same_v<Location, BallLocation<D>>;

  std::uint32_t add(const Point<D>& p) {
    location_.add_vertex();
    return kernel_.add_place(p);
  }
  // At a vertex that is nearest, but for the rounding of floats.
  bool waits_near(const Point<D>& p) const {
    double least = HUGE_VAL;
    for (std::uint32_t v = 1; v <= kernel_.places(); ++v) {
      least = std::min(least, distance2<D>(kernel_.place(v), p));
    }
    for (std::uint32_t v = 1; v <= kernel_.places(); ++v) {
      const bool near = distance2<D>(kernel_.place(v), p) <= least * (1 + 0x1p-20);
      if (near && location_.is_crowded(v)) return true;
    }
    return false;
  }
  bool waits_at_all(std::uint32_t k) {
    const auto& store = kernel_.simplices();
    const auto is_k = [&](std::uint32_t point) { return point == k; };
    for (std::uint32_t s = 0; s < store.places(); ++s) {
      if (!store.alive(s) || kernel_.is_ghost(s)) continue;
      const bool there = location_.find_early(kernel_, s, points_[k], 0, is_k).point == k;
      if (there != kernel_.conflicts(s, points_[k])) return false;
    }
    return true;
  }
  void check_vertices() {
    for (std::uint32_t v = 1; v <= kernel_.places(); ++v) {
      if (!location_.is_crowded(v)) continue;
      const Found any = location_.any(kernel_, v), farthest = location_.farthest(kernel_, v);
      REQUIRE(any.point != kNone);
      REQUIRE(farthest.point != kNone);
      CHECK(waits_[any.point]);
      CHECK(waits_[farthest.point]);
      const double of_any = distance2<D>(points_[any.point], kernel_.place(v));
      const double most = distance2<D>(points_[farthest.point], kernel_.place(v));
      CHECK(of_any <= most * (1 + 0x1p-20));
    }
  }

  std::vector<Point<D>> points_;
  RefinedKernel<D> kernel_;
  Location location_;
  double scale_;
  std::vector<bool> waits_;
};

}  // namespace

TEMPLATE_TEST_CASE_SIG("points wait where they should, and are found", "",
                       ((int D, class Location), D, Location),
                       (2, VoronoiLocation<2, VoronoiLists<2>>),
                       (3, VoronoiLocation<3, VoronoiLists<3>>),
                       (2, VoronoiLocation<2, ShellLists<2>>),
                       (3, VoronoiLocation<3, ShellLists<3>>), (2, SimplexLocation<2>),
                       (3, SimplexLocation<3>), (2, BallLocation<2>), (3, BallLocation<3>)) {
  for (const PointKind kind : {PointKind::clusters, PointKind::grid, PointKind::line_circle}) {
    for (const double scale : {1.0, 0x1p-60, 0x1p60}) {
      INFO("family " << static_cast<int>(kind) << ", scale " << scale);
      auto points = mesher::generate_points<D>(kind, 100, 3);
      const auto domain = mesher::snapped_domain<D>(points);
      for (auto& p : points) {
        for (std::size_t i = 0; i < D; ++i) {
          p[i] = scale * ((p[i] - domain.lo[i]) / (2 * (domain.hi[i] - domain.lo[i])) + 0.25);
        }
      }
      Scene<D, Location> scene(points, scale);
      mesher::SplitMix64 random(11);
      for (int i = 0; i < 120; ++i) {
        scene.insert(random);
        scene.query(random);
        if (i % 20 == 0) scene.check();
      }
      scene.check();
    }
  }
}
