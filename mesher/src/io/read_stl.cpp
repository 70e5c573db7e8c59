// Reads the corners of `.stl` files as points in space:
//
//   solid [name]
//     facet normal x y z / outer loop / vertex x y z (three times) / endloop / endfacet
//   endsolid [name]
//
// or, in binary, 80 bytes of anything, the number of facets (4 bytes, little-endian), and for each
// facet twelve floats (normal, corners) and two bytes. Corners in one place are one point.
#include <algorithm>
#include <bit>
#include <set>
#include <string_view>

#include "io/read_points.hpp"
#include "io/text.hpp"
#include "io/vtu_data.hpp"

namespace mesher {
namespace {

// Points in the order in which their places first come.
class Corners {
 public:
  explicit Corners(const std::string& path) : rows_{path, {}, {}, {}} {}

  void add(const Point<3>& at, const Place& place) {
    if (seen_.insert(unsigned_zeros(at)).second) add_vertex(rows_, at, place);
  }
  PointFile<3> take() { return std::move(rows_); }

 private:
  static Point<3> unsigned_zeros(Point<3> p) {
    for (double& x : p) x += 0.0;
    return p;
  }
  PointFile<3> rows_;
  std::set<Point<3>> seen_;
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

PointFile<3> read_binary(const std::string& bytes, const std::string& path) {
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

  PointFile<3> read() {
    while (lines_.next()) {
      require("solid");
      next();
      for (; line()[0] != "endsolid"; next()) read_facet();
    }
    return all_.take();
  }

 private:
  [[nodiscard]] const text::Line& line() const { return lines_.line(); }

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
  }
  void read_vertex() {
    require("vertex");
    if (line().size() != 4) {
      throw line().error(ErrorCode::wrong_count, "a corner is 'vertex x y z'",
                         std::min<std::size_t>(line().size(), 4));
    }
    all_.add({line().coordinate(1), line().coordinate(2), line().coordinate(3)}, line().place(0));
  }

  text::FieldLines lines_;
  Corners all_;
};

bool is_text(const std::string& content) {
  const auto begin = content.find_first_not_of(" \t\r\n");
  return begin != std::string::npos && content.compare(begin, 5, "solid") == 0;
}

}  // namespace

PointFile<3> read_stl_points(const std::string& path) {
  const std::string content = text::read_file(path);
  const bool binary = has_size_of_binary(content) || !is_text(content);
  return binary ? read_binary(content, path) : StlText(path, content).read();
}

}  // namespace mesher
