// The size of the box, and of the steps on its boundary.
#include "rules/mesh_box.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "geometry/box.hpp"
#include "geometry/power_of_two.hpp"
#include "rules/insertion_rule.hpp"
#include "text/text.hpp"

namespace mesher::detail {

namespace {

[[noreturn]] void refuse(const std::string& what) { throw Error(ErrorCode::bad_option, what); }

template <int D>
void check(const Options<D>& options) {
  if (!(options.rho > 1.01) || !(options.rho <= 100)) {
    refuse("rho is " + text::to_text(options.rho) + ", it must be above 1.01 and at most 100");
  }
  if (options.threads < 1 || options.threads > kMostThreads) {
    refuse("threads is " + std::to_string(options.threads) + ", it must be from 1 to " +
           std::to_string(kMostThreads));
  }
  for (int i = 0; i < D; ++i) {
    const double lo = options.domain.lo[i];
    const double hi = options.domain.hi[i];
    if (!std::isfinite(lo) || !std::isfinite(hi) || !(lo <= hi)) {
      refuse("the domain is empty or not finite");
    }
    if (std::max(std::abs(lo), std::abs(hi)) > 0x1p100) refuse("the domain exceeds 2^100");
  }
}

// All vertices are in the box: its coordinates must be in the predicates' range.
template <int D>
void check(const MeshBox<D>& box) {
  for (int i = 0; i < D; ++i) {
    if (std::max(std::abs(box.lo[i]), std::abs(box.hi(i))) > 0x1p101) {
      refuse("the box around the domain exceeds 2^101");
    }
  }
}

// The distance from the domain to the nearest side of the box.
template <int D>
double distance_to_sides(const Box<D>& domain, const MeshBox<D>& box) {
  double nearest = box.side;
  for (int i = 0; i < D; ++i) {
    nearest = std::min({nearest, domain.lo[i] - box.lo[i], box.hi(i) - domain.hi[i]});
  }
  return nearest;
}

// The fewest steps along a side such that no vertex ever encroaches it [L 4.4.1]. In the ball of a
// grid element, radius r = sqrt(d - 1) step / 2, a vertex x has NN(x) <= sqrt(2) r, so an input
// point within C NN(x) (paper map (i)): it must be farther from the side than r (1 + sqrt(2) C).
template <int D>
int boundary_steps(const Box<D>& domain, MeshBox<D> box, double c) {
  const double room = distance_to_sides(domain, box);
  const auto encroached = [&] {
    const double r = std::sqrt(D - 1.0) * box.longest_boundary_step() / 2;
    return r * (1 + std::sqrt(2.0) * c) >= room;
  };
  for (box.boundary_steps = 1; encroached();) ++box.boundary_steps;
  return box.boundary_steps;
}

}  // namespace

template <int D>
MeshBox<D> mesh_box(const Options<D>& options) {
  check(options);
  const Box<D>& domain = options.domain;
  const double longest = longest_side(domain);
  if (!(longest >= 0x1p-100)) refuse("the domain is smaller than 2^-100");
  MeshBox<D> box;
  box.side = 4 * power_of_two_from(longest);
  const double grid = box.side / 1024;
  for (int i = 0; i < D; ++i) {
    const double middle = domain.lo[i] + (domain.hi[i] - domain.lo[i]) / 2;
    const double steps = std::floor((middle - box.side / 2) / grid);
    if (std::abs(steps) > 0x1p44) {
      refuse("the domain is too far from the origin for its size");
    }
    box.lo[i] = steps * grid;
  }
  check(box);
  box.boundary_steps = boundary_steps(domain, box, promise<D>(options.rule, options.rho).input);
  return box;
}

template MeshBox<2> mesh_box<2>(const Options<2>&);
#ifndef MESHER_PLANE_ONLY
template MeshBox<3> mesh_box<3>(const Options<3>&);
template MeshBox<4> mesh_box<4>(const Options<4>&);
#endif

}  // namespace mesher::detail
