// Reads the vertices of `.ply` files (Stanford) as points in space, and the faces, if asked for:
// lists vertex_indices or vertex_index of the element face.
//
//   ply
//   format ascii|binary_little_endian|binary_big_endian 1.0
//   comment ...
//   element vertex n
//   property float x         and y, z, others; `property list uchar int name` is a counted list
//   element face m
//   ...
//   end_header
//   the elements in this order, each with its properties in their order
#include <algorithm>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "io/binary.hpp"
#include "io/note_counter.hpp"
#include "io/read_points.hpp"
#include "io/rows.hpp"
#include "text/text.hpp"

namespace mesher {
namespace {

struct PlyNumber {
  std::string_view name;
  std::size_t bytes;
  bool is_integral;
  bool is_signed;
};

constexpr PlyNumber kPlyNumbers[] = {
    {"char", 1, true, true},    {"int8", 1, true, true},     {"uchar", 1, true, false},
    {"uint8", 1, true, false},  {"short", 2, true, true},    {"int16", 2, true, true},
    {"ushort", 2, true, false}, {"uint16", 2, true, false},  {"int", 4, true, true},
    {"int32", 4, true, true},   {"uint", 4, true, false},    {"uint32", 4, true, false},
    {"float", 4, false, true},  {"float32", 4, false, true}, {"double", 8, false, true},
    {"float64", 8, false, true}};

struct Property {
  std::string_view name;
  PlyNumber type;
  std::optional<PlyNumber> count;  // of a list
};

struct Element {
  std::string_view name;
  std::int64_t count = 0;
  std::vector<Property> properties;
  FileLocation place;

  // The property of this name; properties.size() if there is none.
  [[nodiscard]] std::size_t find(std::string_view wanted) const {
    std::size_t i = 0;
    while (i < properties.size() && properties[i].name != wanted) ++i;
    return i;
  }
};

// What the header says. Its lines are `lines`'.
class PlyHeader {
 public:
  PlyHeader(const std::string& path, std::string_view content)
      : path_(path), lines_(content), line_(path) {
    next("'ply'");
    if (line_[0] != "ply") throw line_.error(ErrorCode::bad_header, "expected 'ply'", 0);
    for (next("'end_header'"); line_[0] != "end_header"; next("'end_header'")) read_statement();
    if (!has_format_) throw line_.error(ErrorCode::bad_header, "no 'format' before this", 0);
    const auto end = static_cast<std::size_t>(lines_.text().end() - content.begin());
    const auto feed = content.find('\n', end);
    body_ =
        feed == std::string_view::npos ? content.substr(content.size()) : content.substr(feed + 1);
  }

  std::vector<Element> elements;
  bool is_text = false, is_big_endian = false;

  /// What follows the header.
  [[nodiscard]] std::string_view body() const { return body_; }

 private:
  void next(const char* before) {
    do {
      if (!lines_.next()) {
        const FileLocation end =
            lines_.number() > 0 ? line_.place(line_.size()) : FileLocation{path_};
        throw Error(ErrorCode::truncated, std::string("the file ends before ") + before, end);
      }
      line_.split_blanks(lines_.number(), lines_.text());
    } while (line_.size() == 0);
  }

  void read_statement() {
    if (line_[0] == "comment" || line_[0] == "obj_info") return;
    if (line_[0] == "format") return read_format();
    if (line_[0] == "element") return read_element();
    if (line_[0] == "property") return read_property();
    throw line_.error(ErrorCode::bad_syntax, "no statement is called " + text::quoted(line_[0]), 0);
  }
  void require_fields(std::size_t count) const {
    if (line_.size() == count) return;
    throw line_.error(ErrorCode::bad_header,
                      std::to_string(line_.size()) + " fields, expected " + std::to_string(count),
                      std::min(line_.size(), count));
  }
  void read_format() {
    require_fields(3);
    is_text = line_[1] == "ascii";
    is_big_endian = line_[1] == "binary_big_endian";
    has_format_ = is_text || is_big_endian || line_[1] == "binary_little_endian";
    if (!has_format_ || line_[2] != "1.0") {
      throw line_.error(ErrorCode::unsupported,
                        "expected 'ascii', 'binary_little_endian' or 'binary_big_endian' and '1.0'",
                        has_format_ ? 2 : 1);
    }
  }
  void read_element() {
    require_fields(3);
    elements.push_back({line_[1], read_count(line_, 2), {}, line_.place(0)});
  }
  void read_property() {
    if (elements.empty()) throw line_.error(ErrorCode::bad_header, "no element before this", 0);
    const bool list = line_.size() > 1 && line_[1] == "list";
    require_fields(list ? 5 : 3);
    Property property{line_[list ? 4 : 2], type_of(list ? 3 : 1), {}};
    if (list) property.count = type_of(2);
    if (list && !property.count->is_integral) {
      throw line_.error(ErrorCode::bad_header, "a count is an integer", 2);
    }
    elements.back().properties.push_back(property);
  }
  [[nodiscard]] PlyNumber type_of(std::size_t i) const {
    for (const PlyNumber& type : kPlyNumbers) {
      if (type.name == line_[i]) return type;
    }
    throw line_.error(ErrorCode::unsupported, "numbers of the type " + text::quoted(line_[i]), i);
  }

