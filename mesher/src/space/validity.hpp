// Finds and names the faults that make an input no piecewise linear complex, near the feature that
// causes them.
//
// Features may have corners, ends and edges in common, and what a polygon declares to lie in it;
// nothing else. Corners of a polygon are hardly ever coplanar in doubles, so tests go by labels
// first and by tolerances then:
//  - a point is on an edge if it is no end of it and no farther from it than the resolution of the
//    place; on a polygon if that does not have it, its foot is inside, and it is no farther from
//    the plane than the polygon itself is (its thickness);
//  - two edges cross if they have no common end and are no farther apart than that;
//  - an edge goes through a polygon if the two have no point in common, its ends are on different
//    sides of the plane, however near, and the place between is inside. With one point in common it
//    leaves the plane there, or lies in it; then what is wrong is wrong with a point or with an
//    edge of the polygon. With two it lies in the plane, and is on the polygon if its middle is
//    inside;
//  - where two polygons of different planes cross, an edge of one goes through the other, or the
//    places where their line of intersection begins and ends are common points, without a common
//    edge between them: the middle of those is inside both;
//  - where two of one plane overlap, edges cross, a point or an edge of one is on the other, or
//    they have the same side of a common edge.
#pragma once

#include <array>
#include <new>
#include <optional>
#include <string>
#include <vector>

#include "geometry/box.hpp"
#include "mesher/error.hpp"
#include "space/feature_search.hpp"

namespace mesher::detail {

/// What a feature is in the way of.
struct SpaceConflict {
  enum class Kind {  // the first is named of several
    point_on_edge,
    point_on_polygon,
    crossing_edges,
    edge_on_polygon,
    edge_through_polygon,
    crossing_polygons,
    overlapping_polygons,
  };
  Kind kind = Kind::point_on_edge;
  Feature one, other;  // in the order of the kind's name
  Point<3> at{};
};

class SpaceNames;

/// A feature as a message names it; `feature` is the segment or polygon that it is, or belongs to:
/// of several polygons with an edge the least.
struct NamedFeature {
  std::string text;
  mesher::Feature feature;
};
[[nodiscard]] NamedFeature named(const Feature& f, const SpaceNames& names,
                                 const FeatureStore& store);

/// The conflict of two features, if there is one.
[[nodiscard]] std::optional<SpaceConflict> conflict_with(const Vertex<3>& v, const Edge& e);
[[nodiscard]] std::optional<SpaceConflict> conflict_with(const Vertex<3>& v, const Polygon& f);
[[nodiscard]] std::optional<SpaceConflict> conflict_with(const Edge& e, const Edge& t);
[[nodiscard]] std::optional<SpaceConflict> conflict_with(const Edge& e, const Polygon& f);
/// But for conflicts of one with an edge or a point of the other.
[[nodiscard]] std::optional<SpaceConflict> conflict_with(const Polygon& f, const Polygon& g,
                                                         const FeatureStore& store);

/// Whether one of two polygons lies in the other's plane, as far as they can tell.
[[nodiscard]] bool lie_in_one_plane(const Polygon& f, const Polygon& g);
/// The conflict of two that have a side of an edge in common. Requires: lie_in_one_plane(f, g).
[[nodiscard]] std::optional<SpaceConflict> overlap(const Polygon& f, const Polygon& g,
                                                   const FeatureStore& store);
/// Of two in different planes: the points that both have, between which both go on, without an edge
/// of both; in the order along the line in which their planes meet.
[[nodiscard]] std::vector<std::array<VertexHandle, 2>> uncut(const Polygon& f, const Polygon& g,
                                                             const FeatureStore& store);

/// Keeps the first by kind and place.
void keep_first(std::optional<SpaceConflict>& first, const std::optional<SpaceConflict>& conflict);

/// The first conflict of a feature with live features and input points; of a polygon without those
/// of its edges. Cost: O(log L/s), and what is near.
[[nodiscard]] std::optional<SpaceConflict> conflict_of(const Vertex<3>& v, FeatureStore& store);
template <class S>
[[nodiscard]] std::optional<SpaceConflict> conflict_of(const Edge& e, FeatureStore& store,
                                                       const Features<S, 3>& points);
template <class S>
[[nodiscard]] std::optional<SpaceConflict> conflict_of(const Polygon& f, FeatureStore& store,
                                                       const Features<S, 3>& points);

/// What features in space are called.
class SpaceNames {
 public:
  [[nodiscard]] virtual PointId point(VertexHandle v) const = 0;
  /// Nothing: no segment of the input.
  [[nodiscard]] virtual std::optional<LineId> segment(EdgeHandle e) const = 0;
  [[nodiscard]] virtual PolygonId polygon(PolygonHandle f) const = 0;

