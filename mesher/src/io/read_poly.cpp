// Reads `.poly` files (Triangle).
//
//   count [dimension [attributes [markers]]]      points, as in .node; a count of 0: in the .node
//   id x y [attributes...] [marker]               file beside
//   count [markers]                               segments
//   id from to [marker]
//   count                                         holes
//   id x y
//   [count                                        regions
//    id x y attribute [max_area]]
#include <cmath>
#include <filesystem>
#include <utility>

#include "io/note_counter.hpp"
#include "io/read_node.hpp"
#include "io/read_pslg.hpp"
#include "io/rows.hpp"
#include "io/text.hpp"

namespace mesher {
namespace {

class PolyReader {
 public:
  PolyReader(const std::string& path, std::string_view content, PointsBeside beside)
      : lines_(path, content), beside_(beside) {
    out_.file = out_.point_file = path;
  }

  PslgFile read() {
    read_points();
    read_segments();
    read_holes();
    read_regions();
    out_.notes = notes_.notes();
    return std::move(out_);
  }

 private:
  void read_points() {
    const NodeHeader header = read_node_header(header_row(lines_, out_.file), 2);
    read_rows(lines_, header, out_);
    if (header.count > 0 || beside_ == PointsBeside::ignore) return;
    const std::string path = text::with_extension(out_.file, ".node");
    if (std::filesystem::exists(path)) read_points_beside(path);
  }

  void read_points_beside(const std::string& path) {
    const std::string content = text::read_file(path);
    text::FieldLines lines(path, content);
    const NodeHeader header = read_node_header(header_row(lines, path), 2);
    out_.point_file = path;
    read_rows(lines, header, out_);
    require_end(lines, "points");
  }

  // Requires: `header` is that of the current line.
  static void read_rows(text::FieldLines& lines, const NodeHeader& header, PslgFile& out) {
    Pslg& pslg = out.pslg;
    pslg.attributes_per_point = static_cast<std::size_t>(header.attributes);
    while (std::cmp_less(pslg.points.size(), header.count)) {
      const text::Line& line = next_row(lines, 1, pslg.points.size(), header.count, "points");
      require_node_fields(lines, header);
      const Point<2> at = read_node_point<2>(line, CoordinateRule::input);
      for (std::size_t i = 0; i < pslg.attributes_per_point; ++i) {
        pslg.attributes.push_back(line.finite(3 + i));
      }
      const std::int64_t marker = header.markers == 0 ? 0 : line.integer(line.size() - 1);
      pslg.points.push_back({FeatureId{line.integer(0)}, at, marker});
      out.points.push_back(line.position(0));
    }
  }

  void read_segments() {
    const text::Line& header = next_header(lines_, "segments");
    const std::int64_t count = read_count(header, 0);
    const std::size_t fields = 3 + (read_markers(header, 1) ? 1u : 0u);
    require_header(header, 2);
    while (std::cmp_less(out_.segments.size(), count)) {
      const text::Line& line = next_row(lines_, fields, out_.segments.size(), count, "segments");
      require_fields(line, fields, fields);
      const std::int64_t marker = fields == 4 ? line.integer(3) : 0;
      out_.pslg.segments.push_back({FeatureId{line.integer(0)}, FeatureId{line.integer(1)},
                                    FeatureId{line.integer(2)}, marker});
      out_.segments.push_back(line.position(0));
    }
  }

  void read_holes() {
    const text::Line& header = next_header(lines_, "holes");
    const std::int64_t count = read_count(header, 0);
    require_header(header, 1);
    while (std::cmp_less(out_.holes.size(), count)) {
      const text::Line& line = next_row(lines_, 3, out_.holes.size(), count, "holes");
      require_fields(line, 3, 3);
      out_.pslg.holes.push_back({FeatureId{line.integer(0)}, seed_of(line)});
      out_.holes.push_back(line.position(0));
    }
  }

  void read_regions() {
    if (!lines_.next()) return;
    const std::int64_t count = read_count(lines_.line(), 0);
    require_header(lines_.line(), 1);
    while (std::cmp_less(out_.regions.size(), count)) {
      const text::Line& line = next_row(lines_, 4, out_.regions.size(), count, "regions");
      require_fields(line, 4, 5);
      out_.pslg.regions.push_back(
          {FeatureId{line.integer(0)}, seed_of(line), line.finite(3), max_area_of(line)});
      out_.regions.push_back(line.position(0));
    }
    require_end(lines_, "regions");
  }

  std::optional<double> max_area_of(const text::Line& line) {
    if (line.size() < 5) {
      notes_.add("a region with one value: taken as its attribute, not as a limit of area",
                 line.place(3));
      return std::nullopt;
    }
    const double area = line.finite(4);
    return area > 0 ? std::optional(area) : std::nullopt;
  }

  static Point<2> seed_of(const text::Line& line) {
    return {line.coordinate(1), line.coordinate(2)};
  }

  PslgFile out_;
  text::FieldLines lines_;
  PointsBeside beside_;
  NoteCounter notes_;
};

}  // namespace

PslgFile read_poly(const std::string& path, PointsBeside beside) {
  const std::string content = text::read_file(path);
  return PolyReader(path, content, beside).read();
}

}  // namespace mesher
