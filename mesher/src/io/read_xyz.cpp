// Reads `.xyz` files: a line of blank-separated coordinates for each point.
#include "io/read_points.hpp"
#include "text/text.hpp"

namespace mesher {
namespace {

template <int D>
Point<D> read_point(const text::FieldLines& lines) {
  const text::Line& line = lines.line();
  if (line.size() < D) {
    const bool cut = lines.at_end();
    throw line.error(cut ? ErrorCode::truncated : ErrorCode::wrong_count,
                     "a point needs " + std::to_string(D) + " coordinates", line.size());
  }
  if (line.size() > 3) throw line.error(ErrorCode::wrong_count, "a point is 'x y [z]'", 3);
  Point<D> point;
  for (int i = 0; i < D; ++i) point[i] = line.coordinate(i);
  if (D == 2 && line.size() == 3 && line.coordinate(2) != 0) {
    throw line.error(ErrorCode::bad_dimension, "a point in space, expected the plane (z = 0)", 2);
  }
  return point;
}

}  // namespace

template <int D>
PointFile<D> read_xyz(const std::string& path) {
  const std::string content = text::read_file(path);
  PointFile<D> rows{path, {}, {}, {}};
  for (text::FieldLines lines(path, content); lines.next();) {
    add_row<D>(rows, read_point<D>(lines), lines.line().number());
  }
  return rows;
}

template PointFile<2> read_xyz<2>(const std::string&);
#ifndef MESHER_PLANE_ONLY
template PointFile<3> read_xyz<3>(const std::string&);
#endif

}  // namespace mesher
