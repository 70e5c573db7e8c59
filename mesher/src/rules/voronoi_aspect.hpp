// The rule voronoi_aspect [Def 4.2.3], the paper's: while a corner is beyond rho NN(v), insert the
// farthest.
//
// A corner between neighbours nearer to each other than NN(v) is measured by their distance: they
// are incomplete by it, and may have had their event. It is a rule for points alone: it knows no
// triangle that may stay poor.
#pragma once

#include "rules/insertion_rule.hpp"

namespace mesher::detail {

template <int D>
class VoronoiAspect final : public InsertionRule<D> {
  using Base = InsertionRule<D>;

 public:
  using typename Base::NewPoint;

  /// `limits`: there are none for this rule.
  VoronoiAspect(const Options<D>& options, const MeshBox<D>& box, const LimitsOf<D>& limits);

  [[nodiscard]] static Promise promise_for(double rho);
  [[nodiscard]] std::optional<NewPoint> next_point(const CellOf<D>& cell, int b,
                                                   const EdgeFilter<D>* filter) const override;
  /// One event a vertex is enough.
  [[nodiscard]] std::optional<int> next_bucket(const CellOf<D>&, int,
                                               const EdgeFilter<D>*) const override {
    return std::nullopt;
  }
};

}  // namespace mesher::detail
