// Which point to insert, and when to look again: the two rules behind Complete.
//
// Lengths fall into buckets [rho^i l_0, rho^(i+1) l_0). A vertex inserted for a length of bucket i
// has its nearest neighbour in a later bucket [L 4.3.1]; its event runs later than the one that
// inserts it in any case (an edge of the boundary grid may be looked at after its bucket).
//
// radius_edge. A corner q_i of v's cell between u_i and u_{i+1} is a triangle; it is poor if its
//   circumradius exceeds rho times its shortest edge. A corner hidden by the clip stands for a
//   triangle on each visible edge beside it, of larger circumradius than any bound of the bucket.
//   The new vertex lies on the bisector of the shortest edge, as high as a circumradius of rho
//   times that edge allows (the off-centre [Ungor 2004]), or at the circumcentre if that is lower.
// voronoi_aspect [Def 4.2.3]. While a corner is beyond rho NN(v), insert the farthest. A corner
//   between neighbours nearer to each other than NN(v) is measured by their distance: they are
//   incomplete by it, and those on the boundary grid have no event of their own.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "geometry/grid.hpp"
#include "mesher/mesh.hpp"
#include "geometry/voronoi_cell.hpp"

namespace mesher::detail {

class InsertionRule {
 public:
  InsertionRule(const Options<2>& options, const MeshBox<2>& box);

  /// The bucket of a length, given its square. Cost: O(log log L/s).
  [[nodiscard]] int bucket(double length2) const;
  [[nodiscard]] int buckets() const noexcept { return static_cast<int>(start2_.size()); }

  /// How far Complete looks in bucket b; from the last bucket on, everywhere. (A vertex that comes
  /// in bucket b is looked at in b + 1, however short the lengths beside it.)
  [[nodiscard]] double clip_radius(int b) const { return clip_[index(b)]; }

  struct NewPoint {
    Point<2> p;
    double nearest2;  // squared distance to the vertices of the gap ball around it
    bool farther;     // clearly more than the length that asked for it, in spite of rounding
  };
  /// A point to insert now, in bucket b; none if v is complete up to b.
  [[nodiscard]] std::optional<NewPoint> next_point(const VoronoiCell& cell, int b) const;

  /// The bucket in which v must be looked at again, later than b; none if v's star is good.
  [[nodiscard]] std::optional<int> next_bucket(const VoronoiCell& cell, int b) const;

  /// The colour of v in bucket b: vertices of one colour in different squares are independent
  /// [Fig 4.9].
  [[nodiscard]] unsigned colour(const Fixed<2>& f, int b) const;

 private:
  // An edge p -> q of a poor triangle on its left.
  struct Poor {
    double edge2 = 0;
    Point<2> p;
    Point<2> q;
    std::optional<Point<2>> circumcentre;
  };
  [[nodiscard]] std::size_t index(int b) const noexcept {
    return std::min(static_cast<std::size_t>(b), start2_.size() - 1);
  }
  template <class Visit>
  void for_each_poor(const VoronoiCell& cell, Visit&& visit) const;
  [[nodiscard]] Point<2> place(const Poor& poor) const;
  [[nodiscard]] std::optional<NewPoint> poor_triangle_point(const VoronoiCell& cell, int b) const;
  [[nodiscard]] std::optional<NewPoint> farthest_corner(const VoronoiCell& cell) const;
  [[nodiscard]] Point<2> rounded(const Point<2>& p) const;
  [[nodiscard]] NewPoint new_point(const VoronoiCell& cell, const Point<2>& p,
                                   double length2) const;

  Rule rule_;
  double rho2_;     // poor above this
  double growth2_;  // a new vertex is farther from all than this times its squared length
  double tiny_;     // coordinates below are noise around zero
  double height_;   // of the off-centre, in units of the edge
  std::vector<double> start2_;  // squared start of each bucket
  std::vector<double> clip_;
  std::vector<int> square_level_;  // squares of the colouring are cells of this level; 0: no colour
};

}  // namespace mesher::detail
