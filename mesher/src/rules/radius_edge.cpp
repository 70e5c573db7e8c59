// Poor simplices and their off-centres.
#include "rules/radius_edge.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "geometry/centroid.hpp"

namespace mesher::detail {

namespace {

// The off-centre aims a little lower than the bound, so that rounding it does not make it poor.
constexpr double kAim = 1 - 0x1p-16;

// Measures are computed to within 2^-45: what passes is not larger in exact arithmetic.
constexpr double kLargest = 1 - 0x1p-40;

// A circumcentre is as far as the circumradius, but for rounding. What ends the refinement of large
// simplices is not that lengths grow, but that no length is shorter than one that fits the limit.
constexpr double kAsFar = 1 - 0x1p-20;

// Clearances are computed to within 2^-45.
constexpr double kSurely = 1 - 0x1p-20;

// The height at which the apex over an edge of length 1 gives a circumradius of rho.
double offcentre_height(double rho) {
  const double aim = rho * kAim;
  return aim + std::sqrt(aim * aim - 0.25);
}

template <std::size_t N>
std::array<double, N> middle_between(const std::array<double, N>& p,
                                     const std::array<double, N>& q) {
  std::array<double, N> middle;
  for (std::size_t i = 0; i < N; ++i) middle[i] = p[i] + (q[i] - p[i]) / 2;
  return middle;
}

}  // namespace

// gamma: from an end of an edge to its off-centre.
// inserts: x is in a ball around a corner, through v, which reads no farther (paper map (f)).
// input: paper map (i).
template <int D>
Promise RadiusEdge<D>::promise_for(double rho) {
  const double height = offcentre_height(rho);
  return {
      .gamma = std::sqrt(height * height + 0.25), .inserts = kReads<D>, .input = rho / (rho - 1)};
}

template <int D>
RadiusEdge<D>::RadiusEdge(const Options<D>& options, const MeshBox<D>& box,
                          const LimitsOf<D>& limits)
    : Base(options, box, promise_for(options.rho)),
      rho_(options.rho),
      height_(offcentre_height(options.rho)),
      limits_(&limits) {}

// --- In the plane ----------------------------------------------------------------------------

// Whether the triangle of v and the neighbours i and j is larger than the limit at its centroid,
// which is computed alike by all three corners.
template <>
bool RadiusEdge<2>::is_large(const VoronoiCell& cell, int i, int j) const {
  const Point<2>&u = cell.neighbour(i), &w = cell.neighbour(j);
  const double area = (u[0] * w[1] - u[1] * w[0]) / 2;
  const CornersOf<2> corners{cell.center().p, cell.place(i), cell.place(j)};
  return area > limits_->measure(centroid(corners)) * kLargest;
}

// Calls visit(poor) for the shortest edge of every poor triangle of v's star, for every visible
// edge beside a hidden corner, and for the large triangles. One that is poor and large is the
// former first, since R is longer than its edge.
template <>
template <class Visit>
inline void RadiusEdge<2>::for_each_poor(const VoronoiCell& cell, Visit&& visit) const {
  constexpr int kCentre = EdgeFilter<2>::kCentre;
  const Point<2>& v = cell.center().p;
  const bool limited = limits_->any();
  for (int i = 0; i < cell.size(); ++i) {
    const int j = cell.next(i);
    if (!cell.real(i) && !cell.real(j)) continue;
    const double to_i = squared(cell.neighbour(i));
    const double to_j = squared(cell.neighbour(j));
    if (!cell.real(i) || !cell.real(j)) {
      if (!is_centre(cell, i)) continue;
      visit(cell.real(i) ? Poor{to_i, v, cell.place(i), {}, true, kCentre, i}
                         : Poor{to_j, cell.place(j), v, {}, true, j, kCentre});
      continue;
    }
    const double across = squared_distance(cell.place(i), cell.place(j));
    const double shortest = std::min({to_i, to_j, across});
    const bool is_poor = exceeds(cell.corner2(i), shortest);
    const bool large = limited && is_large(cell, i, j);
    if (!is_poor && !large) continue;
    Poor poor{shortest, v, cell.place(i), plus(v, cell.corner(i)), false, kCentre, i};
    if (shortest != to_i) poor.p = cell.place(j), poor.q = v, poor.from = j, poor.to = kCentre;
    if (shortest != to_i && shortest != to_j) {
      poor.p = cell.place(i), poor.q = cell.place(j), poor.from = i, poor.to = j;
    }
    if (is_poor) visit(poor);
    if (!large) continue;
    poor.length2 = cell.corner2(i), poor.large = true;
    visit(poor);
  }
}

// On the bisector of p q, to the left. Whichever corner of a triangle asks, p -> q is the same: its
// triangle is on the left. So it is the same point, to the last bit.
template <>
Point<2> RadiusEdge<2>::place(const Poor& poor) const {
  const Point<2>& p = poor.p;
  const double dx = poor.q[0] - p[0];
  const double dy = poor.q[1] - p[1];
  const Point<2> middle{p[0] + dx / 2, p[1] + dy / 2};
  if (!poor.hidden) {
    const Point<2>& c = poor.corner;
    const double height = (c[1] - middle[1]) * dx - (c[0] - middle[0]) * dy;
    if (poor.large || height < height_ * poor.length2) return c;
  }
  return {middle[0] - height_ * dy, middle[1] + height_ * dx};
}

// --- In space [rules B4] ---------------------------------------------------------------------

// The shortest edge between v and the real neighbours around corner t; ties by places, so that all
// corners of a simplex name the same. Infinitely long if no neighbour is real.
template <int D>
auto RadiusEdge<D>::shortest_edge(const CellOf<D>& cell, int t) const -> Poor {
  const Point<D>& v = cell.center().p;
  Poor best{std::numeric_limits<double>::infinity(), v, v, plus(v, cell.corner(t))};
  const auto look = [&](const Point<D>& a, const Point<D>& b, int from, int to) {
    const double length2 = squared_distance(a, b);
    if (length2 > best.length2) return;
    if (b < a) std::swap(from, to);
    const auto& [low, high] = std::minmax(a, b);
    if (length2 == best.length2 && std::tie(best.p, best.q) < std::tie(low, high)) return;
    best.length2 = length2, best.p = low, best.q = high, best.from = from, best.to = to;
  };
  const auto& ends = cell.ends(t);
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (!cell.real(ends[i])) {
      best.hidden = true;
      continue;
    }
    look(v, cell.place(ends[i]), EdgeFilter<D>::kCentre, ends[i]);
    for (std::size_t j = i + 1; j < ends.size(); ++j) {
      if (!cell.real(ends[j])) continue;
      look(cell.place(ends[i]), cell.place(ends[j]), ends[i], ends[j]);
    }
  }
  return best;
}

