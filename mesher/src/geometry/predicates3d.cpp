// The exact side of the predicates in space.
#include <algorithm>

#include "geometry/exact_sign.hpp"
#include "geometry/ties.hpp"
#include "mesher/predicates.hpp"

namespace mesher::predicates::detail {

namespace {

/// The determinant of three rows x, y, z.
template <std::size_t W>
FixedInt<3 * W> minor(const FixedInt<W>* a, const FixedInt<W>* b, const FixedInt<W>* c) {
  return minor(b[0], b[1], c[0], c[1]) * a[2] + minor(c[0], c[1], a[0], a[1]) * b[2] +
         minor(a[0], a[1], b[0], b[1]) * c[2];
}

template <std::size_t W>
int orient3d_sign(const std::array<FixedInt<W>, 9>& d) {
  return -sign(minor(&d[0], &d[3], &d[6]));
}

template <std::size_t W>
int insphere_sign(const std::array<FixedInt<W>, 12>& d) {
  const FixedInt<W>*a = &d[0], *b = &d[3], *c = &d[6], *e = &d[9];
  const auto lift = [](const FixedInt<W>* p) { return p[0] * p[0] + p[1] * p[1] + p[2] * p[2]; };
  const FixedInt<5 * W> even = lift(e) * minor(a, b, c) + lift(b) * minor(c, e, a);
  return -sign(even - (lift(c) * minor(e, a, b) + lift(a) * minor(b, c, e)));
}

/// Whether the points are corners of one box with sides along the axes, hence on one sphere: on
/// grids, rounded ones too, most ties are of this kind, and need no arithmetic.
bool are_corners_of_box(const Point<3>& a, const Point<3>& b, const Point<3>& c, const Point<3>& d,
                        const Point<3>& e) {
  for (std::size_t i = 0; i < 3; ++i) {
    const double one = a[i];
    const double other = b[i] != one ? b[i] : c[i] != one ? c[i] : d[i] != one ? d[i] : e[i];
    const auto fits = [&](const Point<3>& p) { return p[i] == one || p[i] == other; };
    if (!fits(c) || !fits(d) || !fits(e)) return false;
  }
  return true;
}

/// Whether the points are in one plane across an axis.
bool are_across_axis(const Point<3>& a, const Point<3>& b, const Point<3>& c, const Point<3>& d) {
  bool any = false;
  for (std::size_t i = 0; i < 3; ++i) any |= a[i] == b[i] && a[i] == c[i] && a[i] == d[i];
  return any;
}

}  // namespace

int orient3d_exact(const Point<3>& a, const Point<3>& b, const Point<3>& c, const Point<3>& d) {
  if (are_across_axis(a, b, c, d)) return 0;
  return exact_sign<3, 4>({a[0], a[1], a[2], b[0], b[1], b[2], c[0], c[1], c[2], d[0], d[1], d[2]},
                          [](const auto& differences) { return orient3d_sign(differences); });
}

int insphere_exact(const Point<3>& a, const Point<3>& b, const Point<3>& c, const Point<3>& d,
                   const Point<3>& e) {
  if (are_corners_of_box(a, b, c, d, e)) return 0;
  return exact_sign<3, 5>(
      {a[0], a[1], a[2], b[0], b[1], b[2], c[0], c[1], c[2], d[0], d[1], d[2], e[0], e[1], e[2]},
      [](const auto& differences) { return insphere_sign(differences); });
}

int cospherical_tie(const Point<3>& a, const Point<3>& b, const Point<3>& c, const Point<3>& d,
                    const Point<3>& e) {
  return first_cofactor({&a, &b, &c, &d, &e},
                        [](const auto&... corners) { return orient3d(corners...); });
}

}  // namespace mesher::predicates::detail
