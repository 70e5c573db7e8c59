// Families of points, segments and polygons in space, for tests and benchmarks, the same on every
// machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mesher/plc.hpp"

namespace mesher {

/// A family of complexes. `size`: what it is of each, and its default.
enum class PlcKind : std::uint8_t {
  cube,         ///< the unit cube's sides
  cube_square,  ///< a square in the middle of the cube; its side, 0.5
  skew,         ///< two segments across each other in the cube; the gap between them, 0.001
  dumbbell,     ///< two cubes with a tube between them; its width, 0.2
  nested,       ///< a cube in the cube; the gap between their sides, 0.1
  l_hole,       ///< an L with a square hole in the cube; the side of the hole, 0.1
  plates,       ///< two parallel squares in the cube; the gap between them, 0.02
  cloud,        ///< points in the cube; how many, 1000
  wedge,        ///< two squares at an edge; the angle in degrees, 20
  pages,        ///< six of them; the angle from each to the next, 8
  spike,        ///< a slender pyramid; its angle at the top, 20
  vee,          ///< two segments at a point; the angle, 5
  leaning,      ///< a segment that leaves a square at a corner; the angle, 5
  tetrahedron,  ///< a flat one; its height, 0.1
  pump,         ///< a round housing with a bore and a square stub; its sides, 16
  faults,       ///< tilted squares in the cube that do not touch; how many, 20
  bricks,       ///< a wall of bricks with joints; their width, 0.02
  tee,     ///< a wall that stands on a floor, on a line that the floor declares; its height, 0.5
  shells,  ///< icosahedra around each other; how many, 4
  island,  ///< a square with a hole and an island in it, in the cube; the island's side, 0.2
};

/// The word of the tool's command line; nothing for other names.
[[nodiscard]] std::optional<PlcKind> plc_kind(std::string_view name);
/// All such words, in the order of PlcKind.
[[nodiscard]] const std::vector<std::string>& plc_kind_names();

/// What to generate.
struct PlcFamily {
  PlcKind kind = PlcKind::cube;
  std::optional<double> size{};  ///< see PlcKind
  std::uint64_t seed = 1;        ///< of cloud and faults
};

/// Where sizes are sensible the parts fit together: nothing crosses, overlaps or touches but at
/// common corners, edges, and what polygons declare. Ids are 1, 2, ...
/// Throws: Error(bad_option) for a size that no such thing can have.
[[nodiscard]] Plc generate_plc(const PlcFamily& family);

}  // namespace mesher
