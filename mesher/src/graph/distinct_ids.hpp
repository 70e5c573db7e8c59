// Refusing ids that a file gives twice.
#pragma once

#include <string>
#include <vector>

#include "mesher/error.hpp"
#include "mesher/input_file.hpp"

namespace mesher {

/// Ids with the places of what they name, to be checked.
struct Named {
  const char* what;  // "segment"
  std::vector<FeatureId> ids;
  std::vector<Place> places;
};

/// Of parts that have an id. `place_of(i)`: where the i-th stood.
template <class Part, class PlaceOf>
[[nodiscard]] Named named(const char* what, const std::vector<Part>& parts, PlaceOf place_of) {
  Named all{what, {}, {}};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    all.ids.push_back(parts[i].id);
    all.places.push_back(place_of(i));
  }
  return all;
}

/// Throws: Error(repeated_id) for the first part whose id an earlier one has. Cost: O(n log n).
void require_distinct(const Named& all);

/// Of points, holes and regions of a Pslg or a Plc.
template <class Input>
void require_distinct_parts(const Input& input, const FileParts& f) {
  require_distinct(named("point", input.points, [&](auto i) { return f.place_of_point(i); }));
  require_distinct(named("hole", input.holes, [&](auto i) { return f.place_of_hole(i); }));
  require_distinct(named("region", input.regions, [&](auto i) { return f.place_of_region(i); }));
}

}  // namespace mesher
