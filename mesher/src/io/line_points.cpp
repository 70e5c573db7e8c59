// Points alone, line by line.
#include "io/line_points.hpp"

#include <utility>

#include "io/read_node.hpp"
#include "sac/check.hpp"

namespace mesher {
template <int D>
GraphFile<D> points_alone(PointFile<D> rows, const std::vector<std::int64_t>& markers) {
  GraphFile<D> out;
  out.file = out.point_file = rows.file;
  out.graph.points.reserve(rows.points.size());
  out.points.reserve(rows.points.size());
  for (std::size_t i = 0; i < rows.points.size(); ++i) {
    out.graph.points.push_back({rows.ids[i], rows.points[i], markers.empty() ? 0 : markers[i]});
    out.points.push_back({rows.lines[i], rows.lines[i] > 0 ? 1 : 0});
  }
  out.notes = std::move(rows.notes);
  return out;
}

bool has_line_points(const std::string& path) {
  const std::string extension = text::extension(path);
  return extension == ".node" || extension == ".xyz" || extension == ".csv";
}

std::string head_of(const std::string& path) {
  const std::string extension = text::extension(path);
  if (extension == ".csv") return csv_head(path);
  return extension == ".node" ? head_of<text::FieldLines>(path) : "";
}

bool head_tells_dimension(const std::string& path) { return text::extension(path) == ".node"; }

std::size_t count_rows(const text::Share& share) {
  const std::string extension = text::extension(share.file);
  if (extension == ".csv") return csv_rows(share);
  std::size_t rows = 0;
  for (text::FieldLines lines(share); lines.next();) ++rows;
  return extension == ".node" && rows > 0 ? rows - 1 : rows;  // without the header
}

bool is_in_space(const text::Share& share) {
  const std::string extension = text::extension(share.file);
  if (extension == ".node") return node_is_in_space(share);
  return extension == ".csv" ? csv_is_in_space(share) : xyz_is_in_space(share);
}

bool node_is_in_space(const text::Share& share) {
  text::FieldLines lines(share);
  return lines.next() && lines.line().size() > 1 && lines.line()[1] == "3";
}

bool is_zero(const text::Line& line, std::size_t i) {
  try {
    return i < line.size() && line.finite(i) == 0;
  } catch (const Error&) {
    return false;
  }
}

template <int D>
GraphFile<D> read_share(const text::Share& share) {
  const std::string extension = text::extension(share.file);
  if (extension == ".xyz") return points_alone(read_xyz<D>(share));
  if (extension == ".csv") return points_alone(read_csv<D>(share));
  SAC_EXPECTS(extension == ".node");
  NodeFile<D> nodes = read_node<D>(share, CoordinateRule::input);
  return points_alone(std::move(nodes.rows), nodes.markers);
}

template GraphFile<2> points_alone(PointFile<2>, const std::vector<std::int64_t>&);
template GraphFile<2> read_share(const text::Share&);
#ifndef MESHER_PLANE_ONLY
template GraphFile<3> points_alone(PointFile<3>, const std::vector<std::int64_t>&);
template GraphFile<3> read_share(const text::Share&);
#endif

}  // namespace mesher
