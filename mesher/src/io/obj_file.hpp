// The statements of an `.obj` file (Wavefront) in the plane, for the readers of lines and of
// meshes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/read_node.hpp"
#include "mesher/error.hpp"
#include "mesher/mesh.hpp"

namespace mesher {

struct ObjFile {
  /// A point, line or face; `vertices` count from 0.
  struct Element {
    char kind;  ///< 'p', 'l' or 'f'
    std::vector<std::uint32_t> vertices;
    FilePosition position;
  };
  std::vector<Point<2>> vertices;
  std::vector<FilePosition> positions;  ///< one per vertex
  std::vector<Element> elements;
  std::vector<Note> notes;
};

/// Throws: Error (cannot_read, bad_syntax, bad_number, not_finite, magnitude, bad_dimension,
/// bad_mesh for a vertex that is not there, wrong_count, too_many).
[[nodiscard]] ObjFile read_obj_file(const std::string& path, CoordinateRule rule);

}  // namespace mesher
