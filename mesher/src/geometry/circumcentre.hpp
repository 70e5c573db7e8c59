// The centre of the sphere through four points, relative to one of them [rules B2].
//
// It is computed in doubles if these are precise enough. If |a||b||c| exceeds 10^7 times their
// determinant, the four points are nearly in a plane, and cancellation may leave no correct digit:
// then the centre is a quotient of exact integers, rounded once. So a centre always has a small and
// known error.
#pragma once

#include "mesher/mesh.hpp"

namespace mesher::detail {

struct Circumcentre {
  Point<3> q{};           // relative to the first point
  double length2 = 0;     // |q|^2
  double tolerance2 = 0;  // the square of a bound on the error of 2 w.q, in units of |w|
};

/// The centre for v and its neighbours a, b, c, in any of the three orders that keep the
/// orientation: the same to the last bit.
/// Requires: orient3d(v, a, b, c) > 0. Cost: about 10 ns; nearly in a plane some 1 us.
[[nodiscard]] Circumcentre circumcentre(const Point<3>& v, const Point<3>& a, const Point<3>& b,
                                        const Point<3>& c);

/// In the plane: the centre relative to v, a quotient of exact integers always.
/// Requires: orient2d(v, a, b) != 0.
[[nodiscard]] Point<2> exact_circumcentre(const Point<2>& v, const Point<2>& a, const Point<2>& b);

}  // namespace mesher::detail
