// Reads the vertices of `.off` and `.obj` files as points in space, and the faces, if asked for.
// Lines are not used.
#include <algorithm>
#include <iterator>
#include <string_view>

#include "io/binary_off.hpp"
#include "io/face_groups.hpp"
#include "io/note_counter.hpp"
#include "io/read_mesh.hpp"
#include "io/read_points.hpp"
#include "io/rows.hpp"
#include "text/text.hpp"

namespace mesher {
namespace {

// Adds the vertex in the fields from `first` on.
void read_point(const text::Line& line, std::size_t first, PointFile<3>& rows) {
  add_vertex(rows, read_vertex_place(line, first), line.place(first));
}

// --- .off ------------------------------------------------------------------------------------

constexpr std::string_view kOffHeaders[] = {"OFF", "COFF", "NOFF", "CNOFF"};

void require_off(const text::Line& first) {
  const bool known =
      std::find(std::begin(kOffHeaders), std::end(kOffHeaders), first[0]) != std::end(kOffHeaders);
  if (known && (first.size() == 1 || first.size() == 4)) return;
  throw first.error(ErrorCode::bad_header,
                    "the first line must be 'OFF', 'COFF', 'NOFF', 'CNOFF' or 'OFF BINARY'", 0);
}

// Field i as a vertex, of so many. Throws: Error(bad_mesh).
std::uint32_t corner_of(const text::Line& line, std::size_t i, std::size_t vertices) {
  return vertex_index(line.integer(i), vertices, 0, [&] { return line.place(i); });
}

// Throws: Error(wrong_count) unless the row names as many corners as it says.
void require_face(const text::Line& line) {
  const std::int64_t corners = read_count(line, 0);
  if (std::cmp_less_equal(corners, line.size() - 1)) return;
  throw line.error(ErrorCode::wrong_count,
                   "a face of " + std::to_string(corners) + " corners, but " +
                       std::to_string(line.size() - 1) + " numbers follow",
                   line.size());
}

// --- .obj ------------------------------------------------------------------------------------

constexpr std::string_view kObjWords[] = {"vt", "vn",     "vp",     "g",  "o",   "s", "l",
                                          "f",  "usemtl", "mtllib", "mg", "lod", "p"};

void read_vertex(const text::Line& line, PointFile<3>& rows, NoteCounter& notes) {
  if (line.size() < 4 || line.size() > 7 || line.size() == 6) {
    throw line.error(ErrorCode::wrong_count, "a vertex in space is 'v x y z'", line.size());
  }
  read_point(line, 1, rows);
  if (line.size() > 4) notes.add("a weight or colour is not used", line.place(4));
}

void note_statement(const text::Line& line, NoteCounter& notes) {
  if (std::find(std::begin(kObjWords), std::end(kObjWords), line[0]) == std::end(kObjWords)) {
    throw line.error(ErrorCode::bad_syntax, "no statement is called " + text::quoted(line[0]), 0);
  }
  if (line[0] == "p") return;  // its vertices are points anyway
  notes.add("the statement " + text::quoted(line[0]) + " is not used", line.place(0));
}

// `f v v v...`: v, v/t, v//n or v/t/n; 1 is the first vertex, -1 the last so far.
Surface::Face read_obj_face(const text::Line& line, std::size_t vertices) {
  Surface::Face face{{}, line.position(0)};
  for (std::size_t i = 1; i < line.size(); ++i) {
    const std::int64_t given = line.integer_before(i, line[i].find('/'));
    const std::int64_t index = given < 0 ? given + static_cast<std::int64_t>(vertices) + 1 : given;
    face.corners.push_back(vertex_index(index, vertices, 1, [&] { return line.place(i); }));
  }
  return face;
}

enum class Faces : std::uint8_t { use, note };

Surface read_off(const std::string& path, Faces use) {
  const std::string content = text::read_file(path);
  if (is_binary_off(content)) {
    Surface out = read_binary_off(path, content);
    NoteCounter notes;
    if (use == Faces::note && !out.faces.empty()) notes.add("faces are not used", {path});
    if (use == Faces::note) out.faces.clear();
    out.rows.add(notes.notes());
    return out;
  }
  text::FieldLines lines(path, content);
  const text::Line& first = header_row(lines, path);
  require_off(first);
  const std::size_t at = first.size() == 1 ? 0 : 1;  // of the counts
  const text::Line& counts = at == 1 ? first : next_row(lines, 2, 0, 1, "lines of counts");
  const std::int64_t vertices = read_count(counts, at), faces = read_count(counts, at + 1);
  Surface out{{path, {}, {}, {}}, {}};
  PointFile<3>& rows = out.rows;
  NoteCounter notes;
  while (std::cmp_less(rows.points.size(), vertices)) {
    const text::Line& line = next_row(lines, 3, rows.points.size(), vertices, "vertices");
    read_point(line, 0, rows);
    if (line.size() > 3) notes.add("a colour or normal is not used", line.place(3));
  }
  for (std::size_t i = 0; std::cmp_less(i, faces); ++i) {
    const text::Line& line = next_row(lines, 1, i, faces, "faces");
    require_face(line);
    if (use == Faces::note) {
      notes.add("a face is not used", line.place(0));
      continue;
    }
    Surface::Face& face = out.faces.emplace_back(Surface::Face{{}, line.position(0)});
    const auto corners = static_cast<std::size_t>(read_count(line, 0));
    for (std::size_t k = 1; k <= corners; ++k) {
      face.corners.push_back(corner_of(line, k, rows.points.size()));
    }
    if (line.size() > corners + 1)
      notes.add("a face's colour is not used", line.place(corners + 1));
  }
  require_end(lines, "faces");
  rows.add(notes.notes());
  return out;
}

bool is_group(const text::Line& line) { return line[0] == "g" || line[0] == "o"; }

// A group has the name behind `g` or `o`.
Surface read_obj(const std::string& path, Faces use) {
  const std::string content = text::read_file(path);
  Surface out{{path, {}, {}, {}}, {}};
  NoteCounter notes;
  FaceGroups groups;
  for (text::FieldLines lines(path, content, text::Continued::by_backslash); lines.next();) {
    const text::Line& line = lines.line();
    if (line[0] == "v") {
      read_vertex(line, out.rows, notes);
    } else if (line[0] == "f" && use == Faces::use) {
      out.faces.push_back(read_obj_face(line, out.rows.points.size()));
      groups.add_face();
    } else if (is_group(line) && use == Faces::use) {
      groups.begin(line.trimmed().substr(1), line.place(0));
    } else {
      note_statement(line, notes);
    }
  }
  groups.mark(out, notes);
  out.rows.add(notes.notes());
  return out;
}

}  // namespace

PointFile<3> read_off_points(const std::string& path) { return read_off(path, Faces::note).rows; }
PointFile<3> read_obj_points(const std::string& path) { return read_obj(path, Faces::note).rows; }
Surface read_off_surface(const std::string& path) { return read_off(path, Faces::use); }
Surface read_obj_surface(const std::string& path) { return read_obj(path, Faces::use); }

}  // namespace mesher
