// What a mesh by refinement of points has to be.
#pragma once

#include <algorithm>
#include <catch2/catch.hpp>
#include <vector>

#include "delaunay_case.hpp"
#include "mesher/delaunay.hpp"
#include "space_points.hpp"

namespace support {

/// By the judge; and against the triangulation of the vertices from scratch, which agrees in ties.
template <int D>
void check_refined(const mesher::Mesh<D>& mesh, const std::vector<mesher::Point<D>>& points,
                   double rho) {
  CHECK(box_verdict<D>(mesh, points, rho) == "");
  CHECK(std::is_sorted(mesh.vertices.begin(), mesh.vertices.end()));
  const auto fresh = mesher::delaunay<D>(mesh.vertices);
  CHECK(fresh.duplicates.empty());
  CHECK(as_set<D>(mesh.simplices) == as_set<D>(fresh.simplices));
  std::size_t inputs = 0;
  for (const auto kind : mesh.kinds) inputs += kind == mesher::VertexKind::input ? 1 : 0;
  CHECK(inputs == points.size());
  for (const auto& p : points) {
    const auto at = std::lower_bound(mesh.vertices.begin(), mesh.vertices.end(), p);
    REQUIRE((at != mesh.vertices.end() && *at == p));
    CHECK(mesh.kinds[static_cast<std::size_t>(at - mesh.vertices.begin())] ==
          mesher::VertexKind::input);
  }
}

}  // namespace support
