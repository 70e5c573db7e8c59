// Fields of sizes: functions of bounded slope, and backgrounds.
#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/box.hpp"
#include "geometry/grid.hpp"
#include "geometry/plane.hpp"
#include "input.hpp"
#include "mesher/error.hpp"
#include "mesher/sizes.hpp"
#include "sizes/facet_sizes.hpp"
#include "sizes/sample_triangulation.hpp"

namespace mesher {

template <int D>
SizeRange SlopedSizes<D>::range(const Box<D>& box) const {
  Point<D> middle;
  double radius = 0;
  for (std::size_t i = 0; i < D; ++i) {
    middle[i] = (box.lo[i] + box.hi[i]) / 2;
    radius = std::hypot(radius, box.hi[i] - middle[i]);
  }
  const double here = size_(middle), change = slope_ * radius * (1 + 0x1p-40);
  return {std::max(here - change, least_), here + change};
}
template class SlopedSizes<2>;
template class SlopedSizes<3>;

namespace {

using detail::Facet;
using detail::SampleTriangulation;

Point<2> nearest_in(const Box<2>& square, const Point<2>& p) {
  return {std::clamp(p[0], square.lo[0], square.hi[0]),
          std::clamp(p[1], square.lo[1], square.hi[1])};
}

class SampledSizes final : public detail::FacetSizes {
 public:
  SampledSizes(const Box<2>& square, std::vector<Facet> facets)
      : FacetSizes(std::move(facets)), square_(square) {}

  [[nodiscard]] double at(const Point<2>& p) const override {
    return FacetSizes::at(nearest_in(square_, p));
  }
  [[nodiscard]] SizeRange range(const Box<2>& box) const override {
    return FacetSizes::range({nearest_in(square_, box.lo), nearest_in(square_, box.hi)});
  }

 private:
  Box<2> square_;
};

void check(const std::vector<SizeSample>& samples) {
  if (samples.empty()) throw Error(ErrorCode::bad_option, "a background without samples");
  for (const SizeSample& s : samples) {
    if (s.h > 0 && std::isfinite(s.h)) continue;
    throw Error(ErrorCode::bad_option,
                "the size at " + detail::place_text(s.at) + " is not above 0 and finite");
  }
}

// Four times as wide as what the samples lie in; its side is a power of two.
Box<2> square_around(const std::vector<SizeSample>& samples) {
  Box<2> box{samples.front().at, samples.front().at};
  for (const SizeSample& s : samples) detail::grow(box, s.at);
  double largest = 0x1p-90, extent = 0;
  for (std::size_t i = 0; i < 2; ++i) {
    largest = std::max({largest, std::abs(box.lo[i]), std::abs(box.hi[i])});
    extent = std::max(extent, box.hi[i] - box.lo[i]);
  }
  const double half = std::exp2(std::ceil(std::log2(std::max(extent, largest * 0x1p-20)))) * 2;
  Box<2> square;
  for (std::size_t i = 0; i < 2; ++i) {
    const double middle = box.lo[i] + (box.hi[i] - box.lo[i]) / 2;
    square.lo[i] = middle - half;
    square.hi[i] = middle + half;
  }
  return square;
}

double nearest_size(const std::vector<SizeSample>& samples, const Point<2>& p) {
  const auto nearer = [&](const SizeSample& s, const SizeSample& t) {
    const double ds = detail::squared_distance(s.at, p), dt = detail::squared_distance(t.at, p);
    return ds != dt ? ds < dt : s.at < t.at;
  };
  return std::min_element(samples.begin(), samples.end(), nearer)->h;
}

}  // namespace

std::shared_ptr<const SizeField<2>> sampled_sizes(const std::vector<SizeSample>& samples) {
  check(samples);
  const Box<2> square = square_around(samples);
  std::vector<Point<2>> points{
      square.lo, {square.hi[0], square.lo[1]}, square.hi, {square.lo[0], square.hi[1]}};
  std::vector<double> sizes;
  for (const Point<2>& p : points) sizes.push_back(nearest_size(samples, p));
  std::vector<Point<2>> places;
  for (const SizeSample& s : samples) places.push_back(s.at);
  const double side = square.hi[0] - square.lo[0];
  for (const std::size_t i : detail::morton_order(places, {square.lo, side})) {
    points.push_back(samples[i].at);
    sizes.push_back(samples[i].h);
  }
  std::vector<Facet> facets;
  for (const auto& [a, b, c] : SampleTriangulation(points).triangles()) {
    facets.emplace_back(std::array{points[a], points[b], points[c]},
                        std::array{sizes[a], sizes[b], sizes[c]});
  }
  return std::make_shared<SampledSizes>(square, std::move(facets));
}

}  // namespace mesher
