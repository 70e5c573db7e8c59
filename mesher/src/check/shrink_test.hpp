// The guard at a vertex: how near its nearest neighbour is, against the local feature size.
//
// A disc around a vertex meets two features without a common point: so a vertex is looked at with
// the one disc that decides, in an input of any representation:
//
//   place(v)                    where a vertex is
//   codes_near(p, r)            the features within r of p, and perhaps others; some repeatedly
//   through(v)                  the segment that v is inside of; kNone
//   ends(s), line(s)            of a segment
//   for_each_ending_at(v, f)    f(segment) for those with the end v
//   degrees(s, t, apex)         the angle of two segments
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <cstdint>
#include <limits>
#include <vector>

#include "geometry/segment_tests.hpp"
#include "mesher/reports.hpp"
#include "sets/make_set.hpp"

namespace mesher::detail {

/// A feature is coded as a segment, or as this and a vertex.
inline constexpr std::uint32_t kPointFeature = 0x80000000u;

template <class Input>
class ShrinkTest {
 public:
  /// `side`: that of a box around all.
  ShrinkTest(const Input& input, double allowed, double side)
      : input_(input), allowed_(allowed), side_(side) {}

  /// Mostly the first disc decides, and it is small.
  [[nodiscard]] bool has_shrunk(std::uint32_t v, double nearest) const {
    const double most = allowed_ * nearest;
    for (double radius = 2 * nearest; radius < most; radius *= 2) {
      if (feature_size(v, radius) < kInfinity) return false;
    }
    return feature_size(v, most) == kInfinity;
  }
  [[nodiscard]] ShrunkVertex report(std::uint32_t v, double nearest) const {
    ShrunkVertex found{input_.place(v), nearest, kInfinity, {}, 180};
    for (double most = 2 * allowed_ * nearest;; most *= 2) {
      found.feature_size = feature_size(v, most);
      if (found.feature_size < kInfinity || most > 4 * side_) break;
    }
    for (const Feature& f : features_near(v, found.feature_size)) {
      const bool nearer = f.distance2 < found.feature_size * found.feature_size;
      if (nearer && !is_point(f.code)) blame(f.code, found);
    }
    make_set(found.lines);
    return found;
  }

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  struct Feature {
    double distance2 = 0;
    std::uint32_t code = 0;
    friend auto operator<=>(const Feature&, const Feature&) = default;
  };
  using Ends = std::array<std::uint32_t, 2>;

  static bool is_point(std::uint32_t code) noexcept { return (code & kPointFeature) != 0; }
  [[nodiscard]] Ends ends(std::uint32_t code) const {
    if (!is_point(code)) return input_.ends(code);
    return {code & ~kPointFeature, code & ~kPointFeature};
  }
  [[nodiscard]] bool has(std::uint32_t code, std::uint32_t v) const {
    return ends(code)[0] == v || ends(code)[1] == v;
  }
  [[nodiscard]] bool disjoint(std::uint32_t f, std::uint32_t g) const {
    return !has(f, ends(g)[0]) && !has(f, ends(g)[1]);
  }
  [[nodiscard]] double distance2_of(std::uint32_t v, std::uint32_t code) const {
    if (!is_point(code) && input_.through(v) == code) return 0;
    return distance2(input_.place(v), input_.place(ends(code)[0]), input_.place(ends(code)[1]));
  }

  // Those not farther from v than `most`, by distance.
  [[nodiscard]] std::vector<Feature> features_near(std::uint32_t v, double most) const {
    std::vector<std::uint32_t> near = input_.codes_near(input_.place(v), most);
    make_set(near);
    std::vector<Feature> by_distance;
    for (const std::uint32_t code : near) {
      const double d2 = distance2_of(v, code);
      if (d2 <= most * most) by_distance.push_back({d2, code});
    }
    std::sort(by_distance.begin(), by_distance.end());
    return by_distance;
  }
  // The local feature size at v if it is at most `most`, else infinite.
  [[nodiscard]] double feature_size(std::uint32_t v, double most) const {
    const std::vector<Feature> by_distance = features_near(v, most);
    std::vector<std::uint32_t> hubs;  // what all features so far have in common
    for (std::size_t i = 0; i < by_distance.size(); ++i) {
      const Feature& f = by_distance[i];
      if (i == 0) hubs.assign({ends(f.code)[0], ends(f.code)[1]});
      std::erase_if(hubs, [&](std::uint32_t hub) { return !has(f.code, hub); });
      if (!hubs.empty()) continue;
      for (std::size_t j = 0; j < i; ++j) {
        if (disjoint(f.code, by_distance[j].code)) return std::sqrt(f.distance2);
      }
    }
    return kInfinity;
  }

  void blame(std::uint32_t s, ShrunkVertex& v) const {
    v.lines.push_back(input_.line(s));
    for (const std::uint32_t apex : ends(s)) {
      input_.for_each_ending_at(apex, [&](std::uint32_t t) {
        if (s != t) v.degrees = std::min(v.degrees, input_.degrees(s, t, apex));
      });
    }
  }

  const Input& input_;
  double allowed_;
  double side_;
};

}  // namespace mesher::detail
