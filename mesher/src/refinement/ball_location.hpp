// Each point waits at all simplices that its insertion would take out: those in whose circumballs
// it is [3.1, "By circumball"].
//
// So a query looks at one list. The ball of a new simplex is in those of the two simplices on both
// sides of the facet that it is made of, so its list is made from theirs. A point is on as many
// lists as its insertion takes simplices out.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "geometry/plane_vectors.hpp"
#include "geometry/space_vectors.hpp"
#include "refinement/simplex_lists.hpp"

namespace mesher::detail {

template <int D>
class BallLocation : public SimplexLists<D, BallLocation<D>> {
  using Base = SimplexLists<D, BallLocation<D>>;
  using Base::places_, Base::left_, Base::looked_at_, Base::owned_, Base::star_;

 public:
  using typename Base::Kernel;

  explicit BallLocation(std::span<const Point<D>> points) : Base(points), points_(points.size()) {}

  template <class Visit>
  void start(const Kernel& kernel, std::uint32_t v, std::uint32_t except, Visit&& visit) {
    first_.resize(kernel.simplices().places(), kNone);
    std::uint32_t s = kernel.made().front();
    for (std::uint32_t k = 0; k < places_.size(); ++k) {
      if (k == except) continue;
      s = kernel.walk(places_[k], s);
      add_from(kernel, k, s);
    }
    --left_;
    for (std::uint32_t w = 1; w <= v; ++w) {
      if (owned_[w] != 0) visit(w);
    }
  }
  /// What is in B(c, k r) is in the ball of s.
  template <class Takes>
  [[nodiscard]] Found find_early(const Kernel&, std::uint32_t s, const Point<D>& c, double r,
                                 Takes&& takes) {
    for (std::uint32_t i = first_[s]; i != kNone; i = entries_[i].next) {
      ++looked_at_.to_find;
      const std::uint32_t point = entries_[i].point;
      if (squared_distance(places_[point], c) <= r * r && takes(point)) return {point, s};
    }
    return {};
  }

  std::uint32_t take(const Kernel& kernel, std::uint32_t v) {
    taken_.clear();
    facets_.clear();
    std::uint32_t is_point = kNone;
    for (const std::uint32_t s : kernel.doomed()) {
      const auto begin = static_cast<std::uint32_t>(taken_.size());
      while (first_[s] != kNone) {
        const std::uint32_t point = remove_first(s);
        if (places_[point] == kernel.place(v)) {
          is_point = point;
        } else {
          taken_.push_back(point);
        }
      }
      const auto end = static_cast<std::uint32_t>(taken_.size());
      for (const std::uint32_t across : kernel.simplices().across(s)) {
        if (!kernel.is_doomed(across >> 2)) facets_.push_back({across, begin, end});
      }
    }
    if (is_point != kNone) forget(is_point);
    return is_point;
  }
  template <class Visit>
  void give(const Kernel& kernel, std::uint32_t v, Visit&& visit) {
    const auto& simplices = kernel.simplices();
    first_.resize(simplices.places(), kNone);
    for (const Facet& facet : facets_) {
      const std::uint32_t outer = facet.across >> 2;
      const std::uint32_t made = simplices.across(outer)[facet.across & 3] >> 2;
      if (kernel.is_ghost(made)) continue;
      ++asked_;
      const auto look_at = [&](std::uint32_t point) {
        if (std::exchange(points_[point].asked, asked_) == asked_) return;
        if (add_if_in_ball(kernel, point, made)) note_near(kernel, point, v);
      };
      for (std::uint32_t i = facet.begin; i < facet.end; ++i) look_at(taken_[i]);
      for (std::uint32_t i = first_[outer]; i != kNone; i = entries_[i].next) {
        look_at(entries_[i].point);
      }
    }
    if (this->is_crowded(v)) visit(v);
  }
  /// A point is where a vertex came without taking it: it cannot be, the vertex takes the same
  /// simplices out. `found.owner`: a simplex.
  void drop(Kernel& kernel, const Found& found) {
    for (const std::uint32_t w : kernel.simplices().corners(found.owner)) {
      if (w == kInfinite) continue;
      kernel.find_in_star(w, star_, [](std::uint32_t) { return false; });
      for (const std::uint32_t s : star_) remove(s, found.point);
    }
    forget(found.point);
  }

