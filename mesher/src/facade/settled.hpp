// Options as the algorithms take them.
#pragma once

#include "mesher/mesh.hpp"

namespace mesher::detail {

/// The options with rho in place of min_angle. Throws: Error(bad_option).
template <int D>
[[nodiscard]] Options<D> settled(Options<D> options);

}  // namespace mesher::detail
