// The distances of the corners of a clipped Voronoi cell from its vertex v, and which corners are
// open: the common part of the cells of the plane and of space.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace mesher::detail {

/// `Number`: holds the number of a corner.
template <class Number>
class CornerReach {
 public:
  /// Whether w might cut an open corner, by distance: |w - v|^2 <= 4 |q|^2.
  [[nodiscard]] bool in_reach(double distance2) const noexcept { return distance2 <= 4 * open2_; }
  /// max |q|^2.
  [[nodiscard]] double reach2() const noexcept { return reach2_; }
  /// The same over the open corners; 0: there is none.
  [[nodiscard]] double open2() const noexcept { return open2_; }
  /// Of the gap ball around a corner. Where the corner is known badly, as between neighbours in
  /// nearly one direction, the ball is larger by more than the corner's error.
  [[nodiscard]] double gap_radius(std::size_t i) const noexcept {
    return std::sqrt(q2_[i]) * (1 + 0x1p-30) + std::sqrt(tolerance2_[i]);
  }

 protected:
  /// The corners are 0 .. count - 1, of which q2_, tolerance2_ and is_open_ are right.
  /// Requires: open_.size() >= count.
  void update_reach(std::size_t count) noexcept;

  double reach2_ = 0;
  double open2_ = 0;
  double error_ = 0;                     // of w.q, for any corner and any w in reach
  std::vector<double> q2_, tolerance2_;  // |q|^2, and its error's bound as in circumcentre()
  std::vector<std::uint8_t> is_open_;
  std::vector<Number> open_;  // the open corners
  int open_count_ = 0;
};

template <class Number>
void CornerReach<Number>::update_reach(std::size_t count) noexcept {
  reach2_ = 0;
  open2_ = 0;
  open_count_ = 0;
  double tolerance2 = 0;
  for (std::size_t i = 0; i < count; ++i) {
    reach2_ = std::max(reach2_, q2_[i]);
    tolerance2 = std::max(tolerance2, tolerance2_[i]);
    if (is_open_[i] == 0) continue;
    open2_ = std::max(open2_, q2_[i]);
    open_[static_cast<std::size_t>(open_count_++)] = static_cast<Number>(i);
  }
  reach2_ *= 1 + 0x1p-30;  // so that rounding never leaves out a vertex that cuts
  open2_ *= 1 + 0x1p-30;
  error_ = std::sqrt(tolerance2 * reach2_) * 1.01;  // half of 2 w.q's error, for any w in reach
}

}  // namespace mesher::detail
