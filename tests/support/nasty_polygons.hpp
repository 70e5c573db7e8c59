// Loops that are hard to look things up in, some of them no polygons at all; and what a look at all
// edges says of them.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "polygons.hpp"

namespace support {

using Loop3 = std::vector<Point<3>>;

/// A comb of about n corners, turned by an angle: long teeth, side by side.
inline Loop3 comb(std::size_t n, double angle) {
  const std::size_t teeth = n / 4;
  Loop3 loop;
  const auto add = [&](double x, double y) {
    const double c = std::cos(angle), s = std::sin(angle);
    loop.push_back({c * x - s * y, s * x + c * y, 0});
  };
  for (std::size_t i = 0; i < teeth; ++i) {
    const double x = static_cast<double>(i) / static_cast<double>(teeth);
    const double wide = 0.4 / static_cast<double>(teeth);
    add(x, 0), add(x, 1), add(x + wide, 1), add(x + wide, 0);
  }
  add(1, -0.1), add(0, -0.1);
  return loop;
}

/// A round loop of n corners that is no circle.
inline Loop3 bean(std::size_t n, const Point<2>& center, double radius) {
  Loop3 loop;
  for (std::size_t i = 0; i < n; ++i) {
    const double at = 6.283185307179586 * static_cast<double>(i) / static_cast<double>(n);
    const double r = radius * (0.8 + 0.2 * std::sin(3 * at));
    loop.push_back({center[0] + r * std::cos(at), center[1] + r * std::sin(at), 0});
  }
  return loop;
}

/// A square with n / 4 square holes in rows.
inline Loops sieve(std::size_t n) {
  Loops loops = {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}};
  const auto rows = static_cast<std::size_t>(std::sqrt(static_cast<double>(n) / 4));
  const double step = 1 / static_cast<double>(rows + 1);
  for (std::size_t i = 1; i <= rows * rows; ++i) {
    const double x = step * static_cast<double>(1 + (i - 1) % rows);
    const double y = step * static_cast<double>(1 + (i - 1) / rows), r = step / 4;
    loops.push_back({{x - r, y - r, 0}, {x + r, y - r, 0}, {x + r, y + r, 0}, {x - r, y + r, 0}});
  }
  return loops;
}

/// A corridor that winds inward, with so many corners, of right angles.
inline Loop3 spiral(std::size_t n) {
  Loop3 out, back;
  const std::size_t half = n / 2;
  Point<2> at{0, 0};
  for (std::size_t i = 0; i < half; ++i) {
    const double length = static_cast<double>(half - i) / static_cast<double>(half);
    constexpr double kAlong[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    at = {at[0] + length * kAlong[i % 4][0], at[1] + length * kAlong[i % 4][1]};
    constexpr double kIn[4][2] = {{-1, 1}, {-1, -1}, {1, -1}, {1, 1}};
    const double wide = 0.5 / static_cast<double>(half);
    out.push_back({at[0], at[1], 0});
    back.push_back({at[0] + wide * kIn[i % 4][0], at[1] + wide * kIn[i % 4][1], 0});
  }
  out.insert(out.end(), back.rbegin(), back.rend());
  return out;
}

/// Corners of a small lattice, so that edges cross, touch, overlap and go back on themselves.
inline Loop3 lattice_walk(mesher::SplitMix64& random, std::size_t n) {
  Loop3 loop;
  for (std::size_t i = 0; i < n; ++i) {
    loop.push_back(
        {static_cast<double>(random.below(9)) / 8, static_cast<double>(random.below(9)) / 8, 0});
  }
  return loop;
}

/// With corners in the middle of its edges, and slender spikes on some.
inline Loop3 with_spikes(mesher::SplitMix64& random, const Loop3& loop) {
  Loop3 all;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Point<3>&a = loop[i], &b = loop[(i + 1) % loop.size()];
    const Point<3> middle{(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, 0};
    all.push_back(a);
    all.push_back(middle);
    if (random.below(4) != 0) continue;
    const double thin = std::ldexp(random.unit(), -static_cast<int>(random.below(50)));
    all.push_back({middle[0] * 1.5, middle[1] * 1.5, 0});
    all.push_back({middle[0] + thin * (b[0] - a[0]) / 3, middle[1] + thin * (b[1] - a[1]) / 3, 0});
  }
  return all;
}

/// One of all kinds.
inline Loops nasty_loops(mesher::SplitMix64& random) {
  const std::size_t n = 3 + random.below(200);
  switch (random.below(8)) {
    case 0:
      return {comb(n + 8, 7 * random.unit())};
    case 1:
      return {bean(n, {0, 0}, 1), bean(n, {0.1, 0}, 0.5), random_star(random, {0.1, 0}, 0.2, 20)};
    case 2:
      return sieve(n + 4);
    case 3:
      return {spiral(n + 8)};
    case 4:
      return {lattice_walk(random, n)};
    case 5:
      return {lattice_walk(random, n), lattice_walk(random, 3 + random.below(20)),
              lattice_walk(random, 3 + random.below(20))};
    case 6:
      return {with_spikes(random, random_star(random, {0, 0}, 1, n))};
    default:
      return {random_star(random, {0, 0}, 1, n), bean(3 + random.below(40), {0, 0}, 0.2)};
  }
}

// --- By looking at all -----------------------------------------------------------------------

namespace naive {

using mesher::detail::Polygon;

/// Whether the ray crosses an odd number of the edges of loops [from, to).
inline bool is_around(const Polygon& f, const Point<2>& uv, std::size_t from, std::size_t to) {
  bool around = false;
  for (std::size_t loop = from; loop < to; ++loop) {
    std::uint32_t last = f.loop_end[loop] - 1;
    for (std::uint32_t i = f.loop_begin(loop); i < f.loop_end[loop]; last = i++) {
      around ^= mesher::detail::is_crossed(uv, f.outline[last], f.outline[i]);
    }
  }
  return around;
}
inline bool contains(const Polygon& f, const Point<2>& uv) {
  return is_around(f, uv, 0, f.loop_end.size());
}

struct Nearest {
  double distance2 = std::numeric_limits<double>::infinity();
  Point<3> at{};
};
/// On the border; the first of several.
inline Nearest nearest_on_border(const Polygon& f, const Point<3>& x) {
  using namespace mesher::detail;
  Nearest nearest;
  for (std::size_t loop = 0; loop < f.loop_end.size(); ++loop) {
    std::uint32_t last = f.loop_end[loop] - 1;
    for (std::uint32_t i = f.loop_begin(loop); i < f.loop_end[loop]; last = i++) {
      const Point<3>&a = f.places[last], &b = f.places[i];
      const Point<3> at = plus(a, scaled(nearest_fraction(x, a, b), minus(b, a)));
      if (squared_distance(at, x) < nearest.distance2) nearest = {squared_distance(at, x), at};
    }
  }
  return nearest;
}
inline double distance2(const Polygon& f, const Point<3>& x) {
  if (naive::contains(f, f.plane.in_frame(x))) return f.plane.height(x) * f.plane.height(x);
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t i = 0; i < f.places.size(); ++i) {
    least = std::min(least, mesher::detail::distance2(x, f.places[f.previous(i)], f.places[i]));
  }
  return least;
}

}  // namespace naive
}  // namespace support
