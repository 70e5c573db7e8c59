// Points and the straight rods between them, while they are made planar.
//
// A rod is there once, whoever draws along it. Split, it stays as a list of shorter ones, so that
// whoever drew along it can be told where its line leads now.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "geometry/segment_tests.hpp"
#include "repair/place_grid.hpp"

namespace mesher::detail {

using Spot = std::uint32_t;  // the number of a point in the drawing

struct Rod {
  Spot a = 0, b = 0;          // places[a] < places[b]
  std::vector<Spot> through;  // if it is split: the points from a to b, those included

  [[nodiscard]] bool whole() const noexcept { return through.empty(); }
  [[nodiscard]] bool has(Spot s) const noexcept { return s == a || s == b; }
  [[nodiscard]] bool touches(const Rod& r) const noexcept { return has(r.a) || has(r.b); }
};

class Drawing {
 public:
  /// `tolerance`: what is as close is made to touch.
  Drawing(const Point<2>& origin, double tolerance)
      : tolerance_(tolerance), spots_(origin, 2 * tolerance) {}

  [[nodiscard]] double tolerance() const noexcept { return tolerance_; }
  [[nodiscard]] const std::vector<Point<2>>& places() const noexcept { return spots_.places(); }
  [[nodiscard]] const Point<2>& place(Spot s) const noexcept { return places()[s]; }
  [[nodiscard]] const std::vector<Rod>& rods() const noexcept { return rods_; }

  /// The point that is within twice the tolerance of p, the nearest; nothing if there is none.
  [[nodiscard]] std::optional<Spot> spot_near(const Point<2>& p) const { return spots_.near(p); }
  Spot add_spot(const Point<2>& p) {
    spots_.add(p);
    return static_cast<Spot>(places().size() - 1);
  }
  /// The rod between two points. Requires: s != t.
  std::uint32_t rod(Spot s, Spot t);
  /// Leads a rod through more points, which it may be led through; the shorter rods are there then.
  void split(std::uint32_t rod, std::vector<Spot> through);

  /// Calls visit(s) for each point from `from` to the other end of a rod, but for `from`, as its
  /// pieces lead now.
  template <class Visit>
  void walk(std::uint32_t rod, Spot from, Visit&& visit) const;

  /// Whether a rod may be led through a point: both parts will be shorter than it.
  [[nodiscard]] bool may_lead(const Rod& r, Spot s) const {
    const double whole = length2(r.a, r.b);
    return !r.has(s) && length2(r.a, s) < whole && length2(s, r.b) < whole;
  }
  /// Whether a rod must be led through a point, which is as close to it as the tolerance.
  [[nodiscard]] bool must_lead(const Rod& r, Spot s) const {
    return may_lead(r, s) && distance2(place(s), place(r.a), place(r.b)) <= tolerance_ * tolerance_;
  }
  /// Whether two rods without a common end meet.
  [[nodiscard]] bool cross(const Rod& r, const Rod& t) const {
    return !r.touches(t) && segments_meet(place(r.a), place(r.b), place(t.a), place(t.b));
  }
  [[nodiscard]] std::uint32_t find(Spot s, Spot t) const { return by_ends_.at(key(s, t)); }

 private:
  [[nodiscard]] double length2(Spot s, Spot t) const {
    const Point<2>&p = place(std::min(s, t)), &q = place(std::max(s, t));
    return distance2(p, q, q);
  }
  static std::uint64_t key(Spot s, Spot t) noexcept {
    return static_cast<std::uint64_t>(std::min(s, t)) << 32 | std::max(s, t);
  }

  double tolerance_;
  PlaceGrid<2> spots_;
  std::vector<Rod> rods_;
  std::unordered_map<std::uint64_t, std::uint32_t> by_ends_;
};

// Rods get shorter as they are split, so this ends. Without recursion: that may be deep.
template <class Visit>
void Drawing::walk(std::uint32_t rod, Spot from, Visit&& visit) const {
  std::vector<std::pair<Spot, Spot>> ahead{
      {from, rods_[rod].a == from ? rods_[rod].b : rods_[rod].a}};
  while (!ahead.empty()) {
    const auto [s, t] = ahead.back();
    ahead.pop_back();
    const Rod& r = rods_[find(s, t)];
    if (r.whole()) {
      visit(t);
      continue;
    }
    const std::size_t n = r.through.size();
    for (std::size_t i = 0; i + 1 < n; ++i) {  // the first piece on top
      if (r.a == s) {
        ahead.emplace_back(r.through[n - 2 - i], r.through[n - 1 - i]);
      } else {
        ahead.emplace_back(r.through[i + 1], r.through[i]);
      }
    }
  }
}

}  // namespace mesher::detail
