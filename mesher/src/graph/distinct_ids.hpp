// Refusing ids that a file gives twice.
#pragma once

#include <string>
#include <vector>

#include "mesher/error.hpp"
#include "mesher/graph.hpp"

namespace mesher {

/// Features with where they stand, to be checked for ids that repeat.
struct Named {
  std::vector<Feature> features;
  std::vector<FileLocation> locations;
};

/// Of parts that have an id. `location_of(i)`: where the i-th stood.
template <class Part, class LocationOf>
[[nodiscard]] Named named(const std::vector<Part>& parts, LocationOf location_of) {
  Named all;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    all.features.push_back(parts[i].id);
    all.locations.push_back(location_of(i));
  }
  return all;
}

/// Throws: Error(repeated_id) for the first part whose id an earlier one has. Cost: O(n log n).
void require_distinct(const Named& all);

/// Of all parts of a graph, lines aside.
template <int D>
void require_distinct_parts(const Graph<D>& graph, const GraphFile<D>& f) {
  require_distinct(named(graph.points, [&](auto i) { return f.location_of_point(i); }));
  if constexpr (D == 3) {
    require_distinct(named(graph.polygons, [&](auto i) { return f.location_of_polygon(i); }));
  }
  require_distinct(named(graph.seeds, [&](auto i) { return f.location_of_seed(i); }));
}

}  // namespace mesher
