// The features of the input nearest to a position, to name in errors about positions where doubles
// are too coarse.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "geometry/box.hpp"
#include "geometry/segment_tests.hpp"
#include "index/features.hpp"
#include "plane/planarity.hpp"
#include "plane/segment_store.hpp"

namespace mesher::detail {

/// Features as a message names them.
struct NamedFeatures {
  std::string text;  ///< "point 3, segment 7"; "features" if they have no names
  std::vector<mesher::Feature> features;  ///< in this order
};

/// The three nearest features to a place, of those that it is shown; of equally near ones the first
/// by coordinates, points before segments.
class NearFeatures {
 public:
  explicit NearFeatures(const Point<2>& place) : place_(place) {}

  void show(const Vertex<2>& v) noexcept { show(v.p, v.p, {}, v.self); }
  void show(const Segment& s) noexcept { show(s.place_a, s.place_b, s.self, {}); }
  [[nodiscard]] std::size_t count_within(double radius) const noexcept;
  [[nodiscard]] NamedFeatures named(const Names& names) const;

 private:
  struct Feature {
    double distance2 = 0;
    SegmentHandle segment = 0;  // 0: a point
    Point<2> a{}, b{};
    VertexHandle point = 0;
  };
  void show(const Point<2>& a, const Point<2>& b, SegmentHandle s, VertexHandle v) noexcept;
  [[nodiscard]] std::span<const Feature> all() const noexcept { return {nearest_.data(), count_}; }

  Point<2> place_;
  std::array<Feature, 4> nearest_;  // one more than are kept
  std::size_t count_ = 0;
};

/// The features nearest to p. `radius` > 0: where to begin to look; `most`: where all are found.
/// `names`: null if features have none.
template <class S>
[[nodiscard]] NamedFeatures named_near(const Point<2>& p, double radius, double most,
                                       SegmentStore& segments, const Features<S>& points,
                                       const Names* names) {
  NearFeatures near(p);
  if (names == nullptr) return {"features", {}};
  for (; near.count_within(radius / 2) < 2 && radius <= most; radius *= 2) {
    near = NearFeatures(p);
    points.visit_points_in(around(p, radius), [&](const Vertex<2>& v) {
      near.show(v);
      return false;
    });
    segments.visit_near(p, p, radius, [&](const Segment& s) {
      near.show(s);
      return false;
    });
  }
  return near.named(*names);
}

}  // namespace mesher::detail
