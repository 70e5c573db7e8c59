// Checks that all features of a complex fit together, all at once.
#pragma once

#include <functional>

#include "space/feature_store.hpp"

namespace mesher::detail {

/// Whether no two live features, or input points, are in conflict (space/validity.hpp). Where some
/// are, conflict_of() says which. `ask` is called in between, and may throw.
/// Cost: O(n log n), and what is near: a fifth of looking at one after the other.
[[nodiscard]] bool all_fit(const FeatureStore& store, const std::function<void()>& ask);

}  // namespace mesher::detail
