// Newell's normal, parity in the frame, and distances by edges.
#include "space/polygon_shape.hpp"

#include <cmath>
#include <limits>
#include <numeric>
#include <span>

#include "geometry/twofold.hpp"

namespace mesher::detail {
namespace {

Point<3> unit(const Point<3>& a) { return scaled(1 / std::sqrt(squared(a)), a); }

// The place in which a corner is the largest, the first of several.
int largest(const Point<3>& a) {
  int k = 0;
  for (int i = 1; i < 3; ++i) {
    if (std::abs(a[i]) > std::abs(a[k])) k = i;
  }
  return k;
}
int smallest(const Point<3>& a) {
  int k = 0;
  for (int i = 1; i < 3; ++i) {
    if (std::abs(a[i]) < std::abs(a[k])) k = i;
  }
  return k;
}

// twice_area(), in twice the precision of doubles.
Point<3> area_of_needle(std::span<const Point<3>> loop) {
  const auto from_first = [&](std::size_t i) {
    std::array<Twofold, 3> v;
    for (std::size_t k = 0; k < 3; ++k) v[k] = twofold_sum(loop[i][k], -loop[0][k]);
    return v;
  };
  std::array<Twofold, 3> area;
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
    const auto u = from_first(i), w = from_first(i + 1);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t m = (k + 1) % 3, n = (k + 2) % 3;
      area[k] = area[k] + (u[m] * w[n] + -(u[n] * w[m]));
    }
  }
  return {area[0].hi, area[1].hi, area[2].hi};
}

// The normal's largest coordinate is positive, and eu is the axis nearest to the plane: a plane
// across an axis has a frame of axes.
Plane plane_across(const Point<3>& origin, const Point<3>& area) {
  Plane plane{.origin = origin, .normal = unit(area)};
  if (plane.normal[largest(area)] < 0) plane.normal = scaled(-1, plane.normal);
  const int axis = smallest(plane.normal);
  Point<3> along{};
  along[axis] = 1;
  plane.eu = unit(minus(along, scaled(plane.normal[axis], plane.normal)));
  plane.ev = cross(plane.normal, plane.eu);
  return plane;
}

template <std::size_t N>
Box<static_cast<int>(N)> bounds(const std::vector<std::array<double, N>>& places) {
  Box<static_cast<int>(N)> box{places[0], places[0]};
  for (const auto& p : places) {
    for (std::size_t i = 0; i < N; ++i) {
      box.lo[i] = std::min(box.lo[i], p[i]);
      box.hi[i] = std::max(box.hi[i], p[i]);
    }
  }
  return box;
}

// The middle of the bounding box, and the farthest corner from there.
void find_reach(Polygon& f) {
  const Box<3> box = bounds(f.places);
  for (int i = 0; i < 3; ++i) f.middle[i] = box.lo[i] + (box.hi[i] - box.lo[i]) / 2;
  double reach2 = 0;
  for (const Point<3>& p : f.places) reach2 = std::max(reach2, squared_distance(p, f.middle));
  f.reach = std::sqrt(reach2) * (1 + 0x1p-40);
}

// Twice the signed area of a loop in the frame.
double turn(std::span<const Point<2>> loop) {
  double sum = 0;
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
    const Point<2> a{loop[i][0] - loop[0][0], loop[i][1] - loop[0][1]};
    const Point<2> b{loop[i + 1][0] - loop[0][0], loop[i + 1][1] - loop[0][1]};
    sum += a[0] * b[1] - a[1] * b[0];
  }
  return sum;
}

std::span<const Point<2>> loop_in_frame(const Polygon& f, std::size_t loop) {
  const std::uint32_t begin = f.loop_begin(loop);
  return std::span(f.outline).subspan(begin, f.loop_end[loop] - begin);
}

// The edge that leads to the i-th corner.
EdgeTree::Ends edge_to(const Polygon& f, std::uint32_t i) {
  return {f.outline[f.previous(i)], f.outline[i]};
}

