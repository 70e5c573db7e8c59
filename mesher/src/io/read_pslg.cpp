// Reads graphs of any known format and refuses repeated ids and ends that are no points.
#include "io/read_pslg.hpp"

#include <algorithm>
#include <utility>

#include "io/distinct_ids.hpp"
#include "io/read_node.hpp"
#include "io/text.hpp"
#include "mesher/read_for_repair.hpp"

namespace mesher {
namespace {

std::string id_text(FeatureId id) { return std::to_string(static_cast<std::int64_t>(id)); }

void require_distinct_ids(const PslgFile& f) {
  require_distinct_parts(f.pslg, f);
  Named lines = named("segment", f.pslg.segments, [&](auto i) { return f.place_of_segment(i); });
  const Named more =
      named("polyline", f.pslg.polylines, [&](auto i) { return f.place_of_polyline(i); });
  lines.ids.insert(lines.ids.end(), more.ids.begin(), more.ids.end());
  lines.places.insert(lines.places.end(), more.places.begin(), more.places.end());
  require_distinct(lines);
}

// Throws: Error(unknown_id) for a line along a point that is none of `sorted`.
void require_known(const char* what, FeatureId line, const std::vector<FeatureId>& points,
                   const std::vector<FeatureId>& sorted, const PslgFile& f, const Place& place) {
  const bool alone = sorted.empty() && f.point_file == f.file;
  for (const FeatureId id : points) {
    if (std::binary_search(sorted.begin(), sorted.end(), id)) continue;
    throw Error(ErrorCode::unknown_id,
                std::string(what) + " " + id_text(line) + " ends at point " + id_text(id) +
                    ", which is not there; there are " + std::to_string(sorted.size()) +
                    " points in " + f.point_file + (alone ? ", and no .node file beside it" : ""),
                place, {line, id});
  }
}

// Throws: Error(unknown_id) for the first line along what is no point, Error(bad_syntax) for one of
// fewer than two.
void require_known_ends(const PslgFile& f) {
  std::vector<FeatureId> ids;
  for (const auto& point : f.pslg.points) ids.push_back(point.id);
  std::sort(ids.begin(), ids.end());
  for (std::size_t i = 0; i < f.pslg.segments.size(); ++i) {
    const Pslg::Segment& s = f.pslg.segments[i];
    require_known("segment", s.id, {s.from, s.to}, ids, f, f.place_of_segment(i));
  }
  for (std::size_t i = 0; i < f.pslg.polylines.size(); ++i) {
    const Pslg::Polyline& line = f.pslg.polylines[i];
    require_known("polyline", line.id, line.points, ids, f, f.place_of_polyline(i));
    if (line.points.size() >= 2) continue;
    throw Error(ErrorCode::bad_syntax,
                "polyline " + id_text(line.id) + " has fewer than two points",
                f.place_of_polyline(i), {line.id});
  }
}

// `markers`: one for each row, or none.
PslgFile points_alone(const std::string& path, const PointFile<2>& rows,
                      const std::vector<std::int64_t>& markers) {
  PslgFile out;
  out.file = out.point_file = path;
  for (std::size_t i = 0; i < rows.points.size(); ++i) {
    out.pslg.points.push_back({rows.ids[i], rows.points[i], markers.empty() ? 0 : markers[i]});
    out.points.push_back({rows.lines[i], 1});
  }
  return out;
}

PslgFile read_node_points(const std::string& path, CoincidingPoints coinciding) {
  const NodeFile<2> nodes = read_node<2>(path, CoordinateRule::input);
  require_distinct_ids(nodes.rows);
  if (coinciding == CoincidingPoints::refused) require_distinct_points(nodes.rows);
  return points_alone(path, nodes.rows, nodes.markers);
}

PslgFile read_any(const std::string& path, CoincidingPoints coinciding) {
  const std::string extension = text::extension(path);
  if (extension == ".poly") return read_poly(path, PointsBeside::read);
  if (extension == ".geojson" || extension == ".json") return read_geojson(path);
  if (extension == ".obj") return read_obj_lines(path);
  if (extension == ".vtu") return read_vtu_lines(path);
  if (extension == ".node") return read_node_points(path, coinciding);
  if (extension == ".xyz" || extension == ".csv") {
    return points_alone(path, read_points<2>(path, coinciding), {});
  }
  throw Error(ErrorCode::unknown_format,
              "points and lines are read from .poly, .geojson, .json, .obj, .vtu, .node, .xyz and "
              ".csv, not " +
                  text::quoted(extension),
              {path});
}

}  // namespace

void detail::require_ids(const PslgFile& file) {
  require_distinct_ids(file);
  require_known_ends(file);
}

PslgFile read_pslg(const std::string& path, CoincidingPoints coinciding) {
  PslgFile file = read_any(path, coinciding);
  detail::require_ids(file);
  return file;
}

PslgFile read_pslg(const std::string& path) {
  return read_pslg(path, CoincidingPoints::refused);
}

FeatureId PslgBuilder::add_point(const Point<2>& at, std::int64_t marker, FilePosition position) {
  const FeatureId id{static_cast<std::int64_t>(out_.pslg.points.size()) + 1};
  out_.pslg.points.push_back({id, at, marker});
  out_.points.push_back(position);
  return id;
}

FeatureId PslgBuilder::point_at(const Point<2>& at, std::int64_t marker, FilePosition position) {
  const auto [found, is_new] = at_.try_emplace(at, out_.pslg.points.size());
  if (is_new) return add_point(at, marker, position);
  Pslg::Vertex& point = out_.pslg.points[found->second];
  if (point.marker == 0) point.marker = marker;
  return point.id;
}

FeatureId PslgBuilder::add_line(std::vector<FeatureId> points, std::int64_t marker,
                                FilePosition position) {
  const FeatureId id{++lines_};
  if (points.size() == 2) {
    out_.pslg.segments.push_back({id, points[0], points[1], marker});
    out_.segments.push_back(position);
  } else {
    out_.pslg.polylines.push_back({id, std::move(points), marker});
    out_.polylines.push_back(position);
  }
  return id;
}

void PslgBuilder::add_hole(const Point<2>& seed, FilePosition position) {
  const FeatureId id{static_cast<std::int64_t>(out_.pslg.holes.size()) + 1};
  out_.pslg.holes.push_back({id, seed});
  out_.holes.push_back(position);
}

void PslgBuilder::add_region(const Point<2>& seed, double attribute, std::optional<double> max_area,
                             FilePosition position) {
  const FeatureId id{static_cast<std::int64_t>(out_.pslg.regions.size()) + 1};
  out_.pslg.regions.push_back({id, seed, attribute, max_area});
  out_.regions.push_back(position);
}

PslgFile PslgBuilder::finish() {
  out_.notes = notes_.notes();
  return std::move(out_);
}

}  // namespace mesher
