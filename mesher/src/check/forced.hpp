// What a report of small angles is made of, of a whole mesh or of a change.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include "geometry/segment_tests.hpp"
#include "geometry/small_angle.hpp"
#include "mesher/reports.hpp"
#include "sizes/limits.hpp"

namespace mesher::detail {

/// Triangles whose radius-edge ratio exceeds the bound by no more than this are not poor.
inline constexpr double kPoorRounding = 1e-9;

inline void keep_smallest(double& least, double degrees) {
  least = least == 0 ? degrees : std::min(least, degrees);
}
/// One more triangle stays poor for the sake of the angle.
inline void count(SmallAngle& angle, double degrees) {
  ++angle.forced;
  keep_smallest(angle.smallest_deg, degrees);
}
/// The first of a triangle's edges that is as short as any, the triangle on its left.
template <class Vertex, class PlaceOf>
[[nodiscard]] std::pair<Vertex, Vertex> shortest_edge(const std::array<Vertex, 3>& t,
                                                      PlaceOf&& place) {
  std::pair best(t[0], t[1]);
  const auto length2 = [&](const auto& e) {
    return distance2(place(e.first), place(e.second), place(e.second));
  };
  for (const auto& e : {std::pair(t[1], t[2]), std::pair(t[2], t[0])}) {
    if (length2(e) < length2(best)) best = e;
  }
  return best;
}
/// As many more as another count of the same angle has.
inline void add_count(SmallAngle& angle, const SmallAngle& more) {
  if (more.forced == 0) return;
  angle.forced += more.forced;
  keep_smallest(angle.smallest_deg, more.smallest_deg);
}
/// The order of reports. Two angles of one line with itself may differ in the counts alone.
[[nodiscard]] inline bool is_before(const SmallAngle& a, const SmallAngle& b) {
  const auto key = [](const SmallAngle& x) {
    return std::tie(x.at, x.degrees, x.lines, x.forced, x.smallest_deg);
  };
  return key(a) < key(b);
}
/// Short lengths that limits of size ask for are no fault.
[[nodiscard]] inline bool is_wanted(const ShrunkVertex& v, const Limits<2>& limits) {
  if (!limits.any()) return false;
  const Point<2> p = limits.nearest_in_domain(v.at);
  return limits.pitch(p) + std::hypot(p[0] - v.at[0], p[1] - v.at[1]) <= kShrinks * v.nearest;
}

}  // namespace mesher::detail
