// Generates families of points, of points and lines, and of complexes, for tests and benchmarks,
// the same on every machine.
//
// All numbers are computed by + - * / and square roots of doubles, which IEEE 754 rounds in one
// way; no distribution of the standard library, no logarithm or cosine of the C library.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mesher/graph.hpp"
#include "mesher/mesh.hpp"

namespace mesher {

/// Random bits: splitmix64 (Steele, Lea, Flood, OOPSLA 2014).
class SplitMix64 {
 public:
  explicit SplitMix64(std::uint64_t seed) : state_(seed) {}

  [[nodiscard]] std::uint64_t bits() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
  }
  /// Within [0, 1), a multiple of 2^-53.
  [[nodiscard]] double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
  /// Within 0 .. n-1. Requires: 0 < n < 2^32. The bias is below n / 2^64.
  [[nodiscard]] std::uint64_t below(std::uint64_t n) { return ((bits() >> 32) * n) >> 32; }

 private:
  std::uint64_t state_;
};

/// A family of points. n: the number requested.
enum class PointKind : std::uint8_t {
  uniform,   ///< the unit box
  gaussian,  ///< normal distribution around 0 with deviation 1
  clusters,  ///< normal clouds of deviation 1/8 to 1/256 around sqrt(n)/4 positions in the unit box
  grid,      ///< the first n positions of an integer grid: cocircular everywhere
  line_circle,  ///< half on a line, half on a circle around it; in space the line is the circle's
                ///< axis
  spiral,       ///< eight turns outward from 0; in space, upward to 1 as well
  sphere,       ///< the unit sphere; in the plane, the unit circle
  spread,  ///< spheres (circles) around 0, each half as wide as the last: from a few dozen points
           ///< on, the largest distance is 10^12 times the smallest
};

/// "uniform", "gaussian", "clusters", "grid", "line-circle", "spiral", "sphere" or "spread";
/// nothing for other names.
[[nodiscard]] std::optional<PointKind> point_kind(std::string_view name);

/// Generates `n` distinct points, n x D, that can be meshed. grid, line_circle, spiral and spread
/// ignore `seed`.
/// Cost: O(n).
template <int D>
[[nodiscard]] std::vector<Point<D>> generate_points(PointKind kind, std::size_t n,
                                                    std::uint64_t seed);

/// The n points of [Hudson, Fig 2.2], for which refinement at rho = sqrt 2 is slow if it takes the
/// shortest edge first: n - 3 on a line, each a little farther from the next than the one before;
/// one that sees them all; and two far away. Requires: n >= 5.
[[nodiscard]] std::vector<Point<2>> generate_quadratic(std::size_t n);

/// A family of points and lines. n: the number of segments requested.
enum class PslgKind : std::uint8_t {
  segments,   ///< n segments of length h/5 to h, h = 1 / sqrt(2 n), and as many points
  lengths,    ///< n segments of widely differing lengths: 0.3 h u^(-3/4), u uniform
  polylines,  ///< polylines of 3 to 12 pieces that turn by up to 75 degrees
  trees,      ///< n/2 segments, and as many again that start at ends of others, at any angle
  corridors,  ///< n lines from side to side, nearly parallel, some very close to the next
  zigzag,     ///< a polyline of n pieces, up and down
  fan,        ///< n segments of one length from one point, `angle` from one to the next
  bundle,     ///< n segments of lengths 0.3 to 0.8 from one point, within `angle`
};

/// The family with this name on the tool's command line; nothing for other names.
[[nodiscard]] std::optional<PslgKind> pslg_kind(std::string_view name);
/// All such names, in the order of PslgKind.
[[nodiscard]] const std::vector<std::string>& pslg_kind_names();

/// A family of points and lines, and its parameters.
struct PslgFamily {
  PslgKind kind = PslgKind::segments;
  std::size_t n = 0;
  std::uint64_t seed = 1;
  /// For fan and bundle, in degrees. Default: fan 360 / n, bundle 0.05.
  std::optional<double> angle{};
};

/// Generates points and lines in the square (0,1)^2. By exact tests no lines cross, overlap, or
/// touch except at shared ends, and no point is in the interior of a line. Where there is no room,
/// there are fewer than n. Ids are 1, 2, ... Requires: 0 < angle, and angle * n <= 360 for fan,
/// angle <= 360 for bundle.
/// Cost: O(n) for lines of similar length.
[[nodiscard]] Graph<2> generate_pslg(const PslgFamily& family);

/// A family of complexes. The last words of each comment: the meaning of `size`, and its default.
enum class PlcKind : std::uint8_t {
  cube,         ///< the unit cube's sides
  cube_square,  ///< a square in the middle of the cube; side of the square, 0.5
  skew,         ///< two skew segments in the cube; gap between them, 0.001
  dumbbell,     ///< two cubes with a tube between them; width of the tube, 0.2
  nested,       ///< a cube in the cube; gap between their sides, 0.1
  l_hole,       ///< an L with a square hole in the cube; side of the hole, 0.1
  plates,       ///< two parallel squares in the cube; gap between them, 0.02
  cloud,        ///< points in the cube; number of points, 1000
  wedge,        ///< two squares at an edge; angle in degrees, 20
  pages,        ///< six squares at an edge; angle from each to the next in degrees, 8
  spike,        ///< a slender pyramid; angle at the top in degrees, 20
  vee,          ///< two segments at a point; angle in degrees, 5
  leaning,      ///< a segment that leaves a square at a corner; angle in degrees, 5
  tetrahedron,  ///< a flat tetrahedron; height, 0.1
  pump,    ///< a round housing with a bore and a square stub; number of sides of the housing, 16
  faults,  ///< tilted squares in the cube that do not touch; number of squares, 20
  bricks,  ///< a wall of bricks with joints; width of the joints, 0.02
  tee,  ///< a wall that stands on a floor, on a line that the floor declares; height of the wall,
        ///< 0.5
  shells,  ///< nested icosahedra; number of icosahedra, 4
  island,  ///< a square with a hole and an island in it, in the cube; side of the island, 0.2
};

/// The family with this name on the tool's command line; nothing for other names.
[[nodiscard]] std::optional<PlcKind> plc_kind(std::string_view name);
/// All such names, in the order of PlcKind.
[[nodiscard]] const std::vector<std::string>& plc_kind_names();

/// A family of complexes, and its parameters.
struct PlcFamily {
  PlcKind kind = PlcKind::cube;
  std::optional<double> size{};  ///< see PlcKind
  std::uint64_t seed = 1;        ///< for cloud and faults
};

/// Generates a complex. With sensible sizes the parts fit together: nothing crosses, overlaps or
/// touches except at common corners and edges, and where polygons declare it. Ids are 1, 2, ...
/// Throws: Error(bad_option) for a size that the family cannot have.
[[nodiscard]] Graph<3> generate_plc(const PlcFamily& family);

}  // namespace mesher