void plant_trees(Polygon& f) {
  std::vector<EdgeTree::Ends> edges;
  for (std::uint32_t i = 0; i < f.outline.size(); ++i) edges.push_back(edge_to(f, i));
  f.outline_tree.build(edges, f.loop_end);
  edges.clear();
  const std::size_t ends = 2 * f.inner_edges.size();
  for (std::size_t i = 0; i < f.inside.size(); i += i < ends ? 2 : 1) {
    const std::size_t other = i < ends ? i + 1 : i;
    edges.push_back({f.plane.in_frame(f.inside[i]), f.plane.in_frame(f.inside[other])});
  }
  std::vector<std::uint32_t> each_alone(edges.size());
  std::iota(each_alone.begin(), each_alone.end(), 1);
  f.inner_tree.build(edges, each_alone);
}

// A loop that lies inside an even number of others has the inside of f inside.
bool has_inside(const Polygon& f, std::size_t loop) {
  const auto corners = loop_in_frame(f, loop);
  const Point<2> on_it{(corners[0][0] + corners[1][0]) / 2, (corners[0][1] + corners[1][1]) / 2};
  return contains(f, on_it) == loop_contains(f, loop, on_it);
}

// Calls visit(a, b, i) for the edges ab, to the i-th corner, that may be within sqrt(most2) of x.
template <class Visit>
void visit_border(const Polygon& f, const Point<3>& x, const double& most2, Visit&& visit) {
  f.outline_tree.visit_near(place_beside(f, x), most2, [&](std::uint32_t i) {
    return visit(f.places[f.previous(i)], f.places[i], i);
  });
}

}  // namespace

Point<3> twice_area(std::span<const Point<3>> loop) {
  Point<3> sum{};
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
    sum = plus(sum, cross(minus(loop[i], loop[0]), minus(loop[i + 1], loop[0])));
  }
  return sum;
}

bool find_shape(Polygon& f) {
  find_reach(f);
  constexpr double kNeedle = 0x1p-16;  // above this doubles know the normal to about 2^-36
  const double reach2 = f.reach * f.reach;
  const auto outer = std::span<const Point<3>>(f.places).first(f.loop_end[0]);
  Point<3> area = twice_area(outer);
  if (std::sqrt(squared(area)) < reach2 * kNeedle) area = area_of_needle(outer);
  if (!(std::sqrt(squared(area)) > reach2 * 0x1p-40)) return false;
  f.plane = plane_across(f.places[0], area);
  f.outline.clear();
  for (const Point<3>& p : f.places) f.outline.push_back(f.plane.in_frame(p));
  f.bounds = bounds(f.outline);
  plant_trees(f);
  f.inside_left.clear();
  for (std::size_t loop = 0; loop < f.loop_end.size(); ++loop) {
    f.inside_left.push_back((turn(loop_in_frame(f, loop)) > 0) == has_inside(f, loop));
  }
  f.thickness = deviation(f).height + resolution(f.middle, f.reach);
  return true;
}

bool is_flat(const Polygon& f) {
  return deviation(f).height <= kFlatness * f.reach + resolution(f.middle, f.reach);
}

Deviation deviation(const Polygon& f) {
  Deviation most;
  for (const auto* places : {&f.places, &f.inside}) {
    for (const Point<3>& p : *places) {
      const double height = std::abs(f.plane.height(p));
      if (height > most.height) most = {height, p};
    }
  }
  return most;
}

bool loop_contains(const Polygon& f, std::size_t loop, const Point<2>& uv) {
  return f.outline_tree.is_around(
      uv, [&](std::uint32_t i) { return edge_to(f, i); },
      [&](std::uint32_t i) { return f.loop_begin(loop) <= i && i < f.loop_end[loop]; });
}

bool contains(const Polygon& f, const Point<2>& uv) {
  return f.outline_tree.is_around(
      uv, [&](std::uint32_t i) { return edge_to(f, i); }, [](std::uint32_t) { return true; });
}

