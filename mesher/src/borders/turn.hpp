// When a call of one tile has its turn, as other tiles are told.
#pragma once

#include <compare>
#include <cstdint>

#include "mesher/mesh.hpp"
#include "records/roles.hpp"
#include "sac/key.hpp"
#include "sac/label.hpp"

namespace mesher::detail {

/// Of all agendas: many buckets, three phases, a colour for each parity of coordinates.
inline constexpr sac::KeyWidths kKeyWidths{.bucket = 26, .phase = 2, .colour = 4};

/// The agendas of the program, in their order.
enum class Stage : std::uint8_t { fill, quadtree, steiner, stars };

/// `p`: of ComputeNN, Complete and SplitSlivers, the place of the vertex; calls of one rank and
/// order run in the order of these.
template <int D>
struct Turn {
  Stage stage = Stage::quadtree;
  std::uint32_t rank = 0;
  std::uint64_t order = 0;
  Point<D> p{};
  friend auto operator<=>(const Turn&, const Turn&) = default;

  /// Of a call with this turn, on an agenda with these widths.
  [[nodiscard]] sac::Key key(const sac::KeyWidths& w) const noexcept {
    sac::Key key;
    key.colour = rank & ((1u << w.colour) - 1);
    key.phase = rank >> w.colour & ((1u << w.phase) - 1);
    key.bucket = static_cast<int>(static_cast<std::int64_t>(rank >> (w.colour + w.phase)) -
                                  (std::int64_t{1} << (w.bucket - 1)));
    key.order = order;
    return key;
  }
};

/// What a call looks at: the cell of `p` up to `radius`, or, if that is negative, who is nearest.
template <int D>
struct Look {
  Point<D> p{};
  double radius = 0;
  Turn<D> turn;
  friend auto operator<=>(const Look&, const Look&) = default;
};

/// A vertex that is born at this turn. `bucket`: when it is to be completed, or if `asks_nearest`
/// its nearest neighbour is asked for, by who owns its place; negative: it is only seen. `role`: on
/// a feature as all tiles call it.
template <int D>
struct Birth {
  Point<D> p{};
  int bucket = -1;
  Turn<D> turn;
  Role role{};
  bool asks_nearest = false;
  friend auto operator<=>(const Birth&, const Birth&) = default;
};

/// A leaf that is cut at this turn, in a bucket; on a segment as all tiles call it.
template <int D>
struct CutOfLeaf {
  Piece piece;
  int bucket = 0;
  Turn<D> turn;
  friend auto operator<=>(const CutOfLeaf&, const CutOfLeaf&) = default;
};

/// The call of SplitSlivers, of the vertex at `p` in a bucket, that has this turn.
template <int D>
struct SliverCall {
  Point<D> p{};
  int bucket = 0;
  Turn<D> turn;
  friend auto operator<=>(const SliverCall&, const SliverCall&) = default;
};

template <int D>
struct TurnHash {
  std::size_t operator()(const Point<D>& p) const noexcept {
    std::uint64_t h = 0;
    for (const double x : p) h = sac::mix(h) + std::bit_cast<std::uint64_t>(x + 0.0);
    return sac::mix(h);
  }
  std::size_t operator()(const Look<D>& l) const noexcept {
    const std::uint64_t h = sac::mix((*this)(l.p) + l.turn.order) + l.turn.rank;
    return sac::mix(sac::mix(h + static_cast<std::uint64_t>(l.turn.stage)) +
                    std::bit_cast<std::uint64_t>(l.radius));
  }
};

}  // namespace mesher::detail
