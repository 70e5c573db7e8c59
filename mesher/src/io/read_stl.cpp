// Reads the corners of `.stl` files as points in space, and the facets between them:
//
//   solid [name]
//     facet normal x y z / outer loop / vertex x y z (three times) / endloop / endfacet
//   endsolid [name]
//
// or, in binary, 80 bytes of anything, the number of facets (4 bytes, little-endian), and for each
// facet twelve floats (normal, corners) and two bytes. Corners in one place are one point.
#include <algorithm>
#include <bit>
#include <map>
#include <string_view>

#include "io/face_groups.hpp"
#include "io/read_points.hpp"
#include "io/vtu_data.hpp"
#include "text/text.hpp"

namespace mesher {
namespace {

// Points in the order in which their places first come; each three corners are a facet.
class Corners {
 public:
  explicit Corners(const std::string& path) : out_{{path, {}, {}, {}}, {}} {}

  void add(const Point<3>& at, const FileLocation& place) {
    const auto number = static_cast<std::uint32_t>(out_.rows.points.size());
    const auto [it, fresh] = number_at_.try_emplace(without_noise(at), number);
    if (fresh) add_vertex(out_.rows, at, place);
    if (out_.faces.empty() || out_.faces.back().corners.size() == 3) {
      out_.faces.push_back({{}, {place.line, place.column}});
    }
    out_.faces.back().corners.push_back(it->second);
  }
  Surface take() { return std::move(out_); }

 private:
  // And without negative zeros.
  static Point<3> without_noise(Point<3> p) {
    for (double& x : p) x = mesher::without_noise(x);
    return p;
  }
  Surface out_;
  std::map<Point<3>, std::uint32_t> number_at_;
};

// --- Binary ----------------------------------------------------------------------------------

constexpr std::size_t kHeader = 80, kCount = 4, kNormal = 12, kFacet = 50, kFloat = 4;

double float_at(const std::string& bytes, std::size_t at, const std::string& path) {
  const auto bits = static_cast<std::uint32_t>(read_bits(bytes.data() + at, kFloat, false));
  const double value = std::bit_cast<float>(bits);
  if (value - value == 0) return value;
  throw Error(ErrorCode::not_finite,
              "a coordinate is not finite, before byte " + std::to_string(at + kFloat), {path});
}

std::uint64_t facets_of(const std::string& bytes) {
  return bytes.size() < kHeader + kCount ? 0 : read_bits(bytes.data() + kHeader, kCount, false);
}

bool has_size_of_binary(const std::string& bytes) {
  return bytes.size() >= kHeader + kCount &&
         bytes.size() == kHeader + kCount + facets_of(bytes) * kFacet;
}

void require_size(const std::string& bytes, const std::string& path) {
  if (has_size_of_binary(bytes)) return;
  const bool cut = bytes.size() < kHeader + kCount + facets_of(bytes) * kFacet;
  throw Error(cut ? ErrorCode::truncated : ErrorCode::wrong_count,
              "a binary file of " + std::to_string(bytes.size()) + " bytes, but " +
                  std::to_string(facets_of(bytes)) + " facets take " +
                  std::to_string(kHeader + kCount + facets_of(bytes) * kFacet),
              {path});
}

Surface read_binary(const std::string& bytes, const std::string& path) {
  require_size(bytes, path);
  Corners corners(path);
  for (std::uint64_t i = 0; i < facets_of(bytes); ++i) {
    std::size_t at = kHeader + kCount + i * kFacet + kNormal;
    for (int corner = 0; corner < 3; ++corner) {
      Point<3> p;
      for (double& x : p) {
        x = float_at(bytes, at, path);
        at += kFloat;
      }
      corners.add(p, {path});
    }
  }
  return corners.take();
}

// --- Text ------------------------------------------------------------------------------------

class StlText {
 public:
  StlText(const std::string& path, std::string_view content) : lines_(path, content), all_(path) {}

  Surface read() {
    while (lines_.next()) {
      require("solid");
      groups_.begin(name_of_solid(), line().place(0));
      next();
      for (; line()[0] != "endsolid"; next()) read_facet();
    }
    Surface surface = all_.take();
    NoteCounter notes;
    groups_.mark(surface, notes);
    surface.rows.add(notes.notes());
    return surface;
  }

 private:
  [[nodiscard]] const text::Line& line() const { return lines_.line(); }

  // What follows the word.
  [[nodiscard]] std::string_view name_of_solid() const {
    const std::string_view all = line().trimmed();
    return all.substr(std::min(all.find_first_of(" \t"), all.size()));
  }
  void next() {
    if (lines_.next()) return;
    throw line().error(ErrorCode::truncated, "the file ends before 'endsolid'", line().size());
  }
  void require(std::string_view word) const {
    if (line()[0] == word) return;
    throw line().error(ErrorCode::bad_syntax,
                       "expected " + text::quoted(word) + ", not " + text::quoted(line()[0]), 0);
  }
  void read_facet() {
    require("facet");
    next();
    require("outer");
    for (int corner = 0; corner < 3; ++corner) {
      next();
      read_vertex();
    }
    next();
    require("endloop");
    next();
    require("endfacet");
    groups_.add_face();
  }
  void read_vertex() {
    require("vertex");
    if (line().size() != 4) {
      throw line().error(ErrorCode::wrong_count, "a corner is 'vertex x y z'",
                         std::min<std::size_t>(line().size(), 4));
    }
    all_.add(read_vertex_place(line(), 1), line().place(0));
  }

  text::FieldLines lines_;
  Corners all_;
  FaceGroups groups_;
};

bool is_text(const std::string& content) {
  const auto begin = content.find_first_not_of(" \t\r\n");
  return begin != std::string::npos && content.compare(begin, 5, "solid") == 0;
}

}  // namespace

Surface read_stl_surface(const std::string& path) {
  const std::string content = text::read_file(path);
  const bool binary = has_size_of_binary(content) || !is_text(content);
  return binary ? read_binary(content, path) : StlText(path, content).read();
}

PointFile<3> read_stl_points(const std::string& path) { return read_stl_surface(path).rows; }

}  // namespace mesher
