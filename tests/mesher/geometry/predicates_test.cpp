// Plane predicates against rational arithmetic, and the perturbed triangulation against its axioms.
#include "mesher/predicates.hpp"

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <catch2/catch.hpp>
#include <cfenv>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

namespace {

namespace detail = mesher::predicates::detail;
using boost::multiprecision::cpp_int;
using mesher::predicates::incircle;
using mesher::predicates::incircle_perturbed;
using mesher::predicates::orient2d;
using Exact = boost::multiprecision::cpp_rational;
using P = mesher::Point<2>;
using Quad = std::array<P, 4>;
using Random = std::mt19937_64;

constexpr std::uint64_t kSeed = 20240229;

// ---- the oracle: determinants with a row x, y, height, 1 for each point ----

Exact area(const P& a, const P& b, const P& c) {
  const Exact ax(a[0]), ay(a[1]), bx(b[0]), by(b[1]), cx(c[0]), cy(c[1]);
  return ax * by - ay * bx + bx * cy - by * cx + cx * ay - cy * ax;
}

Exact lifted_volume(const Quad& q, const std::array<Exact, 4>& height) {
  return height[0] * area(q[1], q[2], q[3]) - height[1] * area(q[0], q[2], q[3]) +
         height[2] * area(q[0], q[1], q[3]) - height[3] * area(q[0], q[1], q[2]);
}

std::array<Exact, 4> paraboloid(const Quad& q) {
  std::array<Exact, 4> height;
  for (int i = 0; i < 4; ++i) {
    const Exact x(q[i][0]), y(q[i][1]);
    height[i] = x * x + y * y;
  }
  return height;
}

int exact_orient2d(const P& a, const P& b, const P& c) { return area(a, b, c).sign(); }
int exact_incircle(const Quad& q) { return lifted_volume(q, paraboloid(q)).sign(); }

/// With perturbations that are there: 2^-64 for the greatest point, its powers for the next ones.
int exact_incircle_perturbed(const Quad& q) {
  std::array<Exact, 4> height = paraboloid(q);
  for (int i = 0; i < 4; ++i) {
    const auto greater = std::count_if(q.begin(), q.end(), [&](const P& p) { return p > q[i]; });
    height[i] += Exact(cpp_int(1), cpp_int(1) << static_cast<int>(64 * (greater + 1)));
  }
  return lifted_volume(q, height).sign();
}

// ---- points ----

double uniform(Random& random, double lo, double hi) {
  return std::uniform_real_distribution<double>(lo, hi)(random);
}

int integer(Random& random, int lo, int hi) {
  return std::uniform_int_distribution<int>(lo, hi)(random);
}

double moved_by_ulps(double x, int ulps) {
  const double far = std::copysign(std::numeric_limits<double>::infinity(), ulps);
  for (; ulps != 0; ulps -= ulps > 0 ? 1 : -1) x = std::nextafter(x, far);
  return x;
}

template <class Make>
Quad quad_of(Make make) {
  return {make(), make(), make(), make()};
}

Quad uniform_quad(Random& random) {
  return quad_of([&] { return P{uniform(random, -1, 1), uniform(random, -1, 1)}; });
}

/// Points of a line, moved by up to two ulps.
Quad nearly_collinear(Random& random) {
  const double x = uniform(random, -2, 2), y = uniform(random, -2, 2);
  const double dx = uniform(random, -1, 1), dy = uniform(random, -1, 1);
  return quad_of([&] {
    const double t = uniform(random, -1, 1);
    return P{moved_by_ulps(x + t * dx, integer(random, -2, 2)),
             moved_by_ulps(y + t * dy, integer(random, -2, 2))};
  });
}

/// Points of a circle, moved by up to two ulps; centres near and far, so that tails occur.
Quad nearly_cocircular(Random& random) {
  const double far = std::ldexp(1.0, integer(random, -20, 4)), r = uniform(random, 0.1, 2);
  const double x = far * uniform(random, -1, 1), y = far * uniform(random, -1, 1);
  return quad_of([&] {
    const double angle = uniform(random, 0, 6.283185307179586);
    return P{moved_by_ulps(x + r * std::cos(angle), integer(random, -2, 2)),
             moved_by_ulps(y + r * std::sin(angle), integer(random, -2, 2))};
  });
}

/// A small grid, of any power-of-two step.
Quad on_grid(Random& random) {
  const double step = std::ldexp(1.0, integer(random, -90, 90));
  return quad_of([&] { return P{step * integer(random, -4, 4), step * integer(random, -4, 4)}; });
}

/// 0 or of magnitude 2^low to 2^high.
double any_magnitude(Random& random, int low, int high) {
  if (integer(random, 0, 15) == 0) return 0;
  const double sign = integer(random, 0, 1) == 0 ? -1 : 1;
  if (integer(random, 0, 15) == 0) return sign * std::ldexp(1.0, high);
  return sign * std::ldexp(uniform(random, 1, 2), integer(random, low, high - 1));
}

/// Every point of another magnitude, and coordinates that recur.
Quad any_magnitudes(Random& random) {
  const int low = integer(random, -100, 99), high = integer(random, low + 1, 100);
  std::array<double, 3> some;
  for (double& x : some) x = any_magnitude(random, low, high);
  const auto coordinate = [&] {
    return integer(random, 0, 1) == 0 ? some[integer(random, 0, 2)]
                                      : any_magnitude(random, low, high);
  };
  return quad_of([&] { return P{coordinate(), coordinate()}; });
}

/// A rectangle or a diagonal through all magnitudes, one coordinate perhaps moved by an ulp.
Quad degenerate_at_any_magnitude(Random& random) {
  Quad q;
  if (integer(random, 0, 1) == 0) {
    const double x = any_magnitude(random, -99, 99), y = any_magnitude(random, -99, 99);
    const double z = any_magnitude(random, -99, 99), w = any_magnitude(random, -99, 99);
    q = {P{x, y}, P{z, y}, P{z, w}, P{x, w}};
  } else {
    q = quad_of([&] {
      const double t = any_magnitude(random, -99, 99);
      return P{t, t};
    });
  }
  double& moved = q[integer(random, 0, 3)][integer(random, 0, 1)];
  if (moved != 0) moved = moved_by_ulps(moved, integer(random, -1, 1));
  return q;
}

/// The ends of the range only: as many bits and as large a determinant as there can be.
Quad at_the_limits(Random& random) {
  constexpr std::array kEnds{0.0, 0x1p100, 0x1.fffffffffffffp99, 0x1p-100, 0x1.0000000000001p-100};
  const auto end = [&] { return (integer(random, 0, 1) == 0 ? -1 : 1) * kEnds[random() % 5]; };
  return quad_of([&] { return P{end(), end()}; });
}

using Make = Quad (*)(Random&);
constexpr std::array<std::pair<const char*, Make>, 7> kKinds{{
    {"uniform", uniform_quad},
    {"nearly collinear", nearly_collinear},
    {"nearly cocircular", nearly_cocircular},
    {"grid", on_grid},
    {"any magnitudes", any_magnitudes},
    {"degenerate at any magnitude", degenerate_at_any_magnitude},
    {"limits of the range", at_the_limits},
}};

/// Calls check(quad) for `count` quads of each kind.
template <class Check>
void for_each_kind(int count, Check check) {
  for (const auto& [name, make] : kKinds) {
    INFO("points: " << name << ", seed " << kSeed);
    Random random(kSeed);
    for (int i = 0; i < count; ++i) {
      const Quad q = make(random);
      CAPTURE(i, q[0][0], q[0][1], q[1][0], q[1][1], q[2][0], q[2][1], q[3][0], q[3][1]);
      check(q);
    }
  }
}

bool usable_for_perturbation(const Quad& q) {
  const std::set<P> distinct(q.begin(), q.end());
  return distinct.size() == 4 &&
         (orient2d(q[0], q[1], q[2]) != 0 || orient2d(q[0], q[1], q[3]) != 0);
}

/// The sign of a permutation.
int parity(const std::array<int, 4>& order) {
  int inversions = 0;
  for (int i = 0; i < 4; ++i) {
    for (int j = i + 1; j < 4; ++j) inversions += order[i] > order[j] ? 1 : 0;
  }
  return inversions % 2 == 0 ? 1 : -1;
}

/// Requires `predicate` to change as a determinant does, over all 24 orders of `q`.
template <class Predicate>
void require_alternating(const Quad& q, Predicate predicate) {
  const int sign = predicate(q[0], q[1], q[2], q[3]);
  std::array<int, 4> o{0, 1, 2, 3};
  do {
    REQUIRE(predicate(q[o[0]], q[o[1]], q[o[2]], q[o[3]]) == parity(o) * sign);
  } while (std::next_permutation(o.begin(), o.end()));
}

// ---- triangulations by brute force ----

struct IntPoint {
  int x, y;
  friend auto operator<=>(const IntPoint&, const IntPoint&) = default;
};

std::int64_t twice_area(const IntPoint& a, const IntPoint& b, const IntPoint& c) {
  return std::int64_t{b.x - a.x} * (c.y - a.y) - std::int64_t{b.y - a.y} * (c.x - a.x);
}

using IntPoints = std::vector<IntPoint>;
using Triangle = std::array<IntPoint, 3>;  // counterclockwise, smallest point first

Triangle counterclockwise(IntPoint a, IntPoint b, IntPoint c) {
  if (twice_area(a, b, c) < 0) std::swap(b, c);
  Triangle t{a, b, c};
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

/// How integers become doubles; every choice is exact.
struct Frame {
  double step = 1, x = 0, y = 0;
  P operator()(const IntPoint& p) const { return {x + step * p.x, y + step * p.y}; }
};

/// The triangles with every other point outside by the perturbed predicate.
std::vector<Triangle> empty_triangles(const IntPoints& points, const Frame& at) {
  std::vector<Triangle> found;
  const auto outside = [&](const Triangle& t, const IntPoint& p) {
    return p == t[0] || p == t[1] || p == t[2] ||
           incircle_perturbed(at(t[0]), at(t[1]), at(t[2]), at(p)) < 0;
  };
  for (auto a = points.begin(); a != points.end(); ++a) {
    for (auto b = std::next(a); b != points.end(); ++b) {
      for (auto c = std::next(b); c != points.end(); ++c) {
        if (twice_area(*a, *b, *c) == 0) continue;
        const Triangle t = counterclockwise(*a, *b, *c);
        const auto is_outside = [&](const IntPoint& p) { return outside(t, p); };
        if (std::all_of(points.begin(), points.end(), is_outside)) found.push_back(t);
      }
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

using Edge = std::pair<IntPoint, IntPoint>;

/// The boundary of the convex hull, counterclockwise: the edges with no point to the right of them
/// and none within.
std::set<Edge> hull_edges(const IntPoints& points) {
  std::set<Edge> edges;
  const auto between = [](const IntPoint& p, const IntPoint& q, const IntPoint& r) {
    return std::min(p, q) < r && r < std::max(p, q);
  };
  for (const IntPoint& p : points) {
    for (const IntPoint& q : points) {
      const bool extreme = p != q && std::all_of(points.begin(), points.end(), [&](auto& r) {
                             const auto side = twice_area(p, q, r);
                             return side > 0 || (side == 0 && !between(p, q, r));
                           });
      if (extreme) edges.insert({p, q});
    }
  }
  return edges;
}

/// Requires `triangles` to be a triangulation of the hull of `points` with each point a vertex.
void require_triangulation(const IntPoints& points, const std::vector<Triangle>& triangles) {
  const auto hull = hull_edges(points);
  std::int64_t hull_area = 0, area = 0;
  for (const auto& [p, q] : hull) hull_area += twice_area({0, 0}, p, q);
  std::map<Edge, int> edges;
  std::set<IntPoint> vertices;
  for (const Triangle& t : triangles) {
    area += twice_area(t[0], t[1], t[2]);
    vertices.insert(t.begin(), t.end());
    for (int i = 0; i < 3; ++i) ++edges[{t[i], t[(i + 1) % 3]}];
  }
  REQUIRE(area == hull_area);
  REQUIRE(vertices == std::set<IntPoint>(points.begin(), points.end()));
  for (const auto& [edge, count] : edges) {
    REQUIRE(count == 1);
    REQUIRE(edges.contains({edge.second, edge.first}) != hull.contains(edge));
  }
  const std::size_t undirected = (edges.size() + hull.size()) / 2;
  REQUIRE(vertices.size() + triangles.size() == undirected + 1);  // Euler, the outer face left out
}

IntPoints grid(int width, int height) {
  IntPoints points;
  for (int x = 0; x < width; ++x) {
    for (int y = 0; y < height; ++y) points.push_back({x, y});
  }
  return points;
}

/// The integer points with x^2 + y^2 = square, and the centre if asked.
IntPoints circle(int square, bool centre) {
  IntPoints points;
  for (int x = -20; x <= 20; ++x) {
    for (int y = -20; y <= 20; ++y) {
      const int s = x * x + y * y;
      if (s == square || (centre && s == 0)) points.push_back({x, y});
    }
  }
  return points;
}

IntPoints sample(Random& random, const IntPoints& from, std::size_t count) {
  IntPoints points;
  std::sample(from.begin(), from.end(), std::back_inserter(points), count, random);
  return points;
}

bool on_one_line(const IntPoints& points) {
  return std::all_of(points.begin(), points.end(),
                     [&](const IntPoint& p) { return twice_area(points[0], points[1], p) == 0; });
}

}  // namespace

TEST_CASE("orient2d is the sign of the rational area", "[predicates]") {
  for_each_kind(4000, [](const Quad& q) {
    const int sign = exact_orient2d(q[0], q[1], q[2]);
    REQUIRE(orient2d(q[0], q[1], q[2]) == sign);
    REQUIRE(detail::orient2d_exact(q[0], q[1], q[2]) == sign);
  });
}

TEST_CASE("incircle is the sign of the rational determinant", "[predicates]") {
  for_each_kind(3000, [](const Quad& q) {
    const int sign = exact_incircle(q);
    REQUIRE(incircle(q[0], q[1], q[2], q[3]) == sign);
    REQUIRE(detail::incircle_exact(q[0], q[1], q[2], q[3]) == sign);
  });
}

TEST_CASE("the meaning of the signs is as documented", "[predicates]") {
  const P a{0, 0}, b{1, 0}, c{0, 1};
  REQUIRE(orient2d(a, b, c) == 1);
  REQUIRE(orient2d(a, c, b) == -1);
  REQUIRE(orient2d(a, b, {3, 0}) == 0);
  REQUIRE(incircle(a, b, c, {0.5, 0.5}) == 1);
  REQUIRE(incircle(a, c, b, {0.5, 0.5}) == -1);
  REQUIRE(incircle(a, b, c, {2, 2}) == -1);
  REQUIRE(incircle(a, b, c, {1, 1}) == 0);
  REQUIRE(incircle_perturbed(a, b, c, {1, 1}) == -1);  // the greatest is outside
  REQUIRE(incircle_perturbed(b, {1, 1}, c, a) == -1);  // so this is the other triangle
  REQUIRE(incircle_perturbed(a, b, {1, 1}, c) == 1);   // and this is none
}

TEST_CASE("the kinds of points reach zero, both signs, filter and exact way", "[predicates]") {
  std::map<int, int> orientations, circles, undecided;
  for_each_kind(1000, [&](const Quad& q) {
    ++orientations[orient2d(q[0], q[1], q[2])];
    ++circles[incircle(q[0], q[1], q[2], q[3])];
    ++undecided[detail::incircle_filter(q[0], q[1], q[2], q[3]) == 0 ? 1 : 0];
  });
  for (const auto& counts : {orientations, circles}) {
    for (const int sign : {-1, 0, 1}) REQUIRE(counts.at(sign) > 300);
  }
  for (const int which : {0, 1}) REQUIRE(undecided.at(which) > 1000);
}

TEST_CASE("the filters decide more than 99.99% of uniform points", "[predicates]") {
  INFO("seed " << kSeed);
  Random random(kSeed);
  constexpr int kCount = 300000;
  int undecided_orient = 0, undecided_incircle = 0;
  for (int i = 0; i < kCount; ++i) {
    const Quad q = uniform_quad(random);
    undecided_orient += detail::orient2d_filter(q[0], q[1], q[2]) == 0 ? 1 : 0;
    undecided_incircle += detail::incircle_filter(q[0], q[1], q[2], q[3]) == 0 ? 1 : 0;
  }
  REQUIRE(undecided_orient < kCount / 10000);
  REQUIRE(undecided_incircle < kCount / 10000);
}

TEST_CASE("the error bounds of the filters cover their derivation", "[predicates]") {
  const Exact u(detail::kUnitRoundoff);
  const auto power = [](const Exact& x, int n) {
    Exact result = 1;
    while (n-- > 0) result *= x;
    return result;
  };
  const auto needed = [&](int k, int m) {
    return Exact((power(1 + u, k) - 1) / power(1 - u, m + 2));
  };
  REQUIRE(Exact(detail::kOrientBound) >= needed(3, 4));
  REQUIRE(Exact(detail::kIncircleBound) >= needed(10, 11));
}

TEST_CASE("swapping two points flips the sign", "[predicates]") {
  for_each_kind(1000, [](const Quad& q) {
    const auto& [a, b, c, d] = q;
    const int sign = orient2d(a, b, c);
    REQUIRE(orient2d(b, c, a) == sign);
    REQUIRE(orient2d(c, a, b) == sign);
    REQUIRE(orient2d(b, a, c) == -sign);
    REQUIRE(orient2d(a, c, b) == -sign);
    REQUIRE(orient2d(c, b, a) == -sign);
    REQUIRE(orient2d(a, a, b) == 0);
    REQUIRE(incircle(a, b, c, a) == 0);
    require_alternating(q, incircle);
  });
}

TEST_CASE("scaling by a power of two, mirroring and turning act as in the plane", "[predicates]") {
  for (const Make make : {uniform_quad, nearly_collinear, nearly_cocircular}) {
    INFO("seed " << kSeed);
    Random random(kSeed);
    for (int i = 0; i < 1000; ++i) {
      const Quad q = make(random);
      const double scale = std::ldexp(1.0, integer(random, -40, 90));
      const auto both = [&](auto map) {
        return std::pair(orient2d(map(q[0]), map(q[1]), map(q[2])),
                         incircle(map(q[0]), map(q[1]), map(q[2]), map(q[3])));
      };
      const auto signs = both([](const P& p) { return p; });
      const auto flipped = std::pair(-signs.first, -signs.second);
      CAPTURE(i, scale);
      REQUIRE(both([&](const P& p) { return P{scale * p[0], scale * p[1]}; }) == signs);
      REQUIRE(both([](const P& p) { return P{-p[1], p[0]}; }) == signs);
      REQUIRE(both([](const P& p) { return P{p[1], p[0]}; }) == flipped);
    }
  }
}

TEST_CASE("the perturbed predicate is never 0, alternates, and agrees with incircle",
          "[predicates]") {
  int ties = 0;
  for_each_kind(1000, [&](const Quad& q) {
    if (!usable_for_perturbation(q)) return;
    const int sign = incircle(q[0], q[1], q[2], q[3]);
    const int perturbed = incircle_perturbed(q[0], q[1], q[2], q[3]);
    REQUIRE(perturbed != 0);
    if (sign != 0) REQUIRE(perturbed == sign);
    ties += sign == 0 ? 1 : 0;
    require_alternating(q, incircle_perturbed);
  });
  REQUIRE(ties > 100);
}

TEST_CASE("the perturbed predicate is incircle of points lifted a little higher", "[predicates]") {
  INFO("seed " << kSeed);
  Random random(kSeed);
  int ties = 0;
  for (int i = 0; i < 5000; ++i) {
    const Quad q = quad_of([&] {
      return P{double(integer(random, -3, 3)), double(integer(random, -3, 3))};
    });
    if (!usable_for_perturbation(q)) continue;
    CAPTURE(i);
    ties += incircle(q[0], q[1], q[2], q[3]) == 0 ? 1 : 0;
    REQUIRE(incircle_perturbed(q[0], q[1], q[2], q[3]) == exact_incircle_perturbed(q));
  }
  REQUIRE(ties > 100);
}

TEST_CASE("the triangles empty by the perturbed predicate are one triangulation of the hull",
          "[predicates]") {
  Random random(kSeed);
  std::vector<IntPoints> sets{grid(2, 2),         grid(2, 7),        grid(3, 3),
                              grid(4, 4),         grid(5, 5),        grid(6, 6),
                              grid(9, 3),         circle(25, false), circle(25, true),
                              circle(325, false), circle(65, true)};
  for (int i = 0; i < 400; ++i) sets.push_back(sample(random, grid(6, 6), 4 + i % 14));
  for (std::size_t i = 0; i < sets.size(); ++i) {
    IntPoints points = sets[i];
    CAPTURE(i, points.size(), kSeed);
    if (on_one_line(points)) continue;
    const auto triangles = empty_triangles(points, Frame{});
    require_triangulation(points, triangles);
    std::shuffle(points.begin(), points.end(), random);
    REQUIRE(empty_triangles(points, Frame{}) == triangles);
    REQUIRE(empty_triangles(points, Frame{0x1p-20, -3, 0.625}) == triangles);
    REQUIRE(empty_triangles(points, Frame{0x1p90, 0, 0x1p95}) == triangles);
  }
}

TEST_CASE("coordinates too far apart for the exact integers are refused", "[predicates]") {
  const P a{0x1p-200, 0x1p-200}, b{1, 1}, c{0x1p100, 0x1p100};
  REQUIRE_THROWS_AS(orient2d(a, b, c), std::domain_error);
}

TEST_CASE("the self-test accepts this build, and no rounding but to nearest", "[predicates]") {
  REQUIRE_NOTHROW(mesher::predicates::self_test());
  for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    bool refused = false;
    REQUIRE(std::fesetround(mode) == 0);
    try {
      mesher::predicates::self_test();
    } catch (const std::logic_error&) {
      refused = true;
    }
    std::fesetround(FE_TONEAREST);
    CHECK(refused);
  }
}
