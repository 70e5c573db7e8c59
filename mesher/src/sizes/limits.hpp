// How large triangles may be, and which places are filled for that [rules A7]: functions of space.
//
// A triangle whose centroid is in the domain has at most the area of the limit there. A limit of A
// asks for a *spacing* of sqrt(A / 0.4375), that of the lattice whose triangles have this area. The
// vertices come from a lattice first: were too large a triangle but one more reason to insert, the
// mesh would be one advancing front, and an edit would move all of it.
//
// The pitch of the lattice at a place is the spacing there: that of max_area, where this is what
// limits; elsewhere that of its *band*, [2^(k/4), 2^((k+1)/4)), so that lattices of some extent
// result. A point of a lattice is a *candidate* if its pitch is that of the lattice, and no
// candidate of a smaller pitch is within half of it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "geometry/grid.hpp"
#include "mesher/sizes.hpp"
#include "sizes/lattice.hpp"

namespace mesher::detail {

class Limits {
 public:
  static constexpr double kNone = std::numeric_limits<double>::infinity();

  /// Throws: Error(bad_option).
  Limits(const Options<2>& options, const MeshBox<2>& box);

  /// Whether there is a limit somewhere.
  [[nodiscard]] bool any() const noexcept { return !pitches_.empty(); }
  /// The largest area of a triangle with its centroid at p; kNone: any.
  /// Throws: Error(bad_option) for a size that is not above 0.
  [[nodiscard]] double area(const Point<2>& p) const;
  /// The pitch of the lattice at p; kNone: no lattice. Throws: also if it is too small.
  [[nodiscard]] double pitch(const Point<2>& p) const {
    return any() ? pitch_for(spacing(area(p))) : kNone;
  }
  [[nodiscard]] Point<2> nearest_in_domain(const Point<2>& p) const noexcept {
    return {std::clamp(p[0], domain_.lo[0], domain_.hi[0]),
            std::clamp(p[1], domain_.lo[1], domain_.hi[1])};
  }
  /// None in the box is shorter.
  [[nodiscard]] double least_pitch(const Box<2>& box) const { return pitches_in(box).least; }
  /// Whether a piece of a segment is so long that the lattice would leave a gap beside it.
  [[nodiscard]] bool is_long(const Point<2>& a, const Point<2>& b) const;

  /// A place that may be filled.
  struct Candidate {
    Point<2> place{};
    double pitch = 0;
    // The six around it on the lattice are candidates, its six triangles have no other candidates
    // in their circumcircles, and they fit.
    bool amid = false;
  };
  /// Those in a cell, by pitch and rows.
  [[nodiscard]] std::vector<Candidate> candidates(const MeshBox<2>& box, const Cell<2>& c) const;

 private:
  // From a spacing on; kNone: no lattice.
  struct Pitch {
    double spacing, pitch;
  };
  static double spacing(double area) noexcept { return std::sqrt(area / Lattice::kArea); }
  void add_bands(double end);
  void add_pitch(double spacing);
  [[nodiscard]] double pitch_for(double spacing) const;
  [[nodiscard]] SizeRange spacings_in(const Box<2>& box) const;
  [[nodiscard]] SizeRange pitches_in(const Box<2>& box) const;
  template <class Visit>
  bool visit_pitches(const SizeRange& range, Visit&& visit) const;
  [[nodiscard]] bool is_candidate(const Lattice& lattice, const LatticePoint& q) const;
  [[nodiscard]] bool is_amid(const Lattice& lattice, const LatticePoint& q) const;
  [[nodiscard]] bool is_between(const Lattice& lattice, const LatticePoint& q) const;
  [[nodiscard]] bool fits(const Lattice& lattice, const std::array<LatticePoint, 3>& t) const;

  Box<2> domain_;
  double coordinates_;  // none in the domain is larger
  double area_ = kNone;
  std::shared_ptr<const SizeField<2>> sizes_;  // null: area_ everywhere
  std::vector<Pitch> pitches_;                 // ascending; the last is kNone; empty: no limits
};

}  // namespace mesher::detail
