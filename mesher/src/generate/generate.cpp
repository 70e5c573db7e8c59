// Families of points, computed the same on every machine.
#include "mesher/extra/generate.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <unordered_set>

#include "generate/on_circle.hpp"
#include "sac/check.hpp"
#include "text/text.hpp"

namespace mesher {
namespace {

constexpr double kLn2 = 0.6931471805599453;

// ln x for x in (0, 1]: with x = m 2^e, ln m = 2 artanh s, s = (m-1)/(m+1), |s| <= 1/3; the first
// term left out is below 3^-41 / 41, under half a unit of the last place of any result.
double natural_log(double x) {
  int exponent = 0;
  const double m = std::frexp(x, &exponent);
  const double s = (m - 1) / (m + 1);
  double power = s, sum = 0;
  for (int k = 1; k < 40; k += 2, power *= s * s) sum += power / k;
  return 2 * sum + exponent * kLn2;
}

// A normal deviate by Marsaglia's polar method (SIAM Review 6, 1964).
double normal(SplitMix64& random) {
  double u = 0, square = 0;
  do {
    u = 2 * random.unit() - 1;
    const double v = 2 * random.unit() - 1;
    square = u * u + v * v;
  } while (square >= 1 || square == 0);
  return u * std::sqrt(-2 * natural_log(square) / square);
}

template <int D>
struct PointHash {
  std::size_t operator()(const Point<D>& p) const {
    std::uint64_t h = 0;
    for (const double x : p) h = SplitMix64(h ^ std::bit_cast<std::uint64_t>(x)).bits();
    return static_cast<std::size_t>(h);
  }
};

// n points from `draw`, those left out that are no input or came before.
template <int D, class Draw>
std::vector<Point<D>> draw_distinct(std::size_t n, Draw draw) {
  std::unordered_set<Point<D>, PointHash<D>> seen;
  std::vector<Point<D>> points;
  while (points.size() < n) {
    Point<D> p = draw();
    for (double& x : p) x += 0.0;  // no negative zero: it hashes apart from zero
    const bool usable = std::all_of(p.begin(), p.end(), text::is_coordinate);
    if (usable && seen.insert(p).second) points.push_back(p);
  }
  return points;
}

template <int D>
Point<D> uniform_point(SplitMix64& random) {
  Point<D> p;
  for (double& x : p) x = random.unit();
  return p;
}

template <int D>
Point<D> normal_point(SplitMix64& random, const Point<D>& centre, double deviation) {
  Point<D> p = centre;
  for (double& x : p) x += deviation * normal(random);
  return p;
}

template <int D>
struct Cluster {
  Point<D> centre;
  double deviation;
};

template <int D>
std::vector<Cluster<D>> make_clusters(std::size_t n, SplitMix64& random) {
  const double count = std::sqrt(static_cast<double>(n)) / 4;
  std::vector<Cluster<D>> clusters(std::max<std::size_t>(1, static_cast<std::size_t>(count)));
  for (auto& cluster : clusters) {
    cluster.centre = uniform_point<D>(random);
    cluster.deviation = std::ldexp(1.0, -3 - static_cast<int>(random.below(6)));
  }
  return clusters;
}

template <int D>
std::vector<Point<D>> grid(std::size_t n) {
  std::size_t side = 0;
  const auto places = [&] { return D == 2 ? side * side : side * side * side; };
  while (places() < n) ++side;
  std::vector<Point<D>> points;
  for (std::size_t i = 0; i < n; ++i) {
    std::size_t rest = i;
    Point<D> p;
    for (double& x : p) {
      x = static_cast<double>(rest % side);
      rest /= side;
    }
    points.push_back(p);
  }
  return points;
}

// i of n equal parts of 1.
double fraction(std::size_t i, std::size_t n) {
  return static_cast<double>(i) / static_cast<double>(n);
}

// In the plane the line is half as long as the circle is wide, so that they stay apart.
template <int D>
std::vector<Point<D>> line_circle(std::size_t n) {
  const double half_length = D == 2 ? 0.5 : 1.0;
  const std::size_t on_line = n / 2;
  std::vector<Point<D>> points;
  for (std::size_t i = 0; i < on_line; ++i) {
    Point<D> p{};
    p[D == 2 ? 0 : 2] = half_length * (2 * fraction(i, std::max<std::size_t>(1, on_line - 1)) - 1);
    points.push_back(p);
  }
  for (std::size_t i = 0; i < n - on_line; ++i) {
    const Point<2> c = on_circle(fraction(i, n - on_line));
    Point<D> p{};
    std::copy(c.begin(), c.end(), p.begin());
    points.push_back(p);
  }
  return points;
}

// Radius and angle grow with the square root of i: equal steps along the curve.
template <int D>
std::vector<Point<D>> spiral(std::size_t n) {
  constexpr double kTurns = 8;
  std::vector<Point<D>> points;
  for (std::size_t i = 0; i < n; ++i) {
    const double radius = std::sqrt(fraction(i, n));
    const Point<2> c = on_circle(kTurns * radius);
    Point<D> p{radius * c[0], radius * c[1]};
    if constexpr (D == 3) p[2] = fraction(i, n);
    points.push_back(p);
  }
  return points;
}

// On the unit sphere: a normal deviate has no preferred direction.
template <int D>
Point<D> sphere_point(SplitMix64& random) {
  Point<D> p = normal_point<D>(random, Point<D>{}, 1.0);
  double square = 0;
  for (const double x : p) square += x * x;
  for (double& x : p) x /= std::sqrt(square);
  return p;
}

// The i-th of m places on the unit sphere that are nowhere near each other (a golden spiral), after
// some golden parts of a turn.
template <int D>
Point<D> even_direction(std::size_t i, std::size_t m, std::size_t turns) {
  constexpr double kGolden = 0.6180339887498949;
  const double turned = kGolden * static_cast<double>(turns);
  if constexpr (D == 2) {
    return on_circle(turned + fraction(i, m));
  } else {
    const double z = 1 - fraction(2 * i + 1, m);
    const Point<2> c = on_circle(turned + kGolden * static_cast<double>(i));
    const double r = std::sqrt(1 - z * z);
    return {r * c[0], r * c[1], z};
  }
}

// How many spheres n points are spread over. Neighbours on the innermost, of radius r and m points,
// are 3 r / sqrt(m) apart, in the plane 6 r / m: the last of s spheres has the radius 2^(1-s), and
// 2^(s-1) sqrt(m) is to be about 2^42, or 2^(s-1) m 2^43. Then the least distance is some 2^-40,
// and 10^12 times that is less than the largest, 2.
template <int D>
std::size_t spheres_for(std::size_t n) {
  constexpr int kMost = 44;
  const auto exceeds = [&](int spheres) {
    const double m = std::ceil(static_cast<double>(n) / spheres);
    return std::ldexp(D == 2 ? m : std::sqrt(m), spheres - 1) > (D == 2 ? 0x1p43 : 0x1p42);
  };
  int spheres = kMost;
  while (spheres > 1 && exceeds(spheres)) --spheres;
  return static_cast<std::size_t>(spheres);
}

template <int D>
std::vector<Point<D>> spread(std::size_t n) {
  const std::size_t spheres = spheres_for<D>(n);
  std::vector<Point<D>> points;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t sphere = i % spheres;
    const std::size_t on_it = n / spheres + (sphere < n % spheres ? 1 : 0);
    Point<D> p = even_direction<D>(i / spheres, on_it, sphere);
    for (double& x : p) x = std::ldexp(x, -static_cast<int>(sphere)) + 0.0;
    points.push_back(p);
  }
  return points;
}

}  // namespace

