// How good a single tetrahedron is.
#pragma once

#include "check/verdict.hpp"
#include "mesher/mesh.hpp"

namespace mesher::detail {

/// Circumradius over shortest edge.
struct RadiusEdge {
  double ratio;
  double error;  ///< a bound on that of `ratio`
};
/// Requires: orient3d(a, b, c, d) > 0.
[[nodiscard]] RadiusEdge radius_edge(const Point<3>& a, const Point<3>& b, const Point<3>& c,
                                     const Point<3>& d);

/// Whether a ratio exceeds the bound, by more than its rounding and 10^-9 of it, far below any use.
[[nodiscard]] inline bool is_above(const RadiusEdge& x, double rho) {
  return x.ratio - x.error > rho * (1 + 1e-9);
}

/// The ratio of a tetrahedron of a mesh.
[[nodiscard]] inline RadiusEdge radius_edge(const Mesh<3>& mesh, const Mesh<3>::Simplex& s) {
  const auto& v = mesh.vertices;
  return radius_edge(v[s[0]], v[s[1]], v[s[2]], v[s[3]]);
}

/// That no tetrahedron of a mesh is larger than `most`, by more than 10^-9 of it. Cost: O(m).
[[nodiscard]] Verdict check_volumes(const Mesh<3>& mesh, double most);

}  // namespace mesher::detail
