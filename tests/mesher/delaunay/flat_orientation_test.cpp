// The kernel's test on which side of a facet a place is, where it is nearly in the facet's plane.
#include <array>
#include <catch2/catch.hpp>
#include <cstdint>

#include "delaunay/kernel.hpp"
#include "mesher/extra/generate.hpp"
#include "mesher/predicates.hpp"

namespace {

using mesher::Point;
using mesher::predicates::orient3d;

// A place in the plane of three of the corners, or a unit off it: multiples of the unit each.
Point<3> near_facet(const std::array<Point<3>, 4>& corners, std::size_t across, double unit,
                    mesher::SplitMix64& random) {
  const auto corner = [&](std::size_t k) { return corners[(across + k) % 4]; };
  const double s = static_cast<double>(random.below(4)), t = static_cast<double>(random.below(4));
  Point<3> p;
  for (std::size_t i = 0; i < 3; ++i) {
    p[i] = corner(1)[i] + s * (corner(2)[i] - corner(1)[i]) + t * (corner(3)[i] - corner(1)[i]);
  }
  if (random.below(2) == 0) p[random.below(3)] += random.below(2) == 0 ? unit : -unit;
  return p;
}

// Whether the simplex holds p, or is a ghost whose facet p is beyond.
template <class Kernel>
bool is_where(const Kernel& kernel, std::uint32_t s, const Point<3>& p) {
  const auto& c = kernel.simplices().corners(s);
  const bool is_ghost = kernel.is_ghost(s);
  for (std::size_t i = 0; i < 4; ++i) {
    if (is_ghost && c[i] != mesher::detail::kInfinite) continue;
    std::array<Point<3>, 4> q;
    for (std::size_t k = 0; k < 4; ++k) q[k] = k == i ? p : kernel.place(c[k]);
    const int side = orient3d(q[0], q[1], q[2], q[3]);
    if (is_ghost ? side <= 0 : side < 0) return false;
  }
  return true;
}

}  // namespace

TEMPLATE_TEST_CASE(
    "a walk ends where the place is, however near to planes and on grids of any kind", "",
    mesher::detail::ArrayLayout<3>, mesher::detail::BallLayout<3>) {
  mesher::SplitMix64 random(3);
  int inside = 0, outside = 0;
  for (int bits = 2; bits <= 30; ++bits) {
    for (const double unit : {1.0, 0x1p-90, 0x1p60}) {
      for (const double origin : {0.0, 0x1p34, 0x1.0000000001p38}) {
        std::array<Point<3>, 4> corners;
        for (auto& p : corners) {
          for (double& x : p) {
            x = (origin + static_cast<double>(random.below(std::uint64_t{1} << bits))) * unit;
          }
        }
        if (orient3d(corners[0], corners[1], corners[2], corners[3]) <= 0) continue;
        mesher::detail::DelaunayKernel<3, TestType> kernel;
        for (const auto& p : corners) static_cast<void>(kernel.add_place(p));
        kernel.start({1, 2, 3, 4});
        for (int round = 0; round < 40; ++round) {
          const auto p = near_facet(corners, random.below(4), unit, random);
          const std::uint32_t s = kernel.walk(p, 0);
          INFO(bits << " bits, unit " << unit << ", origin " << origin << ", round " << round);
          CHECK(is_where(kernel, s, p));
          ++(kernel.is_ghost(s) ? outside : inside);
        }
      }
    }
  }
  CHECK(inside > 300);
  CHECK(outside > 300);
}
