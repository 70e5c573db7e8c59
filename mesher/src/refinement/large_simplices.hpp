// The simplices of a refined mesh that are larger than the limits of size allow, and where they are
// split [rules A7, here without edits].
//
// Once no simplex is poor, the largest is split, until none is too large. It is split at a point of
// the matching lattice (sizes/lattice.hpp) if that suits, else at its centre. Points of one lattice
// are not too near to each other, and their Delaunay simplices are as large as is allowed, so
// there are fewer vertices than of centres alone.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "delaunay/kernel.hpp"
#include "geometry/centroid.hpp"
#include "refinement/bucketed_queue.hpp"
#include "refinement/growth.hpp"
#include "sizes/limits.hpp"

namespace mesher::detail {

template <int D>
class LargeSimplices {
 public:
  using Kernel = DelaunayKernel<D, BallLayout<D>>;

  /// `limits`: null, or what limits simplices. `least`: no measure of a region is less.
  LargeSimplices(std::shared_ptr<const Limits<D>> limits, double least, double growth);

  [[nodiscard]] bool any() const noexcept { return limits_ != nullptr; }
  [[nodiscard]] bool started() const noexcept { return started_; }
  /// The next that is too large; kNone: there is none. `limit(s, measure)`: what is allowed, given
  /// what is allowed where its centroid is, or nothing: any size is.
  template <class Limit>
  [[nodiscard]] std::uint32_t take(Kernel& kernel, Limit&& limit);
  /// Of a simplex that is new, or that was taken and is not split. Requires: started().
  void look_at(const Kernel& kernel, std::uint32_t s);
  /// Of a vertex that is dug. Requires: started().
  void before_fill(const Kernel& kernel, std::uint32_t v);
  /// Of what was made. Requires: started().
  void after_fill(Kernel& kernel);
  /// Finds the points of the lattice in the ball of the simplex that was taken.
  [[nodiscard]] const std::vector<Point<D>>& places(const Kernel& kernel, std::uint32_t s);
  /// Whether a vertex that is dug at one of them is as far from others as they are to be.
  [[nodiscard]] bool is_clear(const Kernel& kernel, std::uint32_t v) const;

 private:
  struct Entry {
    std::uint32_t simplex, age;
  };
  // Nearest first.
  struct Place {
    double distance2;  // to the centre
    Point<D> at;
  };
  [[nodiscard]] static CornersOf<D> corners_of(const Kernel& kernel, std::uint32_t s);
  [[nodiscard]] static double measure_of(const CornersOf<D>& corners);
  [[nodiscard]] static double size_of(double measure);
  template <class Limit>
  void start(Kernel& kernel, Limit&& limit);
  [[nodiscard]] double graded(const Kernel& kernel, std::uint32_t s, const Point<D>& middle,
                              double limit) const;

  std::shared_ptr<const Limits<D>> limits_;
  double least_ = 0;  // nothing that is not larger is too large, but for growth
  Growth<D> growth_;
  bool started_ = false;
  std::vector<std::uint32_t> age_;  // by simplex: how many there were
  ComputedBuckets<Entry> queue_;
  double limit_ = 0, pitch_ = 0;        // of what was taken
  bool is_graded_ = false;              // and that the limit is one of growth
  double dug_size_ = Limits<D>::kNone;  // of the vertex that will split what was taken
  std::vector<Place> found_;            // scratch
  std::vector<Point<D>> places_;
};

template <int D>
template <class Limit>
void LargeSimplices<D>::start(Kernel& kernel, Limit&& limit) {
  started_ = true;
  if (growth_.any()) {
    growth_.start(kernel);
    kernel.for_each_finite([&](std::uint32_t s) {
      const auto allowed = limit(s, limits_->measure(centroid(corners_of(kernel, s))));
      if (allowed) growth_.bound(kernel, s, size_of(*allowed));
    });
    growth_.spread(kernel, [](std::uint32_t) {});
  }
  kernel.for_each_finite([&](std::uint32_t s) { look_at(kernel, s); });
}

template <int D>
template <class Limit>
std::uint32_t LargeSimplices<D>::take(Kernel& kernel, Limit&& limit) {
  // Measures are computed to within 2^-45: what passes is not larger in exact arithmetic.
  constexpr double kLargest = 1 - 0x1p-40;
  if (!started_) start(kernel, limit);
  while (!queue_.empty()) {
    const Entry entry = queue_.delete_min();
    const std::uint32_t s = entry.simplex;
    if (age_[s] != entry.age) continue;
    const CornersOf<D> corners = corners_of(kernel, s);
    const Point<D> middle = centroid(corners);
    const std::optional<double> allowed = limit(s, limits_->measure(middle));
    if (!allowed) continue;
    limit_ = graded(kernel, s, middle, *allowed);
    is_graded_ = limit_ < *allowed;
    if (!(measure_of(corners) > limit_ * kLargest)) continue;
    dug_size_ = size_of(limit_);
    return s;
  }
  return kNone;
}

}  // namespace mesher::detail
