// Points with integer coordinates, so that geometric tests are exact.
#pragma once

#include <algorithm>
#include <compare>
#include <cstdint>
#include <ostream>

#include "sac/sac.hpp"

namespace examples {

/// Coordinates are in -2^29 .. 2^29. Ordered from left to right, from below, by id.
struct Point {
  int x = 0;
  int y = 0;
  std::uint32_t id = 0;  ///< 0: none
  friend auto operator<=>(const Point&, const Point&) = default;
  friend std::uint64_t hash_value(const Point& p) noexcept { return sac::mix(p.id); }
  friend std::ostream& operator<<(std::ostream& out, const Point& p) {
    return out << '(' << p.x << ' ' << p.y << ")#" << p.id;
  }
};

[[nodiscard]] inline bool same_place(const Point& a, const Point& b) noexcept {
  return a.x == b.x && a.y == b.y;
}

/// (b - a) x (d - c): positive if the second turns left from the first.
[[nodiscard]] inline std::int64_t cross(const Point& a, const Point& b, const Point& c,
                                        const Point& d) noexcept {
  return (std::int64_t{b.x} - a.x) * (std::int64_t{d.y} - c.y) -
         (std::int64_t{b.y} - a.y) * (std::int64_t{d.x} - c.x);
}
/// (b - a) . (d - c)
[[nodiscard]] inline std::int64_t dot(const Point& a, const Point& b, const Point& c,
                                      const Point& d) noexcept {
  return (std::int64_t{b.x} - a.x) * (std::int64_t{d.x} - c.x) +
         (std::int64_t{b.y} - a.y) * (std::int64_t{d.y} - c.y);
}
/// Positive if p lies to the left of the line from a to b.
[[nodiscard]] inline std::int64_t left_of(const Point& a, const Point& b, const Point& p) noexcept {
  return cross(a, b, a, p);
}
[[nodiscard]] inline std::int64_t squared_distance(const Point& a, const Point& b) noexcept {
  return dot(a, b, a, b);
}
/// From p to the segment ab; without rounding but that of the quotient if coordinates are below
/// 2^12.
[[nodiscard]] inline double squared_distance(const Point& p, const Point& a,
                                             const Point& b) noexcept {
  const std::int64_t along = dot(a, b, a, p);
  const std::int64_t length = squared_distance(a, b);
  if (along <= 0) return static_cast<double>(squared_distance(a, p));
  if (along >= length) return static_cast<double>(squared_distance(b, p));
  const auto area = static_cast<double>(left_of(a, b, p));
  return area * area / static_cast<double>(length);
}

}  // namespace examples
