// Predicates in space against rational arithmetic, at every scale, and the perturbed one against
// points that are lifted indeed.
#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "mesher/predicates.hpp"

namespace {

namespace detail = mesher::predicates::detail;
using boost::multiprecision::cpp_int;
using mesher::predicates::insphere;
using mesher::predicates::insphere_perturbed;
using mesher::predicates::orient3d;
using Exact = boost::multiprecision::cpp_rational;
using P = mesher::Point<3>;
using Five = std::array<P, 5>;
using Random = std::mt19937_64;

constexpr std::uint64_t kSeed = 20240229;

// ---- the oracle: determinants by elimination ----

template <std::size_t N>
int determinant_sign(std::array<std::array<Exact, N>, N> m) {
  int sign = 1;
  for (std::size_t i = 0; i < N; ++i) {
    std::size_t pivot = i;
    while (pivot < N && m[pivot][i] == 0) ++pivot;
    if (pivot == N) return 0;
    if (pivot != i) {
      std::swap(m[pivot], m[i]);
      sign = -sign;
    }
    sign *= m[i][i].sign();
    for (std::size_t k = i + 1; k < N; ++k) {
      const Exact factor = m[k][i] / m[i][i];
      for (std::size_t j = i; j < N; ++j) m[k][j] -= factor * m[i][j];
    }
  }
  return sign;
}

std::array<Exact, 3> exact(const P& p) { return {Exact(p[0]), Exact(p[1]), Exact(p[2])}; }

// The determinant of b - a, c - a, d - a.
int exact_orient3d(const P& a, const P& b, const P& c, const P& d) {
  std::array<std::array<Exact, 3>, 3> rows;
  const std::array others{exact(b), exact(c), exact(d)};
  const auto from = exact(a);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) rows[i][j] = others[i][j] - from[j];
  }
  return determinant_sign(rows);
}

// With rows x, y, z, height, 1. Positive for e inside of a positive abcd: its height is below the
// plane of the others then.
int exact_lifted(const Five& q, const std::array<Exact, 5>& height) {
  std::array<std::array<Exact, 5>, 5> rows;
  for (std::size_t i = 0; i < 5; ++i) {
    const auto p = exact(q[i]);
    rows[i] = {p[0], p[1], p[2], height[i], Exact(1)};
  }
  return -determinant_sign(rows);
}

std::array<Exact, 5> paraboloid(const Five& q) {
  std::array<Exact, 5> height;
  for (std::size_t i = 0; i < 5; ++i) {
    const auto p = exact(q[i]);
    height[i] = p[0] * p[0] + p[1] * p[1] + p[2] * p[2];
  }
  return height;
}

int exact_insphere(const Five& q) { return exact_lifted(q, paraboloid(q)); }

/// With perturbations that are there: 2^-80 for the greatest point, its powers for the next ones.
int exact_insphere_perturbed(const Five& q) {
  std::array<Exact, 5> height = paraboloid(q);
  for (std::size_t i = 0; i < 5; ++i) {
    const auto greater = std::count_if(q.begin(), q.end(), [&](const P& p) { return p > q[i]; });
    height[i] += Exact(cpp_int(1), cpp_int(1) << static_cast<int>(80 * (greater + 1)));
  }
  return exact_lifted(q, height);
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
Five five_of(Make make) {
  return {make(), make(), make(), make(), make()};
}

Five uniform_five(Random& random) {
  return five_of([&] {
    return P{uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1)};
  });
}

/// Points of a plane, moved by up to two ulps.
Five nearly_coplanar(Random& random) {
  const Five frame = uniform_five(random);
  return five_of([&] {
    const double s = uniform(random, -1, 1), t = uniform(random, -1, 1);
    P p;
    for (std::size_t i = 0; i < 3; ++i) {
      p[i] = moved_by_ulps(frame[0][i] + s * frame[1][i] + t * frame[2][i], integer(random, -2, 2));
    }
    return p;
  });
}

/// Points of a sphere, moved by up to two ulps; centres near and far.
Five nearly_cospherical(Random& random) {
  const double far = std::ldexp(1.0, integer(random, -20, 4)), r = uniform(random, 0.1, 2);
  const P centre{far * uniform(random, -1, 1), far * uniform(random, -1, 1), far};
  return five_of([&] {
    const double angle = uniform(random, 0, 6.283185307179586), z = uniform(random, -1, 1);
    const double flat = std::sqrt(1 - z * z);
    const std::array unit{flat * std::cos(angle), flat * std::sin(angle), z};
    P p;
    for (std::size_t i = 0; i < 3; ++i) {
      p[i] = moved_by_ulps(centre[i] + r * unit[i], integer(random, -2, 2));
    }
    return p;
  });
}

