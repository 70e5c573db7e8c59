// What the checks of meshes of triangles and of tetrahedra share. D is 2 or 3.
#pragma once

#include <functional>
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

/// A point that is to be a vertex, and the line of its file.
template <int D>
struct InputPoint {
  Point<D> at;
  FeatureId id;
  long line;
};
/// "input point 7 at (0, 1) (line 8)"
template <int D>
[[nodiscard]] std::string input_name(const InputPoint<D>& point);
template <int D>
[[nodiscard]] std::vector<InputPoint<D>> input_points(const PointFile<D>& file);

/// Whether all points are vertices, bit for bit, but those that may be outside and are.
template <int D>
[[nodiscard]] Verdict check_input(const Mesh<D>& mesh, const std::vector<InputPoint<D>>& points,
                                  const std::function<bool(const Point<D>&)>& is_outside);

/// Whether vertices of the kind `boundary` are on the bounding box and, if there is an input, those
/// of the kind `input` are its points, under the ids that `origins` (one per vertex, or none) has.
template <int D>
[[nodiscard]] Verdict check_kinds(const Mesh<D>& mesh, const PointFile<D>* input,
                                  const std::vector<FeatureId>& origins);

}  // namespace mesher::detail