std::optional<PointKind> point_kind(std::string_view name) {
  constexpr std::string_view kNames[] = {"uniform",     "gaussian", "clusters", "grid",
                                         "line-circle", "spiral",   "sphere",   "spread"};
  const auto found = std::find(std::begin(kNames), std::end(kNames), name);
  if (found == std::end(kNames)) return std::nullopt;
  return static_cast<PointKind>(found - std::begin(kNames));
}

template <int D>
std::vector<Point<D>> generate_points(PointKind kind, std::size_t n, std::uint64_t seed) {
  SplitMix64 random(seed);
  switch (kind) {
    case PointKind::uniform:
      return draw_distinct<D>(n, [&] { return uniform_point<D>(random); });
    case PointKind::gaussian:
      return draw_distinct<D>(n, [&] { return normal_point<D>(random, Point<D>{}, 1.0); });
    case PointKind::clusters: {
      const auto clusters = make_clusters<D>(n, random);
      return draw_distinct<D>(n, [&] {
        const Cluster<D>& cluster = clusters[random.below(clusters.size())];
        return normal_point<D>(random, cluster.centre, cluster.deviation);
      });
    }
    case PointKind::grid:
      return grid<D>(n);
    case PointKind::line_circle:
      return line_circle<D>(n);
    case PointKind::spiral:
      return spiral<D>(n);
    case PointKind::sphere:
      return draw_distinct<D>(n, [&] { return sphere_point<D>(random); });
    case PointKind::spread:
      return spread<D>(n);
  }
  return {};
}

std::vector<Point<2>> generate_quadratic(std::size_t n) {
  SAC_EXPECTS(n >= 5);
  std::vector<Point<2>> points;
  double y = 0;
  for (double gap = 1; points.size() < n - 3; y += gap, gap *= 1 + 0x1p-20)
    points.push_back({0, y});
  // A little nearer than the off-centre of the first two.
  points.push_back({(1 - 0x1p-13) * (std::sqrt(2.0) + std::sqrt(1.75)), 0.5});
  points.push_back({8 * y, -y / 2});
  points.push_back({8 * y, 1.5 * y});
  return points;
}

template std::vector<Point<2>> generate_points<2>(PointKind, std::size_t, std::uint64_t);
#ifndef MESHER_PLANE_ONLY
template std::vector<Point<3>> generate_points<3>(PointKind, std::size_t, std::uint64_t);
#endif

}  // namespace mesher
