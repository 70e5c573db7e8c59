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

void write_vertices(const Mesh<2>& mesh, const MeshFeatures& features, TextFile& file) {
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
    if (!data.regions.empty()) write_array("Float64", "region", data.regions, file);
    if (!data.markers.empty()) write_array("Int64", "marker", data.markers, file);
    if (!data.lines.empty()) write_array("Int64", "line", data.lines, file);
    if (!data.has_line.empty()) write_array("UInt8", "has_line", data.has_line, file);
    file << "</CellData>\n";
  }
  file << "<Points>\n"
          "<DataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\" "
          "format=\"ascii\">\n";
  for (const auto& [x, y] : mesh.vertices) file << x << ' ' << y << " 0\n";
  file << "</DataArray>\n</Points>\n";
}

void write_cells(const Mesh<2>& mesh, const MeshFeatures& features, TextFile& file) {
  file << "<Cells>\n<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">\n";
  for (const auto& [a, b, c] : mesh.simplices) file << a << ' ' << b << ' ' << c << '\n';
  for (const MeshEdge& e : features.edges) file << e.low << ' ' << e.high << '\n';
  file << "</DataArray>\n<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">\n";
  const std::size_t triangles = mesh.simplices.size();
  for (std::size_t i = 1; i <= triangles; ++i) file << 3 * i << '\n';
  for (std::size_t i = 1; i <= features.edges.size(); ++i) file << 3 * triangles + 2 * i << '\n';
  file << "</DataArray>\n<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">\n";
  for (std::size_t i = 0; i < triangles; ++i) file << kVtkTriangle << '\n';
  for (std::size_t i = 0; i < features.edges.size(); ++i) file << kVtkLine << '\n';
  file << "</DataArray>\n</Cells>\n";
}

}  // namespace

// The vertices' kind: 0 Steiner, 1 boundary grid, 2 input, 3 on a line.
void write_vtu(const Mesh<2>& mesh, const MeshFeatures& features, TextFile& file) {
  file << "<?xml version=\"1.0\"?>\n"
          "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
          "header_type=\"UInt64\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\""
       << mesh.vertices.size() << "\" NumberOfCells=\""
       << mesh.simplices.size() + features.edges.size() << "\">\n";
  write_vertices(mesh, features, file);
  write_cells(mesh, features, file);
  file << "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
}

}  // namespace mesher
