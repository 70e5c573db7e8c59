// Points in the plane and the straight rods between them, while they are made planar.
//
// A rod is there once, whoever draws along it. Split, it stays as a list of shorter ones, so that
// whoever drew along it can be told where its line leads now.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "geometry/grid.hpp"
#include "geometry/segment_tests.hpp"
#include "repair/drawn_points.hpp"

namespace mesher::detail {

struct Rod {
  Spot a = 0, b = 0;          // places[a] < places[b]
  std::vector<Spot> through;  // if it is split: the points from a to b, those included

  [[nodiscard]] bool whole() const noexcept { return through.empty(); }
  [[nodiscard]] bool has(Spot s) const noexcept { return s == a || s == b; }
  [[nodiscard]] bool touches(const Rod& r) const noexcept { return has(r.a) || has(r.b); }
};

template <>
class Drawing<2> : public DrawnPoints<2> {
 public:
  Drawing(const MeshBox<2>& box, double tolerance) : DrawnPoints(box.lo, tolerance) {}

  [[nodiscard]] const std::vector<Rod>& rods() const noexcept { return rods_; }

  Spot add_spot(const Point<2>& p) { return add_place(p); }
  /// The rod between two points. Requires: s != t.
  std::uint32_t rod(Spot s, Spot t);
  /// Leads a rod through more points, which it may be led through; the shorter rods are there then.
  void split(std::uint32_t rod, std::vector<Spot> through);

  /// The points from one end of a rod to the other, those included, as its pieces lead now.
  [[nodiscard]] std::vector<Spot> way(Spot from, Spot to) const;

  /// Whether a rod may be led through a point.
  [[nodiscard]] bool may_lead(const Rod& r, Spot s) const {
    return DrawnPoints::may_lead(r.a, r.b, s);
  }
  /// Whether a rod must be led through a point, which is as close to it as the tolerance.
  [[nodiscard]] bool must_lead(const Rod& r, Spot s) const {
    return may_lead(r, s) &&
           distance2(place(s), place(r.a), place(r.b)) <= tolerance() * tolerance();
  }
  /// Whether two rods without a common end meet.
  [[nodiscard]] bool cross(const Rod& r, const Rod& t) const {
    return !r.touches(t) && segments_meet(place(r.a), place(r.b), place(t.a), place(t.b));
  }

 private:
  std::vector<Rod> rods_;
  std::unordered_map<std::uint64_t, std::uint32_t> by_ends_;
};

}  // namespace mesher::detail
