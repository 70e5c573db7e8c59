// What a static run does that is for one tile alone, and has a halo: the points of the tile, and
// those around it, as far as some times their spacing.
//
// Near the end of the halo the run goes wrong, since points are missing there; what is wrong
// spreads inward by a few lengths a bucket, and ever less. So whether the tile itself is right must
// be proved afterwards. For this the run notes
//   - of each vertex, by which call it was born, and in which bucket it is first completed;
//   - of each call of the tile that looks beyond the tile, the balls that it found empty, or whose
//     rim it looked at.
// If the births in these balls, before the turn of the call, are those that the neighbour's own run
// has there, all tiles are right: tiles/halo_certificate.hpp.
#pragma once

#include <algorithm>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "borders/halo_tiles.hpp"
#include "borders/turn.hpp"
#include "mesher/error.hpp"
#include "records/vertex.hpp"

namespace mesher::detail {

/// When a vertex was born: the turn of the call, and the bucket in which it is first completed.
template <int D>
struct Born {
  Turn<D> turn;
  int bucket = -1;
  friend auto operator<=>(const Born&, const Born&) = default;
};

template <int D>
class HaloBorder {
 public:
  struct Look {
    Turn<D> turn;
    RelativeBall<D> ball;
  };

  HaloBorder(const HaloTiles<D>& tiles, std::size_t self) : tiles_(tiles), self_(self) {}

  [[nodiscard]] bool owns(const Point<D>& p) const noexcept { return tiles_.owner(p) == self_; }

  /// The call about what is at turn.p has its turn.
  void begin(const Turn<D>& turn) noexcept {
    turn_ = turn;
    is_own_ = owns(turn.p);
  }
  /// Whether a look as far as `reach` from `at` is to be noted. Requires: of the running call.
  [[nodiscard]] bool notes(const Point<D>& at, double reach) const noexcept {
    return is_own_ && !tiles_.holds(self_, {at, {}, reach});
  }
  /// The running call has looked at a ball.
  void looked(const RelativeBall<D>& ball) {
    if (is_own_ && !tiles_.holds(self_, ball)) looks_.push_back({turn_, ball});
  }
  /// The same for the gap balls of a cell.
  template <class Cell>
  void looked_at_cell(const Cell& cell) {
    if (!is_own_) return;
    for (int i = 0; i < cell.corners(); ++i) {
      looked({cell.center().p, cell.corner(i), cell.gap_radius(static_cast<std::size_t>(i))});
    }
  }
  /// The running call gives birth to a vertex.
  void born(VertexHandle v, int bucket) {
    if (v >= born_.size()) born_.resize(std::size_t{v} + 1);
    born_[v] = {turn_, bucket};
  }
  /// The running call cannot do what it should: in the tile this counts, if all is right.
  void fault(const Error& error) {
    if (is_own_ && !fault_) fault_ = error;
  }

  /// Of a vertex of the input, or on the boundary: there from the beginning.
  [[nodiscard]] Born<D> birth(VertexHandle v) const noexcept {
    return v < born_.size() ? born_[v] : Born<D>();
  }
  /// Of looks at one ball the last one: who agree on all births there until then, agree on those
  /// until an earlier turn.
  [[nodiscard]] std::vector<Look> take_looks() {
    const auto ball = [](const Look& a) {
      return std::tie(a.ball.at, a.ball.center, a.ball.radius);
    };
    std::sort(looks_.begin(), looks_.end(), [&](const Look& a, const Look& b) {
      return ball(a) != ball(b) ? ball(a) < ball(b) : b.turn < a.turn;
    });
    const auto end = std::unique(looks_.begin(), looks_.end(),
                                 [&](const Look& a, const Look& b) { return ball(a) == ball(b); });
    looks_.erase(end, looks_.end());
    return std::move(looks_);
  }
  [[nodiscard]] const std::optional<Error>& first_fault() const noexcept { return fault_; }

 private:
  const HaloTiles<D>& tiles_;
  std::size_t self_;
  Turn<D> turn_;
  bool is_own_ = false;
  std::vector<Born<D>> born_;  // by handle
  std::vector<Look> looks_;
  std::optional<Error> fault_;
};

}  // namespace mesher::detail
