// Dihedral angles.
#include "rules/sliver_rule.hpp"

#include <algorithm>
#include <numbers>

#include "geometry/space_vectors.hpp"

namespace mesher::detail {

SliverRule::SliverRule(const MeshBox<3>& box, double min_dihedral)
    : box_(box),
      most_(min_dihedral <= 10   ? 12
            : min_dihedral <= 12 ? 16
                                 : 24) {
  const double cosine = std::cos(min_dihedral * (std::numbers::pi / 180));
  worst_ = min_dihedral > 0 ? cosine * cosine : 1;
}

bool SliverRule::is_surely_good(const Point<3>& a, const Point<3>& b,
                                const Point<3>& c) const noexcept {
  std::array<Point<3>, 4> normal{Point<3>{}, cross(b, c), cross(c, a), cross(a, b)};
  normal[0] = scaled(-1, plus(normal[1], plus(normal[2], normal[3])));
  std::array<double, 4> length2;
  for (std::size_t i = 0; i < 4; ++i) length2[i] = squared(normal[i]);
  const double most = worst_ * (1 - 0x1p-20);
  bool good = true;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const double d = -dot(normal[i], normal[k]);
      good &= d * std::abs(d) < most * length2[i] * length2[k];
    }
  }
  return good;
}

double SliverRule::score(std::array<const Point<3>*, 4> corners) {
  std::sort(corners.begin(), corners.end(), [](auto* p, auto* q) { return *p < *q; });
  const Point<3> a = minus(*corners[1], *corners[0]), b = minus(*corners[2], *corners[0]),
                 c = minus(*corners[3], *corners[0]);
  std::array<Point<3>, 4> normal{Point<3>{}, cross(b, c), cross(c, a), cross(a, b)};
  normal[0] = scaled(-1, plus(normal[1], plus(normal[2], normal[3])));
  std::array<double, 4> length2;
  for (std::size_t i = 0; i < 4; ++i) length2[i] = squared(normal[i]);
  double worst = -1;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const double d = -dot(normal[i], normal[k]);
      const double cosine2 = d * std::abs(d) / (length2[i] * length2[k]);
      if (!(cosine2 <= worst)) worst = std::min(cosine2, 1.0);  // of what is flat it is no number
    }
  }
  return worst;
}

}  // namespace mesher::detail
