// Cutting edges and polygons by the planes of a cell.
#include "space/encroachment.hpp"

#include <algorithm>
#include <cmath>

#include "space/polygon_shape.hpp"

namespace mesher::detail {

namespace {

constexpr double kClosed = 1 + 0x1p-30;

bool is_in(const VoronoiCell3& cell, const Point<3>& x) {
  for (int i = 0; i < cell.size(); ++i) {
    if (!cell.used(i)) continue;
    const Point<3>& u = cell.neighbour(i);
    if (dot(u, x) > squared(u) / 2 * kClosed) return false;
  }
  return true;
}

// The farthest corner of what the plane cuts of the cell, inside the polygon.
class FarthestCorner {
 public:
  FarthestCorner(const VoronoiCell3& cell, const Polygon& f) : cell_(cell), f_(f) {
    const double height = f.plane.height(cell.center().p);
    for (int t = 0; t < cell.corners(); ++t) look_from(t, height);
  }
  [[nodiscard]] const std::optional<Point<3>>& place() const noexcept { return best_; }

 private:
  // At corner t, if it is in the plane but for rounding (then its foot), and along the edges that
  // lead to corners beyond: each edge from its smaller end, since numbers of corners say nothing.
  void look_from(int t, double height) {
    const Point<3> q = cell_.corner(t);
    const double h = dot(f_.plane.normal, q) + height;
    if (std::abs(h) <= 0x1p-30 * std::sqrt(cell_.corner2(t))) {
      look_at(minus(q, scaled(h, f_.plane.normal)));
    }
    for (const int other : cell_.across(t)) {
      const Point<3> r = cell_.corner(other);
      if (r < q) continue;
      const double to = dot(f_.plane.normal, r) + height;
      if ((h > 0) != (to > 0)) look_at(plus(q, scaled(h / (h - to), minus(r, q))));
    }
  }
  void look_at(const Point<3>& q) {
    const Point<3> x = plus(q, cell_.center().p);
    const double far2 = squared(q);
    if (far2 < far2_ || (far2 == far2_ && best_ && *best_ < x) || !contains(f_, x)) return;
    far2_ = far2;
    best_ = x;
  }

  const VoronoiCell3& cell_;
  const Polygon& f_;
  double far2_ = 0;
  std::optional<Point<3>> best_;
};

}  // namespace

std::optional<Span> part_in(const VoronoiCell3& cell, const Edge& e) {
  const Point<3> from = minus(e.place_a, cell.center().p), along = minus(e.place_b, e.place_a);
  Span part;
  for (int i = 0; i < cell.size(); ++i) {
    if (!cell.used(i)) continue;
    const Point<3>& u = cell.neighbour(i);
    const double room = squared(u) / 2 * kClosed - dot(u, from), slope = dot(u, along);
    if (slope == 0 && room < 0) return std::nullopt;
    if (slope > 0) part.hi = std::min(part.hi, room / slope);
    if (slope < 0) part.lo = std::max(part.lo, room / slope);
    if (part.lo > part.hi) return std::nullopt;
  }
  return part;
}

std::optional<Point<3>> place_in(const VoronoiCell3& cell, const Polygon& f) {
  const Point<3>& v = cell.center().p;
  const double height = f.plane.height(v);
  if (height * height > cell.reach2()) return std::nullopt;
  const Point<3> foot = f.plane.foot(v);
  if (contains(f, foot) && is_in(cell, minus(foot, v))) return foot;
  return FarthestCorner(cell, f).place();
}

}  // namespace mesher::detail
