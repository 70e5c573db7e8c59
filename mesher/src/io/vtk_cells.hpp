// What both of VTK's formats say of the cells of a mesh: the triangles, then the edges on lines.
#pragma once

#include <cstdint>
#include <vector>

#include "mesher/mesh_data.hpp"
#include "io/vtk_grid.hpp"

namespace mesher {

inline constexpr int kVtkLine = static_cast<int>(VtkCell::line);
inline constexpr int kVtkTriangle = static_cast<int>(VtkCell::triangle);

/// Ids or kinds as integers.
template <class T>
[[nodiscard]] std::vector<std::int64_t> as_integers(const std::vector<T>& values) {
  std::vector<std::int64_t> integers;
  for (const T value : values) integers.push_back(static_cast<std::int64_t>(value));
  return integers;
}

/// Arrays with a value for each cell, 0 where a cell has none; empty where no cell has one.
struct CellData {
  std::vector<double> regions;
  std::vector<std::int64_t> markers, lines, has_line;

  CellData(const Mesh<2>& mesh, const MeshFeatures& features) {
    const std::size_t triangles = mesh.simplices.size();
    if (!features.regions.empty()) {
      regions = features.regions;
      regions.resize(triangles + features.edges.size());
    }
    if (features.edges.empty()) return;
    markers.resize(triangles);
    lines.resize(triangles);
    has_line.resize(triangles);
    for (const MeshEdge& e : features.edges) {
      markers.push_back(e.marker);
      lines.push_back(static_cast<std::int64_t>(e.line.value_or(FeatureId{0})));
      has_line.push_back(e.line ? 1 : 0);
    }
  }

  [[nodiscard]] bool empty() const { return regions.empty() && markers.empty(); }
};

}  // namespace mesher
