// The layout of the simplices of a triangulation in memory.
//
// ArrayLayout: one array of corners and one of neighbours, which become the result. BallLayout: all
// data of a simplex that an insertion needs in one record, with its ball: an in-ball test is one
// distance, except for points within rounding of the sphere. In space a record is one cache line of
// 64 bytes [rules D1].
//   (The other design was a second store for the refiner. An insertion is the same in both but for
// this test and for what is kept of a new simplex, so the kernel takes the layout as a parameter.
// For a triangulation alone the arrays are better: an insertion makes 20 simplices and tests 40, a
// ball costs as much as two tests, and memory doubles. A refiner needs the circumcentre of each new
// simplex anyway.)
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "delaunay/simplex_ball.hpp"
#include "sac/huge_pages.hpp"

namespace mesher::detail {

template <int D>
class ArrayLayout {
 public:
  using Ids = std::array<std::uint32_t, D + 1>;
  static constexpr bool kHasBalls = false;

  [[nodiscard]] std::size_t size() const noexcept { return corners_.size(); }
  [[nodiscard]] std::size_t bytes() const noexcept {
    return (corners_.capacity() + across_.capacity()) * sizeof(Ids);
  }
  [[nodiscard]] const Ids& corners(std::uint32_t s) const noexcept { return corners_[s]; }
  [[nodiscard]] const Ids& across(std::uint32_t s) const noexcept { return across_[s]; }
  [[nodiscard]] Ids& corners(std::uint32_t s) noexcept { return corners_[s]; }
  [[nodiscard]] Ids& across(std::uint32_t s) noexcept { return across_[s]; }

  void reserve(std::size_t n) {
    corners_.reserve(n);
    across_.reserve(n);
  }
  /// Strong guarantee.
  void resize(std::size_t n) {
    const std::size_t size = corners_.size();
    across_.resize(n);
    try {
      corners_.resize(n);
    } catch (...) {
      across_.resize(size);
      throw;
    }
  }
  void clear() noexcept {
    corners_.clear();
    across_.clear();
  }
  /// Takes the arrays out; nothing is left.
  [[nodiscard]] std::vector<Ids> release_corners() noexcept { return std::move(corners_); }
  [[nodiscard]] std::vector<Ids> release_across() noexcept { return std::move(across_); }

 private:
  std::vector<Ids> corners_, across_;
};

template <int D>
class BallLayout {
 public:
  using Ids = std::array<std::uint32_t, D + 1>;
  static constexpr bool kHasBalls = true;

  [[nodiscard]] std::size_t size() const noexcept { return lines_.size(); }
  [[nodiscard]] std::size_t bytes() const noexcept { return lines_.capacity() * sizeof(Line); }
  [[nodiscard]] const Ids& corners(std::uint32_t s) const noexcept { return lines_[s].corners; }
  [[nodiscard]] const Ids& across(std::uint32_t s) const noexcept { return lines_[s].across; }
  [[nodiscard]] Ids& corners(std::uint32_t s) noexcept { return lines_[s].corners; }
  [[nodiscard]] Ids& across(std::uint32_t s) noexcept { return lines_[s].across; }
  [[nodiscard]] const SimplexBall<D>& ball(std::uint32_t s) const noexcept {
    return lines_[s].ball;
  }
  [[nodiscard]] SimplexBall<D>& ball(std::uint32_t s) noexcept { return lines_[s].ball; }

  void reserve(std::size_t n) { lines_.reserve(n); }
  /// Strong guarantee.
  void resize(std::size_t n) { lines_.resize(n); }
  void clear() noexcept { lines_.clear(); }

 private:
  struct alignas(D == 3 ? 64 : 16) Line {
    Ids corners, across;
    SimplexBall<D> ball;
  };
  static_assert(sizeof(Line) == (D == 3 ? 64 : 48));

  std::vector<Line, sac::HugePages<Line>> lines_;
};

}  // namespace mesher::detail