  std::string path_;
  text::Lines lines_;
  text::Line line_;
  std::string_view body_;
  bool has_format_ = false;
};

class PlyReader {
 public:
  enum class Faces : std::uint8_t { use, note };

  PlyReader(const text::Source& source, Faces use)
      : source_(source),
        use_(use),
        header_(source.file(), source.content()),
        fields_(header_.body()),
        bytes_(source, fields_),
        out_{{source.file(), {}, {}, {}}, {}} {
    bytes_.set_big_endian(header_.is_big_endian);
  }

  Surface read() {
    bool found = false;
    for (const Element& element : header_.elements) {
      const bool vertices = element.name == "vertex" && !found;
      if (vertices) {
        read_vertices(element);
      } else if (element.name == "face" && use_ == Faces::use) {
        read_faces(element);
      } else {
        skip(element);
      }
      found = found || vertices;
    }
    if (!found) throw Error(ErrorCode::bad_header, "no element vertex", {source_.file()});
    require_end();
    require_corners();
    out_.rows.add(notes_.notes());
    return std::move(out_);
  }

 private:
  void read_vertices(const Element& element) {
    const std::size_t axes[] = {element.find("x"), element.find("y"), element.find("z")};
    for (const std::size_t axis : axes) {
      if (axis < element.properties.size() && !element.properties[axis].count) continue;
      throw Error(ErrorCode::bad_header, "vertices without the properties x, y and z",
                  element.place);
    }
    if (element.properties.size() > 3) {
      notes_.add("properties of vertices other than x, y and z are not used", element.place);
    }
    for (std::int64_t i = 0; i < element.count; ++i) {
      FileLocation place{source_.file()};
      Point<3> p{};
      for (std::size_t k = 0; k < element.properties.size(); ++k) {
        const double value = read_property(element, element.properties[k], i);
        if (k == 0 && header_.is_text) place = source_.place(field_);
        for (std::size_t axis = 0; axis < 3; ++axis) {
          if (axes[axis] == k) p[axis] = value;
        }
      }
      add_vertex(out_.rows, p, place);
    }
  }

  // Vertices may follow: corners are looked at in the end.
  void read_faces(const Element& element) {
    std::size_t list = element.find("vertex_indices");
    if (list == element.properties.size()) list = element.find("vertex_index");
    if (list == element.properties.size() || !element.properties[list].count ||
        !element.properties[list].type.is_integral) {
      throw Error(ErrorCode::bad_header, "faces without a list vertex_indices of integers",
                  element.place);
    }
    if (element.properties.size() > 1) {
      notes_.add("properties of faces other than their corners are not used", element.place);
    }
    for (std::int64_t i = 0; i < element.count; ++i) {
      corners_.clear();
      for (std::size_t k = 0; k < element.properties.size(); ++k) {
        read_property(element, element.properties[k], i, k == list ? &corners_ : nullptr);
      }
      Surface::Face& face = out_.faces.emplace_back();
      if (header_.is_text) face.position = source_.position(field_);
      for (const double corner : corners_) face.corners.push_back(number_of(corner));
    }
  }
  // What is beyond 32 bits is no vertex, and said so in the end.
  static std::uint32_t number_of(double corner) {
    const bool fits = corner >= 0 && corner < static_cast<double>(UINT32_MAX);
    return fits ? static_cast<std::uint32_t>(corner) : UINT32_MAX;
  }
  void require_corners() const {
    for (const Surface::Face& face : out_.faces) {
      for (const std::uint32_t corner : face.corners) {
        if (corner < out_.rows.points.size()) continue;
        throw Error(ErrorCode::bad_mesh,
                    "a face has a corner that is none of the " +
                        std::to_string(out_.rows.points.size()) + " vertices",
                    {source_.file(), face.position.line, face.position.column});
      }
    }
  }

