// Predicates of shrunken balls against integers of any size, whose centres come from linear
// equations; near the sphere, on it, at every scale.
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <random>
#include <set>
#include <stdexcept>
#include <vector>

#include "mesher/predicates.hpp"

namespace {

namespace detail = mesher::predicates::detail;
using boost::multiprecision::cpp_int;
using mesher::Point;
using mesher::predicates::in_shrunken_ball;
using Random = std::mt19937_64;

constexpr std::uint64_t kSeed = 20251123;

// ---- the oracle ----

// x / 2^low as an integer.
cpp_int integer(double x, int low) {
  int exponent = 0;
  const double fraction = std::frexp(x, &exponent);
  const auto mantissa = static_cast<std::int64_t>(std::ldexp(fraction, 53));
  const int shift = exponent - 53 - low;
  cpp_int all = mantissa;
  if (shift >= 0) return all << shift;
  const cpp_int cut = all >> -shift;
  REQUIRE(cpp_int(cut << -shift) == all);
  return all >> -shift;
}

using Vector = std::vector<cpp_int>;
cpp_int dot(const Vector& a, const Vector& b) {
  cpp_int sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

cpp_int determinant(const std::vector<Vector>& m) {
  if (m.size() == 1) return m[0][0];
  cpp_int sum = 0;
  for (std::size_t j = 0; j < m.size(); ++j) {
    std::vector<Vector> minor;
    for (std::size_t i = 1; i < m.size(); ++i) {
      minor.push_back(m[i]);
      minor.back().erase(minor.back().begin() + static_cast<std::ptrdiff_t>(j));
    }
    const cpp_int part = m[0][j] * determinant(minor);
    sum += j % 2 == 0 ? part : -part;
  }
  return sum;
}

constexpr int kFlat = 2;

// kFlat if the corners are on a line, or in a plane: there is no such ball.
// The centre is the first corner and a sum of edges from it, such that its products with these are
// half of their squares: Cramer's rule for the Gram matrix.
template <std::size_t D, std::size_t N>
int oracle(const std::array<Point<D>, N>& corners, const Point<D>& p, double k) {
  constexpr int kLow = -220;
  const auto from_first = [&](const Point<D>& q) {
    Vector v;
    for (std::size_t i = 0; i < D; ++i)
      v.push_back(integer(q[i], kLow) - integer(corners[0][i], kLow));
    return v;
  };
  std::vector<Vector> edges, gram;
  for (std::size_t i = 1; i < N; ++i) edges.push_back(from_first(corners[i]));
  for (const Vector& a : edges) {
    gram.emplace_back();
    for (const Vector& b : edges) gram.back().push_back(dot(a, b));
  }
  const cpp_int twice = 2 * determinant(gram);
  if (twice == 0) return kFlat;
  Vector centre(D, 0);  // times `twice`
  for (std::size_t j = 0; j < edges.size(); ++j) {
    auto replaced = gram;
    for (std::size_t i = 0; i < edges.size(); ++i) replaced[i][j] = gram[i][i];
    const cpp_int share = determinant(replaced);
    for (std::size_t i = 0; i < D; ++i) centre[i] += share * edges[j][i];
  }
  Vector to_p = from_first(p);
  for (std::size_t i = 0; i < D; ++i) to_p[i] = to_p[i] * twice - centre[i];
  constexpr int kLowest = -70;  // of k
  const cpp_int factor = integer(k, kLowest);
  const cpp_int inside = factor * factor * dot(centre, centre), distance = dot(to_p, to_p) << 140;
  return inside.compare(distance);
}

// ---- calls for any number of corners ----

template <std::size_t D>
int call(const std::array<Point<D>, 2>& q, const Point<D>& p, double k) {
  return in_shrunken_ball(q[0], q[1], p, k);
}
template <std::size_t D>
int call(const std::array<Point<D>, 3>& q, const Point<D>& p, double k) {
  return in_shrunken_ball(q[0], q[1], q[2], p, k);
}
int call(const std::array<Point<3>, 4>& q, const Point<3>& p, double k) {
  return in_shrunken_ball(q[0], q[1], q[2], q[3], p, k);
}
template <std::size_t D>
int filter(const std::array<Point<D>, 2>& q, const Point<D>& p, double k) {
  return detail::in_shrunken_ball_filter<D>(q[0], q[1], p, k);
}
template <std::size_t D>
int filter(const std::array<Point<D>, 3>& q, const Point<D>& p, double k) {
  return detail::in_shrunken_ball_filter(q[0], q[1], q[2], p, k);
}
int filter(const std::array<Point<3>, 4>& q, const Point<3>& p, double k) {
  return detail::in_shrunken_ball_filter(q[0], q[1], q[2], q[3], p, k);
}

// Centre and radius, but for rounding.
template <std::size_t D, std::size_t N>
std::pair<Point<D>, double> ball(const std::array<Point<D>, N>& q) {
  std::array<std::array<long double, N>, N - 1> m{};
  const auto edge = [&](std::size_t i, std::size_t axis) {
    return static_cast<long double>(q[i + 1][axis]) - q[0][axis];
  };
  for (std::size_t i = 0; i + 1 < N; ++i) {
    for (std::size_t j = 0; j + 1 < N; ++j) {
      for (std::size_t axis = 0; axis < D; ++axis) m[i][j] += edge(i, axis) * edge(j, axis);
    }
    m[i][N - 1] = m[i][i] / 2;
  }
  for (std::size_t i = 0; i + 1 < N; ++i) {
    for (std::size_t k = 0; k + 1 < N; ++k) {
      if (k == i) continue;
      const long double factor = m[k][i] / m[i][i];
      for (std::size_t j = i; j < N; ++j) m[k][j] -= factor * m[i][j];
    }
  }
  Point<D> centre = q[0];
  long double r2 = 0;
  for (std::size_t axis = 0; axis < D; ++axis) {
    long double x = 0;
    for (std::size_t i = 0; i + 1 < N; ++i) x += m[i][N - 1] / m[i][i] * edge(i, axis);
    r2 += x * x;
    centre[axis] = static_cast<double>(centre[axis] + x);
  }
  return {centre, std::sqrt(static_cast<double>(r2))};
}

// Corners on a grid of 2^-bits, moved away from the origin, times a scale; p near the sphere.
template <std::size_t D, std::size_t N>
void try_near_sphere(Random& random, std::size_t cases) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> one(0, 1);
  std::size_t filtered = 0;
  std::array<std::size_t, 3> seen{};
  for (std::size_t n = 0; n < cases; ++n) {
    const double grid = std::ldexp(1, static_cast<int>(random() % 3 == 0 ? 4 : 10 + random() % 42));
    const double scale = std::ldexp(1, static_cast<int>(random() % 190) - 95);
    const double away = random() % 2 == 0 ? 0 : std::ldexp(1, static_cast<int>(random() % 30));
    const auto place = [&](double x) {
      x = std::round((x + away) * grid) / grid * scale;
      return std::abs(x) < 0x1p-100 ? 0 : x;
    };
    std::array<Point<D>, N> q;
    for (auto& corner : q) {
      for (double& x : corner) x = place(normal(random));
    }
    // Nearly on a line, or in a plane.
    const double flat = random() % 4 == 0 ? std::ldexp(1, -static_cast<int>(random() % 40)) : 1;
    for (std::size_t i = 0; N > 2 && flat < 1 && i < D; ++i) {
      q[N - 1][i] = q[0][i] + (q[1][i] - q[0][i]) * 0.4 + flat * (q[N - 1][i] - q[0][i]);
      if (std::abs(q[N - 1][i]) < 0x1p-100) q[N - 1][i] = 0;
    }
    constexpr std::array kFactors{0.5, 0.9, 0.95, 1.0, 0.6, 0x1p-10, 1 - 0x1p-53, 0.75};
    const double k = random() % 2 == 0 ? kFactors[random() % kFactors.size()]
                                       : 0x1p-9 + one(random) * (1 - 0x1p-9);
    const auto [centre, r] = ball(q);
    if (!std::isfinite(r) || r > 0x1p100 || r == 0) continue;
    Point<D> way;
    double length2 = 0;
    for (double& x : way) {
      x = normal(random);
      length2 += x * x;
    }
    Point<D> p;
    for (std::size_t i = 0; i < D; ++i) {
      p[i] = centre[i] + k * r / std::sqrt(length2) * way[i];
      for (int steps = static_cast<int>(random() % 4); steps > 0; --steps) {
        p[i] = std::nextafter(p[i], random() % 2 == 0 ? 1e300 : -1e300);
      }
      if (random() % 2 == 0) p[i] = std::round(p[i] / scale * grid) / grid * scale;
      if (std::abs(p[i]) < 0x1p-100) p[i] = 0;
    }
    if (std::any_of(p.begin(), p.end(), [](double x) { return std::abs(x) > 0x1p101; })) continue;
    int expected = 0;
    try {
      const int sign = call(q, p, k);
      expected = oracle(q, p, k);
      if (expected == kFlat) continue;
      if (sign != expected) {
        INFO("seed " << kSeed << " case " << n);
        CHECK(sign == expected);
      }
    } catch (const std::domain_error&) {  // more than 253 bits
      continue;
    }
    filtered += filter(q, p, k) != 0 ? 1 : 0;
    ++seen[static_cast<std::size_t>(expected + 1)];
  }
  // All three answers, with and without the filter.
  CHECK((seen[0] > cases / 10 && seen[2] > cases / 10));
  CHECK((filtered > cases / 20 && filtered < cases - cases / 20));
}

void try_all(std::size_t cases) {
  Random random(kSeed);
  SECTION("segments in the plane") { try_near_sphere<2, 2>(random, cases); }
  SECTION("segments in space") { try_near_sphere<3, 2>(random, cases); }
  SECTION("triangles in the plane") { try_near_sphere<2, 3>(random, cases); }
  SECTION("triangles in space") { try_near_sphere<3, 3>(random, cases); }
  SECTION("tetrahedra") { try_near_sphere<3, 4>(random, cases); }
}

}  // namespace