// Whether corner t is that of a simplex that is not poor: nearly all are.
template <int D>
bool RadiusEdge<D>::is_good(const CellOf<D>& cell, int t) const {
  double shortest2 = std::numeric_limits<double>::infinity();
  const auto& ends = cell.ends(t);
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (!cell.real(ends[i])) return false;
    shortest2 = std::min(shortest2, squared(cell.neighbour(ends[i])));
    for (std::size_t j = 0; j < i; ++j) {
      const double across = squared_distance(cell.place(ends[i]), cell.place(ends[j]));
      shortest2 = std::min(shortest2, across);
    }
  }
  return !Base::exceeds(cell.corner2(t), shortest2);
}

#ifndef MESHER_PLANE_ONLY
// Whether the tetrahedron of corner t, all visible, is larger than the limit at its centroid, which
// is computed alike by all of its corners.
template <>
bool RadiusEdge<3>::is_large(const VoronoiCell3& cell, int t) const {
  const auto& ends = cell.ends(t);
  const Point<3>& u = cell.neighbour(ends[0]);
  const Point<3> uxw = cross(cell.neighbour(ends[1]), cell.neighbour(ends[2]));
  const double volume = std::abs(dot(u, uxw)) / 6;
  const Point<3> middle = centroid(
      CornersOf<3>{cell.center().p, cell.place(ends[0]), cell.place(ends[1]), cell.place(ends[2])});
  return volume > limits_->measure(middle) * kLargest;
}
#endif

// Beyond space there are no limits.
template <int D>
bool RadiusEdge<D>::is_large(const CellOf<D>&, int) const {
  return false;
}

// Calls visit(poor) for the shortest edge of every poor simplex of v's star, for the shortest
// visible one beside every hidden corner, and for the large simplices. One that is poor and large
// is the former first, since R is longer than its edge.
template <int D>
template <class Visit>
void RadiusEdge<D>::for_each_poor(const CellOf<D>& cell, Visit&& visit) const {
  const bool limited = limits_->any();
  for (int t = 0; t < cell.corners(); ++t) {
    const bool good = is_good(cell, t);
    if (good && !(limited && is_large(cell, t))) continue;
    Poor poor = shortest_edge(cell, t);
    if (std::isinf(poor.length2)) continue;  // no neighbour is visible
    if (poor.hidden ? Base::is_centre(cell, t) : Base::exceeds(cell.corner2(t), poor.length2)) {
      visit(poor);
    }
    if (poor.hidden || !limited || !(good || is_large(cell, t))) continue;
    poor.length2 = cell.corner2(t), poor.large = true;
    visit(poor);
  }
}

// On the line from the middle of p q to the circumcentre.
template <int D>
Point<D> RadiusEdge<D>::place(const Poor& poor) const {
  Point<D> middle = middle_between(poor.p, poor.q), up;
  for (std::size_t i = 0; i < D; ++i) up[i] = poor.corner[i] - middle[i];
  const double highest = height_ * std::sqrt(poor.length2);
  const double height = std::sqrt(squared(up));
  if (poor.large || (!poor.hidden && height <= highest)) return poor.corner;
  for (std::size_t i = 0; i < D; ++i) middle[i] += highest / height * up[i];
  return middle;
}

