// Triangulations of many points at once: by the definition, by the exact judge, and beside meshes.
#include "mesher/delaunay.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "delaunay_case.hpp"
#include "facade/graph_runs.hpp"
#include "feature_ids.hpp"
#include "mesher/graph.hpp"
#include "mesher/mesher.hpp"

namespace {

using mesher::Delaunay;
using mesher::Error;
using mesher::ErrorCode;
using mesher::kNoSimplex;
using mesher::Point;
using support::Kind;

template <int D>
using Points = std::vector<Point<D>>;

// Neighbours share all corners but one each, and know each other; simplices are positive.
template <int D>
void require_consistent(const Points<D>& points, const Delaunay<D>& t) {
  REQUIRE(t.neighbours.size() == t.simplices.size());
  for (std::uint32_t s = 0; s < t.simplices.size(); ++s) {
    std::array<Point<D>, D + 1> corners;
    for (std::size_t i = 0; i <= D; ++i) corners[i] = points[t.simplices[s][i]];
    REQUIRE(support::orientation(corners) > 0);
    for (std::size_t i = 0; i <= D; ++i) {
      const std::uint32_t other = t.neighbours[s][i];
      if (other == kNoSimplex) continue;
      REQUIRE(other < t.simplices.size());
      const auto& theirs = t.simplices[other];
      for (std::size_t k = 0; k <= D; ++k) {
        const bool shared =
            std::find(theirs.begin(), theirs.end(), t.simplices[s][k]) != theirs.end();
        REQUIRE(shared == (k != i));
      }
      const auto& back = t.neighbours[other];
      REQUIRE(std::count(back.begin(), back.end(), s) == 1);
    }
  }
}

template <int D>
ErrorCode refusal(const Points<D>& points) {
  try {
    static_cast<void>(mesher::delaunay<D>(points));
  } catch (const Error& e) {
    return e.code();
  }
  FAIL("not refused");
  return {};
}

template <int D>
Points<D> moved(Points<D> points, double scale) {
  for (auto& p : points) {
    for (double& x : p) x *= scale;
  }
  return points;
}

// FNV-1a of the numbers, in their order.
template <int D>
std::uint64_t hash_of(const Delaunay<D>& t) {
  std::uint64_t h = 0xcbf29ce484222325u;
  for (const auto* list : {&t.simplices, &t.neighbours}) {
    for (const auto& s : *list) {
      for (const auto v : s) h = (h ^ v) * 0x100000001b3u;
    }
  }
  return h;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("a triangulation is what the definition says, ties by coordinates",
                       "[template]", ((int D), D), 2, 3) {
  for (const Kind kind : support::kKinds) {
    for (const std::size_t n : {1u, 2u, 3u, 4u, 5u, 6u, 8u, 12u, 20u}) {
      for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        INFO(support::name(kind) << ", " << n << " points, seed " << seed);
        const Points<D> points = support::distinct_points<D>(kind, n, seed);
        const Delaunay<D> t = mesher::delaunay<D>(points);
        require_consistent<D>(points, t);
        const auto set = support::as_set<D>(t.simplices);
        REQUIRE(set.size() == t.simplices.size());
        REQUIRE(set == support::by_definition<D>(points));
        REQUIRE(t.duplicates.empty());
      }
    }
  }
}

TEMPLATE_TEST_CASE_SIG("the exact judge finds triangulations of boxes Delaunay", "[template]",
                       ((int D), D), 2, 3) {
  for (const Kind kind : support::kKinds) {
    for (const std::size_t n : {50u, 2000u}) {
      INFO(support::name(kind) << ", " << n << " points");
      Points<D> points = support::distinct_points<D>(kind, n, 7 + n);
      support::add_corners<D>(points);
      const Delaunay<D> t = mesher::delaunay<D>(points);
      require_consistent<D>(points, t);
      CHECK(support::delaunay_verdict<D>(points, t) == "");
    }
  }
}

TEMPLATE_TEST_CASE_SIG("scaling by powers of two and the order of the points change nothing",
                       "[template]", ((int D), D), 2, 3) {
  for (const Kind kind : support::kKinds) {
    INFO(support::name(kind));
    Points<D> points = support::distinct_points<D>(kind, 500, 3);
    const auto set = support::fresh_set<D>(points);
    const auto plain = support::as_set<D>(mesher::delaunay<D>(points).simplices);
    // No coordinate is less than 2^-53, nor than 2^-99 where they are spread.
    for (const double scale : {kind == Kind::spread ? 1.0 : 0x1p-40, 0x1p95}) {
      const Points<D> there = moved<D>(points, scale);
      REQUIRE(support::as_set<D>(mesher::delaunay<D>(there).simplices) == plain);
    }
    mesher::SplitMix64 random(1);
    for (int i = 0; i < 5; ++i) {
      support::shuffle(points, random);
      REQUIRE(support::fresh_set<D>(points) == set);
    }
  }
}

TEMPLATE_TEST_CASE_SIG("coordinates from the least to the greatest in one set", "[template]",
                       ((int D), D), 2, 3) {
  mesher::SplitMix64 random(11);
  for (int round = 0; round < 200; ++round) {
    std::set<Point<D>> points;
    for (std::size_t i = 0; i < 9; ++i) {
      Point<D> p;
      for (double& x : p) {
        const std::uint64_t kind = random.below(4);
        const double size = kind == 0 ? 0 : kind == 1 ? 0x1p100 : kind == 2 ? 0x1p-100 : 1;
        x = random.below(2) == 0 ? size : -size;
      }
      points.insert(p);
    }
    const Points<D> list(points.begin(), points.end());
    const auto set = support::as_set<D>(mesher::delaunay<D>(list).simplices);
    // 0 and -0 are one place.
    REQUIRE(set == support::by_definition<D>(list));
  }
}

TEMPLATE_TEST_CASE_SIG("of equal points the first is a corner, the others are told", "[template]",
                       ((int D), D), 2, 3) {
  for (const Kind kind : support::kKinds) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      INFO(support::name(kind) << ", seed " << seed);
      mesher::SplitMix64 random(seed);
      // The last are enough for more than one round of insertion.
      Points<D> points = support::distinct_points<D>(kind, seed < 20 ? seed * 10 : 3000, seed);
      const std::size_t n = points.size();
      for (std::size_t i = 0; i < n; ++i) {
        if (random.below(3) != 0) continue;
        points.push_back(points[random.below(n)]);
        for (double& x : points.back()) x = x == 0 ? -x : x;
      }
      support::shuffle(points, random);
      std::vector<typename Delaunay<D>::Duplicate> expected;
      Points<D> distinct;
      for (std::uint32_t i = 0; i < points.size(); ++i) {
        const auto first = std::find(points.begin(), points.end(), points[i]) - points.begin();
        const auto original = static_cast<std::uint32_t>(first);
        if (original != i) expected.push_back({i, original});
        if (original == i) distinct.push_back(points[i]);
      }
      const Delaunay<D> t = mesher::delaunay<D>(points);
      REQUIRE(t.duplicates == expected);
      REQUIRE(support::fresh_set<D>(distinct) ==
              support::placed_set<D>(t, [&](std::uint32_t i) { return points[i]; }));
      for (const auto& s : t.simplices) {
        for (const std::uint32_t v : s) {
          REQUIRE(std::none_of(expected.begin(), expected.end(),
                               [&](const auto& d) { return d.point == v; }));
        }
      }
    }
  }
}

