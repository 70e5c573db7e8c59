// Reads the statements of `.obj` files:
//
//   v x y [z [w]]      or x y z and a colour
//   p v ...    l v v ...    f v v v ...      v, v/t, v//n or v/t/n; 1 is the first vertex, -1 the
//                                            last so far
#include "io/obj_file.hpp"

#include <algorithm>
#include <utility>

#include "io/note_counter.hpp"
#include "io/read_mesh.hpp"
#include "io/rows.hpp"
#include "text/text.hpp"

namespace mesher {
namespace {

constexpr std::string_view kNotedWords[] = {"vt", "vn",     "vp",     "g",  "o",
                                            "s",  "usemtl", "mtllib", "mg", "lod"};

class ObjReader {
 public:
  ObjReader(const std::string& path, std::string_view content, CoordinateRule rule)
      : lines_(path, content, text::Continued::by_backslash), rule_(rule) {}

  ObjFile read() {
    while (lines_.next()) read_statement(lines_.line());
    out_.notes = notes_.notes();
    return std::move(out_);
  }

 private:
  void read_statement(const text::Line& line) {
    const std::string_view word = line[0];
    if (word == "v") return read_vertex(line);
    if (word == "p" || word == "l" || word == "f") return read_element(line);
    if (std::find(std::begin(kNotedWords), std::end(kNotedWords), word) == std::end(kNotedWords)) {
      throw line.error(ErrorCode::bad_syntax, "no statement is called " + text::quoted(word), 0);
    }
    notes_.add("the statement " + text::quoted(word) + " is not used", line.place(0));
  }

  void read_vertex(const text::Line& line) {
    if (line.size() < 3 || line.size() > 7 || line.size() == 6) {
      throw line.error(ErrorCode::wrong_count, "a vertex is 'v x y [z]'", line.size());
    }
    const bool input = rule_ == CoordinateRule::input;
    const auto number = [&](std::size_t i) { return input ? line.coordinate(i) : line.finite(i); };
    height_.see(line.size() > 3 ? line.finite(3) : 0, [&] { return line.place(3); });
    height_.require_same();
    for (std::size_t i = 4; i < line.size(); ++i) (void)line.finite(i);
    if (line.size() > 4) notes_.add("a weight or colour is not used", line.place(4));
    out_.vertices.push_back({number(1), number(2)});
    out_.positions.push_back(line.position(0));
    require_indexable(out_.vertices.size(), line.place(0).file);
  }

  void read_element(const text::Line& line) {
    const char kind = line[0].front();
    const std::size_t least = kind == 'p' ? 1 : kind == 'l' ? 2 : 3;
    if (line.size() < 1 + least) {
      throw line.error(
          ErrorCode::wrong_count,
          "'" + std::string(1, kind) + "' names " + std::to_string(least) + " vertices or more",
          line.size());
    }
    ObjFile::Element element{kind, {}, line.position(0)};
    for (std::size_t i = 1; i < line.size(); ++i) element.vertices.push_back(vertex_at(line, i));
    out_.elements.push_back(std::move(element));
  }

  std::uint32_t vertex_at(const text::Line& line, std::size_t i) {
    const auto slash = line[i].find('/');
    if (slash != std::string_view::npos) {
      notes_.add("a texture or normal is not used", line.place(i));
    }
    const std::int64_t number = line.integer_before(i, slash);
    const auto count = static_cast<std::int64_t>(out_.vertices.size());
    if (number >= 1 && number <= count) return static_cast<std::uint32_t>(number - 1);
    if (number <= -1 && number >= -count) return static_cast<std::uint32_t>(count + number);
    throw line.error(ErrorCode::bad_mesh,
                     "no vertex " + text::quoted(line[i].substr(0, slash)) + ": there are " +
                         std::to_string(count) + " so far",
                     i);
  }

  ObjFile out_;
  text::FieldLines lines_;
  CoordinateRule rule_;
  NoteCounter notes_;
  PlaneHeight height_;
};

}  // namespace

ObjFile read_obj_file(const std::string& path, CoordinateRule rule) {
  const std::string content = text::read_file(path);
  return ObjReader(path, content, rule).read();
}

}  // namespace mesher
