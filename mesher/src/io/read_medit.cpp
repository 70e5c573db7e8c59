// Reads `.mesh` files (Medit, ASCII).
//
//   MeshVersionFormatted v   Dimension 2 or 3
//   Vertices n  x y [z] ref      Edges n  a b ref      Triangles n  a b c ref      (from 1)
//   Tetrahedra n  a b c d ref
#include <optional>
#include <utility>

#include "io/note_counter.hpp"
#include "io/read_mesh.hpp"
#include "io/rows.hpp"
#include "text/text.hpp"

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
  explicit MeditReader(const text::Source& source)
      : source_(source), fields_(source.content()), mesh_(source.file()) {}

  AnyMesh read() {
    if (const auto word = next(); word != "MeshVersionFormatted") {
      throw source_.error(ErrorCode::bad_header, "expected MeshVersionFormatted", word);
    }
    (void)source_.integer(take("a version"));
    for (auto word = next(); !word.empty() && word != "End"; word = next()) read_list(word);
    check_indices();
    return mesh_.finish();
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
    throw source_.error(ErrorCode::bad_header, "a count of " + text::quoted(field), field);
  }
  std::int64_t take_integer(std::string_view list) {
    return source_.integer(take("all " + std::string(list)));
  }

  void read_list(std::string_view word) {
    if (word == "Dimension") return read_dimension();
    if (word == "Vertices") return read_vertices(word);
    if (word == "Edges") return read_edges(word);
    if (word == "Triangles") return read_simplices<2>(word);
    if (word == "Tetrahedra") return read_simplices<3>(word);
    for (const auto& [noted, numbers] : kNoted) {
      if (word != noted) continue;
      mesh_.notes.add("the list " + text::quoted(word) + " is not used", source_.place(word));
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
      Point<3> p{};
      std::string_view field;
      for (int i = 0; i < dimension_; ++i) {
        field = take("all Vertices");
        p[i] = source_.finite(field);
      }
      mesh_.add_vertex(p, [&] { return source_.place(field); });
      mesh_.markers.push_back(take_integer(word));
    }
    require_indexable(mesh_.vertices(), source_.file());
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
    (void)vertex_index(highest_, mesh_.vertices(), 1, [&] { return source_.place(highest_at_); });
  }

  void read_edges(std::string_view word) {
    for (auto left = take_count(word); left > 0; --left) {
      const std::uint32_t a = take_vertex(word), b = take_vertex(word);
      MeshEdge edge = edge_of(a, b, [&] { return source_.place(word); });
      edge.marker = take_integer(word);
      mesh_.edges.push_back(edge);
    }
  }

  template <int D>
  void read_simplices(std::string_view word) {
    for (auto left = take_count(word); left > 0; --left) {
      typename Mesh<D>::Simplex corners;
      for (auto& corner : corners) corner = take_vertex(word);
      if (!are_different(corners)) {
        throw source_.error(ErrorCode::bad_mesh,
                            std::string(kSimplexName<D>) + ' ' +
                                std::to_string(mesh_.count<D>() + 1) + " has the same corner twice",
                            word);
      }
      const std::int64_t reference = take_integer(word);
      if constexpr (D == 2) {
        mesh_.add_triangle(corners, static_cast<double>(reference), reference);
      } else {
        mesh_.add<D>(corners, static_cast<double>(reference));
      }
    }
  }

  const text::Source& source_;
  text::Fields fields_;
  MeshParts mesh_;
  std::int64_t dimension_ = 0;
  std::int64_t highest_ = 0;  // the highest number of a vertex that is named, and where
  std::string_view highest_at_;
};

}  // namespace

AnyMesh read_medit(const std::string& path) {
  const text::Source source(path);
  return MeditReader(source).read();
}

}  // namespace mesher
