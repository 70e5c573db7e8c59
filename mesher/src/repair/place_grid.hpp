// Places in cells of one size, to find those near a place.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "mesher/mesh.hpp"
#include "sac/label.hpp"

namespace mesher::detail {

/// Numbers 0, 1, ... of places, found by place. Those in it are farther apart than `reach`, so a
/// cell holds few.
template <int D>
class PlaceGrid {
 public:
  PlaceGrid(const Point<D>& origin, double reach) : origin_(origin), reach_(reach) {}

  /// Adds the next place.
  void add(const Point<D>& p) {
    cells_.emplace(cell(p), static_cast<std::uint32_t>(places_.size()));
    places_.push_back(p);
  }
  /// The nearest within `reach` of p, the first of several; nothing if there is none.
  [[nodiscard]] std::optional<std::uint32_t> near(const Point<D>& p) const {
    std::optional<std::uint32_t> best;
    double best2 = reach_ * reach_;
    visit_around(p, [&](std::uint32_t i, double d2) {
      if (d2 > best2 || (d2 == best2 && best && *best < i)) return;
      best = i;
      best2 = d2;
    });
    return best;
  }
  /// All within `reach` of p, the nearest first, of equally near ones the first.
  [[nodiscard]] std::vector<std::uint32_t> all_near(const Point<D>& p) const {
    std::vector<std::pair<double, std::uint32_t>> found;
    visit_around(p, [&](std::uint32_t i, double d2) {
      if (d2 <= reach_ * reach_) found.emplace_back(d2, i);
    });
    std::sort(found.begin(), found.end());
    std::vector<std::uint32_t> all;
    for (const auto& [d2, i] : found) all.push_back(i);
    return all;
  }
  [[nodiscard]] const std::vector<Point<D>>& places() const noexcept { return places_; }
  [[nodiscard]] const Point<D>& origin() const noexcept { return origin_; }
  [[nodiscard]] double reach() const noexcept { return reach_; }

 private:
  using Cell = std::array<std::int64_t, D>;
  struct Hash {
    std::size_t operator()(const Cell& c) const noexcept {
      std::uint64_t h = 0;
      for (const std::int64_t x : c) h = sac::mix(h + static_cast<std::uint64_t>(x));
      return h;
    }
  };
  [[nodiscard]] Cell cell(const Point<D>& p) const {
    Cell c;
    for (int i = 0; i < D; ++i) {
      c[i] = static_cast<std::int64_t>(std::floor((p[i] - origin_[i]) / reach_));
    }
    return c;
  }
  // Calls visit(i, squared distance) for those in the cell of p and beside it.
  template <class Visit>
  void visit_around(const Point<D>& p, Visit&& visit) const {
    constexpr int kAround = D == 2 ? 9 : 27;
    const Cell middle = cell(p);
    for (int k = 0; k < kAround; ++k) {
      Cell c = middle;
      for (int i = 0, rest = k; i < D; ++i, rest /= 3) c[i] += rest % 3 - 1;
      const auto [first, last] = cells_.equal_range(c);
      for (auto it = first; it != last; ++it) {
        double d2 = 0;
        for (int i = 0; i < D; ++i) {
          const double x = places_[it->second][i] - p[i];
          d2 += x * x;
        }
        visit(it->second, d2);
      }
    }
  }

  Point<D> origin_;
  double reach_;
  std::vector<Point<D>> places_;
  std::unordered_multimap<Cell, std::uint32_t, Hash> cells_;
};

}  // namespace mesher::detail