// --- Everywhere ------------------------------------------------------------------------------

// How far y, in the ball of a poor simplex, is from all vertices at least (paper map (g)).
// `middle`: of the shortest edge, whose ends are on the sphere.
template <int D>
double clearance(const Point<D>& middle, const Point<D>& centre, double radius, const Point<D>& y) {
  double height = 0, depth = 0, off = 0;
  for (std::size_t i = 0; i < D; ++i) {
    const double up = centre[i] - middle[i];
    height += (y[i] - middle[i]) * up;
    depth += up * up;
    off += (y[i] - centre[i]) * (y[i] - centre[i]);
  }
  depth = std::sqrt(depth);
  height /= depth;
  off = std::sqrt(off);
  const double to_sphere = radius - off;
  const bool is_nearest_behind = depth * off < radius * (depth - height);
  return is_nearest_behind ? std::max(to_sphere, height) : to_sphere;
}

// How many lattices there are. The first is about as coarse as the place is far from the edge's
// ends, each of the others twice as fine as the one before.
constexpr int kLattices = 4;

// On the coarsest that has a point that will do.
template <int D>
auto RadiusEdge<D>::on_lattice(const CellOf<D>& cell, const Poor& poor, const Point<D>& place) const
    -> std::optional<typename NewPoint::OnLattice> {
  const MeshBox<D>& box = Base::box();
  const double input = Base::promise().input;
  const double length = std::sqrt(poor.length2);
  const double radius = std::sqrt(squared_distance(poor.corner, poor.p));
  const double reach = std::sqrt(squared_distance(place, poor.p));
  const Point<D> middle = middle_between(poor.p, poor.q);
  double spacing = std::scalbn(box.side, std::ilogb(reach / box.side));
  for (int lattice = 0; lattice < kLattices; ++lattice, spacing /= 2) {
    const Point<D> y = box.nearest_in_lattice(place, spacing);
    const double clear = clearance<D>(middle, poor.corner, radius, y) * kSurely;
    // Neither holds of what is no number: a tile may see stars that are flat for a while.
    if (!(clear >= rho_ * length) || !box.contains(y)) continue;
    const double far2 = std::max(squared_distance(y, poor.p), squared_distance(y, poor.q));
    if (!(std::sqrt(far2) + input * length <= input * clear)) continue;
    return {{y, clear * clear, Base::new_point(cell, y, poor.length2, Base::growth2()).nearest2}};
  }
  return std::nullopt;
}

template <int D>
auto RadiusEdge<D>::next_point(const CellOf<D>& cell, int b, const EdgeFilter<D>* filter) const
    -> std::optional<NewPoint> {
  std::optional<Poor> best;
  Point<D> place_of_best{};
  for_each_poor(cell, [&](const Poor& poor) {
    if (Base::buckets().bucket(poor.length2) > b) return;
    if (best && poor.length2 > best->length2) return;
    const Point<D> x = place(poor);
    // Shortest edge first. Two simplices, or two diagonals, may ask for one place.
    const auto order = [](const Poor& one, const Point<D>& at) {
      return std::tie(one.length2, at, one.corner, one.p, one.q, one.large);
    };
    if (best && order(*best, place_of_best) < order(poor, x)) return;
    if (skipped(poor, cell, filter)) return;
    best = poor;
    place_of_best = x;
  });
  if (!best) return std::nullopt;
  NewPoint found =
      Base::new_point(cell, place_of_best, best->length2, best->large ? kAsFar : Base::growth2());
  if constexpr (D >= 3) {
    if (!best->large) found.on_lattice = on_lattice(cell, *best, place_of_best);
  }
  found.from = best->from, found.to = best->to;
  found.corner = best->corner;
  found.large = best->large;
  return found;
}

// A neighbour that the clip hides may be nearer than the visible ones beside it, but not nearer
// than twice the clip (paper map (f)). Behind an edge that is skipped there may be other triangles
// of v, with edges of v beyond the clip.
template <int D>
std::optional<int> RadiusEdge<D>::next_bucket(const CellOf<D>& cell, int b,
                                              const EdgeFilter<D>* filter) const {
  const double hidden = 2 * Base::buckets().clip_radius(b);
  std::optional<int> next;
  bool alone = true;
  for (int i = 0; i < cell.size(); ++i) alone = alone && !cell.real(i);
  if (alone) next = b + 1;
  for_each_poor(cell, [&](const Poor& poor) {
    const bool skips = skipped(poor, cell, filter);
    if (skips && !poor.hidden) return;
    const double length2 = skips ? hidden * hidden : std::min(poor.length2, hidden * hidden);
    const int later = std::max(b + 1, Base::buckets().bucket(length2));
    if (!next.has_value() || later < *next) next = later;
  });
  if (next.has_value() && *next >= Base::buckets().count()) return std::nullopt;
  return next;
}

template class RadiusEdge<2>;
#ifndef MESHER_PLANE_ONLY
template class RadiusEdge<3>;
template class RadiusEdge<4>;
#endif

}  // namespace mesher::detail
