// Poor triangles, off-centres, buckets and colours.
#include "rules/insertion_rule.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mesher::detail {

namespace {

Point<2> plus(const Point<2>& a, const Point<2>& b) { return {a[0] + b[0], a[1] + b[1]}; }
double squared_distance(const Point<2>& a, const Point<2>& b) {
  const double x = a[0] - b[0];
  const double y = a[1] - b[1];
  return x * x + y * y;
}
double squared(const Point<2>& a) { return a[0] * a[0] + a[1] * a[1]; }

// The distance from an edge's end to its off-centre, in units of the edge: see clip_ below.
double offcentre_distance(double height) { return std::sqrt(height * height + 0.25); }

// A length kept as a float in units of the box's side, as observations store it.
double representable(double length, double side) {
  const double x = length / side;
  auto f = static_cast<float>(x);
  if (double{f} < x) f = std::nextafter(f, std::numeric_limits<float>::infinity());
  return double{f} * side;
}

// Circumradii and edges of the triangles in question are computed to within 2^-45 (their
// coordinates relative to v are exact to the last place, and their angles are not small where the
// outcome is close), so what passes as good here is good in exact arithmetic.
constexpr double kSlack = 1 - 0x1p-40;
// The off-centre aims a little lower than the bound, so that rounding it does not make it poor.
constexpr double kAim = 1 - 0x1p-16;

}  // namespace

InsertionRule::InsertionRule(const Options<2>& options, const MeshBox<2>& box)
    : rule_(options.rule),
      rho2_(options.rho * options.rho * kSlack),
      growth2_((1 + options.rho) * (1 + options.rho) / 4),
      tiny_(box.side * 0x1p-60) {
  const double aim = options.rho * kAim;
  height_ = aim + std::sqrt(aim * aim - 0.25);
  // No length is below side * 2^-51 (two points differ in their finest cell or a neighbouring
  // one) nor above the box's diagonal.
  double start = box.side * 0x1p-52;
  // An off-centre of an edge in bucket b is at most rho * offcentre_distance * start from v. The
  // paper's rule looks for gap balls up to gamma NN(v), gamma = 2 rho.
  const double gamma = rule_ == Rule::radius_edge
                           ? std::max(offcentre_distance(height_), options.rho)
                           : 2 * options.rho;
  for (; start < 2 * box.side; start *= options.rho) {
    start2_.push_back(start * start);
    const double clip = std::min(gamma * options.rho * start * (1 + 0x1p-20), 2 * box.side);
    clip_.push_back(representable(clip, box.side));
    // A vertex reads up to 2.2 clips away and inserts up to 1.1 away: 3 gamma rho l [Fig 4.10],
    // rounded up to a cell of the box.
    int level = 0;
    while (level < 30 && box.cell_side(level + 1) >= 3.3 * clip) ++level;
    square_level_.push_back(level);
  }
}

int InsertionRule::bucket(double length2) const {
  const auto above = std::upper_bound(start2_.begin() + 1, start2_.end(), length2);
  return static_cast<int>(above - start2_.begin()) - 1;
}

unsigned InsertionRule::colour(const Fixed<2>& f, int b) const {
  const int level = square_level_[index(b)];
  if (level == 0) return 0;
  const auto bit = [&](int i) {
    return static_cast<unsigned>(f[static_cast<std::size_t>(i)] >> (kLevels - level) & 1);
  };
  return bit(0) | bit(1) << 1;
}

// Calls visit(poor) for the shortest edge of every poor triangle of v's star, and for every visible
// edge beside a hidden corner.
template <class Visit>
void InsertionRule::for_each_poor(const VoronoiCell& cell, Visit&& visit) const {
  const Point<2>& v = cell.center().p;
  for (int i = 0; i < cell.size(); ++i) {
    const int j = cell.next(i);
    if (!cell.real(i) && !cell.real(j)) continue;
    const double to_i = squared(cell.neighbour(i));
    const double to_j = squared(cell.neighbour(j));
    if (!cell.real(j)) {
      visit(Poor{to_i, v, cell.place(i), std::nullopt});
    } else if (!cell.real(i)) {
      visit(Poor{to_j, cell.place(j), v, std::nullopt});
    } else {
      const double across = squared_distance(cell.place(i), cell.place(j));
      const double shortest = std::min({to_i, to_j, across});
      if (cell.corner2(i) <= rho2_ * shortest) continue;
      Poor poor{shortest, v, cell.place(i), plus(v, cell.corner(i))};
      if (shortest != to_i) poor.p = cell.place(j), poor.q = v;
      if (shortest != to_i && shortest != to_j) poor.p = cell.place(i), poor.q = cell.place(j);
      visit(poor);
    }
  }
}

