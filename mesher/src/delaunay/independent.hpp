// Points that are not all in one hyperplane.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesher/predicates.hpp"

namespace mesher::detail {

[[nodiscard]] inline bool are_on_line(const Point<2>& a, const Point<2>& b, const Point<2>& c) {
  return predicates::orient2d(a, b, c) == 0;
}
/// Just if they are on one line seen along each axis.
[[nodiscard]] inline bool are_on_line(const Point<3>& a, const Point<3>& b, const Point<3>& c) {
  for (std::size_t i = 0; i < 3; ++i) {
    const auto seen = [i](const Point<3>& p) { return Point<2>{p[i], p[(i + 1) % 3]}; };
    if (!are_on_line(seen(a), seen(b), seen(c))) return false;
  }
  return true;
}

/// Up to D + 1 of the points given one after the other: those that are in no point, line or plane
/// of the ones kept before.
template <int D>
class Independent {
 public:
  /// Whether p is kept.
  bool offer(std::uint32_t name, const Point<D>& p) {
    if (full() || depends(p)) return false;
    names_[count_] = name;
    places_[count_++] = p;
    return true;
  }
  [[nodiscard]] bool full() const noexcept { return count_ == D + 1; }
  [[nodiscard]] bool keeps(std::uint32_t name) const noexcept {
    const auto end = names_.begin() + static_cast<std::ptrdiff_t>(count_);
    return std::find(names_.begin(), end, name) != end;
  }
  /// Requires: full().
  [[nodiscard]] const std::array<std::uint32_t, D + 1>& names() const noexcept { return names_; }

 private:
  [[nodiscard]] bool depends(const Point<D>& p) const {
    if (count_ == 0) return false;
    if (count_ == 1) return p == places_[0];
    if (count_ == 2) return are_on_line(places_[0], places_[1], p);
    if constexpr (D == 3) {
      return predicates::orient3d(places_[0], places_[1], places_[2], p) == 0;
    }
    return true;
  }

  std::array<std::uint32_t, D + 1> names_{};
  std::array<Point<D>, D + 1> places_{};
  std::size_t count_ = 0;
};

}  // namespace mesher::detail
