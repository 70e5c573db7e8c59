// Writes `.vtu` files (VTK's XML unstructured grid) in ASCII: no byte order, no encoding of blocks
// on which readers disagree, and shortest decimals read back bit for bit.
#include "io/write_mesh.hpp"

namespace mesher {
namespace {

constexpr int kVtkTriangle = 5;  // VTK_TRIANGLE of VTK's vtkCellType.h

void write_vertices(const Mesh<2>& mesh, TextFile& file) {
  file << "<PointData Scalars=\"kind\">\n"
          "<DataArray type=\"UInt8\" Name=\"kind\" format=\"ascii\">\n";
  for (const VertexKind kind : mesh.kinds) file << static_cast<int>(kind) << '\n';
  file << "</DataArray>\n</PointData>\n<Points>\n"
          "<DataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\" "
          "format=\"ascii\">\n";
  for (const auto& [x, y] : mesh.vertices) file << x << ' ' << y << " 0\n";
  file << "</DataArray>\n</Points>\n";
}

void write_triangles(const Mesh<2>& mesh, TextFile& file) {
  file << "<Cells>\n<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">\n";
  for (const auto& [a, b, c] : mesh.simplices) file << a << ' ' << b << ' ' << c << '\n';
  file << "</DataArray>\n<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">\n";
  for (std::size_t i = 1; i <= mesh.simplices.size(); ++i) file << 3 * i << '\n';
  file << "</DataArray>\n<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">\n";
  for (std::size_t i = 0; i < mesh.simplices.size(); ++i) file << kVtkTriangle << '\n';
  file << "</DataArray>\n</Cells>\n";
}

}  // namespace

// The vertices' kind: 0 Steiner, 1 boundary grid, 2 input.
void write_vtu(const Mesh<2>& mesh, TextFile& file) {
  file << "<?xml version=\"1.0\"?>\n"
          "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
          "header_type=\"UInt64\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\""
       << mesh.vertices.size() << "\" NumberOfCells=\"" << mesh.simplices.size() << "\">\n";
  write_vertices(mesh, file);
  write_triangles(mesh, file);
  file << "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
}

}  // namespace mesher
