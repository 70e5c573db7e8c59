// Writes graphs as `.poly` (Triangle, TetGen), `.obj` (Wavefront) and `.smesh` (TetGen).
//
// In space a hole of a polygon needs a place in it: one beside the loop's first edge.
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "graph/has_features.hpp"
#include "mesher/graph.hpp"
#include "mesher/write.hpp"
#include "space/polygon_shape.hpp"
#include "text/id_text.hpp"
#include "text/text.hpp"

namespace mesher {
namespace {

template <class Id>
requires std::is_enum_v<Id> TextFile& operator<<(TextFile& file, Id id) {
  return file << static_cast<std::int64_t>(id);
}
template <std::size_t N>
TextFile& operator<<(TextFile& file, const std::array<double, N>& p) {
  for (std::size_t i = 0; i < N; ++i) (i > 0 ? file << ' ' : file) << p[i];
  return file;
}

template <int D>
void write_points(const Graph<D>& graph, TextFile& file) {
  const bool marked = has_marker(graph.points);
  file << graph.points.size() << ' ' << D << ' ' << graph.attributes_per_point
       << (marked ? " 1\n" : " 0\n");
  for (std::size_t i = 0; i < graph.points.size(); ++i) {
    file << graph.points[i].id << ' ' << graph.points[i].at;
    for (std::size_t k = 0; k < graph.attributes_per_point; ++k) {
      file << ' ' << graph.attributes[i * graph.attributes_per_point + k];
    }
    if (marked) file << ' ' << graph.points[i].marker;
    file << '\n';
  }
}

void write_segments(const std::vector<Segment>& segments, TextFile& file) {
  const bool marked = has_marker(segments);
  file << segments.size() << (marked ? " 1\n" : " 0\n");
  for (const Segment& s : segments) {
    file << s.id << ' ' << s.from << ' ' << s.to;
    if (marked) file << ' ' << s.marker;
    file << '\n';
  }
}

// A limit is always written: a region with one value would say less.
template <int D>
void write_seeds(const Graph<D>& graph, TextFile& file) {
  const auto holes = graph.holes(), regions = graph.regions();
  file << holes.size() << '\n';
  for (const Seed<D>& hole : holes) file << hole.id.number << ' ' << hole.at << '\n';
  if (regions.empty()) return;
  file << regions.size() << '\n';
  for (const Seed<D>& r : regions) {
    file << r.id.number << ' ' << r.at << ' ' << r.attribute << ' ' << r.max_measure.value_or(-1)
         << '\n';
  }
}

class ComplexWriter {
 public:
  ComplexWriter(const Graph<3>& plc, TextFile& file) : plc_(without_polylines(plc)), file_(file) {
    for (const GraphPoint<3>& v : plc.points) places_.emplace(v.id, v.at);
  }

  void write_poly() {
    write_points(plc_, file_);
    write_header();
    for (const mesher::Polygon& f : plc_.polygons) write_facet(f);
    for (const mesher::Segment& s : plc_.segments) {
      file_ << "1 0";
      write_marker(s.marker);
      write_corners({s.from, s.to});
    }
    write_seeds(plc_, file_);
  }

  void write_smesh() {
    write_points(plc_, file_);
    write_header();
    for (const mesher::Polygon& f : plc_.polygons) write_row(f.loops.front(), f.marker);
    for (const mesher::Segment& s : plc_.segments) write_row({s.from, s.to}, s.marker);
    write_seeds(plc_, file_);
  }

 private:
  void write_header() {
    marked_ = has_marker(plc_.polygons) || has_marker(plc_.segments);
    file_ << plc_.polygons.size() + plc_.segments.size() << (marked_ ? " 1\n" : " 0\n");
  }
  void write_marker(std::int64_t marker) {
    if (marked_) file_ << ' ' << marker;
    file_ << '\n';
  }
  void write_corners(const std::vector<PointId>& corners) {
    file_ << corners.size();
    for (const PointId id : corners) file_ << ' ' << id;
    file_ << '\n';
  }
  void write_row(const std::vector<PointId>& corners, std::int64_t marker) {
    file_ << corners.size();
    for (const PointId id : corners) file_ << ' ' << id;
    write_marker(marker);
  }

  void write_facet(const mesher::Polygon& f) {
    const std::vector<Point<3>> holes = holes_of(f);
    file_ << f.loops.size() + f.edges.size() + f.points.size() << ' ' << holes.size();
    write_marker(f.marker);
    for (const auto& loop : f.loops) write_corners(loop);
    for (const auto& [a, b] : f.edges) write_corners({a, b});
    for (const PointId id : f.points) write_corners({id});
    for (std::size_t i = 0; i < holes.size(); ++i) file_ << i + 1 << ' ' << holes[i] << '\n';
  }

