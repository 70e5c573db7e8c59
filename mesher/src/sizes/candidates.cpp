// Points of lattices, and those of others beside them.
#include "sizes/candidates.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "geometry/box.hpp"
#include "geometry/plane.hpp"

namespace mesher::detail {

namespace {

/// A cell not wider than this, in pitches, is filled at once.
constexpr double kFilledAtOnce = 4;

// Areas are computed to within 2^-45.
constexpr double kFits = 1 - 0x1p-40;

// Looks at the limits, and notes where.
class Search {
 public:
  Search(const Limits& limits, const Box<2>& start) : limits_(limits), looked_at_(start) {}

  [[nodiscard]] const Box<2>& looked_at() const noexcept { return looked_at_; }
  [[nodiscard]] Limits::Pitches pitches_in(const Box<2>& box) {
    grow(looked_at_, box.lo);
    grow(looked_at_, box.hi);
    return limits_.pitches_in(box);
  }
  [[nodiscard]] bool is_candidate(const Lattice& lattice, const LatticePoint& q);
  [[nodiscard]] bool is_amid(const Lattice& lattice, const LatticePoint& q);
  [[nodiscard]] Candidates in_cell(const MeshBox<2>& box, const Cell<2>& c, const Box<2>& area);

 private:
  using Corners = std::array<LatticePoint, 3>;
  [[nodiscard]] double pitch(const Point<2>& p) {
    grow(looked_at_, p);
    return limits_.pitch(p);
  }
  [[nodiscard]] bool fits(const Lattice& lattice, const Corners& t);
  [[nodiscard]] bool is_between(const Lattice& lattice, const LatticePoint& q);

  const Limits& limits_;
  Box<2> looked_at_;
};

bool Search::is_candidate(const Lattice& lattice, const LatticePoint& q) {
  const Point<2> p = lattice.place(q);
  const double own = lattice.pitch();
  if (pitch(p) != own) return false;
  if (limits_.uniform()) return true;
  const double clear = own / 2;
  const Box<2> near = around(p, clear);
  Limits::Pitches smaller = pitches_in(near);
  smaller.most = std::nextafter(own, 0);
  return !limits_.visit_pitches(smaller, [&](double pitch) {
    const Lattice other(pitch);
    return other.visit_in(near, [&](const LatticePoint& n) {
      return squared_distance(other.place(n), p) < clear * clear && is_candidate(other, n);
    });
  });
}

// Where the pitch is of a constant, the lattice's triangles have at most its area.
bool Search::fits(const Lattice& lattice, const Corners& t) {
  const Point<2> middle = centroid({lattice.place(t[0]), lattice.place(t[1]), lattice.place(t[2])});
  grow(looked_at_, middle);
  if (limits_.constant_pitch(middle) == lattice.pitch()) return true;
  return Lattice::kArea * lattice.pitch() * lattice.pitch() <= limits_.area(middle) * kFits;
}

// Whether a candidate of another lattice is in the circumcircle of a triangle at q: as near to one
// of its corners as the circumradius.
bool Search::is_between(const Lattice& lattice, const LatticePoint& q) {
  const double own = lattice.pitch(), radius = Lattice::kCircumradius * own;
  const Point<2> p = lattice.place(q);
  const auto near_corner = [&](const Point<2>& x) {
    const auto six = Lattice::around(q);
    return squared_distance(p, x) < radius * radius ||
           std::any_of(six.begin(), six.end(), [&](const LatticePoint& n) {
             return squared_distance(lattice.place(n), x) < radius * radius;
           });
  };
  const Box<2> near = around(p, 2 * radius);
  return limits_.visit_pitches(pitches_in(near), [&](double pitch) {
    const Lattice other(pitch);
    return pitch != own && other.visit_in(near, [&](const LatticePoint& n) {
      return near_corner(other.place(n)) && is_candidate(other, n);
    });
  });
}

bool Search::is_amid(const Lattice& lattice, const LatticePoint& q) {
  const auto six = Lattice::around(q);
  for (const LatticePoint& n : six) {
    if (!is_candidate(lattice, n)) return false;
  }
  if (limits_.uniform()) return true;
  for (std::size_t i = 0; i < six.size(); ++i) {
    if (!fits(lattice, {q, six[i], six[(i + 1) % six.size()]})) return false;
  }
  return !is_between(lattice, q);
}

Candidates Search::in_cell(const MeshBox<2>& box, const Cell<2>& c, const Box<2>& area) {
  Candidates found;
  limits_.visit_pitches(pitches_in(area), [&](double pitch) {
    const Lattice lattice(pitch);
    lattice.visit_in(area, [&](const LatticePoint& q) {
      const Point<2> p = lattice.place(q);
      const bool here = box.contains(p) && MeshBox<2>::cell(box.fixed(p), c.level) == c;
      if (here && is_candidate(lattice, q)) found.push_back({p, pitch, is_amid(lattice, q)});
      return false;
    });
    return false;
  });
  return found;
}

}  // namespace

CellPlan plan_of(const Limits& limits, const MeshBox<2>& box, const Cell<2>& c) {
  const Box<2> area = box.box_of(c);
  Search search(limits, area);
  CellPlan plan;
  const double least = search.pitches_in(area).least;
  if (least != Limits::kNone) {
    plan.parts = box.cell_side(c.level) > kFilledAtOnce * least;
    if (!plan.parts) plan.candidates = search.in_cell(box, c, area);
  }
  plan.looked_at = search.looked_at();
  return plan;
}

}  // namespace mesher::detail
