// The error in space for a mesh that needs more vertices than allowed: it names where they are.
#pragma once

#include <map>
#include <vector>

#include "index/vertex_search.hpp"
#include "mesher/error.hpp"
#include "space/validity.hpp"

namespace mesher::detail {

/// Names the two features with the most vertices on them, if there are any, and where these lie the
/// closest. `names`: null if there are no features. Cost: O(vertices).
[[nodiscard]] Error too_many_vertices(const VertexSearch<3>& vertices, const SpaceNames* names,
                                      const FeatureStore& store, std::size_t most);

/// Of what a role says that vertices are on (Role::on): their places.
using PlacesOnFeatures = std::map<SegmentHandle, std::vector<Point<3>>>;
/// The same where the vertices on each feature are known.
[[nodiscard]] Error too_many_vertices(const PlacesOnFeatures& on_features, const SpaceNames* names,
                                      const FeatureStore& store, std::size_t most);

/// An error too_many that any algorithm would end with.
class SurelyTooMany : public Error {
 public:
  explicit SurelyTooMany(const Error& error) : Error(error) {}
};

/// Where two polygons lie so close to each other that the mesh needs more than `most`.
[[nodiscard]] SurelyTooMany too_many_between(const Polygon& f, const Polygon& g, double width,
                                             const Point<3>& at, const SpaceNames* names,
                                             const FeatureStore& store, std::size_t most);

}  // namespace mesher::detail
