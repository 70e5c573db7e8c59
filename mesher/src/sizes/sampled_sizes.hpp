// Backgrounds of sizes, as what can be told to others.
#pragma once

#include <vector>

#include "mesher/sizes.hpp"

namespace mesher::detail {

/// The samples of a field that sampled_sizes() has made; null: of any other.
template <int D>
[[nodiscard]] const std::vector<SizeSample<D>>* samples_of(const SizeField<D>& field);

}  // namespace mesher::detail
