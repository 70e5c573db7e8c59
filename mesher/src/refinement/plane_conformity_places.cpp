// Where new vertices go while points are left.
#include <algorithm>
#include <tuple>

#include "geometry/segment_tests.hpp"
#include "program/split_segments.hpp"
#include "refinement/plane_conformity.hpp"

namespace mesher::detail {

namespace {

// A new vertex yields to segments within this times its distance to others.
constexpr double kYieldsWithin = 0.5;
// And goes to a place that is no farther than this from its foot, in the same units.
constexpr double kFromFoot = 0.5;

}  // namespace

/// The nearest segment; of those as near, the first in canonical order.
auto PlaneConformity::yield(const Point<2>& x, double radius) const -> std::optional<Placed> {
  const Segment* nearest = nullptr;
  double least2 = kYieldsWithin * kYieldsWithin * radius * radius;
  const auto key = [](const Segment& s) { return std::tie(s.place_a, s.place_b); };
  store_.segments.store().visit_near(x, x, kYieldsWithin * radius, [&](const Segment& s) {
    const double d2 = distance2(x, s.place_a, s.place_b);
    if (d2 > least2 || (d2 == least2 && nearest != nullptr && !(key(s) < key(*nearest))))
      return false;
    nearest = &s, least2 = d2;
    return false;
  });
  if (nearest == nullptr) return std::nullopt;
  const Segment& s = *nearest;
  double along = 0;
  for (std::size_t i = 0; i < 2; ++i)
    along += (x[i] - s.place_a[i]) * (s.place_b[i] - s.place_a[i]);
  return place_near(s, std::clamp(along / s.length, 0.0, s.length), kFromFoot * radius);
}

/// The highest place in the tree that is within the radius.
auto PlaneConformity::place_near(const Segment& s, double from_a, double radius) const
    -> std::optional<Placed> {
  for (PieceRef piece = whole(s); piece.length() > store_.box.side * kShortestPiece;) {
    const Halves parts = halves(piece);
    const double at = parts.role.label.from(false, s.length);
    if (std::abs(at - from_a) <= radius) return Placed{parts.place, parts.role};
    piece = from_a < at ? parts.lower : parts.upper;
  }
  return std::nullopt;
}

}  // namespace mesher::detail
