// The diameter of points: the greatest distance of any two of them.
//
// Two points farthest apart are corners of the hull that parallel lines touch; the pairs of such
// corners are those of half a turn of the calipers around the hull, from its leftmost corner.
//
// Cost: that of quickhull.hpp, and O(log corners) for an added or removed corner.
// Source: Shamos 1978; a benchmark of Acar and others (PLDI 2006).
#pragma once

#include "calipers.hpp"

namespace examples {

struct GreatestDistance {
  using Value = std::int64_t;
  static Value of(const Point& p, const Point&, const Point& q, const Point&) {
    return squared_distance(p, q);
  }
  static Value join(Value a, Value b) { return std::max(a, b); }
};

struct DiameterOfHull {
  static constexpr std::string_view kName = "diameter_of_hull";
  template <class S>
  void operator()(S& s, HullMod<S> hull, typename S::template ModType<std::int64_t> result) const {
    const auto [left, right] = s.read(hull);
    if (left == nullptr) return s.write(result, 0);
    s.template tail<fold_pairs<GreatestDistance>>(left, right, right, left, result);
  }
};
inline constexpr DiameterOfHull diameter_of_hull{};

/// Writes the square of the diameter of the points of `list` to `result`; of no points 0.
struct Diameter {
  static constexpr std::string_view kName = "diameter";
  template <class S>
  void operator()(S& s, const PointNode<S>* list,
                  typename S::template ModType<std::int64_t> result) const {
    const HullMod<S> hull = s.template cell<Hull<S>>(list);
    s.template call<quickhull>(list, hull);
    s.template tail<diameter_of_hull>(hull, result);
  }
};
inline constexpr Diameter diameter{};

}  // namespace examples
