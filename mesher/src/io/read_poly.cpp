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
#include <utility>

#include "io/poly_tables.hpp"
#include "io/read_pslg.hpp"

namespace mesher {
namespace {

class PolyReader {
 public:
  PolyReader(const std::string& path, std::string_view content, PointsBeside beside)
      : lines_(path, content), beside_(beside) {
    out_.file = out_.point_file = path;
  }

  GraphFile<2> read() {
    read_point_table(lines_, beside_, out_.graph, out_);
    read_segments();
    read_hole_table(lines_, out_.graph, out_);
    read_region_table(lines_, out_.graph, out_, notes_);
    out_.notes = notes_.notes();
    return std::move(out_);
  }

 private:
  void read_segments() {
    const text::Line& header = next_header(lines_, "segments");
    const std::int64_t count = read_count(header, 0);
    const std::size_t fields = 3 + (read_markers(header, 1) ? 1u : 0u);
    require_header(header, 2);
    while (std::cmp_less(out_.segments.size(), count)) {
      const text::Line& line = next_row(lines_, fields, out_.segments.size(), count, "segments");
      require_fields(line, fields, fields);
      const std::int64_t marker = fields == 4 ? line.integer(3) : 0;
      out_.graph.segments.push_back(
          {LineId{line.integer(0)}, PointId{line.integer(1)}, PointId{line.integer(2)}, marker});
      out_.segments.push_back(line.position(0));
    }
  }

  GraphFile<2> out_;
  text::FieldLines lines_;
  PointsBeside beside_;
  NoteCounter notes_;
};

}  // namespace

GraphFile<2> read_poly(const std::string& path, PointsBeside beside) {
  const std::string content = text::read_file(path);
  return PolyReader(path, content, beside).read();
}

}  // namespace mesher
