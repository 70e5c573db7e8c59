// Ids of features, written as numbers.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <vector>

#include "mesher/mesh.hpp"

namespace support {

inline mesher::FeatureId id(std::int64_t value) { return mesher::FeatureId{value}; }
inline std::vector<mesher::FeatureId> ids(std::initializer_list<std::int64_t> values) {
  std::vector<mesher::FeatureId> all;
  for (const auto value : values) all.push_back(id(value));
  return all;
}

}  // namespace support
