// Binary `.off` files: a line `OFF BINARY`, then numbers of 4 bytes:
//
//   vertices faces edges / x y z of each vertex, floats / corners v v v ... of each face
//
// Geomview writes them big-endian, with the number of a face's colours, and these, behind its
// corners; others write them little-endian and without. Which it is, only the file's length says.
#pragma once

#include <string>
#include <string_view>

#include "io/face_groups.hpp"
#include "io/read_points.hpp"

namespace mesher {

[[nodiscard]] bool is_binary_off(std::string_view content) noexcept;

/// Throws: Error (truncated; wrong_count: its length fits no such file; bad_mesh: a corner is no
/// vertex; not_finite), with the byte.
[[nodiscard]] Surface read_binary_off(const std::string& path, std::string_view content);

}  // namespace mesher
