// Ids of features, written as numbers.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <vector>

#include "mesher/error.hpp"

namespace support {

inline mesher::FeatureId id(std::int64_t value) { return mesher::FeatureId{value}; }
inline std::vector<mesher::FeatureId> ids(std::initializer_list<std::int64_t> values) {
  std::vector<mesher::FeatureId> all;
  for (const auto value : values) all.push_back(id(value));
  return all;
}

/// Of what the error is about.
inline std::vector<mesher::FeatureId> ids_of(const mesher::Error& error) {
  std::vector<mesher::FeatureId> all;
  for (const mesher::Feature& f : error.features()) all.push_back(f.id);
  return all;
}

}  // namespace support
