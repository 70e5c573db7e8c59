// The meshing box around the domain [§4.4].
#include <cmath>
#include <string>

#include "program/world.hpp"

namespace mesher::detail {

namespace {

[[noreturn]] void refuse(const std::string& what) { throw Error(ErrorCode::bad_option, what); }

void check(const Options<2>& options) {
  if (!(options.rho > 1.01) || !(options.rho <= 100)) {
    refuse("rho is " + std::to_string(options.rho) + ", it must be above 1.01 and at most 100");
  }
  for (int i = 0; i < 2; ++i) {
    const double lo = options.domain.lo[i];
    const double hi = options.domain.hi[i];
    if (!std::isfinite(lo) || !std::isfinite(hi) || !(lo <= hi)) {
      refuse("the domain is empty or not finite");
    }
    if (std::max(std::abs(lo), std::abs(hi)) > 0x1p100) refuse("the domain exceeds 2^100");
  }
}

// The least power of two >= x > 0.
double power_of_two_from(double x) {
  int exponent;
  const double mantissa = std::frexp(x, &exponent);
  return std::ldexp(1.0, mantissa == 0.5 ? exponent - 1 : exponent);
}

// Steps along a side so that no vertex ever encroaches the boundary [L 4.4.1]:
//   l <= (1 - 2 sqrt(d-1) / steps (sqrt(2) / (rho - 1) + 1)) L,   d = 2,
// with l/L at most 1/4, and 1/32 more for the box being moved to a grid.
int boundary_steps(double rho) {
  const double least = 2 * (std::sqrt(2.0) / (rho - 1) + 1) / (1 - 0.25 - 0.03125);
  int steps = 4;
  while (steps < least) steps *= 2;
  return steps;
}

}  // namespace

MeshBox<2> mesh_box(const Options<2>& options) {
  check(options);
  const Box<2>& d = options.domain;
  const double longest = std::max(d.hi[0] - d.lo[0], d.hi[1] - d.lo[1]);
  if (!(longest >= 0x1p-100)) refuse("the domain is smaller than 2^-100");
  MeshBox<2> box;
  box.side = 4 * power_of_two_from(longest);
  box.boundary_steps = boundary_steps(options.rho);
  const double grid = box.side / 64;
  for (int i = 0; i < 2; ++i) {
    const double middle = d.lo[i] + (d.hi[i] - d.lo[i]) / 2;
    const double steps = std::floor((middle - box.side / 2) / grid);
    if (std::abs(steps) > 0x1p40) {
      refuse("the domain is too far from the origin for its size");
    }
    box.lo[i] = steps * grid;
  }
  return box;
}

}  // namespace mesher::detail