 protected:
  ~SpaceNames() = default;
};

/// Throws: Error as the conflict says, with the ids of both and the place.
[[noreturn]] void fail(const SpaceConflict& conflict, const SpaceNames& names,
                       const FeatureStore& store);

/// Throws: Error (bad_polygon, not_flat), with what place is off, if a polygon, whose corners are
/// different in each loop, is none: if it has no area, is not flat, has a loop outside the first or
/// twice the same edge, or if what it declares to lie in it does not.
void require_shape(const Polygon& f, PolygonId id, const FeatureStore& store);

namespace validity {

// Beyond a feature by the tolerance of all tests.
[[nodiscard]] inline FeatureExtent<3> widened(FeatureExtent<3> where) {
  const Point<3> middle = scaled(0.5, plus(where.p, where.q));
  where.slack += resolution(middle, std::sqrt(squared_distance(where.p, where.q)) + where.slack);
  return where;
}
[[nodiscard]] inline Box<3> box_of(const FeatureExtent<3>& where) {
  Box<3> box = around(where.p, where.slack);
  const Box<3> other = around(where.q, where.slack);
  for (int i = 0; i < 3; ++i) {
    box.lo[i] = std::min(box.lo[i], other.lo[i]);
    box.hi[i] = std::max(box.hi[i], other.hi[i]);
  }
  return box;
}

}  // namespace validity

template <class S>
std::optional<SpaceConflict> conflict_of(const Edge& e, FeatureStore& store,
                                         const Features<S, 3>& points) {
  std::optional<SpaceConflict> first;
  const FeatureExtent<3> where = validity::widened(extent_of(e));
  store.visit_near(where.p, where.q, where.slack, [&](const auto& f) {
    keep_first(first, conflict_with(e, f));
    return false;
  });
  points.visit_points_in(validity::box_of(where), [&](const Vertex<3>& v) {
    keep_first(first, conflict_with(v, e));
    return false;
  });
  return first;
}

template <class S>
std::optional<SpaceConflict> conflict_of(const Polygon& f, FeatureStore& store,
                                         const Features<S, 3>& points) {
  std::optional<SpaceConflict> first;
  const FeatureExtent<3> where = validity::widened(extent_of(f));
  bool failed = false;
  struct Look {  // must not throw
    std::optional<SpaceConflict>& first;
    const Polygon& f;
    const FeatureStore& store;
    bool& failed;
    bool operator()(const Edge& e) const noexcept {
      return keep_first(first, conflict_with(e, f)), false;
    }
    bool operator()(const Polygon& g) const noexcept {
      try {
        keep_first(first, conflict_with(f, g, store));
      } catch (const std::bad_alloc&) {
        failed = true;
      }
      return failed;
    }
  };
  store.visit_near(where.p, where.q, where.slack, Look{first, f, store, failed});
  if (failed) throw std::bad_alloc();
  points.visit_points_in(validity::box_of(where), [&](const Vertex<3>& v) {
    keep_first(first, conflict_with(v, f));
    return false;
  });
  return first;
}

}  // namespace mesher::detail
