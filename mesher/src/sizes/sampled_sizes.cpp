// Fields of sizes: functions of bounded slope, and backgrounds.
#include "sizes/sampled_sizes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/box.hpp"
#include "geometry/input_point.hpp"
#include "geometry/plane_vectors.hpp"
#include "geometry/power_of_two.hpp"
#include "geometry/space_vectors.hpp"
#include "mesher/delaunay.hpp"
#include "mesher/error.hpp"
#include "mesher/sizes.hpp"
#include "sizes/facet_sizes.hpp"

namespace mesher {

template <int D>
SizeRange SlopedSizes<D>::range(const Box<D>& box) const {
  Point<D> middle;
  for (std::size_t i = 0; i < D; ++i) middle[i] = (box.lo[i] + box.hi[i]) / 2;
  const double radius = std::sqrt(detail::squared_distance(box.hi, middle));
  const double here = size_(middle), change = slope_ * radius * (1 + 0x1p-40);
  return {std::max(here - change, least_), here + change};
}
template class SlopedSizes<2>;
#ifndef MESHER_PLANE_ONLY
template class SlopedSizes<3>;
#endif

namespace {

using detail::Facet;

template <int D>
Point<D> nearest_in(const Box<D>& cube, Point<D> p) {
  for (std::size_t i = 0; i < D; ++i) p[i] = std::clamp(p[i], cube.lo[i], cube.hi[i]);
  return p;
}

template <int D>
class SampledSizes final : public detail::FacetSizes<D> {
 public:
  SampledSizes(const Box<D>& cube, std::vector<Facet<D>> facets,
               const std::vector<SizeSample<D>>& samples)
      : detail::FacetSizes<D>(std::move(facets)), cube_(cube), samples_(samples) {}

  [[nodiscard]] const std::vector<SizeSample<D>>& samples() const noexcept { return samples_; }

  [[nodiscard]] double at(const Point<D>& p) const override {
    return detail::FacetSizes<D>::at(nearest_in<D>(cube_, p));
  }
  [[nodiscard]] SizeRange range(const Box<D>& box) const override {
    return detail::FacetSizes<D>::range(
        {nearest_in<D>(cube_, box.lo), nearest_in<D>(cube_, box.hi)});
  }

 private:
  Box<D> cube_;
  std::vector<SizeSample<D>> samples_;
};

template <int D>
void check(const std::vector<SizeSample<D>>& samples) {
  if (samples.empty()) throw Error(ErrorCode::bad_option, "a background without samples");
  for (const auto& s : samples) {
    if (s.h > 0 && std::isfinite(s.h)) continue;
    throw Error(ErrorCode::bad_option,
                "the size at " + detail::place_text(s.at) + " is not above 0 and finite");
  }
}

// A square or a cube, four times as wide as what the samples lie in; its side is a power of two.
template <int D>
Box<D> cube_around(const std::vector<SizeSample<D>>& samples) {
  Box<D> box{samples.front().at, samples.front().at};
  for (const auto& s : samples) detail::grow(box, s.at);
  double largest = 0x1p-90, extent = 0;
  for (std::size_t i = 0; i < D; ++i) {
    largest = std::max({largest, std::abs(box.lo[i]), std::abs(box.hi[i])});
    extent = std::max(extent, box.hi[i] - box.lo[i]);
  }
  const double half = 2 * detail::power_of_two_from(std::max(extent, largest * 0x1p-20));
  Box<D> cube;
  for (std::size_t i = 0; i < D; ++i) {
    const double middle = box.lo[i] + (box.hi[i] - box.lo[i]) / 2;
    cube.lo[i] = middle - half;
    cube.hi[i] = middle + half;
  }
  return cube;
}

template <int D>
double nearest_size(const std::vector<SizeSample<D>>& samples, const Point<D>& p) {
  const auto nearer = [&](const auto& s, const auto& t) {
    const double ds = detail::squared_distance(s.at, p), dt = detail::squared_distance(t.at, p);
    return ds != dt ? ds < dt : s.at < t.at;
  };
  return std::min_element(samples.begin(), samples.end(), nearer)->h;
}

// The corners of a box of samples, with the sizes of the samples nearest to them, and the samples.
template <int D>
std::vector<SizeSample<D>> with_corners(const std::vector<SizeSample<D>>& samples,
                                        const Box<D>& box) {
  std::vector<SizeSample<D>> all;
  for (std::size_t c = 0; c < std::size_t{1} << D; ++c) {
    Point<D> p;
    for (std::size_t i = 0; i < D; ++i) p[i] = ((c >> i) & 1) != 0 ? box.hi[i] : box.lo[i];
    all.push_back({p, nearest_size<D>(samples, p)});
  }
  all.insert(all.end(), samples.begin(), samples.end());
  return all;
}

// Its corners by their coordinates, the last two in the order that leaves it positively oriented:
// what is between them is the same to the last bit in whatever order samples are.
template <int D>
Facet<D> facet_of(std::array<SizeSample<D>, D + 1> corners) {
  const auto before = [](const auto& s, const auto& t) { return s.at < t.at; };
  bool turned = false;
  for (std::size_t i = 0; i <= D; ++i) {
    for (std::size_t j = 0; j < i; ++j) turned = turned != before(corners[i], corners[j]);
  }
  std::sort(corners.begin(), corners.end(), before);
  if (turned) std::swap(corners[D - 1], corners[D]);
  detail::CornersOf<D> at;
  typename Facet<D>::Sizes sizes;
  for (std::size_t i = 0; i <= D; ++i) {
    at[i] = corners[i].at;
    sizes[i] = corners[i].h;
  }
  return {at, sizes};
}

}  // namespace

template <int D>
std::shared_ptr<const SizeField<D>> sampled_sizes(
    const std::vector<std::type_identity_t<SizeSample<D>>>& samples) {
  check<D>(samples);
  const Box<D> cube = cube_around<D>(samples);
  const auto all = with_corners<D>(samples, cube);
  std::vector<Point<D>> places;
  for (const auto& s : all) places.push_back(s.at);
  const Delaunay<D> triangulation = delaunay<D>(places);
  if (!triangulation.duplicates.empty()) {
    throw Error(
        ErrorCode::duplicate_point,
        "two sizes at " + detail::place_text(places[triangulation.duplicates.front().point]));
  }
  std::vector<Facet<D>> facets;
  facets.reserve(triangulation.simplices.size());
  for (const auto& simplex : triangulation.simplices) {
    std::array<SizeSample<D>, D + 1> corners;
    for (std::size_t i = 0; i <= D; ++i) corners[i] = all[simplex[i]];
    facets.push_back(facet_of<D>(corners));
  }
  return std::make_shared<SampledSizes<D>>(cube, std::move(facets), samples);
}
template std::shared_ptr<const SizeField<2>> sampled_sizes<2>(const std::vector<SizeSample<2>>&);
#ifndef MESHER_PLANE_ONLY
template std::shared_ptr<const SizeField<3>> sampled_sizes<3>(const std::vector<SizeSample<3>>&);
#endif

template <int D>
const std::vector<SizeSample<D>>* detail::samples_of(const SizeField<D>& field) {
  const auto* sampled = dynamic_cast<const SampledSizes<D>*>(&field);
  return sampled == nullptr ? nullptr : &sampled->samples();
}
template const std::vector<SizeSample<2>>* detail::samples_of(const SizeField<2>&);
#ifndef MESHER_PLANE_ONLY
template const std::vector<SizeSample<3>>* detail::samples_of(const SizeField<3>&);
#endif

}  // namespace mesher