 private:
  friend Base;

  struct Waiting {
    double distance2 = std::numeric_limits<double>::infinity();  // to the nearest vertex
    std::uint32_t nearest = 0;
    std::uint32_t asked = 0;  // for which facet last
  };
  struct Entry {
    std::uint32_t point, next;
  };
  // Between what goes, with these points of taken_, and what stays.
  struct Facet {
    std::uint32_t across, begin, end;
  };

  [[nodiscard]] std::uint32_t owner(std::uint32_t point) const noexcept {
    return points_[point].nearest;
  }
  template <class Visit>
  void visit_at(std::uint32_t s, Visit&& visit) const {
    for (std::uint32_t i = first_[s]; i != kNone; i = entries_[i].next) visit(entries_[i].point);
  }
  void forget(std::uint32_t point) noexcept {
    --owned_[points_[point].nearest];
    --left_;
  }
  // To s, which it is in, and those around it. The vertex nearest to it is a corner of one.
  void add_from(const Kernel& kernel, std::uint32_t point, std::uint32_t s) {
    std::vector<std::uint32_t>& asked = star_;
    asked.assign(1, s);
    for (std::size_t i = 0; i < asked.size(); ++i) {
      const std::uint32_t t = asked[i];
      if (kernel.is_ghost(t) || !add_if_in_ball(kernel, point, t)) continue;
      for (const std::uint32_t w : kernel.simplices().corners(t)) note_near(kernel, point, w);
      for (const std::uint32_t across : kernel.simplices().across(t)) {
        if (std::find(asked.begin(), asked.end(), across >> 2) != asked.end()) continue;
        asked.push_back(across >> 2);
      }
    }
  }
  bool add_if_in_ball(const Kernel& kernel, std::uint32_t point, std::uint32_t s) {
    ++looked_at_.to_move;
    if (!kernel.conflicts(s, places_[point])) return false;
    if (free_ == kNone) {
      entries_.push_back({kNone, kNone});
      free_ = static_cast<std::uint32_t>(entries_.size() - 1);
    }
    const std::uint32_t entry = free_;
    free_ = entries_[entry].next;
    entries_[entry] = {point, first_[s]};
    first_[s] = entry;
    return true;
  }
  void note_near(const Kernel& kernel, std::uint32_t point, std::uint32_t v) noexcept {
    Waiting& p = points_[point];
    const double d2 = squared_distance(places_[point], kernel.place(v));
    if (!(d2 < p.distance2)) return;
    if (p.nearest != 0) --owned_[p.nearest];
    p.nearest = v;
    p.distance2 = d2;
    ++owned_[v];
  }
  std::uint32_t remove_first(std::uint32_t s) noexcept {
    const std::uint32_t entry = first_[s];
    first_[s] = entries_[entry].next;
    entries_[entry].next = free_;
    free_ = entry;
    return entries_[entry].point;
  }
  void remove(std::uint32_t s, std::uint32_t point) noexcept {
    std::uint32_t* link = &first_[s];
    while (*link != kNone && entries_[*link].point != point) link = &entries_[*link].next;
    if (*link == kNone) return;
    const std::uint32_t entry = *link;
    *link = entries_[entry].next;
    entries_[entry].next = free_;
    free_ = entry;
  }

  std::vector<Waiting> points_;
  std::vector<std::uint32_t> first_;  // by simplex: entries
  std::vector<Entry> entries_;
  std::uint32_t free_ = kNone;
  std::vector<std::uint32_t> taken_;  // scratch
  std::vector<Facet> facets_;         // scratch
  std::uint32_t asked_ = 0;           // counts facets
};

}  // namespace mesher::detail