TEST_CASE("points near the spheres of shrunken balls are on the side that integers say") {
  try_all(20000);
}

TEST_CASE("points near the spheres of shrunken balls, a million of each kind", "[soak]") {
  try_all(1000000);
}

TEST_CASE(
    "points on the spheres of shrunken balls are on them, in every order and at every scale") {
  // Circumcentre 0, radius 5 (25 in space); 3/5 of it is 3 (15).
  for (const double scale : {0x1p-98, 0x1p-40, 1.0, 0x1p90}) {
    const auto at = [&](double x, double y) { return Point<2>{x * scale, y * scale}; };
    std::array<Point<2>, 3> q{at(5, 0), at(-3, 4), at(-3, -4)};
    std::sort(q.begin(), q.end());
    do {
      INFO(scale);
      for (const Point<2>& p : {at(3, 0), at(0, 3), at(-3, 0), at(0, -3)}) {
        CHECK(call(q, p, 0.6) == -1);  // the double next to 3/5 is less
        CHECK(call(q, p, std::nextafter(0.6, 1)) == 1);
        CHECK(call(q, p, 0.75) == 1);
        CHECK(call(q, p, 0.5) == -1);
      }
      CHECK(call(q, at(4, 3), 1) == 0);
      CHECK(call(q, at(0, 2.5), 0.5) == 0);
      CHECK(call(q, at(1.5, 2), 0.5) == 0);
      CHECK(call(q, at(0, 0), 0) == 0);
      CHECK(call(q, at(0, 0), 0x1p-10) == 1);
      CHECK(call(q, at(0x1p-40, 0), 0) == -1);
      const std::array<Point<2>, 2> segment{at(3, 4), at(-3, -4)};
      CHECK(call(segment, at(0, 5), 1) == 0);
      CHECK(call(segment, at(0, 2.5), 0.5) == 0);
      CHECK(call(segment, at(std::nextafter(2.5, 3), 0), 0.5) == -1);
      CHECK(call(segment, at(std::nextafter(2.5, 2), 0), 0.5) == 1);
    } while (std::next_permutation(q.begin(), q.end()));
    // On the sphere of radius 3 around (1, 1, 1).
    const auto in = [&](double x, double y, double z) {
      return Point<3>{(1 + x) * scale, (1 + y) * scale, (1 + z) * scale};
    };
    std::array<Point<3>, 4> s{in(1, 2, 2), in(-2, 1, -2), in(2, -2, -1), in(-3, 0, 0)};
    std::sort(s.begin(), s.end());
    do {
      CHECK(call(s, in(0, 0, 3), 1) == 0);
      CHECK(call(s, in(0, 1.5, 0), 0.5) == 0);
      CHECK(call(s, in(0.5, 1, 1), 0.5) == 0);
      CHECK(call(s, in(0.5, 1, 1 - 0x1p-50), 0.5) == 1);
      CHECK(call(s, in(0, 0, 0.75), 0.25) == 0);
      // A triangle with a great circle around it, and one with a lesser one.
      const std::array<Point<3>, 3> great{in(1, 2, 2), in(-1, -2, -2), in(2, -2, 1)};
      CHECK(call(great, in(0, 0, 3), 1) == 0);
      CHECK(call(great, in(0, -1.5, 0), 0.5) == 0);
      const std::array<Point<3>, 3> lesser{in(0, 2, 0), in(2, 0, 0), in(-2, 0, 0)};
      CHECK(call(lesser, in(0, 0, 1), 0.5) == 0);
      CHECK(call(lesser, in(0, 0, -2), 1) == 0);
      CHECK(call(lesser, in(0, 0, 1 + 0x1p-50), 0.5) == -1);
    } while (std::next_permutation(s.begin(), s.end()));
  }
}

