// Reads graphs of any known format.
#include "io/read_pslg.hpp"

#include <utility>

#include "graph/require_ids.hpp"
#include "io/read_node.hpp"
#include "mesher/read_for_repair.hpp"
#include "text/text.hpp"

namespace mesher {
namespace {

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