  // A place in each loop but the first that has the outside of the polygon directly in it.
  std::vector<Point<3>> holes_of(const Polygon& polygon) const {
    if (polygon.loops.size() == 1) return {};
    detail::Polygon f;
    for (const auto& loop : polygon.loops) {
      for (const PointId id : loop) f.places.push_back(places_.at(id));
      f.loop_end.push_back(static_cast<std::uint32_t>(f.places.size()));
    }
    std::vector<Point<3>> holes;
    if (!detail::find_shape(f)) return holes;
    for (std::size_t loop = 1; loop < polygon.loops.size(); ++loop) {
      if (const auto hole = place_beside(f, f.loop_begin(loop), loop)) holes.push_back(*hole);
    }
    return holes;
  }

  // Beside an edge of the loop, where it has the outside within; as near as it takes.
  static std::optional<Point<3>> place_beside(const detail::Polygon& f, std::uint32_t i,
                                              std::size_t loop) {
    const Point<3>&a = f.places[i], &b = f.places[f.next(i)];
    const Point<3> middle = detail::scaled(0.5, detail::plus(a, b));
    const Point<3> out = detail::scaled(-std::sqrt(detail::squared_distance(a, b)), inward(f, i));
    for (double s = 0.25; s > 0x1p-40; s /= 2) {
      const Point<3> x = detail::plus(middle, detail::scaled(s, out));
      const Point<2> uv = f.plane.in_frame(x);
      if (!detail::loop_contains(f, loop, uv)) continue;
      if (!contains(f, uv) && is_directly_in(f, uv, loop)) return x;
    }
    return std::nullopt;  // the outside is around it
  }
  static bool is_directly_in(const detail::Polygon& f, const Point<2>& uv, std::size_t loop) {
    for (std::size_t other = 1; other < f.loop_end.size(); ++other) {
      const Point<2>& corner = f.outline[f.loop_begin(other)];
      if (other != loop && detail::loop_contains(f, loop, corner) &&
          detail::loop_contains(f, other, uv)) {
        return false;
      }
    }
    return true;
  }

  Graph<3> plc_;  // without polylines
  TextFile& file_;
  std::map<PointId, Point<3>> places_;
  bool marked_ = false;
};

}  // namespace

void write_poly(const Graph<2>& graph, TextFile& file) {
  write_points(graph, file);
  write_segments(without_polylines(graph).segments, file);
  write_seeds(graph, file);
}

void write_obj(const Graph<2>& graph, TextFile& file) {
  std::map<PointId, std::size_t> number;
  for (const GraphPoint<2>& point : graph.points) {
    number.try_emplace(point.id, number.size() + 1);
    file << "v " << point.at << " 0\n";
  }
  for (const Segment& s : graph.segments) {
    file << "l " << number.at(s.from) << ' ' << number.at(s.to) << '\n';
  }
  for (const Polyline& line : graph.polylines) {
    file << 'l';
    for (const PointId id : line.points) file << ' ' << number.at(id);
    file << '\n';
  }
}

void write_graph(const Graph<2>& graph, const std::string& path) {
  const std::string extension = text::extension(path);
  if (extension != ".poly" && extension != ".obj") {
    throw Error(ErrorCode::unknown_format,
                "points and lines are written to .poly and .obj, not " + text::quoted(extension),
                {path});
  }
  OutputFiles files;
  TextFile& file = files.open(path);
  extension == ".poly" ? write_poly(graph, file) : write_obj(graph, file);
  files.commit();
}

void require_single_loops(const Graph<3>& plc) {
  for (const Polygon& polygon : plc.polygons) {
    if (polygon.loops.size() == 1 && polygon.edges.empty() && polygon.points.empty()) continue;
    throw Error(ErrorCode::unsupported,
                ".smesh cannot store more than one loop of polygon " + id_text(polygon.id) +
                    ", nor edges or points inside it; .poly can",
                {}, {mesher::Feature(polygon.id)});
  }
}

void write_poly(const Graph<3>& plc, TextFile& file) { ComplexWriter(plc, file).write_poly(); }
void write_smesh(const Graph<3>& plc, TextFile& file) { ComplexWriter(plc, file).write_smesh(); }

void write_graph(const Graph<3>& plc, const std::string& path) {
  const std::string extension = text::extension(path);
  if (extension != ".poly" && extension != ".smesh") {
    throw Error(ErrorCode::unknown_format,
                "points, segments and polygons in space are written as .poly and .smesh, not " +
                    text::quoted(extension),
                {path});
  }
  if (extension == ".smesh") require_single_loops(plc);
  OutputFiles files;
  TextFile& file = files.open(path);
  extension == ".poly" ? write_poly(plc, file) : write_smesh(plc, file);
  files.commit();
}

}  // namespace mesher