bool contains(const Polygon& f, const Point<3>& x) { return contains(f, f.plane.in_frame(x)); }

Point<2> centre_in_frame(const Polygon& f, const std::array<Point<3>, 3>& places) {
  std::array<Point<2>, 3> p;
  for (std::size_t i = 0; i < 3; ++i) p[i] = f.plane.in_frame(places[i]);
  std::sort(p.begin(), p.end());
  const double bu = p[1][0] - p[0][0], bv = p[1][1] - p[0][1];
  const double cu = p[2][0] - p[0][0], cv = p[2][1] - p[0][1];
  const double b2 = bu * bu + bv * bv, c2 = cu * cu + cv * cv, twice = 2 * (bu * cv - bv * cu);
  return {p[0][0] + (cv * b2 - bv * c2) / twice, p[0][1] + (bu * c2 - cu * b2) / twice};
}

Point<3> inward(const Polygon& f, std::uint32_t i) {
  const Point<3> left = unit(cross(f.plane.normal, minus(f.places[f.next(i)], f.places[i])));
  return f.inside_left[f.loop_of(i)] ? left : scaled(-1, left);
}

EdgeTree::Place place_beside(const Polygon& f, const Point<3>& x) {
  const Point<2> uv = f.plane.in_frame(x);
  const double height = std::abs(f.plane.height(x));
  const double size = f.outline_tree.extent() + std::abs(uv[0]) + std::abs(uv[1]) + height;
  const double slack = 4 * EdgeTree::kSlack * size, thick = f.thickness + slack;
  return {uv, slack, std::max(height - thick, 0.0), height + thick};
}

Point<3> nearest_place(const Polygon& f, const Point<3>& x) {
  if (contains(f, x)) return f.plane.foot(x);
  Point<3> nearest{};
  std::uint32_t corner = 0;
  double least = std::numeric_limits<double>::infinity();
  visit_border(f, x, least, [&](const Point<3>& a, const Point<3>& b, std::uint32_t i) {
    const Point<3> at = plus(a, scaled(nearest_fraction(x, a, b), minus(b, a)));
    const double d = squared_distance(at, x);
    if (d < least || (d == least && i < corner)) least = d, nearest = at, corner = i;
    return false;
  });
  return nearest;
}

double distance2(const Point<3>& x, const Polygon& f) {
  if (contains(f, x)) {
    const double height = f.plane.height(x);
    return height * height;
  }
  double least = std::numeric_limits<double>::infinity();
  visit_border(f, x, least, [&](const Point<3>& a, const Point<3>& b, std::uint32_t) {
    least = std::min(least, distance2(x, a, b));
    return false;
  });
  return least;
}

bool is_within(const Point<3>& x, const Polygon& f, double most2) {
  if (contains(f, x)) {
    const double height = f.plane.height(x);
    return height * height <= most2;
  }
  bool found = false;
  visit_border(f, x, most2, [&](const Point<3>& a, const Point<3>& b, std::uint32_t) {
    return found = distance2(x, a, b) <= most2;
  });
  return found;
}

std::optional<Point<3>> crossing(const Point<3>& a, const Point<3>& b, const Polygon& f) {
  const double from = f.plane.height(a), to = f.plane.height(b);
  if (from * to > 0 || from == to) return std::nullopt;
  const Point<3> x = plus(a, scaled(from / (from - to), minus(b, a)));
  if (!contains(f, x)) return std::nullopt;
  return x;
}

double distance2(const Point<3>& a, const Point<3>& b, const Polygon& f) {
  if (crossing(a, b, f)) return 0;
  double least = std::min(distance2(a, f), distance2(b, f));
  for (std::uint32_t i = 0; i < f.places.size(); ++i) {
    least = std::min(least, distance2(a, b, f.places[f.previous(i)], f.places[i]));
  }
  return least;
}

}  // namespace mesher::detail
