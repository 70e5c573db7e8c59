// Writes `.vtk` files (VTK's legacy format, version 3.0) in ASCII, z = 0.
#include "io/vtk_cells.hpp"
#include "io/write_mesh.hpp"

namespace mesher {
namespace {

template <class Values>
void write_array(const char* type, const char* name, const Values& values, TextFile& file) {
  file << name << " 1 " << values.size() << ' ' << type << '\n';
  for (const auto value : values) file << value << '\n';
}

void write_point_data(const Mesh<2>& mesh, const MeshFeatures& features, TextFile& file) {
  const int arrays = 1 + (features.origins.empty() ? 0 : 1) + (features.markers.empty() ? 0 : 1);
  file << "POINT_DATA " << mesh.vertices.size() << "\nFIELD FieldData " << arrays << '\n';
  write_array("unsigned_char", "kind", as_integers(mesh.kinds), file);
  if (!features.origins.empty()) {
    write_array("long", "origin", as_integers(features.origins), file);
  }
  if (!features.markers.empty()) write_array("long", "marker", features.markers, file);
}

void write_cell_data(const Mesh<2>& mesh, const MeshFeatures& features, TextFile& file) {
  const CellData data(mesh, features);
  if (data.empty()) return;
  const int arrays = (data.regions.empty() ? 0 : 1) + (data.markers.empty() ? 0 : 3);
  file << "CELL_DATA " << mesh.simplices.size() + features.edges.size() << "\nFIELD FieldData "
       << arrays << '\n';
  if (!data.regions.empty()) write_array("double", "region", data.regions, file);
  if (data.markers.empty()) return;
  write_array("long", "marker", data.markers, file);
  write_array("long", "line", data.lines, file);
  write_array("unsigned_char", "has_line", data.has_line, file);
}

}  // namespace

void write_vtk(const Mesh<2>& mesh, const MeshFeatures& features, TextFile& file) {
  const std::size_t triangles = mesh.simplices.size(), lines = features.edges.size();
  file << "# vtk DataFile Version 3.0\nmesh\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS "
       << mesh.vertices.size() << " double\n";
  for (const auto& [x, y] : mesh.vertices) file << x << ' ' << y << " 0\n";
  file << "CELLS " << triangles + lines << ' ' << 4 * triangles + 3 * lines << '\n';
  for (const auto& [a, b, c] : mesh.simplices) file << "3 " << a << ' ' << b << ' ' << c << '\n';
  for (const MeshEdge& e : features.edges) file << "2 " << e.low << ' ' << e.high << '\n';
  file << "CELL_TYPES " << triangles + lines << '\n';
  for (std::size_t i = 0; i < triangles; ++i) file << kVtkTriangle << '\n';
  for (std::size_t i = 0; i < lines; ++i) file << kVtkLine << '\n';
  write_point_data(mesh, features, file);
  write_cell_data(mesh, features, file);
}

}  // namespace mesher
