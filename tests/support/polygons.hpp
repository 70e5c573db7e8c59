// Polygons in space made of places, and random ones.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "mesher/extra/generate.hpp"
#include "space/polygon_shape.hpp"

namespace support {

using mesher::Point;
using Loops = std::vector<std::vector<Point<3>>>;

/// A polygon of these loops; corners are numbered by their places.
inline mesher::detail::Polygon polygon_of(Loops loops, std::vector<Point<3>> inside = {}) {
  mesher::detail::put_in_order(loops, [](const Point<3>& p) { return p; });
  std::map<Point<3>, mesher::detail::VertexHandle> numbers;
  for (const auto& loop : loops) {
    for (const Point<3>& p : loop) numbers.try_emplace(p, 0);
  }
  mesher::detail::VertexHandle count = 0;
  for (auto& [place, number] : numbers) number = ++count;
  mesher::detail::Polygon f;
  f.inside = std::move(inside);
  for (const auto& loop : loops) {
    for (const Point<3>& p : loop) {
      f.places.push_back(p);
      f.corners.push_back(numbers[p]);
    }
    f.loop_end.push_back(static_cast<std::uint32_t>(f.places.size()));
  }
  if (!mesher::detail::find_shape(f)) f.loop_end.clear();
  return f;
}

/// A turn and a move of space.
struct Motion {
  Point<3> x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, to{};
  Point<3> operator()(const Point<3>& p) const {
    Point<3> q;
    for (int i = 0; i < 3; ++i) q[i] = x[i] * p[0] + y[i] * p[1] + z[i] * p[2] + to[i];
    return q;
  }
  /// The place that is moved to q.
  Point<3> back(const Point<3>& q) const {
    const Point<3> r = mesher::detail::minus(q, to);
    return {mesher::detail::dot(r, x), mesher::detail::dot(r, y), mesher::detail::dot(r, z)};
  }
};

inline Motion random_motion(mesher::SplitMix64& random) {
  using namespace mesher::detail;
  const auto direction = [&] {
    for (;;) {
      const Point<3> d{random.unit() - 0.5, random.unit() - 0.5, random.unit() - 0.5};
      if (squared(d) > 0.01) return scaled(1 / std::sqrt(squared(d)), d);
    }
  };
  Motion m;
  m.x = direction();
  const Point<3> n = cross(m.x, direction());
  m.z = scaled(1 / std::sqrt(squared(n)), n);
  m.y = cross(m.z, m.x);
  m.to = {random.unit(), random.unit(), random.unit()};
  return m;
}

/// A star-shaped loop around `center` in the plane of z = 0, of the given radii at most.
inline std::vector<Point<3>> random_star(mesher::SplitMix64& random, const Point<2>& center,
                                         double radius, std::size_t corners) {
  std::vector<Point<3>> loop;
  for (std::size_t i = 0; i < corners; ++i) {
    const double at = 6.283185307179586 * (static_cast<double>(i) + 0.8 * random.unit()) /
                      static_cast<double>(corners);
    const double r = radius * (0.3 + 0.7 * random.unit());
    loop.push_back({center[0] + r * std::cos(at), center[1] + r * std::sin(at), 0});
  }
  return loop;
}

inline Loops moved(const Loops& loops, const Motion& motion) {
  Loops all = loops;
  for (auto& loop : all) {
    for (Point<3>& p : loop) p = motion(p);
  }
  return all;
}

}  // namespace support
