// The facets of a simplex, as its other simplex sees them the other way round.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace mesher::detail {

/// The corners of the facet across from corner i, in such an order that they and then corner i are
/// a positively oriented simplex (in space), or counterclockwise around it (in the plane).
template <int D>
inline constexpr std::array<std::array<std::uint32_t, D>, D + 1> kFacet;
template <>
inline constexpr std::array<std::array<std::uint32_t, 2>, 3> kFacet<2>{{{1, 2}, {2, 0}, {0, 1}}};
template <>
inline constexpr std::array<std::array<std::uint32_t, 3>, 4> kFacet<3>{
    {{1, 3, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 2}}};

}  // namespace mesher::detail
