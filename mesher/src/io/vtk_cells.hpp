// The cells of a mesh in both of VTK's formats: the simplices, in space then the faces in polygons,
// then the edges on lines.
#pragma once

#include <cstdint>
#include <vector>

#include "io/vtk_grid.hpp"
#include "io/write_mesh.hpp"
#include "mesher/mesh.hpp"

namespace mesher {

[[nodiscard]] inline std::vector<std::int64_t> as_integers(const std::vector<Feature>& origins) {
  std::vector<std::int64_t> integers;
  for (const Feature& origin : origins) integers.push_back(origin.number);
  return integers;
}
template <class T>
[[nodiscard]] std::vector<std::int64_t> as_integers(const std::vector<T>& values) {
  std::vector<std::int64_t> integers;
  for (const T value : values) integers.push_back(static_cast<std::int64_t>(value));
  return integers;
}

/// Arrays with a value for each cell, 0 where a cell has none; empty where no cell has one. Cells:
/// simplices, faces, edges.
struct CellData {
  std::vector<double> regions;
  std::vector<std::int64_t> markers, lines, has_line, polygons, has_polygon;

  template <int D>
  CellData(const Mesh<D>& mesh, const MeshFeatures& features) {
    const std::size_t simplices = mesh.simplices.size(), faces = features.faces.size();
    const std::size_t all = simplices + faces + features.edges.size();
    if (!features.regions.empty()) {
      regions = features.regions;
      regions.resize(all);
    }
    if (all == simplices) return;
    for (auto* array : {&markers, &lines, &has_line}) array->resize(all);
    if (D == 3) polygons.resize(all), has_polygon.resize(all);
    for (std::size_t i = 0; i < faces; ++i) {
      const MeshFace& f = features.faces[i];
      markers[simplices + i] = f.marker;
      polygons[simplices + i] = static_cast<std::int64_t>(f.polygon.value_or(PolygonId{0}));
      has_polygon[simplices + i] = f.polygon ? 1 : 0;
    }
    for (std::size_t i = 0; i < features.edges.size(); ++i) {
      const MeshEdge& e = features.edges[i];
      markers[simplices + faces + i] = e.marker;
      lines[simplices + faces + i] = static_cast<std::int64_t>(e.line.value_or(LineId{0}));
      has_line[simplices + faces + i] = e.line ? 1 : 0;
    }
  }

  [[nodiscard]] bool empty() const { return regions.empty() && markers.empty(); }
  /// Calls visit(name, type, values) for those there are; a type is real, whole, or flag.
  enum class Type : std::uint8_t { real, whole, flag };
  template <class Visit>
  void for_each(Visit&& visit) const {
    if (!regions.empty()) visit("region", Type::real, regions);
    if (!markers.empty()) visit("marker", Type::whole, markers);
    if (!polygons.empty()) {
      visit("polygon", Type::whole, polygons);
      visit("has_polygon", Type::flag, has_polygon);
    }
    if (!lines.empty()) {
      visit("line", Type::whole, lines);
      visit("has_line", Type::flag, has_line);
    }
  }
};

/// Calls visit(type, nodes) for each cell.
template <int D, class Visit>
void for_each_cell(const Mesh<D>& mesh, const MeshFeatures& features, const WriteHow<D>& how,
                   Visit&& visit) {
  const auto type_of = [&](VtkCell first, VtkCell second) {
    return static_cast<int>(how.second == nullptr ? first : second);
  };
  const int line = type_of(VtkCell::line, VtkCell::quadratic_line);
  const int triangle = type_of(VtkCell::triangle, VtkCell::quadratic_triangle);
  const int tetrahedron = type_of(VtkCell::tetrahedron, VtkCell::quadratic_tetrahedron);
  const auto visit_as = [&](int type) {
    return [&visit, type](const auto& nodes) { visit(type, nodes); };
  };
  for (const auto& s : mesh.simplices) {
    visit_nodes<D>(s, how, visit_as(D == 2 ? triangle : tetrahedron));
  }
  for (const MeshFace& f : features.faces) visit_nodes(f, how, visit_as(triangle));
  for (const MeshEdge& e : features.edges) visit_nodes(e, how, visit_as(line));
}
template <int D>
[[nodiscard]] std::size_t cell_count(const Mesh<D>& mesh, const MeshFeatures& features) {
  return mesh.simplices.size() + features.faces.size() + features.edges.size();
}

}  // namespace mesher
