// The poor triangles that Complete leaves: exempt ones [rules A5.2], and in this call those that
// have yielded to leaves.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "plane/exempt.hpp"
#include "program/world.hpp"

namespace mesher::detail {

/// What becomes of a new point [5.2c]: it is inserted; not yet, leaves that have it in their balls
/// are cut first; not at all, a vertex on a feature was; never, since lengths have shrunk.
enum class Outcome : std::uint8_t { stands, waits, yielded, refused };

/// Nothing stays where there are points alone. In space it says more: program/space_lines.hpp.
template <class S, int D>
class Staying {
 public:
  Staying(const World<S, D>&, const CellOf<D>&) {}
  [[nodiscard]] const EdgeFilter<D>* filter() const noexcept { return nullptr; }
  void leave(const CellOf<D>&, int, int) {}
  [[nodiscard]] std::uint64_t looked_at() const noexcept { return 0; }
};

template <class S>
class Staying<S, 2> final : public EdgeFilter<2> {
 public:
  Staying(const World<S>& world, const VoronoiCell&)
      : world_(world), before_(world.segments.store().looked_at()) {}

  /// This, for a rule; null where nothing can stay.
  [[nodiscard]] const EdgeFilter<2>* filter() const noexcept {
    return world_.leaves.any() ? this : nullptr;
  }
  /// The triangles on both sides of this edge stay for now.
  void leave(const VoronoiCell& cell, int p, int q) { left_.push_back(edge(cell, p, q)); }

  /// How many segments at points have been looked at for all this.
  [[nodiscard]] std::uint64_t looked_at() const noexcept {
    return world_.segments.store().looked_at() - before_;
  }

  [[nodiscard]] bool skips(const VoronoiCell& cell, int p, int q) const override {
    return skips_large(cell, p, q) || world_.is_exempt(vertex(cell, p), vertex(cell, q));
  }
  [[nodiscard]] bool skips_large(const VoronoiCell& cell, int p, int q) const override {
    return std::find(left_.begin(), left_.end(), edge(cell, p, q)) != left_.end();
  }

 private:
  using Edge = std::array<VertexHandle, 2>;

  [[nodiscard]] const Vertex<2>& vertex(const VoronoiCell& cell, int i) const {
    return i == kCentre ? cell.center() : world_.vertices.pool()[cell.handle(i)];
  }
  [[nodiscard]] Edge edge(const VoronoiCell& cell, int p, int q) const {
    const auto [first, last] = std::minmax({vertex(cell, p).self, vertex(cell, q).self});
    return {first, last};
  }

  const World<S>& world_;
  const std::uint64_t before_;
  std::vector<Edge> left_;
};

}  // namespace mesher::detail
