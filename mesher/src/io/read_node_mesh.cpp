// Reads the files of a mesh that Triangle or TetGen would write: `.node` and `.ele`, and where they
// are, `.edge`, in the plane `.poly` and `.neigh`, in space `.face`.
//
//   .ele:   count [nodes [attributes]]       id corner corner corner [corner] [attributes...]
//   .edge:  count [markers]                  id vertex vertex [marker [line]]
//   .face:  count [markers]                  id vertex vertex vertex [marker [polygon]]
//   .neigh: count 3                          id triangle triangle triangle    (-1: none)
//
// Of second order, triangles have 6 nodes and tetrahedra 10: three or six between corners follow
// the corners, in .face three, in .edge of tetrahedra one. They are not used.
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <utility>

#include "io/mesh_parts.hpp"
#include "io/note_counter.hpp"
#include "io/read_mesh.hpp"
#include "io/read_node.hpp"
#include "io/read_pslg.hpp"
#include "io/rows.hpp"
#include "text/text.hpp"

namespace mesher {
namespace {

// Finds the position of a vertex or triangle by its id.
class IdTable {
 public:
  IdTable() = default;
  explicit IdTable(const std::vector<PointId>& ids) {
    for (std::size_t i = 0; i < ids.size(); ++i) rows_.emplace_back(ids[i], i);
    std::sort(rows_.begin(), rows_.end());
  }
  // Throws: Error(bad_mesh) if there is none of that id.
  [[nodiscard]] std::uint32_t at(PointId id, const char* what, const FileLocation& place) const {
    const auto row = std::lower_bound(rows_.begin(), rows_.end(), std::pair(id, std::size_t{0}));
    if (row != rows_.end() && row->first == id) return static_cast<std::uint32_t>(row->second);
    throw Error(
        ErrorCode::bad_mesh,
        std::string("no ") + what + " has the id " + std::to_string(static_cast<std::int64_t>(id)),
        place);
  }
  // Field i of `line` as a vertex.
  [[nodiscard]] std::uint32_t vertex(const text::Line& line, std::size_t i) const {
    return at(PointId{line.integer(i)}, "vertex", line.place(i));
  }

 private:
  std::vector<std::pair<PointId, std::size_t>> rows_;
};

template <int D>
class NodeMesh {
 public:
  explicit NodeMesh(const std::string& path) : path_(path) {}

  MeshData<D> read() {
    read_vertices(beside(".node"));
    read_simplices(beside(".ele"));
    if (std::filesystem::exists(beside(".edge"))) read_edges(beside(".edge"));
    if constexpr (D == 2) {
      read_lines();
    } else if (std::filesystem::exists(beside(".face"))) {
      read_faces(beside(".face"));
    }
    for (const auto& [ends, edge] : edges_) mesh_.features.edges.push_back(edge);
    if (is_second_order_) drop_midpoints(mesh_, is_midpoint_);
    mesh_.notes = notes_.notes();
    return std::move(mesh_);
  }

 private:
  void read_lines() {
    if (std::filesystem::exists(beside(".poly"))) read_segments(beside(".poly"));
    if (std::filesystem::exists(beside(".neigh"))) check_neighbours(beside(".neigh"));
  }

  [[nodiscard]] std::string beside(const char* extension) const {
    return text::with_extension(path_, extension);
  }

  void read_vertices(const std::string& path) {
    NodeFile<D> nodes = read_node<D>(text::whole_file(path), CoordinateRule::finite);
    require_distinct_ids(nodes.rows);
    require_indexable(nodes.rows.points.size(), path_);
    vertices_ = IdTable(nodes.rows.ids);
    mesh_.vertices = std::move(nodes.rows.points);
    mesh_.kinds = std::move(nodes.kinds);
    mesh_.features.origins = std::move(nodes.origins);
    mesh_.features.markers = std::move(nodes.markers);
    for (const Note& note : nodes.notes) notes_.add(note.text, note.location);
  }

  void read_simplices(const std::string& path) {
    constexpr std::size_t kCorners = D + 1, kSecondOrder = D == 2 ? 6 : 10;
    const std::string content = text::read_file(path);
    text::FieldLines lines(path, content);
    const text::Line& header = header_row(lines, path);
    const std::int64_t count = read_count(header, 0);
    is_second_order_ = header.size() > 1 && header.integer(1) == kSecondOrder;
    if (is_second_order_) note_second_order(header);
    if (header.size() > 1 && header.integer(1) != kCorners && !is_second_order_) {
      throw header.error(ErrorCode::bad_dimension,
                         std::string("expected ") + kSimplicesName<D> + ": " +
                             std::to_string(kCorners) + " corners each",
                         1);
    }
    const std::int64_t attributes = header.size() > 2 ? read_count(header, 2) : 0;
    if (attributes > 1) notes_.add("attributes but the first are not used", header.place(2));
    std::vector<PointId> ids;
    const std::size_t nodes = is_second_order_ ? kSecondOrder : kCorners;
    const std::size_t fields = 1 + nodes + (attributes > 0 ? 1 : 0);
    while (std::cmp_less(ids.size(), count)) {
      const text::Line& line = next_row(lines, fields, ids.size(), count, kSimplicesName<D>);
      ids.push_back(PointId{line.integer(0)});
      mesh_.simplices.push_back(
          read_corners<D>(line, 1, [&](std::size_t i) { return vertices_.vertex(line, i); }));
      skip_midpoints(line, 1 + kCorners, nodes - kCorners);
      if (attributes > 0) mesh_.features.regions.push_back(line.finite(1 + nodes));
    }
    require_end(lines, kSimplicesName<D>);
    triangles_ = IdTable(ids);
  }