Five on_grid(Random& random) {
  const double step = std::ldexp(1.0, integer(random, -97, 97));
  return five_of([&] {
    return P{step * integer(random, -2, 2), step * integer(random, -2, 2),
             step * integer(random, -2, 2)};
  });
}

/// Next to 2^-160 in steps of 2^-212: the smallest differences that there can be.
Five least_steps(Random& random) {
  const auto coordinate = [&] { return moved_by_ulps(0x1p-160, integer(random, 0, 4)); };
  return five_of([&] { return P{coordinate(), coordinate(), coordinate()}; });
}

double any_magnitude(Random& random, int low, int high) {
  if (integer(random, 0, 15) == 0) return 0;
  const double sign = integer(random, 0, 1) == 0 ? -1 : 1;
  if (integer(random, 0, 15) == 0) return sign * std::ldexp(1.0, high);
  return sign * std::ldexp(uniform(random, 1, 2), integer(random, low, high - 1));
}

Five any_magnitudes(Random& random) {
  const int low = integer(random, -100, 99), high = integer(random, low + 1, 100);
  std::array<double, 3> some;
  for (double& x : some) x = any_magnitude(random, low, high);
  const auto coordinate = [&] {
    return integer(random, 0, 1) == 0 ? some[static_cast<std::size_t>(integer(random, 0, 2))]
                                      : any_magnitude(random, low, high);
  };
  return five_of([&] { return P{coordinate(), coordinate(), coordinate()}; });
}

/// Corners of a box of any extent, on one sphere; one coordinate perhaps moved by an ulp.
Five box_corners(Random& random) {
  std::array<std::array<double, 2>, 3> sides;
  for (auto& side : sides) side = {any_magnitude(random, -99, 99), any_magnitude(random, -99, 99)};
  Five q = five_of([&] {
    const auto end = [&](std::size_t i) { return sides[i][random() % 2]; };
    return P{end(0), end(1), end(2)};
  });
  double& moved = q[static_cast<std::size_t>(integer(random, 0, 4))]
                   [static_cast<std::size_t>(integer(random, 0, 2))];
  if (moved != 0) moved = moved_by_ulps(moved, integer(random, -1, 1));
  return q;
}

/// The ends of the range only: as many bits and as large a determinant as there can be.
Five at_the_limits(Random& random) {
  constexpr std::array kEnds{0.0, 0x1p100, 0x1.fffffffffffffp99, 0x1p-100, 0x1.0000000000001p-100};
  const auto end = [&] { return (integer(random, 0, 1) == 0 ? -1 : 1) * kEnds[random() % 5]; };
  return five_of([&] { return P{end(), end(), end()}; });
}

using Make = Five (*)(Random&);
constexpr std::array<std::pair<const char*, Make>, 8> kKinds{{
    {"uniform", uniform_five},
    {"nearly coplanar", nearly_coplanar},
    {"nearly cospherical", nearly_cospherical},
    {"grid", on_grid},
    {"least steps", least_steps},
    {"any magnitudes", any_magnitudes},
    {"box corners", box_corners},
    {"limits of the range", at_the_limits},
}};

template <class Check>
void for_each_kind(int count, Check check) {
  for (const auto& [name, make] : kKinds) {
    INFO("points: " << name << ", seed " << kSeed);
    Random random(kSeed);
    for (int i = 0; i < count; ++i) {
      const Five q = make(random);
      CAPTURE(i);
      check(q);
    }
  }
}

Five scaled(Five q, double factor) {
  for (P& p : q) {
    for (double& x : p) x *= factor;
  }
  return q;
}

int orient(const Five& q) { return orient3d(q[0], q[1], q[2], q[3]); }
int inside(const Five& q) { return insphere(q[0], q[1], q[2], q[3], q[4]); }
int perturbed(const Five& q) { return insphere_perturbed(q[0], q[1], q[2], q[3], q[4]); }

