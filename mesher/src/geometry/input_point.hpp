// Checks input points at the boundary, and sorts them into spatial order. N is the dimension.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "geometry/grid.hpp"
#include "mesher/error.hpp"
#include "mesher/mesh.hpp"

namespace mesher::detail {

/// "(x, y)", "(x, y, z)", digits that read back to the same doubles.
template <std::size_t N>
[[nodiscard]] std::string place_text(const std::array<double, N>& p);

/// The place, for an error; nothing if it is not known.
template <std::size_t N>
[[nodiscard]] std::vector<Position> places_of(const std::optional<std::array<double, N>>& p) {
  return p ? std::vector<Position>{position_of(*p)} : std::vector<Position>();
}

/// Throws: Error (not_finite, magnitude).
template <std::size_t N>
void check_coordinates(const std::array<double, N>& p, PointId id);

/// Throws: Error (not_finite, magnitude, outside_domain).
template <std::size_t N>
void check_point(const std::array<double, N>& p, const Box<static_cast<int>(N)>& domain,
                 PointId id);

/// Throws: Error(duplicate_point) for equal points, else Error(too_close).
template <std::size_t N>
[[noreturn]] void fail_too_near(const std::array<double, N>& p, PointId id,
                                const std::array<double, N>& other, PointId other_id);

/// The indices of `points` in Morton order, equal places in the order given.
template <std::size_t N>
[[nodiscard]] std::vector<std::size_t> morton_order(
    const std::vector<std::array<double, N>>& points, const MeshBox<static_cast<int>(N)>& box);

}  // namespace mesher::detail
