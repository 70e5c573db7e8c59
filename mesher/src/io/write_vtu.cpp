// Writes `.vtu` files (VTK's XML unstructured grid) in ASCII: no byte order, no encoding of blocks
// on which readers disagree, and shortest decimals read back bit for bit.
#include "io/vtk_cells.hpp"
#include "io/write_mesh.hpp"

namespace mesher {
namespace {

// One array of numbers, a line each.
template <class Values>
void write_array(const char* type, const char* name, const Values& values, TextFile& file) {
  file << "<DataArray type=\"" << type << "\" Name=\"" << name << "\" format=\"ascii\">\n";
  for (const auto value : values) file << value << '\n';
  file << "</DataArray>\n";
}

template <int D>
void write_vertices(const Mesh<D>& mesh, const MeshFeatures& features, TextFile& file) {
  file << "<PointData Scalars=\"kind\">\n";
  write_array("UInt8", "kind", as_integers(mesh.kinds), file);
  if (!features.origins.empty()) {
    write_array("Int64", "origin", as_integers(features.origins), file);
  }
  if (!features.markers.empty()) write_array("Int64", "marker", features.markers, file);
  file << "</PointData>\n";
  const CellData data(mesh, features);
  if (!data.empty()) {
    file << "<CellData>\n";
    data.for_each([&](const char* name, CellData::Type type, const auto& values) {
      constexpr const char* kTypes[] = {"Float64", "Int64", "UInt8"};
      write_array(kTypes[static_cast<std::size_t>(type)], name, values, file);
    });
    file << "</CellData>\n";
  }
  file << "<Points>\n"
          "<DataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\" "
          "format=\"ascii\">\n";
  for (const Point<D>& p : mesh.vertices) {
    write_in_space(p, file);
    file << '\n';
  }
  file << "</DataArray>\n</Points>\n";
}

template <int D>
void write_cells(const Mesh<D>& mesh, const MeshFeatures& features, const WriteHow<D>& how,
                 TextFile& file) {
  file << "<Cells>\n<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">\n";
  for_each_cell(mesh, features, how, [&](int, const auto& nodes) {
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      file << nodes[i] << (i + 1 < nodes.size() ? ' ' : '\n');
    }
  });
  file << "</DataArray>\n<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">\n";
  std::size_t offset = 0;
  for_each_cell(mesh, features, how,
                [&](int, const auto& nodes) { file << (offset += nodes.size()) << '\n'; });
  file << "</DataArray>\n<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">\n";
  for_each_cell(mesh, features, how, [&](int type, const auto&) { file << type << '\n'; });
  file << "</DataArray>\n</Cells>\n";
}

}  // namespace

// The vertices' kind: 0 Steiner, 1 boundary grid, 2 input, 3 on a line.
template <int D>
void write_vtu(const Mesh<D>& mesh, const MeshFeatures& features, const WriteHow<D>& how,
               TextFile& file) {
  file << "<?xml version=\"1.0\"?>\n"
          "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
          "header_type=\"UInt64\">\n<UnstructuredGrid>\n";
  if (D == 3 && mesh.simplices.empty()) {  // no cell tells the dimension
    file << "<FieldData>\n<DataArray type=\"Int32\" Name=\"dimension\" NumberOfTuples=\"1\" "
            "format=\"ascii\">\n3\n</DataArray>\n</FieldData>\n";
  }
  file << "<Piece NumberOfPoints=\"" << mesh.vertices.size() << "\" NumberOfCells=\""
       << cell_count(mesh, features) << "\">\n";
  write_vertices(mesh, features, file);
  write_cells(mesh, features, how, file);
  file << "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
}

template void write_vtu(const Mesh<2>&, const MeshFeatures&, const WriteHow<2>&, TextFile&);
#ifndef MESHER_PLANE_ONLY
template void write_vtu(const Mesh<3>&, const MeshFeatures&, const WriteHow<3>&, TextFile&);
#endif

}  // namespace mesher
