// The exact side of the predicates in the plane.
#include "mesher/predicates.hpp"

#include <algorithm>

#include "geometry/exact_sign.hpp"

namespace mesher::predicates::detail {

namespace {

template <std::size_t W>
int orient2d_sign(const std::array<FixedInt<W>, 4>& d) {
  const auto& [ax, ay, bx, by] = d;
  return sign(minor(ax, ay, bx, by));
}

template <std::size_t W>
int incircle_sign(const std::array<FixedInt<W>, 6>& d) {
  const auto& [ax, ay, bx, by, cx, cy] = d;
  return sign((ax * ax + ay * ay) * minor(bx, by, cx, cy) +
              (bx * bx + by * by) * minor(cx, cy, ax, ay) +
              (cx * cx + cy * cy) * minor(ax, ay, bx, by));
}

}  // namespace

int orient2d_exact(const Point<2>& a, const Point<2>& b, const Point<2>& c) {
  return exact_sign<2, 3>({a[0], a[1], b[0], b[1], c[0], c[1]},
                          [](const auto& d) { return orient2d_sign(d); });
}

int incircle_exact(const Point<2>& a, const Point<2>& b, const Point<2>& c, const Point<2>& d) {
  return exact_sign<2, 4>({a[0], a[1], b[0], b[1], c[0], c[1], d[0], d[1]},
                          [](const auto& differences) { return incircle_sign(differences); });
}

/// The cofactor of the height of the greatest point in the determinant with rows px, py, h(p), 1;
/// it is not 0 (see incircle_perturbed).
int cocircular_tie(const Point<2>& a, const Point<2>& b, const Point<2>& c, const Point<2>& d) {
  const Point<2>& ab = std::max(a, b);
  const Point<2>& cd = std::max(c, d);
  if (ab < cd) return cd == d ? -orient2d(a, b, c) : orient2d(a, b, d);
  return ab == b ? -orient2d(a, c, d) : orient2d(b, c, d);
}

}  // namespace mesher::predicates::detail
