// The rows of a .node file, shared by the readers of points and of meshes.
#pragma once

#include <string>
#include <vector>

#include "mesher/io.hpp"

namespace mesher {

/// Which numbers a coordinate may be.
enum class CoordinateRule : std::uint8_t {
  input,   ///< 0 or of magnitude 2^-100 to 2^100; -0 becomes 0
  finite,  ///< any finite double, bit for bit
};

template <int D>
struct NodeFile {
  PointFile<D> rows;              ///< ids and points may repeat
  std::vector<VertexKind> kinds;  ///< from one attribute and a marker, else all steiner
};

/// Throws: Error as read_points, but repeated ids and duplicate points are not looked for.
template <int D>
[[nodiscard]] NodeFile<D> read_node(const std::string& path, CoordinateRule rule);

/// Throws: Error(repeated_id) naming the first line whose id stood before. Cost: O(n log n).
template <int D>
void require_distinct_ids(const PointFile<D>& rows);

/// Throws: Error(duplicate_point) naming the first line whose point stood before. Cost: O(n log n).
template <int D>
void require_distinct_points(const PointFile<D>& rows);

}  // namespace mesher
