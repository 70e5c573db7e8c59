// Backgrounds: sizes that are linear between samples, in the plane and in space.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "geometry/box.hpp"
#include "geometry/plane_vectors.hpp"
#include "geometry/space_vectors.hpp"
#include "mesher/delaunay.hpp"
#include "mesher/error.hpp"
#include "mesher/extra/generate.hpp"
#include "mesher/sizes.hpp"
#include "sizes/tile.hpp"

namespace {

using mesher::Point;
using mesher::SplitMix64;

template <int D>
using Samples = std::vector<mesher::SizeSample<D>>;

template <int D>
Point<D> random_point(SplitMix64& random, double lo, double hi) {
  Point<D> p;
  for (double& x : p) x = lo + (hi - lo) * random.unit();
  return p;
}

// Half of them on a lattice, whose places are rounded: many are on one sphere, or nearly.
template <int D>
std::vector<Point<D>> places(std::uint64_t seed, int count, double unit) {
  SplitMix64 random(seed);
  std::vector<Point<D>> all;
  for (int i = 0; i < count; ++i) {
    Point<D> p = random_point<D>(random, 0, D == 2 ? 20 : 7);
    for (double& x : p) x = i % 2 == 0 ? std::floor(x) * unit : x * unit;
    if (std::find(all.begin(), all.end(), p) == all.end()) all.push_back(p);
  }
  return all;
}

// With the corners of a box, four times as wide as what they are in: they have the nearest sizes.
template <int D>
Samples<D> with_corners(Samples<D> samples) {
  mesher::Box<D> box{samples[0].at, samples[0].at};
  for (const auto& s : samples) mesher::detail::grow(box, s.at);
  const double half = 2 * std::exp2(std::ceil(std::log2(mesher::detail::longest_side(box))));
  const Point<D> middle = mesher::detail::middle_of(box);
  Samples<D> corners;
  for (unsigned c = 0; c < 1U << D; ++c) {
    Point<D> p = middle;
    for (std::size_t i = 0; i < D; ++i) p[i] += ((c >> i) & 1U) != 0 ? half : -half;
    const auto nearer = [&](const auto& s, const auto& t) {
      return mesher::detail::squared_distance(s.at, p) < mesher::detail::squared_distance(t.at, p);
    };
    corners.push_back({p, std::min_element(samples.begin(), samples.end(), nearer)->h});
  }
  samples.insert(samples.end(), corners.begin(), corners.end());
  return samples;
}

// By all simplices of the triangulation of the samples that have p.
template <int D>
double naively(const Samples<D>& samples, const Point<D>& p) {
  std::vector<Point<D>> at;
  for (const auto& s : samples) at.push_back(s.at);
  double least = std::numeric_limits<double>::infinity();
  for (const auto& simplex : mesher::delaunay<D>(at).simplices) {
    mesher::detail::CornersOf<D> corners;
    for (std::size_t i = 0; i <= D; ++i) corners[i] = at[simplex[i]];
    if (!mesher::detail::Tile<D>(corners).contains(p)) continue;
    // Cramer's rule: the part of each corner is the measure of the simplex with p in its place.
    const auto measure = [](const mesher::detail::CornersOf<D>& c) {
      const auto edge = [&](std::size_t i, std::size_t k) -> long double {
        return static_cast<long double>(c[i][k]) - c[0][k];
      };
      if constexpr (D == 2) return edge(1, 0) * edge(2, 1) - edge(1, 1) * edge(2, 0);
      if constexpr (D == 3) {
        long double sum = 0;
        for (std::size_t k = 0; k < 3; ++k) {
          const std::size_t l = (k + 1) % 3, m = (k + 2) % 3;
          sum += edge(1, k) * (edge(2, l) * edge(3, m) - edge(2, m) * edge(3, l));
        }
        return sum;
      }
    };
    long double h = 0;
    for (std::size_t i = 0; i <= D; ++i) {
      auto other = corners;
      other[i] = p;
      h += measure(other) / measure(corners) * static_cast<long double>(samples[simplex[i]].h);
    }
    least = std::min(least, static_cast<double>(h));
  }
  return least;
}

template <int D>
void check_linear(double unit) {
  const auto h_at = [&](const Point<D>& p) {
    double h = 3 * unit;
    for (std::size_t i = 0; i < D; ++i) h += p[i] / static_cast<double>(5 + 4 * i);
    return h;
  };
  Samples<D> samples;
  for (const auto& p : places<D>(3, 300, unit)) samples.push_back({p, h_at(p)});
  const auto field = mesher::sampled_sizes<D>(samples);
  for (const auto& s : samples) CHECK(field->at(s.at) == Approx(s.h).epsilon(1e-12));
  SplitMix64 random(5);
  for (int i = 0; i < 300; ++i) {  // between samples
    const auto &a = samples[random.below(samples.size())].at,
               &b = samples[random.below(samples.size())].at;
    Point<D> p;
    for (std::size_t k = 0; k < D; ++k) p[k] = a[k] + (b[k] - a[k]) * random.unit();
    bool inside = true;
    for (double x : p) inside = inside && x > 2 * unit && x < 5 * unit;
    if (inside) CHECK(field->at(p) == Approx(h_at(p)).epsilon(1e-9));
  }
}

template <int D>
void check_like_naive() {
  SplitMix64 random(8);
  Samples<D> samples;
  for (const auto& p : places<D>(4, 80, 1)) samples.push_back({p, std::exp(-3 * random.unit())});
  const auto field = mesher::sampled_sizes<D>(samples);
  auto reversed = samples;
  std::reverse(reversed.begin(), reversed.end());
  const auto again = mesher::sampled_sizes<D>(reversed);
  const Samples<D> all = with_corners<D>(samples);
  for (int i = 0; i < 100; ++i) {
    const Point<D> p = random_point<D>(random, i % 4 == 0 ? -5 : 0, D == 2 ? 20 : 7);
    CHECK(field->at(p) == Approx(naively<D>(all, p)).epsilon(1e-10));
    CHECK(again->at(p) == field->at(p));
    const double side = std::exp2(-10 * random.unit());
    mesher::Box<D> box{p, p};
    for (double& x : box.hi) x += side;
    CHECK(again->range(box).least == field->range(box).least);
    CHECK(again->range(box).most == field->range(box).most);
  }
}

template <int D>
void check_bounds() {
  SplitMix64 random(4);
  Samples<D> samples;
  for (const auto& p : places<D>(6, 60, 0.125)) {
    samples.push_back({p, std::exp(-5 * random.unit())});
  }
  const auto field = mesher::sampled_sizes<D>(samples);
  for (int i = 0; i < 1000; ++i) {
    mesher::Box<D> box;
    box.lo = random_point<D>(random, -6, 6);
    const double side = std::exp2(3 - 23 * random.unit());
    for (std::size_t k = 0; k < D; ++k) box.hi[k] = box.lo[k] + side;
    const mesher::SizeRange range = field->range(box);
    CHECK(range.least > 0);
    for (int k = 0; k < 20; ++k) {
      Point<D> p = box.lo;
      for (double& x : p) x += side * (k == 0 ? 0 : random.unit());
      const double h = field->at(p);
      CHECK(h >= range.least);
      CHECK(h <= range.most);
    }
    if (side < 1e-5) CHECK(range.most - range.least <= 1e-2);
  }
}

template <int D>
mesher::ErrorCode refused(const Samples<D>& samples) {
  try {
    (void)mesher::sampled_sizes<D>(samples);
  } catch (const mesher::Error& error) {
    return error.code();
  }
  return mesher::ErrorCode::cannot_read;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("A background is linear between its samples, and has their sizes at them",
                       "", ((int D), D), 2, 3) {
  for (const double unit : {1.0, 1 / 49.0, 1e-9, 1e9}) check_linear<D>(unit);
}

TEMPLATE_TEST_CASE_SIG("It is what the simplices of their triangulation say, in whatever order", "",
                       ((int D), D), 2, 3) {
  check_like_naive<D>();
}

TEMPLATE_TEST_CASE_SIG("The bounds of a background hold, and are near each other in small boxes",
                       "", ((int D), D), 2, 3) {
  check_bounds<D>();
}

TEMPLATE_TEST_CASE_SIG("Samples may be one, or on a line", "", ((int D), D), 2, 3) {
  Point<D> here{}, there{}, aside{};
  here[0] = 3, there[0] = 5, aside[0] = 4, aside[1] = 1;
  const auto constant = mesher::sampled_sizes<D>({{here, 0.5}});
  CHECK(constant->at(here) == 0.5);
  CHECK(constant->at(there) == 0.5);
  CHECK(constant->range({{}, here}).least == 0.5);
  const auto line = mesher::sampled_sizes<D>({{here, 0.5}, {there, 1.5}});
  CHECK(line->at({4}) == Approx(1));
  // The box around them goes from 0 to 8 along the line; its corners have the size of the nearest.
  CHECK(line->at({-1}) == Approx(line->at({0})));
  CHECK(line->at({100}) == Approx(line->at({8})));
  CHECK(line->at({8}) > 0.5);
  CHECK(line->at(aside) >= 0.5);
  CHECK(line->at(aside) <= 1.5);
}

TEST_CASE("Samples in a plane in space are a background") {
  Samples<3> samples;
  for (int i = 0; i < 5; ++i) {
    for (int j = 0; j < 5; ++j) {
      samples.push_back({{i / 7.0, j / 7.0, 1 - i / 7.0}, 1 + 0.1 * i + 0.2 * j});
    }
  }
  const auto field = mesher::sampled_sizes<3>(samples);
  for (const auto& s : samples) CHECK(field->at(s.at) == Approx(s.h).epsilon(1e-9));
  CHECK(field->at({1.5 / 7, 1.5 / 7, 1 - 1.5 / 7}) == Approx(1.45).epsilon(1e-9));
}

TEMPLATE_TEST_CASE_SIG("A background that makes no sense is refused", "", ((int D), D), 2, 3) {
  const Point<D> p{3, 4};
  CHECK(refused<D>({}) == mesher::ErrorCode::bad_option);
  CHECK(refused<D>({{p, 0.5}, {p, 0.5}}) == mesher::ErrorCode::duplicate_point);
  const double infinite = std::numeric_limits<double>::infinity();
  for (const double h : {0.0, -1.0, infinite, std::nan("")}) {
    CHECK(refused<D>({{p, h}}) == mesher::ErrorCode::bad_option);
  }
  CHECK(refused<D>({{{infinite}, 1}}) != mesher::ErrorCode::cannot_read);
}

TEMPLATE_TEST_CASE_SIG("Sizes of any magnitude are bounds of what is between them", "",
                       ((int D), D), 2, 3) {
  Samples<D> samples;
  SplitMix64 random(9);
  for (const auto& p : places<D>(7, 40, 1)) {
    samples.push_back(
        {p, std::ldexp(1 + random.unit(), 1000 - static_cast<int>(random.below(2020)))});
  }
  const auto field = mesher::sampled_sizes<D>(samples);
  for (int i = 0; i < 300; ++i) {
    const Point<D> p = random_point<D>(random, -5, 25);
    const double h = field->at(p);
    CHECK(h > 0);
    CHECK(std::isfinite(h));
    CHECK(field->range({p, p}).least <= h);
    CHECK(field->range({p, p}).most >= h);
  }
}
