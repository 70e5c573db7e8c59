// The rule radius_edge: an off-centre [Ungor 2004] for every poor simplex.
//
// A corner of v's cell is a simplex of v and the neighbours around it; it is poor if its
// circumradius exceeds rho times its shortest edge. A corner hidden by the clip stands for one of
// larger circumradius than any bound of the bucket: in the plane for a triangle on each visible
// edge beside it, in space for a tetrahedron on the shortest visible edge. The new vertex lies on
// the line from the middle of the shortest edge to the circumcentre, as high as a circumradius of
// rho times that edge allows, or at the circumcentre if that is lower. Poor simplices go shortest
// edge first.
//
// From space on a point of a lattice near that place does as well, if it is as far from all
// vertices as the bound asks, and no feature is near [rules E1]: updates that differ nearby come to
// the same vertices again.
//
// A simplex that is too large where it is counts as one of length R, its circumradius, and is
// filled at its circumcentre [rules A7.5].
#pragma once

#include <optional>

#include "rules/insertion_rule.hpp"

namespace mesher::detail {

template <int D>
class RadiusEdge final : public InsertionRule<D> {
  using Base = InsertionRule<D>;

 public:
  using typename Base::NewPoint;

  /// Refers to `limits`.
  RadiusEdge(const Options<D>& options, const MeshBox<D>& box, const LimitsOf<D>& limits);

  [[nodiscard]] static Promise promise_for(double rho);
  [[nodiscard]] std::optional<NewPoint> next_point(const CellOf<D>& cell, int b,
                                                   const EdgeFilter<D>* filter) const override;
  [[nodiscard]] std::optional<int> next_bucket(const CellOf<D>& cell, int b,
                                               const EdgeFilter<D>* filter) const override;
  [[nodiscard]] double surely_good2() const noexcept override {
    return Base::rho2() * (1 - 0x1p-18);
  }

 private:
  // The edge p q of a poor simplex, in the plane on the left of p -> q; or of a large one.
  struct Poor {
    double length2 = 0;  // the edge's; of a large one: its circumradius'
    Point<D> p;
    Point<D> q;
    Point<D> corner;                    // the circumcentre, unless it is hidden
    bool hidden = false;                // behind the clip
    int from = EdgeFilter<D>::kCentre;  // p and q as the filter names them
    int to = EdgeFilter<D>::kCentre;
    bool large = false;
  };
  static bool skipped(const Poor& poor, const CellOf<D>& cell, const EdgeFilter<D>* filter) {
    if (filter == nullptr) return false;
    return poor.large ? filter->skips_large(cell, poor.from, poor.to)
                      : filter->skips(cell, poor.from, poor.to);
  }
  [[nodiscard]] bool is_large(const CellOf<D>& cell, int i, int j) const;  // in the plane
  [[nodiscard]] bool is_large(const CellOf<D>& cell, int t) const;         // in space
  [[nodiscard]] bool is_good(const CellOf<D>& cell, int t) const;
  [[nodiscard]] Poor shortest_edge(const CellOf<D>& cell, int t) const;
  template <class Visit>
  void for_each_poor(const CellOf<D>& cell, Visit&& visit) const;
  [[nodiscard]] Point<D> place(const Poor& poor) const;
  [[nodiscard]] std::optional<typename NewPoint::OnLattice> on_lattice(const CellOf<D>& cell,
                                                                       const Poor& poor,
                                                                       const Point<D>& place) const;

  double rho_;
  double height_;              // of the off-centre, in units of the edge
  const LimitsOf<D>* limits_;  // null: there are none
};

}  // namespace mesher::detail
