// Refusing ids that a file gives twice.
#pragma once

#include <string>
#include <vector>

#include "mesher/error.hpp"
#include "mesher/input_file.hpp"

namespace mesher {

/// Features with where they stand, to be checked for ids that repeat.
struct Named {
  std::vector<Feature> features;
  std::vector<FileLocation> locations;
};

/// Of parts that have an id. `location_of(i)`: where the i-th stood.
template <class Part, class LocationOf>
[[nodiscard]] Named named(FeatureKind kind, const std::vector<Part>& parts,
                          LocationOf location_of) {
  Named all;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    all.features.push_back({kind, parts[i].id});
    all.locations.push_back(location_of(i));
  }
  return all;
}

/// Throws: Error(repeated_id) for the first part whose id an earlier one has. Cost: O(n log n).
void require_distinct(const Named& all);

/// Of points, holes and regions of a Pslg or a Plc.
template <class Input>
void require_distinct_parts(const Input& input, const FileParts& f) {
  require_distinct(
      named(FeatureKind::point, input.points, [&](auto i) { return f.location_of_point(i); }));
  require_distinct(
      named(FeatureKind::hole, input.holes, [&](auto i) { return f.location_of_hole(i); }));
  require_distinct(
      named(FeatureKind::region, input.regions, [&](auto i) { return f.location_of_region(i); }));
}

}  // namespace mesher
