// Points wait at the vertices in whose Voronoi cells they are, on lists [3.1].
#pragma once

#include <cstdint>
#include <span>

#include "refinement/location.hpp"

namespace mesher::detail {

/// `Lists`: VoronoiLists or ShellLists.
template <int D, class Lists>
class VoronoiLocation : Lists {
 public:
  using Kernel = RefinedKernel<D>;

  explicit VoronoiLocation(std::span<const Point<D>> points) : Lists(points) {}

  using Lists::left, Lists::place, Lists::add_vertex, Lists::drop_vertex, Lists::is_crowded,
      Lists::looked_at;
  template <class Visit>
  void start(const Kernel& kernel, std::uint32_t v, std::uint32_t except, Visit&& visit) {
    Lists::start(v, kernel.place(v), except);
    give(kernel, v, visit);
  }
  [[nodiscard]] Found any(Kernel&, std::uint32_t v) const noexcept { return {Lists::any(v), v}; }
  [[nodiscard]] Found farthest(const Kernel& kernel, std::uint32_t v) const noexcept {
    return {Lists::farthest(v, kernel.place(v)), v};
  }

  /// Of a point near the centre nearly always a corner of s is the owner [rules D6].
  template <class Takes>
  [[nodiscard]] Found find_early(const Kernel& kernel, std::uint32_t s, const Point<D>& c, double r,
                                 Takes&& takes) const {
    for (const std::uint32_t w : kernel.simplices().corners(s)) {
      const std::uint32_t point = Lists::find(w, kernel.place(w), c, r);
      if (point != kNone && takes(point)) return {point, w};
    }
    return {};
  }
  /// In the lists of those around the hole.
  template <class Takes>
  [[nodiscard]] Found find_late(const Kernel& kernel, std::uint32_t, const Point<D>& c, double r,
                                Takes&& takes) const {
    Found best;
    kernel.for_each_in_link([&](std::uint32_t w) {
      if (best.point != kNone) return;
      const std::uint32_t point = Lists::find(w, kernel.place(w), c, r);
      if (point != kNone && takes(point)) best = {point, w};
    });
    return best;
  }

  std::uint32_t take(const Kernel& kernel, std::uint32_t v) {
    const Point<D>& p = kernel.place(v);
    std::uint32_t is_point = kNone;
    kernel.for_each_in_link([&](std::uint32_t w) {
      if (w == kInfinite) return;
      const std::uint32_t point = Lists::relocate(v, p, w, kernel.place(w));
      if (point != kNone) is_point = point;
    });
    return is_point;
  }
  template <class Visit>
  void give(const Kernel&, std::uint32_t v, Visit&& visit) {
    if (is_crowded(v)) visit(v);
  }
  void drop(Kernel&, const Found& found) noexcept { Lists::drop(found.owner, found.point); }
};

}  // namespace mesher::detail
