// Each point waits at the simplex that it is in [3.1, "By simplex"; Kirkpatrick].
//
// A vertex is crowded by the points that are nearest to it of the corners of their simplex. When
// simplices go, their points walk to where they are, with exact predicates. A query looks at the
// simplices that its ball meets.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/plane_vectors.hpp"
#include "geometry/space_vectors.hpp"
#include "refinement/clear_of_side.hpp"
#include "refinement/simplex_lists.hpp"

namespace mesher::detail {

template <int D>
class SimplexLocation : public SimplexLists<D, SimplexLocation<D>> {
  using Base = SimplexLists<D, SimplexLocation<D>>;
  using Base::places_, Base::left_, Base::looked_at_, Base::owned_, Base::star_;

 public:
  using typename Base::Kernel;

  explicit SimplexLocation(std::span<const Point<D>> points)
      : Base(points), next_(points.size(), kNone), owner_(points.size()) {}

  /// All vertices but v are the box's. They go to where they are one by one.
  template <class Visit>
  void start(const Kernel& kernel, std::uint32_t v, std::uint32_t except, Visit&& visit) {
    for (std::uint32_t k = 0; k < places_.size(); ++k) {
      if (k != except) moving_.push_back(k);
    }
    --left_;
    give(kernel, v, visit);
  }
  template <class Takes>
  [[nodiscard]] Found find_early(const Kernel& kernel, std::uint32_t s, const Point<D>& c, double r,
                                 Takes&& takes) {
    std::vector<std::uint32_t>& all = met_;
    all.assign(1, kernel.walk(c, s));
    Found found;
    if (kernel.is_ghost(all[0])) return found;
    seen_.resize(first_.size());
    seen_[all[0]] = true;
    for (std::size_t i = 0; i < all.size() && found.point == kNone; ++i) {
      found = find_in(all[i], c, r, takes);
      for (std::uint32_t k = 0; k <= D; ++k) {
        const std::uint32_t other = kernel.simplices().across(all[i])[k] >> 2;
        if (kernel.is_ghost(other) || seen_[other]) continue;
        if (is_clear_of_side<D>(kernel, all[i], k, c, r)) continue;
        seen_[other] = true;
        all.push_back(other);
      }
    }
    for (const std::uint32_t t : all) seen_[t] = false;
    return found;
  }

  std::uint32_t take(const Kernel& kernel, std::uint32_t v) {
    std::uint32_t is_point = kNone;
    for (const std::uint32_t s : kernel.doomed()) {
      for (std::uint32_t k = first_[s]; k != kNone; k = next_[k]) {
        --owned_[owner_[k]];
        if (places_[k] == kernel.place(v)) {
          is_point = k;
          --left_;
        } else {
          moving_.push_back(k);
        }
      }
      first_[s] = kNone;
    }
    return is_point;
  }
  template <class Visit>
  void give(const Kernel& kernel, std::uint32_t, Visit&& visit) {
    first_.resize(kernel.simplices().places(), kNone);
    std::uint32_t s = kernel.made().front();
    for (const std::uint32_t k : moving_) {
      s = kernel.walk(places_[k], s);
      looked_at_.to_move += D + 1;
      next_[k] = first_[s];
      first_[s] = k;
      owner_[k] = nearest_corner(kernel, s, places_[k]);
      if (owned_[owner_[k]]++ == 0) visit(owner_[k]);
    }
    moving_.clear();
  }
  /// `found.owner`: the simplex.
  void drop(Kernel&, const Found& found) noexcept {
    std::uint32_t* link = &first_[found.owner];
    while (*link != found.point) link = &next_[*link];
    *link = next_[found.point];
    --owned_[owner_[found.point]];
    --left_;
  }

 private:
  friend Base;

  [[nodiscard]] std::uint32_t owner(std::uint32_t point) const noexcept { return owner_[point]; }
  template <class Visit>
  void visit_at(std::uint32_t s, Visit&& visit) const {
    for (std::uint32_t k = first_[s]; k != kNone; k = next_[k]) visit(k);
  }
  template <class Takes>
  [[nodiscard]] Found find_in(std::uint32_t s, const Point<D>& c, double r, Takes&& takes) {
    for (std::uint32_t k = first_[s]; k != kNone; k = next_[k]) {
      ++looked_at_.to_find;
      if (squared_distance(places_[k], c) <= r * r && takes(k)) return {k, s};
    }
    return {};
  }
  [[nodiscard]] static std::uint32_t nearest_corner(const Kernel& kernel, std::uint32_t s,
                                                    const Point<D>& p) {
    const auto& corners = kernel.simplices().corners(s);
    std::uint32_t nearest = corners[0];
    for (const std::uint32_t w : corners) {
      if (squared_distance(p, kernel.place(w)) < squared_distance(p, kernel.place(nearest))) {
        nearest = w;
      }
    }
    return nearest;
  }

  std::vector<std::uint32_t> next_, owner_;  // by point: of the same simplex; a vertex
  std::vector<std::uint32_t> first_;         // by simplex
  std::vector<std::uint32_t> moving_, met_;  // scratch
  std::vector<bool> seen_;                   // scratch: by simplex
};

}  // namespace mesher::detail
