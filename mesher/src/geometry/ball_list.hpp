// Balls in space that are asked many times whether another ball meets one of them.
#pragma once

#include <cstddef>
#include <vector>

#include "mesher/mesh.hpp"

namespace mesher::detail {

class BallList {
 public:
  /// Empty, with room for so many. Throws: std::bad_alloc.
  explicit BallList(std::size_t most);

  /// Requires: there is room. radius >= 0.
  void add(const Point<3>& centre, double radius) noexcept;
  /// Whether the ball meets one of them, as doubles have it. Cost: O(balls), several in one step.
  [[nodiscard]] bool meets(const Point<3>& centre, double radius) const noexcept;

 private:
  std::size_t room_, count_ = 0;
  std::vector<double> columns_;  // of coordinates, then radii; behind the last: what meets nothing
};

}  // namespace mesher::detail
