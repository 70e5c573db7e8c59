// Reads `.off` files (Geomview).
//
//   OFF
//   vertices faces edges
//   x y z
//   3 corner corner corner     (from 0)
#include <utility>

#include "io/read_mesh.hpp"
#include "io/rows.hpp"
#include "text/text.hpp"

namespace mesher {
namespace {

Point<2> read_vertex(const text::Line& line) {
  if (line.finite(2) == 0) return {line.finite(0), line.finite(1)};
  throw line.error(ErrorCode::bad_dimension, "a vertex in space, expected the plane (z = 0)", 2);
}

Mesh<2>::Simplex read_face(const text::Line& line, std::size_t vertices) {
  if (line.integer(0) != 3) {
    throw line.error(ErrorCode::bad_mesh, "a face of " + text::quoted(line[0]) + " corners", 0);
  }
  return read_corners<2>(line, 1, [&](std::size_t i) {
    return vertex_index(line.integer(i), vertices, 0, [&] { return line.place(i); });
  });
}

}  // namespace

AnyMesh read_off(const std::string& path) {
  const std::string content = text::read_file(path);
  text::FieldLines lines(path, content);
  const text::Line& first = header_row(lines, path);
  if (first[0] != "OFF" || first.size() != 1) {
    throw first.error(ErrorCode::bad_header, "the first line must be 'OFF'", 0);
  }
  const text::Line& counts = next_row(lines, 2, 0, 1, "lines of counts");
  const std::int64_t vertices = read_count(counts, 0), faces = read_count(counts, 1);
  MeshData<2> mesh;
  while (std::cmp_less(mesh.vertices.size(), vertices)) {
    mesh.vertices.push_back(
        read_vertex(next_row(lines, 3, mesh.vertices.size(), vertices, "vertices")));
  }
  require_indexable(mesh.vertices.size(), path);
  mesh.kinds.assign(mesh.vertices.size(), VertexKind::steiner);
  while (std::cmp_less(mesh.simplices.size(), faces)) {
    const text::Line& line = next_row(lines, 4, mesh.simplices.size(), faces, "faces");
    mesh.simplices.push_back(read_face(line, mesh.vertices.size()));
  }
  require_end(lines, "faces");
  return mesh;
}

}  // namespace mesher
