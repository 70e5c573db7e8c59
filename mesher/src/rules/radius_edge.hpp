// The rule radius_edge: an off-centre [Ungor 2004] for every poor triangle.
//
// A corner q_i of v's cell between u_i and u_{i+1} is a triangle; it is poor if its circumradius
// exceeds rho times its shortest edge. A corner hidden by the clip stands for a triangle on each
// visible edge beside it, of larger circumradius than any bound of the bucket. The new vertex lies
// on the bisector of the shortest edge, as high as a circumradius of rho times that edge allows, or
// at the circumcentre if that is lower. Poor triangles go shortest edge first.
//
// A triangle that is too large where it is counts as one of length R, its circumradius, and is
// filled at its circumcentre [rules A7.5].
#pragma once

#include <optional>

#include "rules/insertion_rule.hpp"

namespace mesher::detail {

class RadiusEdge final : public InsertionRule {
 public:
  /// Refers to `limits`.
  RadiusEdge(const Options<2>& options, const MeshBox<2>& box, const Limits& limits);

  [[nodiscard]] static Promise promise_for(double rho);
  [[nodiscard]] std::optional<NewPoint> next_point(const VoronoiCell& cell, int b,
                                                   const EdgeFilter* filter) const override;
  [[nodiscard]] std::optional<int> next_bucket(const VoronoiCell& cell, int b,
                                               const EdgeFilter* filter) const override;

 private:
  // An edge p -> q of a poor triangle on its left; or of a large one.
  struct Poor {
    double length2 = 0;  // the edge's; of a large one: its circumradius'
    Point<2> p;
    Point<2> q;
    std::optional<Point<2>> circumcentre;
    int from = EdgeFilter::kCentre;  // p and q as the filter names them
    int to = EdgeFilter::kCentre;
    bool large = false;
  };
  static bool skipped(const Poor& poor, const VoronoiCell& cell, const EdgeFilter* filter) {
    if (filter == nullptr) return false;
    return poor.large ? filter->skips_large(cell, poor.from, poor.to)
                      : filter->skips(cell, poor.from, poor.to);
  }
  [[nodiscard]] bool is_large(const VoronoiCell& cell, int i, int j) const;
  template <class Visit>
  void for_each_poor(const VoronoiCell& cell, Visit&& visit) const;
  [[nodiscard]] Point<2> place(const Poor& poor) const;

  double height_;  // of the off-centre, in units of the edge
  const Limits* limits_;
};

}  // namespace mesher::detail
