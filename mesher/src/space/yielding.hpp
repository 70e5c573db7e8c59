// The new position of a point that is too near features of lower dimension [Fig 6.2c; rules C, k =
// 1/2].
//
// It is a function of the point, its ball, and the features of the input. It depends on no vertex,
// so an edit elsewhere on a feature does not matter.
#pragma once

#include <optional>

#include "space/feature_search.hpp"
#include "space/placed.hpp"

namespace mesher::detail {

/// A point yields to features within this times the radius of its ball.
inline constexpr double kYields = 0.5;

/// The roundest place on e in the middle half of what the ball around x has of it; nothing
/// if the ball misses it.
[[nodiscard]] std::optional<Placed> place_in_ball(const Edge& e, const Point<3>& x, double radius);

/// Where the centre x of an empty ball goes instead, on the nearest edge within kYields; nothing if
/// there is none.
[[nodiscard]] std::optional<Placed> yield_to_edges(const FeaturesBeside& near, const Point<3>& x,
                                                   double radius);
/// The same on edges, and if none is near on the nearest polygon: the foot, which yields to edges
/// in turn.
[[nodiscard]] std::optional<Placed> yield(const FeaturesBeside& near, const Point<3>& x,
                                          double radius);

}  // namespace mesher::detail
