// Reads `.poly` and `.smesh` files (TetGen).
//
//   count [dimension [attributes [markers]]]      points, as in .node; a count of 0: in the .node
//   id x y z [attributes...] [marker]             file beside
//   count [markers]                               facets, in .poly each
//   polygons [holes [marker]]
//   count corner...                                 a polygon, maybe over several lines
//   id x y z                                        a hole
//                                                 and in .smesh
//   count corner... [marker]
//   count                                         holes
//   id x y z
//   [count                                        regions
//    id x y z attribute [max_volume]]
#include <unordered_map>
#include <utility>

#include "io/facet.hpp"
#include "io/poly_tables.hpp"
#include "io/read_plc.hpp"
#include "text/id_text.hpp"

namespace mesher {
namespace {

class SpacePolyReader {
 public:
  enum class Format { poly, smesh };

  SpacePolyReader(const std::string& path, std::string_view content, Format format)
      : lines_(path, content), format_(format) {
    out_.file = out_.point_file = path;
  }

  GraphFile<3> read() {
    read_points();
    read_facets();
    number_segments();
    read_hole_table(lines_, out_.graph, out_);
    read_region_table(lines_, out_.graph, out_, notes_);
    out_.notes = notes_.notes();
    return std::move(out_);
  }

 private:
  void read_points() {
    read_point_table(lines_, PointsBeside::read, out_.graph, out_);
    require_indexable(out_.graph.points.size(), out_.point_file);
    for (std::uint32_t i = 0; i < out_.graph.points.size(); ++i) {
      number_of_.try_emplace(out_.graph.points[i].id, i);
      places_.push_back(out_.graph.points[i].at);
    }
  }

  void read_facets() {
    const text::Line& header = next_header(lines_, "facets");
    const std::int64_t count = read_count(header, 0);
    marked_ = read_markers(header, 1);
    require_header(header, 2);
    for (std::int64_t i = 0; i < count; ++i) {
      const text::Line& line = next_row(lines_, 1, static_cast<std::size_t>(i), count, "facets");
      const FilePosition position = line.position(0);
      facet_ = PolygonId{i + 1};
      format_ == Format::poly ? read_facet(line, position) : read_single(position);
    }
    std::int64_t last = count;
    for (auto& [facet, position] : parts_behind_) {
      facet_ = PolygonId{++last};
      add_facet(std::move(facet), position);
    }
  }

  void read_facet(const text::Line& line, FilePosition position) {
    const std::int64_t polygons = read_count(line, 0);
    const std::int64_t holes = line.size() > 1 ? read_count(line, 1) : 0;
    const std::int64_t marker = marked_ && line.size() > 2 ? line.integer(2) : 0;
    require_fields(line, 1, marked_ ? 3 : 2);
    FacetParts facet;
    while (std::cmp_less(facet.polygons.size(), polygons)) {
      next_row(lines_, 1, facet.polygons.size(), polygons, "polygons of a facet");
      facet.polygons.push_back(read_corners().corners);
    }
    std::vector<FileLocation> places;
    while (std::cmp_less(facet.holes.size(), holes)) {
      const text::Line& row = next_row(lines_, 4, facet.holes.size(), holes, "holes of a facet");
      require_fields(row, 4, 4);
      facet.holes.push_back(read_node_point<3>(row, CoordinateRule::input));
      places.push_back(row.place(0));
    }
    add(facet, marker, position, places);
  }

  void read_single(FilePosition position) {
    const Corners row = read_corners();
    const std::int64_t marker = marked_ && row.rest == 1 ? row.marker : 0;
    add(FacetParts{{row.corners}, {}}, marker, position, {});
  }