// On the bisector of p q, to the left.
Point<2> InsertionRule::place(const Poor& poor) const {
  // The same edge gives the same point whichever way it is met.
  const bool flip = poor.q < poor.p;
  const Point<2>& p = flip ? poor.q : poor.p;
  const Point<2>& q = flip ? poor.p : poor.q;
  const double h = flip ? -height_ : height_;
  const double dx = q[0] - p[0];
  const double dy = q[1] - p[1];
  const Point<2> middle{p[0] + dx / 2, p[1] + dy / 2};
  if (poor.circumcentre.has_value()) {
    const Point<2>& c = *poor.circumcentre;
    const double height = (c[1] - middle[1]) * dx - (c[0] - middle[0]) * dy;
    if (std::abs(height) < height_ * poor.edge2) return c;
  }
  return {middle[0] - h * dy, middle[1] + h * dx};
}

std::optional<InsertionRule::NewPoint> InsertionRule::poor_triangle_point(const VoronoiCell& cell,
                                                                          int b) const {
  double shortest2 = std::numeric_limits<double>::infinity();
  Point<2> point{};
  for_each_poor(cell, [&](const Poor& poor) {
    if (bucket(poor.edge2) > b || poor.edge2 > shortest2) return;
    const Point<2> x = place(poor);
    // Shortest edge first; ties by the place of the new vertex.
    if (poor.edge2 == shortest2 && point < x) return;
    shortest2 = poor.edge2;
    point = x;
  });
  if (std::isinf(shortest2)) return std::nullopt;
  return new_point(cell, point, shortest2);
}

std::optional<InsertionRule::NewPoint> InsertionRule::farthest_corner(
    const VoronoiCell& cell) const {
  double nearest2 = std::numeric_limits<double>::infinity();
  for (int i = 0; i < cell.size(); ++i) {
    if (cell.real(i)) nearest2 = std::min(nearest2, squared(cell.neighbour(i)));
  }
  double farthest2 = 0;
  double length2 = 0;
  Point<2> point{};
  for (int i = 0; i < cell.size(); ++i) {
    const int j = cell.next(i);
    double shortest2 = nearest2;
    if (cell.real(i) && cell.real(j)) {
      shortest2 = std::min(shortest2, squared_distance(cell.place(i), cell.place(j)));
    }
    if (cell.corner2(i) < farthest2 || cell.corner2(i) <= rho2_ * shortest2) continue;
    const Point<2> x = plus(cell.center().p, cell.corner(i));
    if (cell.corner2(i) == farthest2 && point < x) continue;
    farthest2 = cell.corner2(i);
    length2 = shortest2;
    point = x;
  }
  if (farthest2 == 0) return std::nullopt;
  return new_point(cell, point, length2);
}

// Sums that cancel near an axis leave noise in the last places; a vertex beside such a one has
// noise in places as far down again. Zero is as near, and keeps coordinates within a range of bits.
Point<2> InsertionRule::rounded(const Point<2>& p) const {
  return {std::abs(p[0]) < tiny_ ? 0 : p[0], std::abs(p[1]) < tiny_ ? 0 : p[1]};
}

// In exact arithmetic p is at least rho lengths from every vertex. The rounded place must keep half
// of the growth: lengths that grow by a factor are what ends the refinement.
InsertionRule::NewPoint InsertionRule::new_point(const VoronoiCell& cell, const Point<2>& p,
                                                 double length2) const {
  NewPoint point{rounded(p), 0, false};
  point.nearest2 = squared_distance(point.p, cell.center().p);
  for (int i = 0; i < cell.size(); ++i) {
    if (!cell.real(i)) continue;
    point.nearest2 = std::min(point.nearest2, squared_distance(point.p, cell.place(i)));
  }
  point.farther = point.nearest2 > growth2_ * length2;
  return point;
}

std::optional<InsertionRule::NewPoint> InsertionRule::next_point(const VoronoiCell& cell,
                                                                 int b) const {
  return rule_ == Rule::radius_edge ? poor_triangle_point(cell, b) : farthest_corner(cell);
}

std::optional<int> InsertionRule::next_bucket(const VoronoiCell& cell, int b) const {
  if (rule_ == Rule::voronoi_aspect) return std::nullopt;
  std::optional<int> next;
  bool alone = true;
  for (int i = 0; i < cell.size(); ++i) alone = alone && !cell.real(i);
  if (alone) next = b + 1;
  for_each_poor(cell, [&](const Poor& poor) {
    const int later = std::max(b + 1, bucket(poor.edge2));
    if (!next.has_value() || later < *next) next = later;
  });
  if (next.has_value() && *next >= buckets()) return std::nullopt;
  return next;
}

}  // namespace mesher::detail
