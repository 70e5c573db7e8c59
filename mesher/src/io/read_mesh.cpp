// Reads triangulations: `.node` with `.ele` beside it (Triangle), and `.off` (Geomview).
//
//   .ele:  count [corners [attributes]]        .off:  OFF
//          id corner corner corner ...                vertices faces edges
//                                                     x y z
//                                                     3 corner corner corner     (from 0)
#include <algorithm>
#include <cstdint>
#include <utility>

#include "mesher/io.hpp"
#include "io/read_node.hpp"
#include "io/text.hpp"

namespace mesher {
namespace {

using Corners = Mesh<2>::Simplex;

// Finds the position of a vertex by its id.
class VertexTable {
 public:
  explicit VertexTable(const std::vector<FeatureId>& ids) {
    for (std::size_t i = 0; i < ids.size(); ++i) rows_.emplace_back(ids[i], i);
    std::sort(rows_.begin(), rows_.end());
  }
  // Field i of `line` as a vertex. Throws: Error(bad_mesh) if there is none of that id.
  [[nodiscard]] std::uint32_t at(const text::Line& line, std::size_t i) const {
    const FeatureId id{line.integer(i)};
    const auto row = std::lower_bound(rows_.begin(), rows_.end(), std::pair(id, std::size_t{0}));
    if (row != rows_.end() && row->first == id) return static_cast<std::uint32_t>(row->second);
    throw line.error(ErrorCode::bad_mesh, "no vertex has the id " + std::string(line[i]), i);
  }

 private:
  std::vector<std::pair<FeatureId, std::size_t>> rows_;
};

// Requires: fields first .. first+2 of `line` exist.
template <class IndexOf>
Corners read_corners(const text::Line& line, std::size_t first, IndexOf index_of) {
  const Corners t{index_of(first), index_of(first + 1), index_of(first + 2)};
  if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) return t;
  throw line.error(ErrorCode::bad_mesh, "a triangle with the same corner twice", first);
}

[[noreturn]] void fail_ended(const text::FieldLines& lines, std::size_t done, std::int64_t count,
                             const std::string& what) {
  throw lines.line().error(
      ErrorCode::truncated,
      "the file ends after " + std::to_string(done) + " of " + std::to_string(count) + " " + what,
      lines.line().size());
}

// The next line, which must be there, with at least `fields` fields.
const text::Line& next_row(text::FieldLines& lines, std::size_t fields, std::size_t done,
                           std::int64_t count, const std::string& what) {
  if (!lines.next()) fail_ended(lines, done, count, what);
  const text::Line& line = lines.line();
  if (line.size() >= fields) return line;
  if (lines.at_end()) fail_ended(lines, done, count, what);
  throw line.error(ErrorCode::wrong_count,
                   std::to_string(line.size()) + " fields, expected " + std::to_string(fields),
                   line.size());
}

void require_end(text::FieldLines& lines, const std::string& what) {
  if (!lines.next()) return;
  throw lines.line().error(ErrorCode::wrong_count, "more " + what + " than the header says", 0);
}

std::int64_t read_count(const text::Line& line, std::size_t i) {
  const std::int64_t count = line.integer(i);
  if (count >= 0) return count;
  throw line.error(ErrorCode::bad_header, "a count of " + std::to_string(count), i);
}

// Vertices are numbered by 32 bits.
void require_indexable(std::size_t vertices, const std::string& path) {
  if (vertices <= UINT32_MAX) return;
  throw Error(ErrorCode::too_many, std::to_string(vertices) + " vertices, 2^32 - 1 at most",
              {path});
}

std::vector<Corners> read_ele(const std::string& path, const VertexTable& vertices) {
  const std::string content = text::read_file(path);
  text::FieldLines lines(path, content);
  if (!lines.next()) throw Error(ErrorCode::truncated, "no header: the file is empty", {path});
  const std::int64_t count = read_count(lines.line(), 0);
  if (lines.line().size() > 1 && lines.line().integer(1) != 3) {
    throw lines.line().error(ErrorCode::bad_dimension, "expected triangles: 3 corners each", 1);
  }
  std::vector<Corners> triangles;
  while (std::cmp_less(triangles.size(), count)) {
    const text::Line& line = next_row(lines, 4, triangles.size(), count, "triangles");
    (void)line.integer(0);
    triangles.push_back(read_corners(line, 1, [&](std::size_t i) { return vertices.at(line, i); }));
  }
  require_end(lines, "triangles");
  return triangles;
}

Mesh<2> read_node_and_ele(const std::string& path) {
  NodeFile<2> nodes = read_node<2>(text::with_extension(path, ".node"), CoordinateRule::finite);
  require_distinct_ids(nodes.rows);
  require_indexable(nodes.rows.points.size(), path);
  Mesh<2> mesh{std::move(nodes.rows.points), std::move(nodes.kinds), {}};
  mesh.simplices = read_ele(text::with_extension(path, ".ele"), VertexTable(nodes.rows.ids));
  return mesh;
}

Point<2> read_off_vertex(const text::Line& line) {
  if (line.finite(2) == 0) return {line.finite(0), line.finite(1)};
  throw line.error(ErrorCode::bad_dimension, "a vertex in space, expected the plane (z = 0)", 2);
}

Corners read_off_face(const text::Line& line, std::size_t vertices) {
  if (line.integer(0) != 3) {
    throw line.error(ErrorCode::bad_mesh, "a face of " + std::string(line[0]) + " corners", 0);
  }
  return read_corners(line, 1, [&](std::size_t i) {
    const std::int64_t index = line.integer(i);
    if (index >= 0 && std::cmp_less(index, vertices)) return static_cast<std::uint32_t>(index);
    throw line.error(ErrorCode::bad_mesh,
                     "no vertex " + std::string(line[i]) + ": there are " +
                         std::to_string(vertices) + ", from 0",
                     i);
  });
}

Mesh<2> read_off(const std::string& path) {
  const std::string content = text::read_file(path);
  text::FieldLines lines(path, content);
  if (!lines.next()) throw Error(ErrorCode::truncated, "no header: the file is empty", {path});
  if (lines.line()[0] != "OFF" || lines.line().size() != 1) {
    throw lines.line().error(ErrorCode::bad_header, "the first line must be 'OFF'", 0);
  }
  const text::Line& counts = next_row(lines, 2, 0, 1, "lines of counts");
  const std::int64_t vertices = read_count(counts, 0), faces = read_count(counts, 1);
  Mesh<2> mesh;
  while (std::cmp_less(mesh.vertices.size(), vertices)) {
    mesh.vertices.push_back(
        read_off_vertex(next_row(lines, 3, mesh.vertices.size(), vertices, "vertices")));
  }
  require_indexable(mesh.vertices.size(), path);
  mesh.kinds.assign(mesh.vertices.size(), VertexKind::steiner);
  while (std::cmp_less(mesh.simplices.size(), faces)) {
    const text::Line& line = next_row(lines, 4, mesh.simplices.size(), faces, "faces");
    mesh.simplices.push_back(read_off_face(line, mesh.vertices.size()));
  }
  require_end(lines, "faces");
  return mesh;
}

}  // namespace

Mesh<2> read_mesh(const std::string& path) {
  const std::string extension = text::extension(path);
  if (extension == ".node" || extension == ".ele") return read_node_and_ele(path);
  if (extension == ".off") return read_off(path);
  throw Error(ErrorCode::unknown_format,
              "meshes are read from .node, .ele and .off, not " + text::quoted(extension), {path});
}

}  // namespace mesher
