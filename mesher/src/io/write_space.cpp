// The formats of meshes of tetrahedra: those of the plane's writers, with a third coordinate.
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "geometry/box.hpp"
#include "io/text.hpp"
#include "io/write_surface.hpp"
#include "mesher/space_files.hpp"
#include "mesher/space_svg.hpp"

namespace mesher {

namespace {

constexpr std::size_t kFirst = 1;  // of what is numbered in TetGen's, Gmsh's and Medit's files
constexpr int kVtkTetrahedron = 10;

void write_place(const Point<3>& p, TextFile& file) { file << p[0] << ' ' << p[1] << ' ' << p[2]; }

void write_places(const Mesh<3>& mesh, std::string_view after, TextFile& file) {
  for (const Point<3>& p : mesh.vertices) {
    write_place(p, file);
    file << after;
  }
}

// Cells or faces: the number of each, its corners, and what comes after.
template <class Corners>
void write_numbered(const std::vector<Corners>& rows, std::string_view after, TextFile& file) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    file << i + kFirst;
    for (const std::uint32_t corner : rows[i]) file << ' ' << corner + kFirst;
    file << after;
  }
}

void write_node(const Mesh<3>& mesh, TextFile& file) {
  file << mesh.vertices.size() << " 3 1 1\n";
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    file << i + kFirst << ' ';
    write_place(mesh.vertices[i], file);
    file << (mesh.kinds[i] == VertexKind::input ? " 1" : " 0");
    file << (mesh.kinds[i] == VertexKind::boundary ? " 1\n" : " 0\n");
  }
}

void write_ele(const Mesh<3>& mesh, TextFile& file) {
  file << mesh.simplices.size() << " 4 0\n";
  write_numbered(mesh.simplices, "\n", file);
}

void write_face(const Mesh<3>& mesh, TextFile& file) {
  const auto faces = boundary_faces(mesh);
  file << faces.size() << " 1\n";
  write_numbered(faces, " 1\n", file);
}

void write_vtu(const Mesh<3>& mesh, TextFile& file) {
  file << "<?xml version=\"1.0\"?>\n"
          "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
          "header_type=\"UInt64\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\""
       << mesh.vertices.size() << "\" NumberOfCells=\"" << mesh.simplices.size() << "\">\n"
       << "<PointData Scalars=\"kind\">\n"
          "<DataArray type=\"UInt8\" Name=\"kind\" format=\"ascii\">\n";
  for (const VertexKind kind : mesh.kinds) file << static_cast<int>(kind) << '\n';
  file << "</DataArray>\n</PointData>\n<Points>\n<DataArray type=\"Float64\" Name=\"Points\" "
          "NumberOfComponents=\"3\" format=\"ascii\">\n";
  write_places(mesh, "\n", file);
  file << "</DataArray>\n</Points>\n<Cells>\n"
          "<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">\n";
  for (const auto& [a, b, c, d] : mesh.simplices) {
    file << a << ' ' << b << ' ' << c << ' ' << d << '\n';
  }
  file << "</DataArray>\n<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">\n";
  for (std::size_t i = 1; i <= mesh.simplices.size(); ++i) file << 4 * i << '\n';
  file << "</DataArray>\n<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">\n";
  for (std::size_t i = 0; i < mesh.simplices.size(); ++i) file << kVtkTetrahedron << '\n';
  file << "</DataArray>\n</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
}

void write_vtk(const Mesh<3>& mesh, TextFile& file) {
  file << "# vtk DataFile Version 3.0\nmesh\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS "
       << mesh.vertices.size() << " double\n";
  write_places(mesh, "\n", file);
  const std::size_t cells = mesh.simplices.size();
  file << "CELLS " << cells << ' ' << 5 * cells << '\n';
  for (const auto& [a, b, c, d] : mesh.simplices) {
    file << "4 " << a << ' ' << b << ' ' << c << ' ' << d << '\n';
  }
  file << "CELL_TYPES " << cells << '\n';
  for (std::size_t i = 0; i < cells; ++i) file << kVtkTetrahedron << '\n';
  file << "POINT_DATA " << mesh.vertices.size() << "\nFIELD FieldData 1\nkind 1 "
       << mesh.vertices.size() << " unsigned_char\n";
  for (const VertexKind kind : mesh.kinds) file << static_cast<int>(kind) << '\n';
}