TEST_CASE("shrunken balls agree with the balls of simplices, and grow with the factor") {
  Random random(kSeed);
  std::uniform_int_distribution<int> small(-4, 4);
  for (int n = 0; n < 20000; ++n) {
    std::array<Point<3>, 5> q;
    for (auto& p : q) p = {1.0 * small(random), 1.0 * small(random), 1.0 * small(random)};
    const auto& [a, b, c, d, p] = q;
    const int orientation = mesher::predicates::orient3d(a, b, c, d);
    if (orientation != 0) {
      CHECK(in_shrunken_ball(a, b, c, d, p, 1) ==
            orientation * mesher::predicates::insphere(a, b, c, d, p));
    }
    const auto flat = [](const Point<3>& x) { return Point<2>{x[0], x[1]}; };
    const Point<2> e = flat(a), f = flat(b), g = flat(c), h = flat(p);
    const int turn = mesher::predicates::orient2d(e, f, g);
    if (turn != 0) {
      CHECK(in_shrunken_ball(e, f, g, h, 1) == turn * mesher::predicates::incircle(e, f, g, h));
      int last = -1;
      for (const double k : {0.0, 0x1p-10, 0.1, 0.3, 0.5, 0.7, 0.9, 1 - 0x1p-53, 1.0}) {
        const int sign = in_shrunken_ball(e, f, g, h, k);
        CHECK(sign >= last);
        last = sign;
      }
    }
    // An edge's smallest ball: right angles are on it.
    const double right = (a[0] - p[0]) * (b[0] - p[0]) + (a[1] - p[1]) * (b[1] - p[1]) +
                         (a[2] - p[2]) * (b[2] - p[2]);
    CHECK(in_shrunken_ball(a, b, p, 1) == -detail::sign(right));
  }
  CHECK(in_shrunken_ball(Point<2>{1, 2}, Point<2>{1, 2}, Point<2>{1, 2}, 0.5) == 0);
  CHECK(in_shrunken_ball(Point<2>{1, 2}, Point<2>{1, 2}, Point<2>{1, 2.5}, 0.5) == -1);
}

TEST_CASE("factors that shrunken balls do not take are refused where they would count") {
  const Point<2> a{0, 0}, b{2, 0}, p{1, 0};
  CHECK_THROWS_AS(detail::in_shrunken_ball_exact<2>(a, b, p, 0x1p-11), std::domain_error);
  CHECK_THROWS_AS(detail::in_shrunken_ball_exact<2>(a, b, p, 1.5), std::domain_error);
  CHECK_THROWS_AS(detail::in_shrunken_ball_exact<2>(a, b, p, -0.5), std::domain_error);
}
