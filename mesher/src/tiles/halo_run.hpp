// The static run for one tile and its halo (borders/halo_border.hpp): the part of the mesh that the
// tile outputs, and what it has seen of others, by which they are compared (halo_certificate.hpp).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "borders/halo_border.hpp"
#include "geometry/grid.hpp"
#include "mesher/mesh.hpp"

namespace mesher::detail {

/// A point of the input, and its number there.
template <int D>
struct HaloPoint {
  Point<D> p{};
  std::uint64_t number = 0;
};

/// The vertices of a mesh that are in a tile, in order of places.
template <int D>
struct HaloVertices {
  std::vector<Point<D>> places;
  std::vector<VertexKind> kinds;
  std::vector<Born<D>> born;
};

/// The simplices of a mesh whose first vertex, in order of places, is in a tile.
template <int D>
struct HaloSimplices {
  std::vector<Point<D>> foreign;  // vertices of other tiles that they have, in order of places
  std::vector<std::array<std::uint32_t, D + 1>> simplices;  // foreign ones after the tile's own
};

/// What a call of the tile has seen of another tile.
template <int D>
struct HaloLook {
  std::uint64_t tile = 0;
  Turn<D> turn;
  RelativeBall<D> ball;
  std::uint64_t seen = 0;  // digest() of the births there before the turn
};

/// A birth in one tile by a call of another.
template <int D>
struct HaloBirth {
  std::uint64_t tile = 0;  // the other one
  Point<D> p{};
  Born<D> born;
  friend auto operator<=>(const HaloBirth&, const HaloBirth&) = default;
};

/// The births across a tile's border, and what fails in it.
template <int D>
struct HaloView {
  std::vector<HaloBirth<D>> gives;     // to others, by the tile's calls; in order
  std::vector<HaloBirth<D>> receives;  // in the tile; in order
  std::optional<Error> fault;          // of the tile's calls, if all is right
};

template <int D>
struct HaloRun {
  HaloVertices<D> vertices;
  HaloSimplices<D> simplices;
  std::vector<HaloLook<D>> looks;  // at other tiles, by tile
  HaloView<D> view;
  std::uint64_t calls = 0;
};

/// Those of one tile in a vector in order of tiles.
template <class T>
[[nodiscard]] std::span<const T> those_of(std::size_t tile, const std::vector<T>& all) {
  const auto begin = std::lower_bound(all.begin(), all.end(), tile,
                                      [](const T& a, std::size_t t) { return a.tile < t; });
  const auto end = std::upper_bound(begin, all.end(), tile,
                                    [](std::size_t t, const T& a) { return t < a.tile; });
  return {begin, end};
}

/// Of a set of births; the sum of those of its parts.
template <int D>
[[nodiscard]] std::uint64_t digest(const Point<D>& p, const Born<D>& born);

/// What a run is told of the input.
template <int D>
struct HaloInput {
  const Options<D>& options;
  const MeshBox<D>& box;
  const HaloTiles<D>& tiles;
  std::function<PointId(std::uint64_t)> id_of;  // by number, for messages
};

/// `points`: of the tile, and of its halo.
/// `step` is called every RunControl::kCallsBetween calls; it may throw.
/// Throws: Error (as mesh_statically), std::bad_alloc, what `step` throws.
template <int D>
[[nodiscard]] HaloRun<D> run_for_tile(const HaloInput<D>& input, std::size_t tile,
                                      const std::vector<HaloPoint<D>>& points,
                                      const std::function<void()>& step);

}  // namespace mesher::detail
