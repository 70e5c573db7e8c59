// Measures of simplices, and lattices.
#include "refinement/large_simplices.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/box.hpp"
#include "geometry/plane_vectors.hpp"
#include "geometry/space_vectors.hpp"

namespace mesher::detail {

namespace {

// Of a lattice's points from all vertices, in pitches. In the lattice it is sqrt(3) / 2 or more.
constexpr double kFromVertices = 0.5;
constexpr std::size_t kMostPlaces = 4;

double measure(const CornersOf<2>& p) {
  const Point<2> ab = minus(p[1], p[0]), ac = minus(p[2], p[0]);
  return std::abs(ab[0] * ac[1] - ab[1] * ac[0]) / 2;
}
#ifndef MESHER_PLANE_ONLY
double measure(const CornersOf<3>& p) {
  return std::abs(dot(minus(p[1], p[0]), cross(minus(p[2], p[0]), minus(p[3], p[0])))) / 6;
}
#endif

}  // namespace

template <int D>
LargeSimplices<D>::LargeSimplices(std::shared_ptr<const Limits<D>> limits, double least,
                                  double growth)
    : limits_(std::move(limits)), growth_(growth) {
  if (limits_ != nullptr) least_ = std::min(least, limits_->least_measure());
}

template <int D>
CornersOf<D> LargeSimplices<D>::corners_of(const Kernel& kernel, std::uint32_t s) {
  CornersOf<D> places;
  const auto& corners = kernel.simplices().corners(s);
  for (std::size_t i = 0; i <= D; ++i) places[i] = kernel.place(corners[i]);
  return places;
}
template <int D>
double LargeSimplices<D>::measure_of(const CornersOf<D>& corners) {
  return measure(corners);
}

/// The size of simplices with this measure. The same on every machine.
template <int D>
double LargeSimplices<D>::size_of(double measure) {
  constexpr double kOfSpacing = D == 2 ? 1.0051688494283456 : 0.89089871814033927;
  return kOfSpacing * Lattice<D>::spacing(measure);
}

template <int D>
void LargeSimplices<D>::look_at(const Kernel& kernel, std::uint32_t s) {
  if (s >= age_.size()) age_.resize(kernel.simplices().places());
  if (kernel.is_ghost(s)) return;
  double least = least_;
  if (growth_.any()) least = std::min(least, measure_of_size<D>(growth_.least(kernel, s)));
  const double own = measure_of(corners_of(kernel, s));
  if (own > least) queue_.insert(1 / own, {s, age_[s]});
}

template <int D>
void LargeSimplices<D>::before_fill(const Kernel& kernel, std::uint32_t v) {
  for (const std::uint32_t s : kernel.doomed()) ++age_[s];
  if (growth_.any()) growth_.add_dug(kernel, v, std::exchange(dug_size_, Limits<D>::kNone));
}

template <int D>
void LargeSimplices<D>::after_fill(Kernel& kernel) {
  if (growth_.any()) growth_.spread(kernel, [&](std::uint32_t s) { look_at(kernel, s); });
}

template <int D>
double LargeSimplices<D>::graded(const Kernel& kernel, std::uint32_t s, const Point<D>& middle,
                                 double limit) const {
  if (!growth_.any()) return limit;
  if (limits_->nearest_in_domain(middle) != middle) return limit;
  return std::min(limit, measure_of_size<D>(growth_.at(kernel, s, middle)));
}

/// By their distance from its centre.
template <int D>
const std::vector<Point<D>>& LargeSimplices<D>::places(const Kernel& kernel, std::uint32_t s) {
  places_.clear();
  found_.clear();
  const CornersOf<D> corners = corners_of(kernel, s);
  pitch_ = limits_->pitch_for_measure(centroid(corners), limit_, is_graded_);
  if (!(pitch_ < Limits<D>::kNone)) return places_;
  const Point<D>& centre = kernel.simplices().ball(s).centre;
  const double radius2 = squared_distance(centre, corners[0]);
  const double clear2 = kFromVertices * kFromVertices * pitch_ * pitch_;
  const double near = std::min(std::sqrt(radius2), pitch_);
  const Lattice<D> lattice(pitch_);
  lattice.visit_in(around(centre, near), [&](const auto& node) {
    const Point<D> p = lattice.place(node);
    const double distance2 = squared_distance(p, centre);
    const bool is_apart = std::all_of(corners.begin(), corners.end(), [&](const Point<D>& q) {
      return squared_distance(p, q) >= clear2;
    });
    const bool is_limited = limits_->nearest_in_domain(p) == p;
    if (distance2 < radius2 && is_apart && is_limited) found_.push_back({distance2, p});
    return false;
  });
  const std::size_t count = std::min(found_.size(), kMostPlaces);
  std::partial_sort(found_.begin(), found_.begin() + static_cast<std::ptrdiff_t>(count),
                    found_.end(), [](const Place& p, const Place& q) {
                      return p.distance2 != q.distance2 ? p.distance2 < q.distance2 : p.at < q.at;
                    });
  for (std::size_t i = 0; i < count; ++i) places_.push_back(found_[i].at);
  return places_;
}

template <int D>
bool LargeSimplices<D>::is_clear(const Kernel& kernel, std::uint32_t v) const {
  const double clear2 = kFromVertices * kFromVertices * pitch_ * pitch_;
  bool is_clear = true;
  kernel.for_each_in_link([&](std::uint32_t w) {
    if (w != kInfinite && squared_distance(kernel.place(w), kernel.place(v)) < clear2) {
      is_clear = false;
    }
  });
  return is_clear;
}

template class LargeSimplices<2>;
#ifndef MESHER_PLANE_ONLY
template class LargeSimplices<3>;
#endif

}  // namespace mesher::detail
