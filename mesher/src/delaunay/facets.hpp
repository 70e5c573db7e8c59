// The corners of a simplex, and its facets in the orientation of the simplex across.
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

template <int D>
[[nodiscard]] constexpr std::array<std::uint32_t, D> facet_across(
    const std::array<std::uint32_t, D + 1>& simplex, std::size_t i) noexcept {
  std::array<std::uint32_t, D> facet{};
  for (std::size_t k = 0; k < D; ++k) facet[k] = simplex[kFacet<D>[i][k]];
  return facet;
}

/// Which corner of a simplex v is; as many as there are if it is none.
template <std::size_t Corners>
[[nodiscard]] constexpr std::uint32_t corner_of(const std::array<std::uint32_t, Corners>& simplex,
                                                std::uint32_t v) noexcept {
  std::uint32_t i = 0;
  while (i < Corners && simplex[i] != v) ++i;
  return i;
}

}  // namespace mesher::detail
