// The points in each Voronoi cell, in concentric shells around its vertex [3.1].
//
// Of a shell's points the squares of the distances have one exponent, so shells grow by sqrt(2).
// What is nearer to the vertex than half of the way to a new one stays, shell by shell, without a
// look; and a ball meets the shells between its nearest and farthest place alone. VoronoiLists has
// the same verbs.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/plane_vectors.hpp"
#include "geometry/space_vectors.hpp"
#include "refinement/location.hpp"

namespace mesher::detail {

template <int D>
class ShellLists : public WaitingPoints<D> {
  using Base = WaitingPoints<D>;
  using Base::places_, Base::left_, Base::looked_at_;

 public:
  explicit ShellLists(std::span<const Point<D>> points) : Base(points), listed_(points.size()) {}

  [[nodiscard]] bool is_crowded(std::uint32_t v) const noexcept { return outermost_[v] != kNone; }
  [[nodiscard]] std::uint32_t any(std::uint32_t v) const noexcept {
    return shells_[outermost_[v]].first;
  }
  [[nodiscard]] std::uint32_t farthest(std::uint32_t v, const Point<D>& /*p*/) const noexcept {
    std::uint32_t best = any(v);
    for (std::uint32_t k = best; k != kNone; k = listed_[k].next) {
      ++looked_at_.to_find;
      if (listed_[k].distance2 > listed_[best].distance2) best = k;
    }
    return best;
  }
  void drop(std::uint32_t v, std::uint32_t point) noexcept {
    std::uint32_t* shell = &outermost_[v];
    while (shells_[*shell].exponent != exponent_of(listed_[point].distance2)) {
      shell = &shells_[*shell].inner;
    }
    std::uint32_t* link = &shells_[*shell].first;
    while (*link != point) link = &listed_[*link].next;
    *link = listed_[point].next;
    if (shells_[*shell].first == kNone) release(shell);
    --left_;
  }

  void add_vertex() { outermost_.push_back(kNone); }
  void drop_vertex() noexcept { outermost_.pop_back(); }
  void start(std::uint32_t v, const Point<D>& p, std::uint32_t except) {
    for (auto k = static_cast<std::uint32_t>(places_.size()); k-- > 0;) {
      if (k != except) put(v, k, squared_distance(places_[k], p));
    }
    --left_;
  }
  std::uint32_t relocate(std::uint32_t v, const Point<D>& p, std::uint32_t w, const Point<D>& q) {
    const int nearest = exponent_of(squared_distance(p, q) / 4 * kDown);
    std::uint32_t was_there = kNone;
    for (std::uint32_t* shell = &outermost_[w];
         *shell != kNone && shells_[*shell].exponent >= nearest;) {
      const std::uint32_t at = *shell;
      std::uint32_t kept = kNone;
      for (std::uint32_t k = shells_[at].first, next; k != kNone; k = next) {
        next = listed_[k].next;
        ++looked_at_.to_move;
        const double d2 = squared_distance(places_[k], p);
        if (!(d2 < listed_[k].distance2)) {
          listed_[k].next = kept;
          kept = k;
        } else if (places_[k] == p) {
          was_there = k;
          --left_;
        } else {
          moving_.push_back({k, d2});
        }
      }
      shells_[at].first = kept;
      if (kept == kNone) {
        release(shell);
      } else {
        shell = &shells_[at].inner;
      }
    }
    for (const Moving& m : moving_) put(v, m.point, m.distance2);
    moving_.clear();
    return was_there;
  }
  [[nodiscard]] std::uint32_t find(std::uint32_t w, const Point<D>& q, const Point<D>& c,
                                   double r) const noexcept {
    if (outermost_[w] == kNone) return kNone;
    const double far = std::sqrt(squared_distance(c, q));
    const double nearest = std::max(far - r, 0.0) * kDown, farthest = (far + r) * kUp;
    const int lowest = exponent_of(nearest * nearest), highest = exponent_of(farthest * farthest);
    for (std::uint32_t s = outermost_[w]; s != kNone && shells_[s].exponent >= lowest;
         s = shells_[s].inner) {
      if (shells_[s].exponent > highest) continue;
      for (std::uint32_t k = shells_[s].first; k != kNone; k = listed_[k].next) {
        ++looked_at_.to_find;
        if (squared_distance(places_[k], c) <= r * r) return k;
      }
    }
    return kNone;
  }

 private:
  static constexpr double kUp = 1 + 0x1p-40, kDown = 1 - 0x1p-40;

  struct Listed {
    double distance2 = 0;  // to the vertex
    std::uint32_t next = kNone;
  };
  struct Shell {
    int exponent = 0;
    std::uint32_t first = kNone;
    std::uint32_t inner = kNone;  // the next smaller one; free ones: the next free one
  };
  struct Moving {
    std::uint32_t point;
    double distance2;
  };

  static int exponent_of(double d2) noexcept {
    return static_cast<int>(std::bit_cast<std::uint64_t>(d2) >> 52);
  }
  void put(std::uint32_t v, std::uint32_t point, double d2) {
    if (free_ == kNone) {
      shells_.emplace_back();  // first of all: links are in shells
      free_ = static_cast<std::uint32_t>(shells_.size() - 1);
    }
    const int exponent = exponent_of(d2);
    std::uint32_t* shell = &outermost_[v];
    while (*shell != kNone && shells_[*shell].exponent > exponent) shell = &shells_[*shell].inner;
    if (*shell == kNone || shells_[*shell].exponent != exponent) {
      const std::uint32_t inner = *shell;
      *shell = free_;
      free_ = shells_[free_].inner;
      shells_[*shell] = {exponent, kNone, inner};
    }
    listed_[point] = {d2, shells_[*shell].first};
    shells_[*shell].first = point;
  }
  void release(std::uint32_t* shell) noexcept {
    const std::uint32_t gone = *shell;
    *shell = shells_[gone].inner;
    shells_[gone].inner = free_;
    free_ = gone;
  }

  std::vector<Listed> listed_;                   // by point
  std::vector<std::uint32_t> outermost_{kNone};  // by vertex
  std::vector<Shell> shells_;
  std::uint32_t free_ = kNone;
  std::vector<Moving> moving_;  // scratch
};

}  // namespace mesher::detail
