// Reads `.xyz` files: a line of blank-separated coordinates for each point.
#include "io/line_points.hpp"
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
PointFile<D> read_xyz(const text::Share& share) {
  PointFile<D> rows{share.file, {}, {}, {}};
  for (text::FieldLines lines(share); lines.next();) {
    add_row<D>(rows, read_point<D>(lines), lines.line().number(), share.rows_before);
  }
  return rows;
}

bool xyz_is_in_space(const text::Share& share) {
  for (text::FieldLines lines(share); lines.next();) {
    if (lines.line().size() > 2 && !is_zero(lines.line(), 2)) return true;
  }
  return false;
}

template PointFile<2> read_xyz<2>(const text::Share&);
#ifndef MESHER_PLANE_ONLY
template PointFile<3> read_xyz<3>(const text::Share&);
#endif

}  // namespace mesher
