// What is left of a polygon where another one covers it.
#pragma once

#include <optional>
#include <vector>

#include "space/feature_store.hpp"

namespace mesher::detail {

/// The loops around what is on g and on none of `others`, if all borders of these on g are declared
/// to lie in g, and the reverse; loops may pass points more than once. Nothing if that is not so:
/// if it would be all of g, or these edges do not go around anything. Requires: they lie in one
/// plane with g.
[[nodiscard]] std::optional<std::vector<Loop>> rest_of(const Polygon& g,
                                                       const std::vector<const Polygon*>& others,
                                                       const FeatureStore& store);

}  // namespace mesher::detail
