// The rule behind Complete: the next point to insert, and the bucket of the next visit.
//
// A rule looks at v's Voronoi cell, clipped as its bucket says. A vertex inserted for a length of
// bucket i has its nearest neighbour in a later bucket [L 4.3.1]; its event runs later than the one
// that inserts it in any case (a length may be looked at after its bucket).
//
// A corner of the cell is a gap ball's centre only if it is in the box [Def 4.2.1 (1)]: corners
// outside are behind a side of the box, where no vertex is missing.
#pragma once

#include <memory>
#include <optional>

#include "cells/cell_of.hpp"
#include "rules/buckets.hpp"
#include "sizes/limits_of.hpp"

namespace mesher::detail {

/// Which poor triangles a rule leaves as they are, named by their edges: p -> q of the cell's
/// neighbours (kCentre: v itself), the triangle on its left.
template <int D>
class EdgeFilter {
 public:
  static constexpr int kCentre = -1;
  virtual ~EdgeFilter() = default;
  /// Whether it stays although it is poor.
  [[nodiscard]] virtual bool skips(const CellOf<D>& cell, int p, int q) const = 0;
  /// Whether it stays although it is too large.
  [[nodiscard]] virtual bool skips_large(const CellOf<D>& cell, int p, int q) const = 0;
};

template <int D>
class InsertionRule {
 public:
  InsertionRule(const Options<D>& options, const MeshBox<D>& box, const Promise& promise);
  virtual ~InsertionRule() = default;

  struct NewPoint {
    Point<D> p;
    double nearest2;  // squared distance to the vertices of the gap ball around it
    bool farther;     // clearly more than the length that asked for it, in spite of rounding
    int from = 0;     // the poor triangle's edge, as EdgeFilter names it
    int to = 0;
    bool large = false;  // the simplex is not poor, but too large
    Point<D> corner{};   // the poor simplex's circumcentre; if it is hidden, where the clip is

    /// A point of a lattice that will do as well where no feature is near.
    struct OnLattice {
      Point<D> p;
      double clear2;  // no vertex is nearer; squared
      double reach2;  // squared distance to the vertices of the gap ball, as nearest2
    };
    std::optional<OnLattice> on_lattice{};
    /// Moves it there. Requires: on_lattice.
    void move() {
      p = on_lattice->p;
      nearest2 = on_lattice->clear2;
    }
  };
  /// A point to insert now, in bucket b; none if v is complete up to b. `filter`: null skips none.
  [[nodiscard]] virtual std::optional<NewPoint> next_point(const CellOf<D>& cell, int b,
                                                           const EdgeFilter<D>* filter) const = 0;
  /// The bucket in which v must be looked at again, later than b; none if v's star is good.
  [[nodiscard]] virtual std::optional<int> next_bucket(const CellOf<D>& cell, int b,
                                                       const EdgeFilter<D>* filter) const = 0;

  /// A simplex with a circumradius, squared, below this times its shortest edge, squared, asks for
  /// nothing unless it is too large, even if both are off by 2^-20. 0: one cannot say.
  [[nodiscard]] virtual double surely_good2() const noexcept { return 0; }

  [[nodiscard]] const Buckets<D>& buckets() const noexcept { return buckets_; }
  [[nodiscard]] const Promise& promise() const noexcept { return promise_; }

  /// Whether a circumradius is too large for an edge, both squared.
  [[nodiscard]] bool exceeds(double radius2, double edge2) const noexcept {
    return radius2 > rho2_ * edge2;
  }

 protected:
  [[nodiscard]] const MeshBox<D>& box() const noexcept { return box_; }
  [[nodiscard]] double rho2() const noexcept { return rho2_; }
  [[nodiscard]] bool is_centre(const CellOf<D>& cell, int corner) const;
  /// `growth2`: to be farther, p must be from all vertices by more than this times length2.
  [[nodiscard]] NewPoint new_point(const CellOf<D>& cell, const Point<D>& p, double length2,
                                   double growth2) const;
  /// For a point that is farther by a factor of rho, but for rounding.
  [[nodiscard]] double growth2() const noexcept { return growth2_; }

 private:
  [[nodiscard]] Point<D> rounded(Point<D> p) const;

  Promise promise_;
  Buckets<D> buckets_;
  MeshBox<D> box_;
  double rho2_;
  double growth2_;  // a new vertex is farther from all than this times its squared length
  double tiny_;     // coordinates below are noise around zero
};

/// The rule that the options name; it refers to `limits`. Throws: Error(bad_option) if there is
/// none.
template <int D>
[[nodiscard]] std::unique_ptr<const InsertionRule<D>> insertion_rule(const Options<D>& options,
                                                                     const MeshBox<D>& box,
                                                                     const LimitsOf<D>& limits);
/// What the rule of this name promises. Throws: likewise.
template <int D>
[[nodiscard]] Promise promise(Rule rule, double rho);

}  // namespace mesher::detail
