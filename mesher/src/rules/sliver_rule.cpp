// Dihedral angles.
#include "rules/sliver_rule.hpp"

#include <algorithm>
#include <numbers>

#include "geometry/space_vectors.hpp"

namespace mesher::detail {

namespace {

// Of the facets of the tetrahedron of 0, a, b and c, all outward or all inward, twice their areas
// long.
struct NormalsOfFacets {
  std::array<Point<3>, 4> normal;
  std::array<double, 4> length2;
};

NormalsOfFacets normals_of(const Point<3>& a, const Point<3>& b, const Point<3>& c) noexcept {
  NormalsOfFacets all{{Point<3>{}, cross(b, c), cross(c, a), cross(a, b)}, {}};
  auto& normal = all.normal;
  normal[0] = scaled(-1, plus(normal[1], plus(normal[2], normal[3])));
  for (std::size_t i = 0; i < 4; ++i) all.length2[i] = squared(normal[i]);
  return all;
}

}  // namespace

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
  const auto [normal, length2] = normals_of(a, b, c);
  const double most = worst_ * (1 - 0x1p-20);
  // Of shorter edges products lose digits.
  if (*std::min_element(length2.begin(), length2.end()) < 0x1p-400) return false;
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
  std::array<Point<3>, 3> edges;
  double longest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    edges[i] = minus(*corners[i + 1], *corners[0]);
    for (const double x : edges[i]) longest = std::max(longest, std::abs(x));
  }
  if (longest == 0) return 1;
  // Products of eight lengths are in range then.
  for (Point<3>& edge : edges) edge = scaled(std::scalbn(1.0, -std::ilogb(longest)), edge);
  const auto& [a, b, c] = edges;
  const auto [normal, length2] = normals_of(a, b, c);
  double worst = -1;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const double d = -dot(normal[i], normal[k]);
      const double cosine2 = d * std::abs(d) / (length2[i] * length2[k]);
      if (!(cosine2 <= worst))
        worst = cosine2 < 1 ? cosine2 : 1;  // of what is flat it is no number
    }
  }
  return worst;
}

}  // namespace mesher::detail
