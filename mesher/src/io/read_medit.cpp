// Reads `.mesh` files (Medit, ASCII).
//
//   MeshVersionFormatted v   Dimension 2 or 3
//   Vertices n  x y [z] ref      Edges n  a b ref      Triangles n  a b c ref      (from 1)
#include <optional>
#include <utility>

#include "io/note_counter.hpp"
#include "io/read_mesh.hpp"
#include "io/rows.hpp"
#include "io/text.hpp"

namespace mesher {
namespace {

// Lists that say more of vertices, edges or triangles than we keep; numbers a row.
constexpr std::pair<std::string_view, int> kNoted[] = {{"Corners", 1},
                                                       {"RequiredVertices", 1},
                                                       {"Ridges", 1},
                                                       {"RequiredEdges", 1},
                                                       {"RequiredTriangles", 1}};

class MeditReader {
 public:
  explicit MeditReader(const text::Source& source) : source_(source), fields_(source.content()) {}

  MeshData read() {
    if (const auto word = next(); word != "MeshVersionFormatted") {
      throw source_.error(ErrorCode::bad_header, "expected MeshVersionFormatted", word);
    }
    (void)source_.integer(take("a version"));
    for (auto word = next(); !word.empty() && word != "End"; word = next()) read_list(word);
    check_indices();
    mesh_.kinds.assign(mesh_.vertices.size(), VertexKind::steiner);
    mesh_.notes = notes_.notes();
    return std::move(mesh_);
  }

 private:
  // The next field; a '#' begins a comment to the end of its line.
  std::string_view next() {
    for (;;) {
      const std::string_view field = fields_.next();
      if (field.empty() || field[0] != '#') return field;
      const auto begin = static_cast<std::size_t>(field.data() - source_.content().data());
      const auto end = std::min(source_.content().find('\n', begin), source_.content().size());
      fields_ = text::Fields(source_.content().substr(end));
    }
  }
  std::string_view take(const std::string& what) {
    const std::string_view field = next();
    if (field.empty()) {
      throw source_.error(ErrorCode::truncated, "the file ends before " + what, source_.end());
    }
    return field;
  }
  std::int64_t take_count(std::string_view list) {
    const std::string_view field = take("the number of " + std::string(list));
    const std::int64_t count = source_.integer(field);
    if (count >= 0) return count;
    throw source_.error(ErrorCode::bad_header, "a count of " + std::string(field), field);
  }
  std::int64_t take_integer(std::string_view list) {
    return source_.integer(take("all " + std::string(list)));
  }

  void read_list(std::string_view word) {
    if (word == "Dimension") return read_dimension();
    if (word == "Vertices") return read_vertices(word);
    if (word == "Edges") return read_edges(word);
    if (word == "Triangles") return read_triangles(word);
    for (const auto& [noted, numbers] : kNoted) {
      if (word != noted) continue;
      notes_.add("the list " + text::quoted(word) + " is not used", source_.place(word));
      for (auto left = take_count(word) * numbers; left > 0; --left) (void)take_integer(word);
      return;
    }
    throw source_.error(ErrorCode::unsupported, "the list " + text::quoted(word), word);
  }

  void read_dimension() {
    const std::string_view field = take("the dimension");
    dimension_ = source_.integer(field);
    if (dimension_ == 2 || dimension_ == 3) return;
    throw source_.error(ErrorCode::bad_dimension, "expected the dimension 2 or 3", field);
  }

  void read_vertices(std::string_view word) {
    if (dimension_ == 0) throw source_.error(ErrorCode::bad_header, "no Dimension", word);
    for (auto left = take_count(word); left > 0; --left) {
      const double x = source_.finite(take("all Vertices"));
      const double y = source_.finite(take("all Vertices"));
      if (dimension_ == 3) {
        const std::string_view z = take("all Vertices");
        height_.require(source_.finite(z), [&] { return source_.place(z); });
      }
      mesh_.vertices.push_back({x, y});
      mesh_.features.markers.push_back(take_integer(word));
    }
    require_indexable(mesh_.vertices.size(), source_.file());
  }

  // Vertices may stand behind what names them: their number is looked at in the end.
  std::uint32_t take_vertex(std::string_view list) {
    const std::string_view field = take("all " + std::string(list));
    const std::int64_t number = source_.integer(field);
    if (number > highest_ || highest_at_.empty()) {
      highest_ = number;
      highest_at_ = field;
    }
    return vertex_index(number, UINT32_MAX, 1, [&] { return source_.place(field); });
  }

  void check_indices() const {
    if (highest_at_.empty()) return;
    (void)vertex_index(highest_, mesh_.vertices.size(), 1,
                       [&] { return source_.place(highest_at_); });
  }

  void read_edges(std::string_view word) {
    for (auto left = take_count(word); left > 0; --left) {
      const std::uint32_t a = take_vertex(word), b = take_vertex(word);
      MeshEdge edge = edge_of(a, b, [&] { return source_.place(word); });
      edge.marker = take_integer(word);
      mesh_.features.edges.push_back(edge);
    }
  }

  void read_triangles(std::string_view word) {
    for (auto left = take_count(word); left > 0; --left) {
      const std::uint32_t a = take_vertex(word), b = take_vertex(word), c = take_vertex(word);
      if (a == b || b == c || c == a) {
        throw source_.error(
            ErrorCode::bad_mesh,
            "triangle " + std::to_string(mesh_.simplices.size() + 1) + " has the same corner twice",
            word);
      }
      mesh_.simplices.push_back({a, b, c});
      mesh_.features.regions.push_back(static_cast<double>(take_integer(word)));
    }
  }

  const text::Source& source_;
  text::Fields fields_;
  MeshData mesh_;
  NoteCounter notes_;
  std::int64_t dimension_ = 0;
  PlaneHeight height_;
  std::int64_t highest_ = 0;  // the highest number of a vertex that is named, and where
  std::string_view highest_at_;
};

}  // namespace

MeshData read_medit(const std::string& path) {
  const text::Source source(path);
  return MeditReader(source).read();
}

}  // namespace mesher