TEMPLATE_TEST_CASE_SIG("too few points, or all in one plane, have no simplices", "[template]",
                       ((int D), D), 2, 3) {
  Points<D> points;
  CHECK(mesher::delaunay<D>(points).simplices.empty());
  for (int i = 0; i < 300; ++i) {
    Point<D> p;
    p.fill(i % 30);
    p[0] = i / 30;
    if (D == 2) p[0] = p[1];
    points.push_back(p);
    const Delaunay<D> t = mesher::delaunay<D>(points);
    REQUIRE((t.simplices.empty() && t.neighbours.empty()));
  }
}

TEMPLATE_TEST_CASE_SIG("numbers that are none, or out of range, are refused", "[template]",
                       ((int D), D), 2, 3) {
  const double bad[] = {std::numeric_limits<double>::quiet_NaN(),
                        std::numeric_limits<double>::infinity(), 0x1p101, 0x1p-101,
                        std::numeric_limits<double>::denorm_min()};
  for (const double x : bad) {
    Points<D> points = support::distinct_points<D>(Kind::grid, 20, 1);
    points[7][D - 1] = -x;
    CHECK(refusal<D>(points) == (std::isfinite(x) ? ErrorCode::magnitude : ErrorCode::not_finite));
    try {
      static_cast<void>(mesher::delaunay<D>(points));
    } catch (const Error& e) {
      CHECK(support::ids_of(e) == support::ids({8}));
      CHECK_THAT(e.what(), Catch::Contains("point 8"));
    }
  }
}

