// What the checks of meshes of triangles and of tetrahedra share. D is 2 or 3.
#pragma once

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <vector>

#include "check/verdict.hpp"

namespace mesher::detail {

/// "vertex 5 at (0, 1)", counted from 1.
template <int D>
[[nodiscard]] std::string vertex_name(const Mesh<D>& mesh, std::size_t v);
/// "triangle 5 with the vertices 1, 2, 3", counted from 1.
template <int D>
[[nodiscard]] std::string simplex_name(const Mesh<D>& mesh, std::size_t i);

/// Whether the predicates can judge all coordinates.
template <int D>
[[nodiscard]] Verdict check_coordinates(const Mesh<D>& mesh);

/// Whether no two vertices coincide and each is a corner.
template <int D>
[[nodiscard]] Verdict check_vertices(const Mesh<D>& mesh);

/// Whether all simplices are positively oriented.
template <int D>
[[nodiscard]] Verdict check_orientation(const Mesh<D>& mesh);

/// Whether vertices of the kind `boundary` are on the bounding box and, if there is an input, those
/// of the kind `input` are its points, under the ids that `origins` (one per vertex, or none) has.
template <int D>
[[nodiscard]] Verdict check_kinds(const Mesh<D>& mesh, const GraphFile<D>* input,
                                  const std::vector<mesher::Feature>& origins);

/// Whether all places are on one side of a box.
template <int D>
[[nodiscard]] bool is_on_side(const Box<D>& box, const std::array<Point<D>, D>& places) {
  for (std::size_t i = 0; i < D; ++i) {
    for (const double side : {box.lo[i], box.hi[i]}) {
      const auto is_there = [&](const Point<D>& p) { return p[i] == side; };
      if (std::all_of(places.begin(), places.end(), is_there)) return true;
    }
  }
  return false;
}
/// Whether each corner of a box is one of the points, which have a place `at`.
template <int D, class Points>
[[nodiscard]] bool has_corners(const Box<D>& box, const Points& points) {
  std::set<Point<D>> corners;
  for (unsigned c = 0; c < 1u << D; ++c) {
    Point<D> corner;
    for (unsigned i = 0; i < D; ++i) corner[i] = (c >> i & 1) != 0 ? box.hi[i] : box.lo[i];
    corners.insert(corner);
  }
  for (const auto& p : points) corners.erase(p.at);
  return corners.empty();
}

}  // namespace mesher::detail
