// The readers of single formats, behind read_points.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "geometry/place_hash.hpp"
#include "io/point_file.hpp"
#include "mesher/names.hpp"
#include "sac/label.hpp"
#include "text/text.hpp"

namespace mesher {

/// The vertices of a surface or a grid in space.
[[nodiscard]] PointFile<3> read_off_points(const std::string& path);
[[nodiscard]] PointFile<3> read_obj_points(const std::string& path);
[[nodiscard]] PointFile<3> read_ply_points(const std::string& path);
/// Distinct: corners in one place are one point.
[[nodiscard]] PointFile<3> read_stl_points(const std::string& path);
[[nodiscard]] PointFile<3> read_vtu_points(const std::string& path);
[[nodiscard]] PointFile<3> read_vtk_points(const std::string& path);

/// The same with faces, by numbers of points from 0.
struct Surface {
  struct Face {
    std::vector<std::uint32_t> corners;
    FilePosition position;
    std::int64_t marker = 0;
    std::optional<PolygonId> id{};  ///< of all faces or of none
  };
  PointFile<3> rows;
  std::vector<Face> faces;
  GroupNames names{};  ///< of markers
};
[[nodiscard]] Surface read_off_surface(const std::string& path);
[[nodiscard]] Surface read_obj_surface(const std::string& path);
[[nodiscard]] Surface read_ply_surface(const std::string& path);
[[nodiscard]] Surface read_stl_surface(const std::string& path);
/// Of a grid's triangles, quadrilaterals and polygons, with cell data `marker`; `polygon` are ids,
/// if all faces have one, and no two the same.
[[nodiscard]] Surface read_vtu_surface(const std::string& path);
[[nodiscard]] Surface read_vtk_surface(const std::string& path);

/// A number that spreads the ids, or the places, of rows.
[[nodiscard]] inline std::uint64_t row_hash(PointId id) noexcept {
  return sac::mix(static_cast<std::uint64_t>(id));
}
template <std::size_t N>
[[nodiscard]] std::uint64_t row_hash(const std::array<double, N>& p) noexcept {
  return detail::place_hash(p);
}

/// Two rows of a file that have one id, or one place; the later one is the first in the file to
/// repeat an earlier.
struct Repeat {
  std::size_t earlier;
  std::size_t later;
};
/// Throws: Error (repeated_id, duplicate_point).
template <int D>
[[noreturn]] void fail_repeated_id(const PointFile<D>& rows, Repeat repeat);
template <int D>
[[noreturn]] void fail_duplicate_point(const PointFile<D>& rows, Repeat repeat);

/// The columns x, y, h of a background of sizes; x, y, z, h in space. Throws: Error likewise.
template <int D>
[[nodiscard]] PointFile<D + 1> read_csv_sizes(const std::string& path);

/// Adds a point of a format without ids: the next of 1..n, where so many are before these.
template <int D>
void add_row(PointFile<D>& rows, const Point<D>& point, long line, std::size_t before = 0) {
  rows.points.push_back(point);
  rows.ids.push_back(PointId{static_cast<std::int64_t>(before + rows.points.size())});
  rows.lines.push_back(line);
}

/// 0 in place of a coordinate below 2^-100.
[[nodiscard]] inline double without_noise(double x) noexcept {
  return x < 0x1p-100 && x > -0x1p-100 ? 0 : x;
}

/// The coordinates of such a vertex, in the fields from `first` on, as they are in the file.
/// Throws: Error (bad_number, not_finite, magnitude: beyond 2^100).
[[nodiscard]] inline Point<3> read_vertex_place(const text::Line& line, std::size_t first) {
  Point<3> at;
  for (std::size_t i = 0; i < 3; ++i) {
    at[i] = line.finite(first + i);
    if (without_noise(at[i]) != 0) at[i] = line.coordinate(first + i);
  }
  return at;
}

/// As add_row(), of a vertex of a surface or a grid, whose coordinates have not been looked at:
/// what is below 2^-100, noise of the program that has made it, becomes 0, with a note. Throws:
/// Error(magnitude) of `place`.
void add_vertex(PointFile<3>& rows, Point<3> point, const FileLocation& place);

}  // namespace mesher