TEMPLATE_TEST_CASE_SIG("more points than can be numbered are refused before they are looked at",
                       "[template]", ((int D), D), 2, 3) {
  const Point<D> one{};
  const std::span<const Point<D>> points(&one, std::size_t{1} << 32);  // as many are not there
  const auto is_refused = [](const auto& run) {
    try {
      run();
    } catch (const Error& e) {
      return e.code() == ErrorCode::too_many;
    }
    return false;
  };
  CHECK(is_refused([&] { static_cast<void>(mesher::delaunay<D>(points)); }));
  CHECK(is_refused([&] { mesher::DynamicDelaunay<D>{points}; }));
}

TEMPLATE_TEST_CASE_SIG("a mesh is the triangulation of its vertices", "[template]", ((int D), D), 2,
                       3) {
  for (const Kind kind : support::kKinds) {
    if (kind == Kind::spread) continue;  // too near for a mesh
    INFO(support::name(kind));
    const Points<D> points = support::distinct_points<D>(kind, D == 2 ? 1000 : 200, 5);
    const auto mesh =
        mesher::mesh_statically<D>(points, {.domain = mesher::snapped_domain<D>(points)});
    CHECK(support::as_set<D>(mesh.simplices) ==
          support::as_set<D>(mesher::delaunay<D>(mesh.vertices).simplices));
  }
}

TEST_CASE("a mesh with segments is the triangulation of its vertices") {
  for (const auto kind :
       {mesher::PslgKind::segments, mesher::PslgKind::trees, mesher::PslgKind::zigzag}) {
    const auto pslg = mesher::without_polylines(mesher::generate_pslg({kind, 300}));
    Points<2> points;
    std::vector<mesher::PointId> ids;
    std::vector<mesher::Segment> segments;
    for (const auto& v : pslg.points) points.push_back(v.at), ids.push_back(v.id);
    for (const auto& s : pslg.segments) segments.push_back({s.id, s.from, s.to});
    const mesher::Options<2> options{.domain = mesher::snapped_domain<2>(points)};
    const auto mesh = mesher::mesh_statically(points, segments, options, ids);
    CHECK(support::as_set<2>(mesh.simplices) ==
          support::as_set<2>(mesher::delaunay<2>(mesh.vertices).simplices));
  }
}

TEST_CASE("a vertex with thousands of neighbours is like any other") {
  const auto line_circle = mesher::generate_points<3>(mesher::PointKind::line_circle, 1200, 1);
  const Delaunay<3> t = mesher::delaunay<3>(line_circle);
  require_consistent<3>(line_circle, t);
  CHECK(t.simplices.size() > 100000);
  // Half on a sphere around one in its middle, with few ties.
  Points<3> points = support::distinct_points<3>(Kind::uniform, 4000, 9);
  for (auto& p : points) {
    for (double& x : p) x -= 0.5;
    const double r = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
    for (double& x : p) x /= r;
  }
  points.push_back({0, 0, 0});
  const Delaunay<3> ball = mesher::delaunay<3>(points);
  require_consistent<3>(points, ball);
  CHECK(ball.simplices.size() == 2 * 4000 - 4);
}

TEST_CASE("the numbers are the same on every machine") {
  CHECK(hash_of(mesher::delaunay<2>(support::distinct_points<2>(Kind::uniform, 5000, 1))) ==
        0x24082170b53be2b8u);
  CHECK(hash_of(mesher::delaunay<2>(support::distinct_points<2>(Kind::grid, 5000, 1))) ==
        0x98ecdf73abf03b5eu);
  CHECK(hash_of(mesher::delaunay<3>(support::distinct_points<3>(Kind::uniform, 5000, 1))) ==
        0x42e0ca6ad0e03daeu);
  CHECK(hash_of(mesher::delaunay<3>(support::distinct_points<3>(Kind::rounded_grid, 5000, 1))) ==
        0x7a2f034a790eca65u);
}