  void note_second_order(const text::Line& header) {
    notes_.add("the nodes between corners of elements of second order are not used",
               header.place(1));
    is_midpoint_.resize(mesh_.vertices.size());
  }
  // Fields first, first + 1, ... of `line`.
  void skip_midpoints(const text::Line& line, std::size_t first, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) is_midpoint_[vertices_.vertex(line, first + i)] = true;
  }

  // Edges with neither marker nor line are not worth a word.
  void read_edges(const std::string& path) {
    const std::string content = text::read_file(path);
    text::FieldLines lines(path, content);
    const std::int64_t count = read_count(header_row(lines, path), 0);
    for (std::size_t done = 0; std::cmp_less(done, count); ++done) {
      const std::size_t between = D == 3 && is_second_order_ ? 1 : 0;
      const text::Line& line = next_row(lines, 3 + between, done, count, "edges");
      MeshEdge edge = edge_of(vertices_.vertex(line, 1), vertices_.vertex(line, 2),
                              [&] { return line.place(1); });
      skip_midpoints(line, 3, between);
      if (line.size() > 3 + between) edge.marker = line.integer(3 + between);
      if (line.size() > 4 + between) edge.line = LineId{line.integer(4 + between)};
      if (edge.marker == 0 && !edge.line) continue;
      if (!edges_.try_emplace({edge.low, edge.high}, edge).second) {
        throw line.error(ErrorCode::bad_mesh, "an edge that is given twice", 1);
      }
    }
    require_end(lines, "edges");
  }

  // Faces with neither marker nor polygon likewise.
  void read_faces(const std::string& path) {
    const std::string content = text::read_file(path);
    text::FieldLines lines(path, content);
    const std::int64_t count = read_count(header_row(lines, path), 0);
    for (std::size_t done = 0; std::cmp_less(done, count); ++done) {
      const std::size_t between = is_second_order_ ? 3 : 0;
      const text::Line& line = next_row(lines, 4 + between, done, count, "faces");
      const auto corners =
          read_corners<2>(line, 1, [&](std::size_t i) { return vertices_.vertex(line, i); });
      skip_midpoints(line, 4, between);
      MeshFace face = MeshParts::face_of(corners);
      if (line.size() > 4 + between) face.marker = line.integer(4 + between);
      if (line.size() > 5 + between) face.polygon = PolygonId{line.integer(5 + between)};
      if (face.marker != 0 || face.polygon) mesh_.features.faces.push_back(face);
    }
    require_end(lines, "faces");
  }

  // A .poly file with points of its own is an input, not a part of this mesh.
  void read_segments(const std::string& path) {
    const GraphFile<2> poly = read_poly(path, PointsBeside::ignore);
    if (!poly.graph.points.empty()) {
      notes_.add("a .poly file with points of its own is no part of the mesh", {path});
      return;
    }
    for (std::size_t i = 0; i < poly.graph.segments.size(); ++i) {
      const mesher::Segment& s = poly.graph.segments[i];
      const FileLocation place = poly.location_of_segment(i);
      MeshEdge edge = edge_of(vertices_.at(s.from, "vertex", place),
                              vertices_.at(s.to, "vertex", place), [&] { return place; });
      edge.marker = s.marker;
      edges_.try_emplace({edge.low, edge.high}, edge);
    }
  }

  void check_neighbours(const std::string& path) const {
    const std::string content = text::read_file(path);
    text::FieldLines lines(path, content);
    const std::int64_t count = read_count(header_row(lines, path), 0);
    if (std::cmp_not_equal(count, mesh_.simplices.size())) {
      throw lines.line().error(
          ErrorCode::wrong_count,
          std::to_string(count) + " triangles, expected " + std::to_string(mesh_.simplices.size()),
          0);
    }
    const auto expected = neighbours(mesh_);
    for (std::size_t done = 0; std::cmp_less(done, count); ++done) {
      const text::Line& line = next_row(lines, 4, done, count, "triangles");
      const auto t = triangles_.at(PointId{line.integer(0)}, "triangle", line.place(0));
      for (std::size_t i = 0; i < 3; ++i) require_neighbour(line, i + 1, expected[t][i]);
    }
    require_end(lines, "triangles");
  }

  void require_neighbour(const text::Line& line, std::size_t i, std::uint32_t expected) const {
    const std::int64_t id = line.integer(i);
    const bool none = id == -1;
    const auto t = none ? kNoTriangle : triangles_.at(PointId{id}, "triangle", line.place(i));
    if (t == expected) return;
    throw line.error(ErrorCode::bad_mesh,
                     "triangle " + text::quoted(line[0]) + " does not have the neighbour " +
                         std::string(line[i]) + " across from corner " + std::to_string(i),
                     i);
  }

  std::string path_;
  MeshData<D> mesh_;
  IdTable vertices_, triangles_;
  bool is_second_order_ = false;
  std::vector<bool> is_midpoint_;  // one per vertex, in second order
  std::map<std::pair<std::uint32_t, std::uint32_t>, MeshEdge> edges_;
  NoteCounter notes_;
};

}  // namespace

AnyMesh read_node_mesh(const std::string& path) {
  if (dimension_of(text::with_extension(path, ".node")) == 3) return NodeMesh<3>(path).read();
  return NodeMesh<2>(path).read();
}

}  // namespace mesher