bool usable_for_perturbation(const Five& q) {
  if (std::set<P>(q.begin(), q.end()).size() != 5) return false;
  for (std::size_t left_out = 0; left_out < 5; ++left_out) {
    Five four = q;
    std::swap(four[left_out], four[4]);
    if (orient(four) != 0) return true;
  }
  return false;
}

template <class Predicate>
void require_alternating(const Five& q, Predicate predicate) {
  const int sign = predicate(q);
  for (std::size_t i = 0; i < 5; ++i) {
    for (std::size_t k = i + 1; k < 5; ++k) {
      Five swapped = q;
      std::swap(swapped[i], swapped[k]);
      REQUIRE(predicate(swapped) == -sign);
    }
  }
}

}  // namespace

TEST_CASE("orient3d is the sign of the rational volume, at every scale", "[predicates]") {
  for_each_kind(1500, [](const Five& q) {
    const int sign = exact_orient3d(q[0], q[1], q[2], q[3]);
    REQUIRE(orient(q) == sign);
    REQUIRE(detail::orient3d_exact(q[0], q[1], q[2], q[3]) == sign);
  });
}

TEST_CASE("insphere is the sign of the rational determinant, at every scale", "[predicates]") {
  for_each_kind(1000, [](const Five& q) {
    const int sign = exact_insphere(q);
    REQUIRE(inside(q) == sign);
    REQUIRE(detail::insphere_exact(q[0], q[1], q[2], q[3], q[4]) == sign);
  });
}

TEST_CASE("the meaning of the signs in space is as documented", "[predicates]") {
  const P o{0, 0, 0}, x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  REQUIRE(orient3d(o, x, y, z) == 1);
  REQUIRE(orient3d(o, y, x, z) == -1);
  REQUIRE(orient3d(o, x, y, {3, 4, 0}) == 0);
  REQUIRE(insphere(o, x, y, z, {0.5, 0.5, 0.5}) == 1);
  REQUIRE(insphere(o, y, x, z, {0.5, 0.5, 0.5}) == -1);
  REQUIRE(insphere(o, x, y, z, {2, 2, 2}) == -1);
  REQUIRE(insphere(o, x, y, z, {1, 1, 1}) == 0);
  REQUIRE(insphere_perturbed(o, x, y, z, {1, 1, 1}) == -1);  // the greatest is outside
}

TEST_CASE("the kinds of points in space reach zero, both signs, filter and exact way",
          "[predicates]") {
  std::map<int, int> orientations, spheres, undecided;
  for_each_kind(1000, [&](const Five& q) {
    ++orientations[orient(q)];
    ++spheres[inside(q)];
    ++undecided[detail::insphere_filter(q[0], q[1], q[2], q[3], q[4]) == 0 ? 1 : 0];
  });
  for (const auto& counts : {orientations, spheres}) {
    for (const int sign : {-1, 0, 1}) REQUIRE(counts.at(sign) > 300);
  }
  for (const int which : {0, 1}) REQUIRE(undecided.at(which) > 1000);
}

TEST_CASE("the filters in space decide more than 99.99% of uniform points, at every scale",
          "[predicates]") {
  for (const int shift : {-159, -100, 0, 100}) {
    INFO("scale 2^" << shift << ", seed " << kSeed);
    Random random(kSeed);
    constexpr int kCount = 100000;
    int undecided_orient = 0, undecided_insphere = 0;
    for (int i = 0; i < kCount; ++i) {
      const Five q = scaled(uniform_five(random), std::ldexp(1.0, shift));
      undecided_orient += detail::orient3d_filter(q[0], q[1], q[2], q[3]) == 0 ? 1 : 0;
      undecided_insphere += detail::insphere_filter(q[0], q[1], q[2], q[3], q[4]) == 0 ? 1 : 0;
    }
    CHECK(undecided_orient < kCount / 10000);
    CHECK(undecided_insphere < kCount / 10000);
  }
}

TEST_CASE("the error bounds of the filters in space cover their derivation", "[predicates]") {
  const Exact u(detail::kUnitRoundoff);
  const auto power = [](const Exact& x, int n) {
    Exact result = 1;
    while (n-- > 0) result *= x;
    return result;
  };
  const auto needed = [&](int k, int m) {
    return Exact((power(1 + u, k) - 1) / power(1 - u, m + 2));
  };
  REQUIRE(Exact(detail::kOrient3dBound) >= needed(7, 8));
  REQUIRE(Exact(detail::kInsphereBound) >= needed(15, 17));
}

