// The readers of single formats, behind read_points.
#pragma once

#include <string>

#include "mesher/io.hpp"

namespace mesher {

/// Throws: Error as read_points, but duplicate points are not looked for.
template <int D>
[[nodiscard]] PointFile<D> read_xyz(const std::string& path);
template <int D>
[[nodiscard]] PointFile<D> read_csv(const std::string& path);

/// The columns x, y, h of a background of sizes. Throws: Error likewise.
[[nodiscard]] PointFile<3> read_csv_sizes(const std::string& path);

/// Adds a point of a format without ids: the next of 1..n.
template <int D>
void add_row(PointFile<D>& rows, const Point<D>& point, long line) {
  rows.points.push_back(point);
  rows.ids.push_back(FeatureId{static_cast<std::int64_t>(rows.points.size())});
  rows.lines.push_back(line);
}

}  // namespace mesher
