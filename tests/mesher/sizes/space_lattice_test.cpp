// The body-centred lattice, and what a tetrahedron has.
#include <boost/multiprecision/cpp_int.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>
#include <vector>

#include "geometry/space_vectors.hpp"
#include "mesher/extra/generate.hpp"
#include "mesher/predicates.hpp"
#include "sizes/lattice.hpp"
#include "sizes/tile.hpp"

namespace {

using mesher::Box;
using mesher::Point;
using mesher::detail::CornersOf;
using mesher::detail::Lattice;
using mesher::detail::Tile;
using Rational = boost::multiprecision::cpp_rational;
using Place = std::array<Rational, 3>;

// What of a polygon is on one side of a plane across an axis.
std::vector<Place> clipped(const std::vector<Place>& polygon, std::size_t axis, int side, int at) {
  std::vector<Place> rest;
  const auto height = [&](const Place& p) { return Rational(side * (p[axis] - at)); };
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Place &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const Rational a = height(p), b = height(q);
    if (a >= 0) rest.push_back(p);
    if ((a > 0 && b < 0) || (a < 0 && b > 0)) {
      Place x;
      for (std::size_t k = 0; k < 3; ++k) x[k] = p[k] + a / (a - b) * (q[k] - p[k]);
      rest.push_back(x);
    }
  }
  return rest;
}

// Whether a face of the tetrahedron and the box have something in common, or the former has the
// latter: exactly.
bool really_touches(const CornersOf<3>& t, const Box<3>& box) {
  for (std::size_t out = 0; out < 4; ++out) {
    std::vector<Place> face;
    for (std::size_t i = 0; i < 4; ++i) {
      if (i != out) face.push_back({Rational(t[i][0]), Rational(t[i][1]), Rational(t[i][2])});
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      face = clipped(face, axis, 1, static_cast<int>(box.lo[axis]));
      face = clipped(face, axis, -1, static_cast<int>(box.hi[axis]));
    }
    if (!face.empty()) return true;
  }
  return Tile<3>(t).contains(box.lo);
}

}  // namespace

TEST_CASE("The tetrahedra at a node of the lattice are Delaunay, alike, and fill what is around") {
  const Lattice<3> lattice(0.75);
  const Lattice<3>::Node node{{3, -5, 7}};
  const auto around = Lattice<3>::around(node);
  const Point<3> p = lattice.place(node);
  std::set<std::array<std::size_t, 3>> all;
  double volume = 0;
  for (auto t : Lattice<3>::kSimplices) {
    CornersOf<3> c{p, lattice.place(around[t[0]]), lattice.place(around[t[1]]),
                   lattice.place(around[t[2]])};
    if (mesher::predicates::orient3d(c[0], c[1], c[2], c[3]) < 0) std::swap(c[2], c[3]);
    using mesher::detail::cross, mesher::detail::dot, mesher::detail::minus;
    const double v = dot(minus(c[3], c[0]), cross(minus(c[1], c[0]), minus(c[2], c[0]))) / 6;
    CHECK(std::abs(v) == Approx(0.75 * 0.75 * 0.75 * Lattice<3>::kMeasure));
    volume += std::abs(v);
    std::size_t inside = 0, on = 0;
    lattice.visit_in({{-2, -6, -2}, {5, 3, 7}}, [&](const Lattice<3>::Node& n) {
      const int sign = mesher::predicates::insphere(c[0], c[1], c[2], c[3], lattice.place(n));
      inside += sign > 0 ? 1 : 0;
      on += sign == 0 ? 1 : 0;
      return false;
    });
    CHECK(inside == 0);
    CHECK(on == 4);  // no other is on the sphere
    std::sort(t.begin(), t.end());
    all.insert(t);
  }
  CHECK(all.size() == 24);
  CHECK(volume == Approx(0.75 * 0.75 * 0.75 * 2));  // each has four nodes, and there are 6 a node
}

TEST_CASE("visit_in finds each node of the lattice in a box once") {
  const Lattice<3> lattice(0.5);
  const Box<3> box{{-0.6, 0.1, -1}, {0.75, 1.4, 0.3}};
  std::set<Point<3>> found;
  std::size_t visited = 0;
  lattice.visit_in(box, [&](const Lattice<3>::Node& n) {
    ++visited;
    found.insert(lattice.place(n));
    return false;
  });
  CHECK(visited == found.size());
  for (int i = -8; i < 9; ++i) {
    for (int j = -8; j < 9; ++j) {
      for (int k = -8; k < 9; ++k) {
        if (((i ^ j) & 1) != 0 || ((j ^ k) & 1) != 0) continue;
        const Point<3> p{i / 4.0, j / 4.0, k / 4.0};
        if (mesher::detail::contains(box, p)) CHECK(found.count(p) == 1);
      }
    }
  }
}

TEST_CASE("A spacing is the cube root that it should be, at all scales") {
  mesher::SplitMix64 random(1);
  for (int i = 0; i < 1000; ++i) {
    const double x = std::exp2(200 * random.unit() - 100);
    const double root = Lattice<3>::spacing(x);
    CHECK(root * root * root / 12 == Approx(x).epsilon(1e-14));
  }
  CHECK(Lattice<3>::spacing(1.0 / 96) == 0.5);
  CHECK(std::isinf(Lattice<3>::spacing(INFINITY)));
}

TEST_CASE("Whether a tetrahedron and a box touch is told exactly") {
  mesher::SplitMix64 random(7);
  const auto number = [&] { return static_cast<double>(random.below(7)); };
  int touching = 0, apart = 0;
  while (touching < 1000 || apart < 1000) {
    CornersOf<3> t;
    for (auto& p : t) p = {number(), number(), number()};
    if (mesher::predicates::orient3d(t[0], t[1], t[2], t[3]) == 0) continue;
    Box<3> box;
    for (std::size_t i = 0; i < 3; ++i) {
      box.lo[i] = number();
      box.hi[i] = box.lo[i] + static_cast<double>(random.below(3));
    }
    const bool touches = really_touches(t, box);
    (touches ? touching : apart) += 1;
    if (Tile<3>(t).touches(box) != touches) CHECK(Tile<3>(t).touches(box) == touches);
  }
}
