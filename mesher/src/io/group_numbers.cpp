// Numbers of groups from values.
#include <algorithm>
#include <cmath>

#include "io/write_mesh.hpp"

namespace mesher {

GroupNumbers::GroupNumbers(std::vector<double> values) : values_(std::move(values)) {
  std::sort(values_.begin(), values_.end());
  values_.erase(std::unique(values_.begin(), values_.end()), values_.end());
  values_.erase(std::remove(values_.begin(), values_.end(), 0.0), values_.end());
  as_they_are_ = std::all_of(values_.begin(), values_.end(), [](double value) {
    return value >= 1 && value <= INT32_MAX && value == std::floor(value);
  });
}

std::int32_t GroupNumbers::of(double value) const {
  if (value == 0 || as_they_are_) return static_cast<std::int32_t>(value);
  const auto found = std::lower_bound(values_.begin(), values_.end(), value);
  return static_cast<std::int32_t>(found - values_.begin()) + 1;
}

}  // namespace mesher
