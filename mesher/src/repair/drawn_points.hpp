// The points of a drawing, in the plane or in space, and how a line between two of them is led
// through others.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "geometry/plane_vectors.hpp"
#include "geometry/space_vectors.hpp"
#include "repair/place_grid.hpp"
#include "sets/make_set.hpp"

namespace mesher::detail {

using Spot = std::uint32_t;  // the number of a point in a drawing
using Ends = std::pair<Spot, Spot>;
[[nodiscard]] inline Ends in_order(Spot a, Spot b) { return {std::min(a, b), std::max(a, b)}; }

/// Equal for both orders of the ends.
[[nodiscard]] inline std::uint64_t ends_key(Spot a, Spot b) noexcept {
  return static_cast<std::uint64_t>(std::min(a, b)) << 32 | std::max(a, b);
}

/// What is between the points: rods in the plane (drawing.hpp), edges and sheets in space
/// (space_drawing.hpp).
template <int D>
class Drawing;

template <int D>
class DrawnPoints {
 public:
  /// Spots are numbered from here: in space they are the handles of vertices.
  static constexpr Spot kFirst = D == 2 ? 0 : 1;

  /// What is as close is made to touch.
  [[nodiscard]] double tolerance() const noexcept { return tolerance_; }
  [[nodiscard]] const std::vector<Point<D>>& places() const noexcept { return grid_.places(); }
  [[nodiscard]] const Point<D>& place(Spot s) const noexcept { return places()[s - kFirst]; }

  /// The point that is within twice the tolerance of p, the nearest; nothing if there is none.
  [[nodiscard]] std::optional<Spot> spot_near(const Point<D>& p) const {
    const auto near = grid_.near(p);
    return near ? std::optional(*near + kFirst) : std::nullopt;
  }
  /// All of these, the nearest first.
  [[nodiscard]] std::vector<Spot> spots_near(const Point<D>& p) const {
    std::vector<Spot> near = grid_.all_near(p);
    for (Spot& s : near) s += kFirst;
    return near;
  }

  /// Whether a line from a to b may be led through a point: both parts will be shorter than it.
  [[nodiscard]] bool may_lead(Spot a, Spot b, Spot s) const {
    const double whole = length2(a, b);
    return s != a && s != b && length2(a, s) < whole && length2(s, b) < whole;
  }

 protected:
  /// Points lie around `origin`.
  DrawnPoints(const Point<D>& origin, double tolerance)
      : tolerance_(tolerance), grid_(origin, 2 * tolerance) {}
  DrawnPoints(const DrawnPoints&) = default;
  DrawnPoints& operator=(const DrawnPoints&) = default;
  ~DrawnPoints() = default;

  /// Requires: it is less than before.
  void set_tolerance(double tolerance) {
    PlaceGrid<D> finer(grid_.origin(), 2 * tolerance);
    for (const Point<D>& p : places()) finer.add(p);
    grid_ = std::move(finer);
    tolerance_ = tolerance;
  }
  /// The next point.
  Spot add_place(const Point<D>& p) {
    grid_.add(p);
    return static_cast<Spot>(places().size() - 1) + kFirst;
  }
  /// From a to b through others, which the line may be led through, in their order along it; what
  /// would make a part as long as the whole is left out: the next round has it.
  [[nodiscard]] std::vector<Spot> chain(Spot a, Spot b, std::vector<Spot> through) const {
    const Point<D> along = minus(place(b), place(a));
    const auto at = [&](Spot s) {
      return std::pair(dot(minus(place(s), place(a)), along), place(s));
    };
    make_set(through);
    std::sort(through.begin(), through.end(), [&](Spot s, Spot t) { return at(s) < at(t); });
    std::vector<Spot> chain{a};
    for (const Spot s : through) {
      if (length2(chain.back(), s) < length2(a, b)) chain.push_back(s);
    }
    chain.push_back(b);
    return chain;
  }

 private:
  [[nodiscard]] double length2(Spot s, Spot t) const {
    return squared_distance(place(s), place(t));
  }

  double tolerance_;
  PlaceGrid<D> grid_;
};

}  // namespace mesher::detail
