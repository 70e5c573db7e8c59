// How large triangles may be, and which places are filled for that [rules A7]: functions of space.
//
// A triangle whose centroid is in the domain has at most the area of the limit there. A limit of A
// asks for a *spacing* of sqrt(A / 0.4375), that of the lattice whose triangles have this area. The
// vertices come from a lattice first: were too large a triangle but one more reason to insert, the
// mesh would be one advancing front, and an edit would move all of it.
#pragma once

#include <limits>
#include <vector>

#include "geometry/grid.hpp"
#include "sizes/lattice.hpp"

namespace mesher::detail {

class Limits {
 public:
  static constexpr double kNone = std::numeric_limits<double>::infinity();

  /// Throws: Error(bad_option).
  Limits(const Options<2>& options, const MeshBox<2>& box);

  /// Whether there is a limit somewhere.
  [[nodiscard]] bool any() const noexcept { return area_ < kNone; }
  /// The largest area of a triangle with its centroid at p; kNone: any.
  [[nodiscard]] double area(const Point<2>& p) const noexcept {
    return contains(p) ? area_ : kNone;
  }
  /// The pitch of the lattice at p; kNone: no lattice.
  [[nodiscard]] double pitch(const Point<2>& p) const noexcept {
    return contains(p) ? pitch_ : kNone;
  }
  /// None is shorter in the box.
  [[nodiscard]] double least_pitch(const Box<2>& box) const noexcept {
    return meets(box) ? pitch_ : kNone;
  }
  /// Whether a piece of a segment is so long that the lattice would leave a gap beside it.
  [[nodiscard]] bool is_long(const Point<2>& a, const Point<2>& b) const;

  /// A place that may be filled.
  struct Candidate {
    Point<2> place{};
    double pitch = 0;
    bool amid = false;  // the six around it on the lattice are candidates, too
  };
  /// Those in a cell, by rows. Cost: O(their number).
  [[nodiscard]] std::vector<Candidate> candidates(const MeshBox<2>& box, const Cell<2>& c) const;

 private:
  [[nodiscard]] bool contains(const Point<2>& p) const noexcept {
    return p[0] >= domain_.lo[0] && p[0] <= domain_.hi[0] && p[1] >= domain_.lo[1] &&
           p[1] <= domain_.hi[1];
  }
  [[nodiscard]] bool meets(const Box<2>& box) const noexcept {
    return box.lo[0] <= domain_.hi[0] && box.hi[0] >= domain_.lo[0] &&
           box.lo[1] <= domain_.hi[1] && box.hi[1] >= domain_.lo[1];
  }
  [[nodiscard]] bool is_candidate(const Lattice& lattice, const LatticePoint& q) const {
    return pitch(lattice.place(q)) == lattice.pitch();
  }
  [[nodiscard]] bool is_amid(const Lattice& lattice, const LatticePoint& q) const;

  Box<2> domain_;
  double area_ = kNone;
  double pitch_ = kNone;
};

}  // namespace mesher::detail
