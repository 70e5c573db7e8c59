// The rows of a .node file, shared by the readers of points and of meshes.
#pragma once

#include <string>
#include <vector>

#include "io/point_file.hpp"
#include "text/text.hpp"

namespace mesher {

/// Which numbers a coordinate may be.
enum class CoordinateRule : std::uint8_t {
  input,   ///< 0 or of magnitude 2^-100 to 2^100; -0 becomes 0
  finite,  ///< any finite double, bit for bit
};

/// What the header of a table of points says.
struct NodeHeader {
  std::int64_t count = 0;
  std::int64_t dimension = 2;
  std::int64_t attributes = 0;
  std::int64_t markers = 0;

  /// Fields of a row: the id, the coordinates, and the rest. Requires: all parts in range.
  [[nodiscard]] std::size_t fields() const {
    return static_cast<std::size_t>(1 + dimension + attributes + markers);
  }
};

/// Throws: Error (bad_header, bad_dimension, bad_number).
[[nodiscard]] NodeHeader read_node_header(const text::Line& line, int dimension);

/// Throws: Error (truncated, wrong_count) unless the current line has the fields of a row.
void require_node_fields(const text::FieldLines& lines, const NodeHeader& header);

/// The coordinates of a row. Throws: Error (bad_number, not_finite, magnitude).
template <int D>
[[nodiscard]] Point<D> read_node_point(const text::Line& line, CoordinateRule rule) {
  Point<D> point;
  for (int i = 0; i < D; ++i) {
    point[i] = rule == CoordinateRule::input ? line.coordinate(i + 1) : line.finite(i + 1);
  }
  return point;
}

template <int D>
struct NodeFile {
  PointFile<D> rows;              ///< ids and points may repeat
  std::vector<VertexKind> kinds;  ///< from a file as write_mesh writes it, else all steiner
  std::vector<Feature> origins;   ///< from such a file, else empty; numbers without kind
  /// One per row, if the file has them; for CoordinateRule::finite if they say more.
  std::vector<std::int64_t> markers;
  std::vector<Note> notes;
};

/// What the rows say beside places and markers is read for CoordinateRule::finite, else only
/// counted. Throws: Error as read_points, but repeated ids and duplicate points are not looked for.
template <int D>
[[nodiscard]] NodeFile<D> read_node(const text::Share& share, CoordinateRule rule);

/// Throws: Error(repeated_id) naming the first line whose id stood before. Cost: O(n log n).
template <int D>
void require_distinct_ids(const PointFile<D>& rows);

/// Throws: Error(duplicate_point) naming the first line whose point stood before. Cost: O(n log n).
template <int D>
void require_distinct_points(const PointFile<D>& rows);

}  // namespace mesher
