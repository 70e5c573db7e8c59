// Obstacles to candidates: features of the input, and in the plane the vertices at which segments
// are split.
#pragma once

#include <cstdint>

#include "geometry/box.hpp"
#include "geometry/plane_vectors.hpp"
#include "index/features.hpp"
#include "space/feature_search.hpp"

namespace mesher::detail {

/// How near the nearest feature is.
enum class Room : std::uint8_t {
  none,  ///< nearer than Obstacles::kClear
  some,
  ample,  ///< not nearer than Obstacles::kUndisturbed
};

template <class S, int D>
class Obstacles;

/// A place nearer to a feature than this, in pitches, is not filled.
inline constexpr double kClear = 0.5;

template <class S>
class Obstacles<S, 2> {
 public:
  /// If no feature is nearer than this, in pitches, a vertex amid the lattice needs nothing: no
  /// leaf's ball has one of the six around it (such a leaf is at most 1.4 spacings long, hence 1.67
  /// pitches, and its ends are features), and no feature is in the circumcircles of its six
  /// triangles.
  static constexpr double kUndisturbed = 3.2;
  /// No room is a matter of features farther than this, in pitches.
  static constexpr double kReach = kUndisturbed;

  /// `whole`: in a tile, the features of the whole input; null: `features` has them.
  explicit Obstacles(const Features<S, 2>& features, const FeatureTree<2>* whole = nullptr)
      : features_(features), whole_(whole) {}

  [[nodiscard]] bool any_in(const Box<2>& box) const {
    return visit_in(box, [](const Vertex<2>&) { return true; });
  }
  [[nodiscard]] Room room(const Point<2>& p, double pitch) const {
    if (!has_within(p, kUndisturbed * pitch)) return Room::ample;
    return has_within(p, kClear * pitch) ? Room::none : Room::some;
  }

 private:
  template <class Visit>
  bool visit_in(const Box<2>& box, Visit&& visit) const {
    return whole_ != nullptr ? whole_->visit_in(box, visit)
                             : features_.visit_features_in(box, visit);
  }
  [[nodiscard]] bool has_within(const Point<2>& p, double distance) const {
    return visit_in(around(p, distance), [&](const Vertex<2>& v) {
      return squared_distance(v.p, p) < distance * distance;
    });
  }
  const Features<S, 2>& features_;
  const FeatureTree<2>* whole_;
};

/// In space edges and polygons are obstacles as they are, with all of their vertices.
template <class S>
class Obstacles<S, 3> {
 public:
  /// A place nearer than this to an edge or a polygon, in pitches, is not filled. Their vertices
  /// lie so close (kLongestEdge, kWidestPiece) that a place farther from them than this has no
  /// feature in its cell.
  static constexpr double kClearOfFeatures = 0.6;
  /// If no feature is nearer than this, in pitches, a vertex amid the lattice needs nothing: those
  /// around it are at most a pitch away, and not too near to a feature; and no vertex on a feature
  /// is in the circumspheres of its tetrahedra, twice 0.56 pitches away at most.
  static constexpr double kUndisturbed = 1.625;
  static constexpr double kReach = kUndisturbed * (1 + 0x1p-20);

  /// `whole`: in a tile, the points of the whole input; null: `points` has them.
  Obstacles(const Features<S, 3>& points, FeatureStore& store,
            const FeatureTree<3>* whole = nullptr)
      : points_(points), store_(store), whole_(whole) {}

  [[nodiscard]] bool any_in(const Box<3>& box) const {
    const Point<3> middle = middle_of(box);
    const auto any = [](const auto&) { return true; };
    return store_.visit_near(middle, middle, reach_of(box), any) || visit_points_in(box, any);
  }
  [[nodiscard]] Room room(const Point<3>& p, double pitch) const {
    if (!has_point(p, kUndisturbed * pitch) && !has_feature(p, kUndisturbed * pitch)) {
      return Room::ample;
    }
    const bool blocked = has_point(p, kClear * pitch) || has_feature(p, kClearOfFeatures * pitch);
    return blocked ? Room::none : Room::some;
  }

 private:
  template <class Visit>
  bool visit_points_in(const Box<3>& box, Visit&& visit) const {
    return whole_ != nullptr ? whole_->visit_in(box, visit) : points_.visit_points_in(box, visit);
  }
  [[nodiscard]] bool has_point(const Point<3>& p, double distance) const {
    return visit_points_in(around(p, distance), [&](const Vertex<3>& v) {
      return squared_distance(v.p, p) < distance * distance;
    });
  }
  [[nodiscard]] bool has_feature(const Point<3>& p, double distance) const {
    return store_.visit_near(p, p, distance * (1 + 0x1p-29),
                             [&](const auto& f) { return is_in_ball(p, distance * distance, f); });
  }
  const Features<S, 3>& points_;
  FeatureStore& store_;
  const FeatureTree<3>* whole_;
};

/// Edges are split, and pieces of polygons halved, that are longer than this many spacings where
/// simplices must not be large.
inline constexpr double kLongestEdge = 1.2;
inline constexpr double kWidestPiece = 1.1;

}  // namespace mesher::detail
