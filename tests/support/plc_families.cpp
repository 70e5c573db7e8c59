// The families, as the model has them.
#include "plc_families.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "geometry/space_vectors.hpp"

namespace support {

using mesher::Box;
using mesher::Point;

std::size_t Complex::point(const Point<3>& p) {
  const auto it = std::find(points.begin(), points.end(), p);
  if (it != points.end()) return static_cast<std::size_t>(it - points.begin());
  points.push_back(p);
  return points.size() - 1;
}

void Complex::segment(const Point<3>& a, const Point<3>& b) {
  segments.push_back({point(a), point(b)});
}

void Complex::face(const Places& outer, const std::vector<Places>& holes) {
  Face f;
  const auto add = [&](const Places& places) {
    Loop& loop = f.loops.emplace_back();
    for (const Point<3>& p : places) loop.push_back(point(p));
  };
  add(outer);
  for (const Places& hole : holes) add(hole);
  faces.push_back(std::move(f));
}

void Complex::box(const Box<3>& box, int skip, const std::vector<Places>& holes_low,
                  const std::vector<Places>& holes_high) {
  const auto& [a, b] = box;
  if ((skip & 1) == 0) {
    face({{a[0], a[1], a[2]}, {a[0], b[1], a[2]}, {a[0], b[1], b[2]}, {a[0], a[1], b[2]}},
         holes_low);
  }
  if ((skip & 2) == 0) {
    face({{b[0], a[1], a[2]}, {b[0], b[1], a[2]}, {b[0], b[1], b[2]}, {b[0], a[1], b[2]}},
         holes_high);
  }
  face({{a[0], a[1], a[2]}, {b[0], a[1], a[2]}, {b[0], a[1], b[2]}, {a[0], a[1], b[2]}});
  face({{a[0], b[1], a[2]}, {b[0], b[1], a[2]}, {b[0], b[1], b[2]}, {a[0], b[1], b[2]}});
  face({{a[0], a[1], a[2]}, {b[0], a[1], a[2]}, {b[0], b[1], a[2]}, {a[0], b[1], a[2]}});
  face({{a[0], a[1], b[2]}, {b[0], a[1], b[2]}, {b[0], b[1], b[2]}, {a[0], b[1], b[2]}});
}

namespace {

using Places = Complex::Places;
constexpr Box<3> kUnit{{0, 0, 0}, {1, 1, 1}};
constexpr Box<3> kWide{{-2, -2, -2}, {2, 2, 2}};

// A rectangle that has 0 < x < 1, |y| < 1/2 turned about the y axis.
Places page(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {{0, -.5, 0}, {0, .5, 0}, {c, .5, s}, {c, -.5, s}};
}
Places square(double lo, double hi, double z) {
  return {{lo, lo, z}, {hi, lo, z}, {hi, hi, z}, {lo, hi, z}};
}
double radians(double degrees) { return degrees * 3.14159265358979323846 / 180; }

void add_dumbbell(Complex& c) {
  const auto hole = [](double x) -> Places {
    return {{x, .4, .4}, {x, .6, .4}, {x, .6, .6}, {x, .4, .6}};
  };
  c.box(kUnit, 0, {}, {hole(1)});
  c.box({{2, 0, 0}, {3, 1, 1}}, 0, {hole(2)}, {});
  c.box({{1, .4, .4}, {2, .6, .6}}, 3);
}

void add_cloud(Complex& c, int n) {
  std::mt19937_64 r(5);
  std::uniform_real_distribution<double> u(0.05, 0.95);
  for (int i = 0; i < n; ++i) {
    const double x = u(r), y = u(r), z = u(r);
    c.points.push_back({x, y, z});
  }
}

void add_spike(Complex& c, double degrees) {
  const double h = std::tan(radians(degrees) / 2);
  const Point<3> a{0.1, 0.2, 1};
  const Places base{
      {.1 - h, .2 - h, 0}, {.1 + h, .2 - h, 0}, {.1 + h, .2 + h, 0}, {.1 - h, .2 + h, 0}};
  for (std::size_t i = 0; i < 4; ++i) c.face({a, base[i], base[(i + 1) % 4]});
  c.face(base);
}

void add_tetrahedron(Complex& c, double height) {
  const Point<3> a{0, 0, 0}, b{1, 0, 0}, d{.3, .9, 0}, e{.4, .3, height};
  c.face({a, b, d});
  c.face({a, b, e});
  c.face({b, d, e});
  c.face({a, d, e});
}

}  // namespace

Complex complex_of(const std::string& family, double g) {
  Complex c;
  const bool wide = family == "fan" || family == "vee" || family == "spike" || family == "segfac" ||
                    family == "tet";
  if (family == "dumbbell")
    add_dumbbell(c);
  else if (family == "wedge")
    c.box({{-1, -2, -1}, {2, 2, 2}});
  else
    c.box(wide ? kWide : kUnit);

  const double angle = radians(g);
  if (family == "cubepoly") c.face(square(.25, .75, .5));
  if (family == "skew") {
    c.segment({.25, .5, .5}, {.75, .5, .5});
    c.segment({.5, .25, .5 + g}, {.5, .75, .5 + g});
  }
  if (family == "nested") c.box({{g, g, g}, {1 - g, 1 - g, 1 - g}});
  if (family == "lhole") {
    c.face({{.2, .2, .5}, {.8, .2, .5}, {.8, .5, .5}, {.5, .5, .5}, {.5, .8, .5}, {.2, .8, .5}},
           {square(.3, .4, .5)});
  }
  if (family == "plates") {
    c.face(square(.2, .8, .5));
    c.face(square(.3, .7, .5 + g));
  }
  if (family == "cloudbox") add_cloud(c, static_cast<int>(g));
  if (family == "wedge") {
    c.face(page(0));
    c.face(page(angle));
  }
  for (int i = 0; family == "fan" && i < 6; ++i) c.face(page(0.3 + i * angle));
  if (family == "vee") {
    c.segment({0, 0, 0}, {1, .1, .05});
    c.segment({0, 0, 0}, {std::cos(angle), .1 + std::sin(angle), .05});
  }
  if (family == "spike") add_spike(c, g);
  if (family == "segfac") {
    c.face({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    c.segment({0, 0, 0}, {.6 * std::cos(angle), .5 * std::cos(angle), .78 * std::sin(angle)});
  }
  if (family == "tet") add_tetrahedron(c, g);
  return c;
}

// By a frame whose first axis is (9, 12, 20) / 25.
Complex turned(Complex complex) {
  using namespace mesher::detail;
  const auto unit = [](const Point<3>& a) { return scaled(1 / std::sqrt(squared(a)), a); };
  const Point<3> a = unit({0.36, 0.48, 0.8});
  const Point<3> b = unit(cross(a, {0.7, -0.2, 0.1}));
  const Point<3> c = cross(a, b);
  for (Point<3>& p : complex.points) p = {dot(a, p), dot(b, p), dot(c, p)};
  return complex;
}

}  // namespace support
