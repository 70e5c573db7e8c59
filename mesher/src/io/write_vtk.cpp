// Writes `.vtk` files (VTK's legacy format, version 3.0) in ASCII; in the plane z = 0.
#include "io/vtk_cells.hpp"
#include "io/write_mesh.hpp"

namespace mesher {
namespace {

template <class Values>
void write_array(const char* type, const char* name, const Values& values, TextFile& file) {
  file << name << " 1 " << values.size() << ' ' << type << '\n';
  for (const auto value : values) file << value << '\n';
}

template <int D>
void write_point_data(const Mesh<D>& mesh, const MeshFeatures& features, TextFile& file) {
  const int arrays = 1 + (features.origins.empty() ? 0 : 1) + (features.markers.empty() ? 0 : 1);
  file << "POINT_DATA " << mesh.vertices.size() << "\nFIELD FieldData " << arrays << '\n';
  write_array("unsigned_char", "kind", as_integers(mesh.kinds), file);
  if (!features.origins.empty()) {
    write_array("long", "origin", as_integers(features.origins), file);
  }
  if (!features.markers.empty()) write_array("long", "marker", features.markers, file);
}

template <int D>
void write_cell_data(const Mesh<D>& mesh, const MeshFeatures& features, TextFile& file) {
  const CellData data(mesh, features);
  if (data.empty()) return;
  int arrays = 0;
  data.for_each([&](const char*, CellData::Type, const auto&) { ++arrays; });
  file << "CELL_DATA " << cell_count(mesh, features) << "\nFIELD FieldData " << arrays << '\n';
  data.for_each([&](const char* name, CellData::Type type, const auto& values) {
    constexpr const char* kTypes[] = {"double", "long", "unsigned_char"};
    write_array(kTypes[static_cast<std::size_t>(type)], name, values, file);
  });
}

}  // namespace

template <int D>
void write_vtk(const Mesh<D>& mesh, const MeshFeatures& features, const WriteHow<D>& how,
               TextFile& file) {
  const std::size_t cells = cell_count(mesh, features);
  file << "# vtk DataFile Version 3.0\nmesh\nASCII\nDATASET UNSTRUCTURED_GRID\n";
  if (D == 3 && mesh.simplices.empty()) {  // no cell tells the dimension
    file << "FIELD FieldData 1\ndimension 1 1 int\n3\n";
  }
  file << "POINTS " << mesh.vertices.size() << " double\n";
  for (const Point<D>& p : mesh.vertices) {
    write_in_space(p, file);
    file << '\n';
  }
  std::size_t numbers = 0;
  for_each_cell(mesh, features, how, [&](int, const auto& nodes) { numbers += 1 + nodes.size(); });
  file << "CELLS " << cells << ' ' << numbers << '\n';
  for_each_cell(mesh, features, how, [&](int, const auto& nodes) {
    file << nodes.size();
    for (const std::uint32_t v : nodes) file << ' ' << v;
    file << '\n';
  });
  file << "CELL_TYPES " << cells << '\n';
  for_each_cell(mesh, features, how, [&](int type, const auto&) { file << type << '\n'; });
  write_point_data(mesh, features, file);
  write_cell_data(mesh, features, file);
}

template void write_vtk(const Mesh<2>&, const MeshFeatures&, const WriteHow<2>&, TextFile&);
#ifndef MESHER_PLANE_ONLY
template void write_vtk(const Mesh<3>&, const MeshFeatures&, const WriteHow<3>&, TextFile&);
#endif

}  // namespace mesher
