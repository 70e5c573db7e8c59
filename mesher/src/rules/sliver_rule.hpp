// Which tetrahedra have too small a dihedral angle, and the places at which a vertex may split them
// [Li, Teng 2001; rules E].
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "geometry/grid.hpp"
#include "geometry/space_vectors.hpp"

namespace mesher::detail {

/// Scores of tetrahedra are the largest cosine of a dihedral angle, squared with its sign: less is
/// better, and what is left to 1 is the sine of the smallest angle, squared.
class SliverRule {
 public:
  /// `min_dihedral`: in degrees; 0: there are no slivers.
  SliverRule(const MeshBox<3>& box, double min_dihedral);

  /// Whether there may be slivers.
  [[nodiscard]] bool any() const noexcept { return worst_ < 1; }
  /// No score of a good tetrahedron is larger.
  [[nodiscard]] double worst() const noexcept { return worst_; }
  /// How many places are tried.
  [[nodiscard]] std::size_t most() const noexcept { return most_; }

  /// The same bits in whatever order the corners come; of what is flat 1.
  [[nodiscard]] static double score(std::array<const Point<3>*, 4> corners);

  /// Whether the tetrahedron of 0, a, b and c surely is no sliver: nearly all are told in a tenth
  /// of the time of a score.
  [[nodiscard]] bool is_surely_good(const Point<3>& a, const Point<3>& b,
                                    const Point<3>& c) const noexcept;

  /// Calls visit(place, distance2) for the points of a body-centred lattice that a vertex in this
  /// ball may go to, spaced by a power of two of the box's side, at most half of the radius:
  /// vertices for several slivers do not come close.
  template <class Visit>
  void for_each_place(const Point<3>& centre, double radius2, Visit&& visit) const;

 private:
  // How much of a ball's radius, squared, a new vertex may be from its centre.
  static constexpr double kOff2 = 0.6;
  // Nearer than this to a side of the box, in units of the side, nothing is inserted.
  static constexpr double kOffSide = 0x1p-3;

  MeshBox<3> box_;
  double worst_;
  std::size_t most_;
};

template <class Visit>
void SliverRule::for_each_place(const Point<3>& centre, double radius2, Visit&& visit) const {
  const double spacing = std::scalbn(box_.side, std::ilogb(std::sqrt(radius2) / (2 * box_.side)));
  std::array<double, 3> nearest;
  for (int i = 0; i < 3; ++i) nearest[i] = box_.nearest_step(i, centre[i], spacing);
  const double margin = kOffSide * box_.side;
  for (int k = 0; k < 54; ++k) {
    const std::array<int, 3> step{k % 3 - 1, k / 3 % 3 - 1, k / 9 % 3 - 1};
    Point<3> place;
    bool is_inside = true;
    for (std::size_t i = 0; i < 3; ++i) {
      place[i] = box_.lo[i] + spacing * (nearest[i] + step[i] + (k < 27 ? 0 : 0.5));
      is_inside = is_inside && place[i] >= box_.lo[i] + margin &&
                  place[i] <= box_.hi(static_cast<int>(i)) - margin;
    }
    const double distance2 = squared_distance(place, centre);
    if (is_inside && distance2 < kOff2 * radius2) visit(place, distance2);
  }
}

}  // namespace mesher::detail