// One entity, the volume 1, that all nodes and elements are of.
void write_msh(const Mesh<3>& mesh, TextFile& file) {
  constexpr int kVolume = 3, kTetrahedron = 4;  // the entity's dimension, the elements' type
  const auto box = detail::bounding_box<3>(mesh.vertices);
  file << "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n0 0 0 1\n1 ";
  write_place(box.lo, file);
  file << ' ';
  write_place(box.hi, file);
  const std::size_t nodes = mesh.vertices.size(), elements = mesh.simplices.size();
  file << " 0 0\n$EndEntities\n$Nodes\n1 " << nodes << " 1 " << nodes << '\n'
       << kVolume << " 1 0 " << nodes << '\n';
  for (std::size_t i = 0; i < nodes; ++i) file << i + kFirst << '\n';
  write_places(mesh, "\n", file);
  file << "$EndNodes\n$Elements\n1 " << elements << " 1 " << elements << '\n'
       << kVolume << " 1 " << kTetrahedron << ' ' << elements << '\n';
  write_numbered(mesh.simplices, "\n", file);
  file << "$EndElements\n";
}

void write_medit(const Mesh<3>& mesh, TextFile& file) {
  file << "MeshVersionFormatted 2\n\nDimension 3\n\nVertices\n" << mesh.vertices.size() << '\n';
  write_places(mesh, " 0\n", file);
  file << "\nTetrahedra\n" << mesh.simplices.size() << '\n';
  for (const auto& simplex : mesh.simplices) {
    for (const std::uint32_t corner : simplex) file << corner + kFirst << ' ';
    file << "0\n";
  }
  file << "\nEnd\n";
}

using Write = void (*)(const Mesh<3>&, TextFile&);
constexpr std::pair<std::string_view, Write> kSingleFiles[] = {
    {".vtu", write_vtu},
    {".vtk", write_vtk},
    {".msh", write_msh},
    {".mesh", write_medit},
    {".off", write_surface_off},
    {".obj", write_surface_obj},
    {".stl", write_surface_stl},
    {".svg", [](const Mesh<3>& mesh, TextFile& file) { write_svg(mesh, space_view(mesh), file); }}};

SpaceMeshWriter open_node(OutputFiles& files, const std::string& path) {
  TextFile& node = files.open(path);
  TextFile& ele = files.open(text::with_extension(path, ".ele"));
  TextFile& face = files.open(text::with_extension(path, ".face"));
  return [&node, &ele, &face](const Mesh<3>& mesh) {
    write_node(mesh, node);
    write_ele(mesh, ele);
    write_face(mesh, face);
  };
}

}  // namespace

SpaceMeshWriter open_space_mesh(OutputFiles& files, const std::string& path) {
  const std::string extension = text::extension(path);
  if (extension == ".node") return open_node(files, path);
  for (const auto& [known, write] : kSingleFiles) {
    if (extension != known) continue;
    TextFile& file = files.open(path);
    return [write = write, &file](const Mesh<3>& mesh) { write(mesh, file); };
  }
  throw Error(ErrorCode::unknown_format,
              "meshes of tetrahedra are written to .node (with .ele and .face), .vtu, .vtk, .msh "
              "and .mesh, their boundaries to .off, .obj and .stl, pictures to .svg, not " +
                  text::quoted(extension),
              {path});
}

void write_mesh(const Mesh<3>& mesh, const std::string& path) {
  OutputFiles files;
  open_space_mesh(files, path)(mesh);
  files.commit();
}

}  // namespace mesher
