// The exact side of the test.
#include "geometry/diametral_ball.hpp"

#include "geometry/exact_sign.hpp"

namespace mesher::detail {

int angle_sign_exact(const Point<2>& a, const Point<2>& x, const Point<2>& b) {
  return predicates::detail::exact_sign<2, 3>({a[0], a[1], b[0], b[1], x[0], x[1]},
                                              [](const auto& d) {
                                                const auto& [ax, ay, bx, by] = d;
                                                return sign(ax * bx + ay * by);
                                              });
}

}  // namespace mesher::detail
