// Points that wait at simplices, of each of which a vertex is the owner: what SimplexLocation and
// BallLocation have in common.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/plane_vectors.hpp"
#include "geometry/space_vectors.hpp"
#include "refinement/location.hpp"

namespace mesher::detail {

/// `Location`, which is derived from this, has
///   owner(point)      a vertex; the point is at a simplex of its star
///   visit_at(s, visit)  calls visit(point) for those at s
template <int D, class Location>
class SimplexLists : public WaitingPoints<D> {
 public:
  using Kernel = RefinedKernel<D>;

  void add_vertex() { owned_.push_back(0); }
  void drop_vertex() noexcept { owned_.pop_back(); }
  [[nodiscard]] bool is_crowded(std::uint32_t v) const noexcept { return owned_[v] != 0; }
  [[nodiscard]] Found any(Kernel& kernel, std::uint32_t v) {
    return best_of(kernel, v, [](std::uint32_t) { return true; });
  }
  [[nodiscard]] Found farthest(Kernel& kernel, std::uint32_t v) {
    double most = -1;
    return best_of(kernel, v, [&](std::uint32_t point) {
      const double d2 = squared_distance(places_[point], kernel.place(v));
      if (d2 <= most) return false;
      most = d2;
      return true;
    });
  }
  /// find_early() has looked at all of the ball.
  template <class Takes>
  [[nodiscard]] Found find_late(const Kernel&, std::uint32_t, const Point<D>&, double,
                                Takes&&) const {
    return {};
  }

 protected:
  using WaitingPoints<D>::places_, WaitingPoints<D>::looked_at_;

  explicit SimplexLists(std::span<const Point<D>> points) : WaitingPoints<D>(points) {}
  ~SimplexLists() = default;

  std::vector<std::uint32_t> owned_{0};  // by vertex: how many points
  std::vector<std::uint32_t> star_;      // scratch

 private:
  // The last of v's points in its star of which is_better(point).
  template <class IsBetter>
  [[nodiscard]] Found best_of(Kernel& kernel, std::uint32_t v, IsBetter&& is_better) {
    const auto& location = static_cast<const Location&>(*this);
    Found best;
    kernel.find_in_star(v, star_, [](std::uint32_t) { return false; });
    for (const std::uint32_t s : star_) {
      location.visit_at(s, [&](std::uint32_t point) {
        ++looked_at_.to_find;
        if (location.owner(point) == v && is_better(point)) best = {point, s};
      });
    }
    return best;
  }
};

}  // namespace mesher::detail
