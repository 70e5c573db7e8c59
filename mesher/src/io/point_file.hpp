// Files of points alone, and the vertices of others.
#pragma once

#include <string>
#include <vector>

#include "mesher/error.hpp"
#include "mesher/mesh.hpp"
#include "mesher/read.hpp"

namespace mesher {

/// Input points with their names and where they stood in the file; the three arrays have one
/// length. Ids are distinct, and so are points.
template <int D>
struct PointFile {
  std::string file;
  std::vector<PointId> ids;
  std::vector<Point<D>> points;
  std::vector<long> lines;    ///< from 1; 0 where a file has no lines
  std::vector<Note> notes{};  ///< what the file holds that is not used

  void add(const std::vector<Note>& more) { notes.insert(notes.end(), more.begin(), more.end()); }
  [[nodiscard]] FileLocation location(std::size_t i) const {
    return {file, lines[i], lines[i] > 0 ? 1 : 0};
  }
};

/// Reads points in the formats of read() (mesher/read.hpp), in space also the vertices of `.off`,
/// `.obj`, `.ply`, `.stl` (corners in one place are one point), `.vtu` and `.vtk`, with ids 1..n.
/// Faces, cells and all else are checked as far as it takes to find the end of the file, and noted.
/// Error(duplicate_point) only if coinciding points are refused. Throws, Cost: as read().
template <int D>
[[nodiscard]] PointFile<D> read_points(const std::string& path,
                                       CoincidingPoints coinciding = CoincidingPoints::refused);

}  // namespace mesher