TEST_CASE("scaling by a power of two and swapping points act as in space", "[predicates]") {
  for_each_kind(200, [](const Five& q) {
    require_alternating(q, inside);
    Five swapped = q;
    std::swap(swapped[1], swapped[2]);
    REQUIRE(orient(swapped) == -orient(q));
  });
  for (const Make make : {uniform_five, nearly_coplanar, nearly_cospherical}) {
    Random random(kSeed);
    for (int i = 0; i < 300; ++i) {
      const Five q = make(random);
      for (const int shift : {-90, -30, 50, 99}) {
        const Five s = scaled(q, std::ldexp(1.0, shift));
        CAPTURE(i, shift, kSeed);
        REQUIRE(orient(s) == orient(q));
        REQUIRE(inside(s) == inside(q));
      }
    }
  }
}

TEST_CASE("the perturbed predicate in space is never 0, alternates, and agrees with insphere",
          "[predicates]") {
  int ties = 0;
  for_each_kind(1000, [&](const Five& q) {
    if (!usable_for_perturbation(q)) return;
    const int sign = inside(q);
    REQUIRE(perturbed(q) != 0);
    if (sign != 0) REQUIRE(perturbed(q) == sign);
    ties += sign == 0 ? 1 : 0;
    require_alternating(q, perturbed);
  });
  REQUIRE(ties > 100);
}

TEST_CASE("the perturbed predicate in space is insphere of points lifted a little higher",
          "[predicates]") {
  Random random(kSeed);
  int ties = 0, flat = 0;
  for (int i = 0; i < 4000; ++i) {
    const Five q = five_of([&] {
      return P{double(integer(random, 0, 2)), double(integer(random, 0, 2)),
               double(integer(random, 0, 2))};
    });
    if (!usable_for_perturbation(q)) continue;
    CAPTURE(i, kSeed);
    REQUIRE(perturbed(q) == exact_insphere_perturbed(q));
    if (inside(q) != 0) continue;
    ++ties;
    Five rest = q;
    std::swap(*std::max_element(rest.begin(), rest.end()), rest[4]);
    flat += orient(rest) == 0 ? 1 : 0;
  }
  REQUIRE(ties > 100);
  REQUIRE(flat > 20);  // four in a plane below the greatest: the next one decides
}

TEST_CASE("where the greatest point is the tip of a pyramid the next point decides the tie",
          "[predicates]") {
  const P a{0, 0, 0}, b{0, 1, 0}, c{0, 1, 1}, d{0, 0, 1}, tip{1, 0, 0};  // of a cube
  REQUIRE(orient3d(a, b, c, d) == 0);
  REQUIRE(insphere(a, b, c, tip, d) == 0);
  for (const Five& q : {Five{a, b, c, tip, d}, Five{tip, a, b, c, d}, Five{a, b, c, d, tip}}) {
    REQUIRE(perturbed(q) != 0);
    REQUIRE(perturbed(q) == exact_insphere_perturbed(q));
  }
}

TEST_CASE("points of a rounded grid have the signs of rational arithmetic", "[predicates]") {
  Random random(kSeed);
  INFO("seed " << kSeed);
  // Two or three values an axis: corners of boxes, and what is nearly that.
  int ties = 0, flat = 0;
  for (int i = 0; i < 3000; ++i) {
    const std::uint64_t values = 2 + random() % 2;
    Five q;
    for (P& p : q) {
      for (double& x : p) x = static_cast<double>(random() % values + 3) / 49;
    }
    if (std::set<P>(q.begin(), q.end()).size() < q.size()) continue;
    const int volume = exact_orient3d(q[0], q[1], q[2], q[3]);
    const int sign = exact_insphere(q);
    CHECK(detail::orient3d_exact(q[0], q[1], q[2], q[3]) == volume);
    CHECK(detail::insphere_exact(q[0], q[1], q[2], q[3], q[4]) == sign);
    ties += sign == 0;
    flat += volume == 0;
  }
  CHECK(ties > 100);
  CHECK(flat > 100);
}

TEST_CASE("coordinates in space too far apart for the exact integers are refused", "[predicates]") {
  const P a{0x1p-200, 0x1p-200, 0}, b{1, 1, 1}, c{0x1p100, 0x1p100, 1}, d{0, 0, 1};
  REQUIRE_THROWS_AS(detail::orient3d_exact(a, b, c, d), std::domain_error);
}
