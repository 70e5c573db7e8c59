// Off-centres, and what keeps them in the box and apart from what is there.
#include "refinement/centres.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/input_point.hpp"
#include "geometry/plane_vectors.hpp"
#include "geometry/space_vectors.hpp"

namespace mesher::detail {

namespace {

// An off-centre aims a little lower than the bound, so that rounding does not make it poor.
constexpr double kAim = 1 - 0x1p-16;
// Nearer than this to a side of the box, in units of its distance to vertices, no vertex is put.
constexpr double kBesideSide = 0.25;
// A new vertex is at least so far from the corners of the simplex, in units of the distance that it
// should have: 0.8 for rho = 1.01, if nothing is rounded.
constexpr double kLeastDistance = 0.5;

// The most from the middle of an edge of length 1 to its off-centre. In the plane that is where the
// triangle of both would have a circumradius of rho; in space lower is better.
template <int D>
double offcentre_height(double rho) {
  const double aim = rho * kAim;
  return D == 2 ? aim + std::sqrt(aim * aim - 0.25) : rho;
}

}  // namespace

template <int D>
Centres<D>::Centres(const MeshBox<D>& box, double rho)
    : box_(box), height_(offcentre_height<D>(rho)), tiny_(box.side * 0x1p-60) {}

template <int D>
Centre<D> Centres<D>::of(const Kernel& kernel, std::uint32_t s) const {
  const auto& corners = kernel.simplices().corners(s);
  double shortest2 = std::numeric_limits<double>::infinity();
  const Point<D>*a = nullptr, *b = nullptr;
  for (std::size_t i = 0; i <= D; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Point<D>&p = kernel.place(corners[i]), &q = kernel.place(corners[j]);
      const double length2 = squared_distance(p, q);
      if (length2 < shortest2) shortest2 = length2, a = &p, b = &q;
    }
  }
  const Point<D>& circumcentre = kernel.simplices().ball(s).centre;
  Point<D> middle;
  for (std::size_t i = 0; i < D; ++i) middle[i] = (*a)[i] + ((*b)[i] - (*a)[i]) / 2;
  const double height2 = squared_distance(circumcentre, middle);
  const double highest2 = height_ * height_ * shortest2;
  Centre<D> centre{circumcentre, std::sqrt(std::min(height2, highest2) + shortest2 / 4), false};
  if (height2 > highest2) {
    const double share = std::sqrt(highest2 / height2);
    for (std::size_t i = 0; i < D; ++i) {
      centre.place[i] = middle[i] + share * (circumcentre[i] - middle[i]);
    }
  }
  // Noise of sums that cancel near an axis would leave the predicates' range of bits.
  for (double& x : centre.place) x = std::abs(x) < tiny_ ? 0 : x;
  centre = moved_to_sides(centre, kBesideSide * centre.radius);
  if (!centre.on_side || kernel.conflicts(s, centre.place)) return centre;
  // What is nearest in the box to the circumcentre is nearer than the corners.
  return moved_to_sides({circumcentre, centre.radius, false}, 0);
}

/// What is nearer than this to a side, or outside of it, goes onto it.
template <int D>
Centre<D> Centres<D>::moved_to_sides(const Centre<D>& centre, double margin) const {
  Centre<D> moved = centre;
  for (int i = 0; i < D; ++i) {
    double& x = moved.place[i];
    const double side = x < box_.lo[i] + margin ? box_.lo[i] : box_.hi(i);
    if (x >= box_.lo[i] + margin && x <= box_.hi(i) - margin) continue;
    x = side;
    moved.on_side = true;
  }
  return moved;
}

/// Of doubles there are not enough where input points are nearly equal.
template <int D>
void Centres<D>::require_apart(const Kernel& kernel, std::uint32_t s,
                               const Centre<D>& centre) const {
  const double least = centre.on_side ? 0 : kLeastDistance * centre.radius;
  for (const std::uint32_t w : kernel.simplices().corners(s)) {
    const double length2 = squared_distance(kernel.place(w), centre.place);
    if (length2 > least * least) continue;
    throw Error(ErrorCode::too_close, "input points are too close for double precision near " +
                                          place_text(kernel.place(w)) +
                                          ": rounding moved a new vertex to " +
                                          place_text(centre.place));
  }
  if (kernel.conflicts(s, centre.place)) return;
  throw Error(ErrorCode::too_close,
              "input points are too close for double precision near " + place_text(centre.place));
}

template class Centres<2>;
#ifndef MESHER_PLANE_ONLY
template class Centres<3>;
#endif

}  // namespace mesher::detail
