// Piecewise linear complexes in space, for tests: those of the model that the rules were measured
// on [rules C].
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "mesher/mesh.hpp"

namespace support {

/// Points, segments between them, and polygons with holes; all by indices of points.
struct Complex {
  using Loop = std::vector<std::size_t>;
  struct Face {
    std::vector<Loop> loops;  // the outer one, then holes
    std::vector<std::size_t> on;  // loose points that lie on it
  };
  std::vector<mesher::Point<3>> points;
  std::vector<std::array<std::size_t, 2>> segments;
  std::vector<Face> faces;

  /// The index of the point, which is added if it is not there.
  std::size_t point(const mesher::Point<3>& p);
  void segment(const mesher::Point<3>& a, const mesher::Point<3>& b);
  using Places = std::vector<mesher::Point<3>>;
  void face(const Places& outer, const std::vector<Places>& holes = {});
  /// The sides of a box; `skip`: without the side of low x (1), of high x (2). Holes in these.
  void box(const mesher::Box<3>& box, int skip = 0, const std::vector<Places>& holes_low = {},
           const std::vector<Places>& holes_high = {});
};

/// cube, cubepoly, skew (gap), dumbbell, nested (gap), lhole, plates (gap), cloudbox (points),
/// wedge, fan, spike, vee, segfac (degrees), tet (height).
[[nodiscard]] Complex complex_of(const std::string& family, double parameter);

/// Turned so that no plane of the complex is axis-parallel.
[[nodiscard]] Complex turned(Complex complex);

}  // namespace support