  void skip(const Element& element) {
    for (std::int64_t i = 0; i < element.count && !element.properties.empty(); ++i) {
      for (const Property& property : element.properties) {
        static_cast<void>(read_property(element, property, i));
      }
    }
    if (element.count > 0) {
      notes_.add("the element " + text::quoted(element.name) + " is not used", element.place);
    }
  }

  // The value; of a list, its length, and the numbers in `list` if that is asked for.
  double read_property(const Element& element, const Property& property, std::int64_t row,
                       std::vector<double>* list = nullptr) {
    row_ = {&element, row};
    if (!property.count) return read_number(property.type);
    const double count = read_number(*property.count);
    if (count < 0) throw error(ErrorCode::bad_number, "a list of fewer than no numbers");
    for (double k = 0; k < count; ++k) {
      const double value = read_number(property.type);
      if (list != nullptr) list->push_back(value);
    }
    return count;
  }

  double read_number(const PlyNumber& type) {
    if (header_.is_text) return read_text(type);
    if (fields_.rest().size() < type.bytes) fail_truncated();
    if (!type.is_integral) return bytes_.real(type.bytes);
    return type.is_signed ? static_cast<double>(bytes_.integer(type.bytes))
                          : static_cast<double>(bytes_.bits(type.bytes));
  }

  double read_text(const PlyNumber& type) {
    const std::string_view last = std::exchange(field_, fields_.next());
    const bool begins_row = row_ != last_row_;
    last_row_ = row_;
    if (begins_row && crowded_.empty() && !last.empty() && is_in_line(last, field_)) {
      crowded_ = field_;
    }
    if (field_.empty()) fail_truncated();
    try {
      return type.is_integral ? static_cast<double>(source_.integer(field_))
                              : source_.finite(field_);
    } catch (const Error&) {
      if (!crowded_.empty()) fail_crowded();
      throw;
    }
  }
  static bool is_in_line(std::string_view last, std::string_view next) {
    const char* end = last.data() + last.size();
    return !next.empty() && std::find(end, next.data(), '\n') == next.data();
  }
  // Files with all in one line are read; but where that fails, the first line with more than one
  // row is what is wrong.
  [[noreturn]] void fail_crowded() const {
    throw source_.error(ErrorCode::wrong_count,
                        "the line has more values than the header says of the element before this",
                        crowded_);
  }

  [[nodiscard]] Error error(ErrorCode code, const std::string& what) const {
    return header_.is_text ? source_.error(code, what, field_) : bytes_.error(code, what);
  }

  [[noreturn]] void fail_truncated() const {
    if (!crowded_.empty()) fail_crowded();
    const auto& [element, row] = row_;
    const std::string what = "the file ends after " + std::to_string(row) + " of " +
                             std::to_string(element->count) + " of the element " +
                             text::quoted(element->name);
    if (header_.is_text) throw source_.error(ErrorCode::truncated, what, source_.end());
    throw Error(ErrorCode::truncated, what, {source_.file()});
  }

  // White space may follow.
  void require_end() {
    const std::string_view more = fields_.next();
    if (more.empty()) return;
    if (!crowded_.empty()) fail_crowded();
    if (header_.is_text)
      throw source_.error(ErrorCode::wrong_count, "more than the header says", more);
    throw Error(ErrorCode::wrong_count, "more bytes than the header says", {source_.file()});
  }

  const text::Source& source_;
  Faces use_;
  PlyHeader header_;
  text::Fields fields_;
  BinaryCursor bytes_;
  Surface out_;
  std::vector<double> corners_;  // of a face
  NoteCounter notes_;
  std::string_view field_;                                        // the last one of a text
  std::pair<const Element*, std::int64_t> row_{nullptr, 0};       // what is being read
  std::pair<const Element*, std::int64_t> last_row_{nullptr, 0};  // what was read before
  std::string_view crowded_;  // the first value of a row that does not begin a line, if one does
};

}  // namespace

PointFile<3> read_ply_points(const std::string& path) {
  const text::Source source(path);
  return PlyReader(source, PlyReader::Faces::note).read().rows;
}
Surface read_ply_surface(const std::string& path) {
  const text::Source source(path);
  return PlyReader(source, PlyReader::Faces::use).read();
}

}  // namespace mesher
