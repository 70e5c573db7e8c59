// Planes by Newell's normal, areas by the shoelace formula, insides by parity.
#include "check/flat_polygon.hpp"

#include <algorithm>
#include <cmath>

namespace mesher::detail {

namespace {

using Real = FlatPolygon::Real;
using Place = FlatPolygon::Place;

Place minus(const Place& a, const Place& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Place plus(const Place& a, const Place& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Place times(Real s, const Place& a) { return {s * a[0], s * a[1], s * a[2]}; }
Real dot(const Place& a, const Place& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Place cross(const Place& a, const Place& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Place unit(const Place& a) { return times(1 / std::sqrt(dot(a, a)), a); }

// Calls visit(a, b) for each side.
template <class Loop, class Visit>
void for_each_side(const Loop& loop, Visit&& visit) {
  for (std::size_t i = 0, j = loop.size() - 1; i < loop.size(); j = i++) visit(loop[j], loop[i]);
}

template <class Loop, class At>
bool goes_around(const Loop& loop, const At& p) {
  bool inside = false;
  for_each_side(loop, [&](const At& a, const At& b) {
    if ((a[1] > p[1]) == (b[1] > p[1])) return;
    inside ^= p[0] < a[0] + (p[1] - a[1]) * (b[0] - a[0]) / (b[1] - a[1]);
  });
  return inside;
}

}  // namespace

FlatPolygon::FlatPolygon(const std::vector<std::vector<Point<3>>>& loops)
    : origin_(wide(loops[0][0])), normal_{} {
  for_each_side(loops[0], [&](const Point<3>& a, const Point<3>& b) {
    normal_ = plus(normal_, cross(minus(wide(a), origin_), minus(wide(b), origin_)));
  });
  normal_ = unit(normal_);
  eu_ = minus(wide(loops[0][1]), origin_);
  eu_ = unit(minus(eu_, times(dot(eu_, normal_), normal_)));
  ev_ = cross(normal_, eu_);
  for (const auto& loop : loops) {
    auto& flat = loops_.emplace_back();
    for (const Point<3>& p : loop) flat.push_back(in_frame(wide(p)));
  }
}

Real FlatPolygon::height(const Place& p) const { return dot(minus(p, origin_), normal_); }

FlatPolygon::Flat FlatPolygon::in_frame(const Place& p) const {
  const Place r = minus(p, origin_);
  return {dot(r, eu_), dot(r, ev_)};
}

bool FlatPolygon::contains(const Flat& p) const {
  bool inside = false;
  for (const auto& loop : loops_) inside ^= goes_around(loop, p);
  return inside;
}
bool FlatPolygon::contains(const Place& p) const { return contains(in_frame(p)); }

Real FlatPolygon::area_of(const Point<3>& a, const Point<3>& b, const Point<3>& c) const {
  const Place o = wide(a);
  return std::abs(dot(cross(minus(wide(b), o), minus(wide(c), o)), normal_)) / 2;
}

bool FlatPolygon::is_left(const Point<3>& a, const Point<3>& b, const Point<3>& c) const {
  const Place o = wide(a);
  return dot(cross(minus(wide(b), o), minus(wide(c), o)), normal_) > 0;
}

FlatPolygon::Place FlatPolygon::beside(const Point<3>& a, const Point<3>& b) const {
  const Place middle = times(Real{1} / 2, plus(wide(a), wide(b)));
  return plus(middle, cross(normal_, minus(wide(b), wide(a))));
}

// A loop adds what it goes around if it lies in an even number of others, else it takes it. Loops
// may share corners, so the middle of a side is asked about.
Real FlatPolygon::area() const {
  Real sum = 0;
  for (const auto& loop : loops_) {
    const Flat middle{(loop[0][0] + loop[1][0]) / 2, (loop[0][1] + loop[1][1]) / 2};
    Real twice = 0;
    for_each_side(loop, [&](const Flat& a, const Flat& b) { twice += a[0] * b[1] - a[1] * b[0]; });
    bool adds = true;
    for (const auto& other : loops_) {
      if (&other != &loop && goes_around(other, middle)) adds = !adds;
    }
    sum += (adds ? 1 : -1) * std::abs(twice) / 2;
  }
  return sum;
}

// The middle of the widest part inside of a line between two heights at which there are corners.
Point<3> FlatPolygon::inner_place() const {
  std::vector<Real> heights, crossings;
  for (const auto& loop : loops_) {
    for (const Flat& p : loop) heights.push_back(p[1]);
  }
  std::sort(heights.begin(), heights.end());
  std::size_t widest = 1;
  for (std::size_t i = 2; i < heights.size(); ++i) {
    if (heights[i] - heights[i - 1] > heights[widest] - heights[widest - 1]) widest = i;
  }
  const Real v = (heights[widest] + heights[widest - 1]) / 2;
  for (const auto& loop : loops_) {
    for_each_side(loop, [&](const Flat& a, const Flat& b) {
      if ((a[1] > v) == (b[1] > v)) return;
      crossings.push_back(a[0] + (v - a[1]) * (b[0] - a[0]) / (b[1] - a[1]));
    });
  }
  std::sort(crossings.begin(), crossings.end());
  std::size_t best = 0;
  for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
    if (crossings[i + 1] - crossings[i] > crossings[best + 1] - crossings[best]) best = i;
  }
  const Real u = crossings.empty() ? 0 : (crossings[best] + crossings[best + 1]) / 2;
  const Place p = plus(origin_, plus(times(u, eu_), times(v, ev_)));
  return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}

}  // namespace mesher::detail