  struct Corners {
    std::vector<std::uint32_t> corners;
    std::size_t rest = 0;  // fields behind them
    std::int64_t marker = 0;
  };
  // `count corner...` from the current line on.
  Corners read_corners() {
    const std::int64_t count = read_count(lines_.line(), 0);
    if (count == 0) throw lines_.line().error(ErrorCode::wrong_count, "a polygon of no corners", 0);
    Corners row;
    std::size_t field = 1;
    while (std::cmp_less(row.corners.size(), count)) {
      if (field == lines_.line().size()) {
        next_row(lines_, 1, row.corners.size(), count, "corners of a polygon");
        field = 0;
      }
      row.corners.push_back(corner(lines_.line(), field++));
    }
    row.rest = lines_.line().size() - field;
    if (row.rest == 1 && marked_ && format_ == Format::smesh) {
      row.marker = lines_.line().integer(field);
    } else if (row.rest > 0) {
      throw lines_.line().error(ErrorCode::wrong_count,
                                "more than the " + std::to_string(count) + " corners of a polygon",
                                field);
    }
    return row;
  }

  std::uint32_t corner(const text::Line& line, std::size_t i) {
    const PointId id{line.integer(i)};
    const auto found = number_of_.find(id);
    if (found != number_of_.end()) return found->second;
    throw Error(ErrorCode::unknown_id,
                "a corner is point " + id_text(id) + ", which is not there; there are " +
                    std::to_string(out_.graph.points.size()) + " points in " + out_.point_file,
                line.place(i), {mesher::Feature(id)});
  }

  // A facet's first part has its number; others are numbered after all facets.
  void add(const FacetParts& facet, std::int64_t marker, FilePosition position,
           const std::vector<FileLocation>& holes) {
    const FacetPolygons all = polygons_of(facet, places_);
    if (!all.useless_holes.empty()) {
      throw Error(ErrorCode::bad_syntax, "a hole of a facet lies in none of its polygons",
                  holes[all.useless_holes.front()]);
    }
    for (const auto& [a, b] : all.segments) {
      out_.graph.segments.push_back({{}, id(a), id(b), marker});
      out_.segments.push_back(position);
    }
    for (std::size_t i = 0; i < all.parts.size(); ++i) {
      Polygon part = polygon(all.parts[i]);
      part.marker = marker;
      if (i == 0) {
        add_facet(std::move(part), position);
      } else {
        parts_behind_.emplace_back(std::move(part), position);
      }
    }
  }

  void add_facet(mesher::Polygon&& facet, FilePosition position) {
    facet.id = facet_;
    out_.graph.polygons.push_back(std::move(facet));
    out_.polygons.push_back(position);
  }

  [[nodiscard]] PointId id(std::uint32_t point) const { return out_.graph.points[point].id; }

  [[nodiscard]] Polygon polygon(const FacetPolygons::Part& part) const {
    Polygon polygon;
    for (const auto& loop : part.loops) {
      auto& corners = polygon.loops.emplace_back();
      for (const std::uint32_t v : loop) corners.push_back(id(v));
    }
    for (const auto& [a, b] : part.edges) polygon.edges.push_back({id(a), id(b)});
    for (const std::uint32_t v : part.points) polygon.points.push_back(id(v));
    return polygon;
  }

  void number_segments() {
    std::int64_t count = 0;
    for (mesher::Segment& s : out_.graph.segments) s.id = LineId{++count};
  }

  GraphFile<3> out_;
  text::FieldLines lines_;
  Format format_;
  bool marked_ = false;
  PolygonId facet_{};  // its number
  std::unordered_map<PointId, std::uint32_t> number_of_;
  std::vector<Point<3>> places_;
  std::vector<std::pair<mesher::Polygon, FilePosition>> parts_behind_;
  NoteCounter notes_;
};

GraphFile<3> read_tetgen(const std::string& path, SpacePolyReader::Format format) {
  const std::string content = text::read_file(path);
  return SpacePolyReader(path, content, format).read();
}

}  // namespace

GraphFile<3> read_space_poly(const std::string& path) {
  return read_tetgen(path, SpacePolyReader::Format::poly);
}
GraphFile<3> read_smesh(const std::string& path) {
  return read_tetgen(path, SpacePolyReader::Format::smesh);
}

}  // namespace mesher
