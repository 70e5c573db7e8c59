// A rotated square with a few features, and sizes in it: what the model of the rules was measured
// on [rules A7].
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "mesher/graph.hpp"
#include "mesher/mesh.hpp"
#include "mesher/sizes.hpp"

namespace support {

/// A square of side 0.7 turned by 0.3 about (0.5, 0.5), in the unit square.
struct SizedSquare {
  static mesher::Box<2> domain() { return {{0, 0}, {1, 1}}; }
  static bool contains(const mesher::Point<2>& p) { return beyond(p) <= 1e-9; }
  /// How far p is outside, in the norm of the square.
  static double beyond(const mesher::Point<2>& p) {
    const double x = p[0] - 0.5, y = p[1] - 0.5, c = std::cos(0.3), d = std::sin(0.3);
    return std::max(std::abs(c * x + d * y), std::abs(c * y - d * x)) - 0.35;
  }
  static std::vector<mesher::Point<2>> points() {
    return {
        {0.26906430113750679, 0.062200156474569113}, {0.93779984352543089, 0.26906430113750673},
        {0.73093569886249332, 0.93779984352543089},  {0.062200156474569113, 0.73093569886249321},
        {0.37802519926765099, 0.6986280864961496},   {0.67038874398921378, 0.53008574677820752},
        {0.70505492028969097, 0.49405442400614941},  {0.27164855006563776, 0.098605212054105273},
        {0.88489500287564149, 0.39434845256005385},  {0.88255861213437248, 0.44429383551287654},
        {0.31593498196283587, 0.37466507029719687},  {0.86143354644333858, 0.33678931702048631},
        {0.81146654759604897, 0.33860563918215164}};
  }
  static std::vector<mesher::Segment> segments() {
    std::vector<mesher::Segment> all;
    for (const auto& [a, b] : std::vector<std::pair<int, int>>{
             {1, 2}, {2, 3}, {3, 4}, {4, 1}, {6, 7}, {9, 10}, {12, 13}}) {
      const auto id = static_cast<std::int64_t>(all.size() + 1);
      all.push_back({mesher::LineId{id}, mesher::PointId{a}, mesher::PointId{b}});
    }
    return all;
  }
};

/// Sizes in the square that depend on the distance from (0.43, 0.52), and do not fall with it; none
/// outside.
class SizesInSquare final : public mesher::SizeField<2> {
 public:
  explicit SizesInSquare(std::function<double(double distance)> size) : size_(std::move(size)) {}

  /// An area's.
  static double size(double area) { return std::sqrt(area / (std::sqrt(3.0) / 4)); }
  static SizesInSquare linear(double area, double slope) {
    return SizesInSquare([=](double d) { return size(area) + slope * d; });
  }
  static SizesInSquare step(double area) {
    return SizesInSquare([=](double d) { return d < 0.15 ? size(area) : 8 * size(area); });
  }

  [[nodiscard]] double at(const mesher::Point<2>& p) const override {
    return SizedSquare::contains(p) ? size_(distance(p)) : kNone;
  }
  [[nodiscard]] mesher::SizeRange range(const mesher::Box<2>& box) const override {
    const mesher::Point<2> middle{(box.lo[0] + box.hi[0]) / 2, (box.lo[1] + box.hi[1]) / 2};
    const double radius =
        std::hypot(box.hi[0] - middle[0], box.hi[1] - middle[1]) * (1 + 0x1p-30) + 1e-12;
    if (SizedSquare::beyond(middle) > radius + 1e-9) return {kNone, kNone};
    const double far = size_(distance(middle) + radius);
    return {size_(std::max(distance(middle) - radius, 0.0)),
            SizedSquare::beyond(middle) < -radius ? far : kNone};
  }

 private:
  static constexpr double kNone = std::numeric_limits<double>::infinity();
  static double distance(const mesher::Point<2>& p) { return std::hypot(p[0] - 0.43, p[1] - 0.52); }
  std::function<double(double)> size_;
};

}  // namespace support
