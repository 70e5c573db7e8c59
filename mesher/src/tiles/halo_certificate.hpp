// Whether the runs for tiles, each with its halo, are parts of one mesh.
//
// Claim: if for each pair of tiles A, B
//   (1) what each call of A has seen of B, in its balls and before its turn, was born there in B's
//       own run, and nothing else was, and
//   (2) the births in B by calls of A are the same in the runs of both,
// then every call of every tile is that of one run for all.
// Proof: by induction over the turns. Let all calls of all tiles before a turn be right, each in
// the run of its own tile. The births in B before the turn, in B's run, are those of its own calls,
// and by (2) those of others' calls: right. So by (1) a call of A with this turn has seen in other
// tiles what is right; in A itself it sees what was born in A's run: right likewise. It sees what
// it sees in one run for all, hence does the same. The first turn: the input, and by (1) how
// crowded its points are. The last one: the stars, and so the simplices. Equal sets are recognised
// by 64-bit digests.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "tiles/halo_run.hpp"

namespace mesher::detail {

/// What others have seen of one tile: only so far inside as some of them have looked.
template <int D>
class HaloWitness {
 public:
  using Looks = std::span<const HaloLook<D>>;

  /// `looks`: at the tile, by others. The vertices must outlive it.
  HaloWitness(const HaloTiles<D>& tiles, std::size_t tile, const HaloVertices<D>& vertices,
              std::span<const Looks> looks)
      : vertices_(vertices), seen_(seen(tiles, tile, vertices, looks)), tree_(places()) {}

  /// (1), of some of the looks. Cost: O(log n) each.
  [[nodiscard]] bool confirms(Looks looks) const;

 private:
  static std::vector<std::uint32_t> seen(const HaloTiles<D>& tiles, std::size_t tile,
                                         const HaloVertices<D>& vertices,
                                         std::span<const Looks> looks);
  [[nodiscard]] std::vector<Point<D>> places() const {
    std::vector<Point<D>> places;
    places.reserve(seen_.size());
    for (const std::uint32_t i : seen_) places.push_back(vertices_.places[i]);
    return places;
  }

  const HaloVertices<D>& vertices_;
  std::vector<std::uint32_t> seen_;  // of the vertices
  PlaceTree<D> tree_;                // of these
};

template <int D>
std::vector<std::uint32_t> HaloWitness<D>::seen(const HaloTiles<D>& tiles, std::size_t tile,
                                                const HaloVertices<D>& vertices,
                                                std::span<const Looks> looks) {
  double deepest = 0;
  for (const Looks some : looks) {
    for (const HaloLook<D>& look : some) {
      Point<D> center = look.ball.at;
      for (std::size_t i = 0; i < D; ++i) center[i] += look.ball.center[i];
      const double depth = tiles.distance_to_end(tile, center) + look.ball.radius;
      deepest = std::max(deepest, depth + 0x1p-40 * (std::abs(depth) + look.ball.radius));
    }
  }
  std::vector<std::uint32_t> seen;
  for (std::uint32_t i = 0; i < vertices.places.size(); ++i) {
    if (tiles.distance_to_end(tile, vertices.places[i]) <= deepest) seen.push_back(i);
  }
  return seen;
}

template <int D>
bool HaloWitness<D>::confirms(Looks looks) const {
  for (const HaloLook<D>& look : looks) {
    std::uint64_t seen = 0;
    tree_.for_each_in(look.ball, [&](std::uint32_t k) {
      const std::uint32_t i = seen_[k];
      const Born<D>& born = vertices_.born[i];
      if (born.turn < look.turn) seen += digest<D>(vertices_.places[i], born);
    });
    if (seen != look.seen) return false;
  }
  return true;
}

/// (2), of births in the tile `to` by calls of `from`.
template <int D>
[[nodiscard]] bool agree_on_births(const HaloView<D>& from_view, std::size_t from,
                                   const HaloView<D>& to_view, std::size_t to) {
  const auto given = those_of(to, from_view.gives);
  const auto received = those_of(from, to_view.receives);
  return std::equal(given.begin(), given.end(), received.begin(), received.end(),
                    [](const auto& a, const auto& b) { return a.p == b.p && a.born == b.born; });
}

}  // namespace mesher::detail
