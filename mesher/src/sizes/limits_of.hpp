// The limits of size of each dimension: in the plane and in space; beyond, there are none.
#pragma once

#include <limits>
#include <type_traits>

#include "geometry/grid.hpp"
#include "mesher/error.hpp"
#include "sizes/limits.hpp"

namespace mesher::detail {

/// Whether the options ask for limits of size.
template <int D>
[[nodiscard]] bool has_limits(const Options<D>& options) noexcept {
  return options.max_measure != 0 || options.sizes != nullptr || !options.box_limits.empty() ||
         options.region_limits != nullptr;
}

template <int D>
class NoLimits {
 public:
  /// Throws: Error(bad_option) if the options ask for some.
  NoLimits(const Options<D>& options, const MeshBox<D>&) {
    if (has_limits(options)) {
      throw Error(ErrorCode::bad_option, "limits of size are for the plane and for space");
    }
  }
  [[nodiscard]] static constexpr bool any() noexcept { return false; }
  [[nodiscard]] static constexpr double pitch(const Point<D>&) noexcept {
    return std::numeric_limits<double>::infinity();
  }
};

template <int D>
using LimitsOf = std::conditional_t<D <= 3, Limits<D>, NoLimits<D>>;

}  // namespace mesher::detail
