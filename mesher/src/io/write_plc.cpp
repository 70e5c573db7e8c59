// Writes complexes as `.poly` and `.smesh` (TetGen).
//
// A hole of a polygon needs a place in it: one beside the loop's first edge.
#include <algorithm>
#include <map>
#include <utility>

#include "mesher/plc.hpp"
#include "space/polygon_shape.hpp"
#include "text/text.hpp"

namespace mesher {
namespace {

TextFile& operator<<(TextFile& file, FeatureId id) { return file << static_cast<std::int64_t>(id); }
TextFile& operator<<(TextFile& file, const Point<3>& p) {
  return file << p[0] << ' ' << p[1] << ' ' << p[2];
}

template <class Part>
bool any_marked(const std::vector<Part>& parts) {
  return std::any_of(parts.begin(), parts.end(), [](const Part& p) { return p.marker != 0; });
}

class PlcWriter {
 public:
  PlcWriter(const Plc& plc, TextFile& file) : plc_(plc), file_(file) {
    for (const Plc::Vertex& v : plc.points) places_.emplace(v.id, v.at);
  }

  void write_poly() {
    write_points();
    write_header();
    for (const Plc::Facet& f : plc_.facets) write_facet(f);
    for (const Plc::Segment& s : plc_.segments) {
      file_ << "1 0";
      write_marker(s.marker);
      write_corners({s.from, s.to});
    }
    write_seeds();
  }

  void write_smesh() {
    write_points();
    write_header();
    for (const Plc::Facet& f : plc_.facets) write_row(f.polygon.loops.front(), f.marker);
    for (const Plc::Segment& s : plc_.segments) write_row({s.from, s.to}, s.marker);
    write_seeds();
  }

 private:
  void write_points() {
    const bool marked = any_marked(plc_.points);
    file_ << plc_.points.size() << " 3 " << plc_.attributes_per_point << (marked ? " 1\n" : " 0\n");
    for (std::size_t i = 0; i < plc_.points.size(); ++i) {
      file_ << plc_.points[i].id << ' ' << plc_.points[i].at;
      for (std::size_t k = 0; k < plc_.attributes_per_point; ++k) {
        file_ << ' ' << plc_.attributes[i * plc_.attributes_per_point + k];
      }
      if (marked) file_ << ' ' << plc_.points[i].marker;
      file_ << '\n';
    }
  }
  void write_header() {
    marked_ = any_marked(plc_.facets) || any_marked(plc_.segments);
    file_ << plc_.facets.size() + plc_.segments.size() << (marked_ ? " 1\n" : " 0\n");
  }
  void write_marker(std::int64_t marker) {
    if (marked_) file_ << ' ' << marker;
    file_ << '\n';
  }
  void write_corners(const std::vector<FeatureId>& corners) {
    file_ << corners.size();
    for (const FeatureId id : corners) file_ << ' ' << id;
    file_ << '\n';
  }
  void write_row(const std::vector<FeatureId>& corners, std::int64_t marker) {
    file_ << corners.size();
    for (const FeatureId id : corners) file_ << ' ' << id;
    write_marker(marker);
  }

  void write_facet(const Plc::Facet& f) {
    const Polygon& p = f.polygon;
    const std::vector<Point<3>> holes = holes_of(p);
    file_ << p.loops.size() + p.edges.size() + p.points.size() << ' ' << holes.size();
    write_marker(f.marker);
    for (const auto& loop : p.loops) write_corners(loop);
    for (const auto& [a, b] : p.edges) write_corners({a, b});
    for (const FeatureId id : p.points) write_corners({id});
    for (std::size_t i = 0; i < holes.size(); ++i) file_ << i + 1 << ' ' << holes[i] << '\n';
  }

  // A place in each loop but the first that has the outside of the polygon directly in it.
  std::vector<Point<3>> holes_of(const Polygon& polygon) const {
    if (polygon.loops.size() == 1) return {};
    detail::Polygon f;
    for (const auto& loop : polygon.loops) {
      for (const FeatureId id : loop) f.places.push_back(places_.at(id));
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
      if (!detail::loop_contains(f, loop, uv)) return std::nullopt;  // the outside is around it
      if (!contains(f, uv) && is_directly_in(f, uv, loop)) return x;
    }
    return std::nullopt;
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

  void write_seeds() {
    file_ << plc_.holes.size() << '\n';
    for (const Plc::Hole& h : plc_.holes) file_ << h.id << ' ' << h.seed << '\n';
    if (plc_.regions.empty()) return;
    file_ << plc_.regions.size() << '\n';
    for (const Plc::Region& r : plc_.regions) {
      file_ << r.id << ' ' << r.seed << ' ' << r.attribute << ' ' << r.max_volume.value_or(-1)
            << '\n';
    }
  }

  const Plc& plc_;
  TextFile& file_;
  std::map<FeatureId, Point<3>> places_;
  bool marked_ = false;
};

}  // namespace

void require_single_loops(const Plc& plc) {
  for (const auto& [polygon, marker] : plc.facets) {
    if (polygon.loops.size() == 1 && polygon.edges.empty() && polygon.points.empty()) continue;
    const auto id = static_cast<std::int64_t>(polygon.id);
    throw Error(ErrorCode::unsupported,
                ".smesh has no place for what polygon " + std::to_string(id) +
                    " has beside one loop; .poly has",
                {}, {polygon_named(polygon.id)});
  }
}

void write_poly(const Plc& plc, TextFile& file) { PlcWriter(plc, file).write_poly(); }
void write_smesh(const Plc& plc, TextFile& file) { PlcWriter(plc, file).write_smesh(); }

void write_plc(const Plc& plc, const std::string& path) {
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
