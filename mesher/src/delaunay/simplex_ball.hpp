// The circumball of a simplex, stored with it for in-ball tests.
//
// The centre is rounded, and its error unknown but bounded; so two squared lengths are kept, the
// ball's radius less all errors and more them. A point nearer than the one is in the ball, farther
// than the other it is not, and between them exact arithmetic decides. On random points that is one
// test in 10000; on grids each tie.
//
// Both are floats, rounded outward. Squares beyond their range (lengths under 2^-63 or over 2^63)
// leave nothing sure, which costs time alone.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "delaunay/ball_filter.hpp"
#include "mesher/mesh.hpp"

namespace mesher::detail {

template <int D>
struct SimplexBall {
  Point<D> centre{};
  float inner2 = 0, outer2 = 0;

  /// Not sure if the centre is not a number.
  [[nodiscard]] BallSide side(const Point<D>& p) const noexcept {
    double distance2 = 0;
    for (std::size_t i = 0; i < D; ++i) {
      distance2 += (p[i] - centre[i]) * (p[i] - centre[i]);
    }
    if (distance2 < static_cast<double>(inner2)) return BallSide::inside;
    return distance2 > static_cast<double>(outer2) ? BallSide::outside : BallSide::unsure;
  }
};

/// Of a simplex: its circumradius and shortest edge, squared.
struct Shape {
  double radius2 = 0, shortest2 = 0;
};

/// The balls of simplices that share a vertex, computed together: the lanes of a block go through
/// one loop, which the compiler takes several at a time.
template <int D>
class BallBatch {
 public:
  /// The next start(p, n) will find room.
  void make_room(std::size_t n) {
    if (blocks_.size() * kLanes < n) blocks_.resize(2 * n / kLanes + 1);
  }
  /// For n simplices around a vertex at p. Requires: make_room(n) was called.
  void start(const Point<D>& p, std::size_t n) noexcept {
    p_ = p;
    used_ = (n + kLanes - 1) / kLanes;
  }
  /// The i-th other corner of the k-th, relative to p, in such an order that their determinant is
  /// positive.
  void set_corner(std::size_t k, std::size_t i, const Point<D>& corner) noexcept {
    Block& b = blocks_[k / kLanes];
    for (std::size_t axis = 0; axis < D; ++axis) b.corner[i][axis][k % kLanes] = corner[axis];
  }
  /// Computes them all.
  void run() noexcept {
    for (std::size_t i = 0; i < used_; ++i) run(blocks_[i]);
  }
  /// Whether the k-th is too flat for doubles, or is not a number: what was computed is worthless.
  [[nodiscard]] bool is_flat(std::size_t k) const noexcept {
    return !(blocks_[k / kLanes].flatness[k % kLanes] <= kMostFlatness);
  }
  /// Of such a one: its centre relative to p, as circumcentre() has it.
  void set_centre(std::size_t k, const Point<D>& q) noexcept;

  [[nodiscard]] SimplexBall<D> ball(std::size_t k) const noexcept {
    const Block& b = blocks_[k / kLanes];
    SimplexBall<D> ball;
    for (std::size_t i = 0; i < D; ++i) ball.centre[i] = b.centre[i][k % kLanes];
    ball.inner2 = static_cast<float>(b.inner2[k % kLanes]);
    ball.outer2 = static_cast<float>(b.outer2[k % kLanes]);
    return ball;
  }
  [[nodiscard]] Shape shape(std::size_t k) const noexcept {
    const Block& b = blocks_[k / kLanes];
    return {b.radius2[k % kLanes], b.shortest2[k % kLanes]};
  }

 private:
  static constexpr double kMostFlatness = 1e7;
  static constexpr std::size_t kLanes = 4;
  using Lanes = std::array<double, kLanes>;
  struct Block {
    std::array<std::array<Lanes, D>, D> corner;
    std::array<Lanes, D> centre;
    Lanes radius2, shortest2, inner2, outer2;
    Lanes flatness;  // the product of the corners' lengths over their determinant
  };

  void run(Block& block) const noexcept;
  [[nodiscard]] double rounding() const noexcept;

  Point<D> p_{};
  std::size_t used_ = 0;
  std::vector<Block> blocks_;
};

}  // namespace mesher::detail
