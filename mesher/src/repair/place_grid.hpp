// Places in cells of one size, to find those near a place.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "mesher/mesh.hpp"
#include "sac/label.hpp"

namespace mesher::detail {

/// Numbers 0, 1, ... of places, found by place. Those in it are farther apart than `reach`, so a
/// cell holds few.
class PlaceGrid {
 public:
  PlaceGrid(const Point<2>& origin, double reach) : origin_(origin), reach_(reach) {}

  /// Adds the next place.
  void add(const Point<2>& p) {
    cells_.emplace(cell(p), static_cast<std::uint32_t>(places_.size()));
    places_.push_back(p);
  }
  /// The nearest within `reach` of p, the first of several; nothing if there is none.
  [[nodiscard]] std::optional<std::uint32_t> near(const Point<2>& p) const {
    std::optional<std::uint32_t> best;
    double best2 = reach_ * reach_;
    const Cell c = cell(p);
    for (const std::int64_t dx : {-1, 0, 1}) {
      for (const std::int64_t dy : {-1, 0, 1}) {
        const auto [first, last] = cells_.equal_range({c.x + dx, c.y + dy});
        for (auto it = first; it != last; ++it) {
          const Point<2>& q = places_[it->second];
          const double x = q[0] - p[0], y = q[1] - p[1];
          const double d2 = x * x + y * y;
          if (d2 > best2 || (d2 == best2 && best && *best < it->second)) continue;
          best = it->second;
          best2 = d2;
        }
      }
    }
    return best;
  }
  [[nodiscard]] const std::vector<Point<2>>& places() const noexcept { return places_; }
  [[nodiscard]] double reach() const noexcept { return reach_; }

 private:
  struct Cell {
    std::int64_t x, y;
    friend bool operator==(const Cell&, const Cell&) = default;
  };
  struct Hash {
    std::size_t operator()(const Cell& c) const noexcept {
      return sac::mix(sac::mix(static_cast<std::uint64_t>(c.x)) + static_cast<std::uint64_t>(c.y));
    }
  };
  [[nodiscard]] Cell cell(const Point<2>& p) const {
    return {static_cast<std::int64_t>(std::floor((p[0] - origin_[0]) / reach_)),
            static_cast<std::int64_t>(std::floor((p[1] - origin_[1]) / reach_))};
  }

  Point<2> origin_;
  double reach_;
  std::vector<Point<2>> places_;
  std::unordered_multimap<Cell, std::uint32_t, Hash> cells_;
};

}  // namespace mesher::detail
