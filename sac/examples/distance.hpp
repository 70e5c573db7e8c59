// The distance of the convex hulls of two sets of points.
//
// Two nearest points of the hulls lie on parallel lines that touch the hulls from the sides that
// face each other, one of them in a corner. A full turn of the calipers around both hulls visits
// such pairs of corners: two half turns, from left to right and back.
//
// Requires: a line separates the two sets; points of both have different ids.
// Cost: that of quickhull.hpp, and O(log corners) for an added or removed corner.
// Source: Toussaint 1983; a benchmark of Acar and others (PLDI 2006).
#pragma once

#include <limits>

#include "calipers.hpp"

namespace examples {

struct LeastDistance {
  using Value = double;
  static Value of(const Point& p, const Point& p2, const Point& q, const Point& q2) {
    return std::min(squared_distance(p, q, q2), squared_distance(q, p, p2));
  }
  static Value join(Value a, Value b) { return std::min(a, b); }
};

/// The less of what two half turns have found.
struct Lesser {
  static constexpr std::string_view kName = "lesser";
  template <class S, class M>
  void operator()(S& s, M a, M b, M result) const {
    const auto first = s.read(a);
    s.write(result, std::min(first, s.read(b)));
  }
};
inline constexpr Lesser lesser{};

struct DistanceOfHulls {
  static constexpr std::string_view kName = "distance_of_hulls";
  template <class S>
  void operator()(S& s, HullMod<S> a, HullMod<S> b,
                  typename S::template ModType<double> result) const {
    const auto [a_left, a_right] = s.read(a);
    const auto [b_left, b_right] = s.read(b);
    if (a_left == nullptr || b_left == nullptr) {
      return s.write(result, std::numeric_limits<double>::infinity());
    }
    if (a_left == a_right && b_left == b_right) {  // no edges, so no turns
      return s.write(result, LeastDistance::of(a_left->element, a_left->element, b_left->element,
                                               b_left->element));
    }
    const auto there = s.template cell<double>(0), back = s.template cell<double>(1);
    s.template call<fold_pairs<LeastDistance>>(a_left, b_right, a_right, b_left, there);
    s.template call<fold_pairs<LeastDistance>>(a_right, b_left, a_left, b_right, back);
    s.template tail<lesser>(there, back, result);
  }
};
inline constexpr DistanceOfHulls distance_of_hulls{};

/// Writes the square of the distance of the hulls of `a` and `b` to `result`; infinity if one is
/// empty.
struct Distance {
  static constexpr std::string_view kName = "distance";
  template <class S>
  void operator()(S& s, const PointNode<S>* a, const PointNode<S>* b,
                  typename S::template ModType<double> result) const {
    const HullMod<S> hull_a = s.template cell<Hull<S>>(a), hull_b = s.template cell<Hull<S>>(b);
    s.template call<quickhull>(a, hull_a);
    s.template call<quickhull>(b, hull_b);
    s.template tail<distance_of_hulls>(hull_a, hull_b, result);
  }
};
inline constexpr Distance distance{};

}  // namespace examples
