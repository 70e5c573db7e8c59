// Circumcentres against rational arithmetic, flat tetrahedra included.
#include "geometry/circumcentre.hpp"

#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <catch2/catch.hpp>
#include <cmath>

#include "mesher/extra/generate.hpp"
#include "mesher/predicates.hpp"

namespace {

using mesher::Point;
using mesher::SplitMix64;
using mesher::detail::circumcentre;
using Exact = boost::multiprecision::cpp_rational;
using Vector = std::array<Exact, 3>;

Vector minus(const Point<3>& a, const Point<3>& b) {
  return {Exact(a[0]) - b[0], Exact(a[1]) - b[1], Exact(a[2]) - b[2]};
}
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Exact dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vector exact_centre(const Point<3>& v, const Point<3>& a, const Point<3>& b, const Point<3>& c) {
  const Vector x = minus(a, v), y = minus(b, v), z = minus(c, v);
  const Vector yz = cross(y, z), zx = cross(z, x), xy = cross(x, y);
  const Exact det = 2 * dot(x, yz);
  Vector q;
  for (std::size_t i = 0; i < 3; ++i) {
    q[i] = (dot(x, x) * yz[i] + dot(y, y) * zx[i] + dot(z, z) * xy[i]) / det;
  }
  return q;
}

}  // namespace

TEST_CASE("a circumcentre is exact within its bound, and the same from each corner on [B2]") {
  SplitMix64 random(71);
  INFO("seed 71");
  int flat = 0;
  for (int i = 0; i < 4000; ++i) {
    INFO("case " << i);
    const double unit = std::ldexp(1.0, static_cast<int>(random.below(160)) - 80);
    // From round to as flat as doubles make it.
    const double height = std::ldexp(1.0, -static_cast<int>(random.below(56)));
    std::array<Point<3>, 4> p;
    for (auto& x : p) {
      const double a = random.unit(), b = random.unit();
      x = {unit * a, unit * b, unit * (0.3 * a + 0.6 * b + height * random.unit())};
    }
    const int side = mesher::predicates::orient3d(p[0], p[1], p[2], p[3]);
    if (side == 0) continue;
    if (side < 0) std::swap(p[2], p[3]);
    const auto c = circumcentre(p[0], p[1], p[2], p[3]);
    CHECK(circumcentre(p[0], p[2], p[3], p[1]).q == c.q);
    CHECK(circumcentre(p[0], p[3], p[1], p[2]).q == c.q);
    const Vector q = exact_centre(p[0], p[1], p[2], p[3]);
    // |2 w.(q - c)| <= tolerance |w| for all w: the error itself is at most half of it.
    Vector error;
    for (std::size_t k = 0; k < 3; ++k) error[k] = q[k] - Exact(c.q[k]);
    CHECK(4 * dot(error, error) <= Exact(c.tolerance2));
    const double length = std::sqrt(c.length2);
    CHECK(std::abs(std::sqrt(dot(q, q).convert_to<double>()) - length) <=
          std::sqrt(c.tolerance2) + 0x1p-50 * length);
    flat += c.tolerance2 < 0x1p-90 * c.length2 && height < 0x1p-24;
  }
  CHECK(flat > 500);  // among them many that doubles say nothing of
}
