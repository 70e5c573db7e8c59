// Points of lattices, and those of others beside them.
#include "sizes/candidates.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "geometry/box.hpp"
#include "geometry/centroid.hpp"
#include "geometry/plane_vectors.hpp"
#include "geometry/space_vectors.hpp"

namespace mesher::detail {

namespace {

/// A cell not wider than this, in pitches, is filled at once.
template <int D>
inline constexpr double kFilledAtOnce = D == 2 ? 4 : 2;

// Measures are computed to within 2^-45.
constexpr double kFits = 1 - 0x1p-40;

template <int D>
double lattice_measure(double pitch) {
  double measure = Lattice<D>::kMeasure;
  for (int i = 0; i < D; ++i) measure *= pitch;
  return measure;
}

// Looks at the limits, and notes where.
template <int D>
class Search {
  using Lattice = detail::Lattice<D>;
  using Node = typename Lattice::Node;
  using Candidates = detail::Candidates<D>;

 public:
  Search(const Limits<D>& limits, const Box<D>& start) : limits_(limits), looked_at_(start) {}

  [[nodiscard]] const Box<D>& looked_at() const noexcept { return looked_at_; }
  [[nodiscard]] typename Limits<D>::Pitches pitches_in(const Box<D>& box) {
    grow(looked_at_, box.lo);
    grow(looked_at_, box.hi);
    return limits_.pitches_in(box);
  }
  [[nodiscard]] bool is_candidate(const Lattice& lattice, const Node& q);
  [[nodiscard]] bool is_amid(const Lattice& lattice, const Node& q);
  [[nodiscard]] Candidates in_cell(const MeshBox<D>& box, const Cell<D>& c, const Box<D>& area);

 private:
  using Simplex = std::array<std::size_t, D>;  // in around()
  [[nodiscard]] double pitch(const Point<D>& p) {
    grow(looked_at_, p);
    return limits_.pitch(p);
  }
  [[nodiscard]] bool fits(const Lattice& lattice, const Node& q, const Simplex& t);
  [[nodiscard]] bool is_between(const Lattice& lattice, const Node& q);

  const Limits<D>& limits_;
  Box<D> looked_at_;
};

template <int D>
bool Search<D>::is_candidate(const Lattice& lattice, const Node& q) {
  const Point<D> p = lattice.place(q);
  const double own = lattice.pitch();
  if (pitch(p) != own) return false;
  if (limits_.uniform()) return true;
  const double clear = own / 2;
  const Box<D> near = around(p, clear);
  typename Limits<D>::Pitches smaller = pitches_in(near);
  smaller.most = std::nextafter(own, 0);
  return !limits_.visit_pitches(smaller, [&](double pitch) {
    const Lattice other(pitch);
    return other.visit_in(near, [&](const Node& n) {
      return squared_distance(other.place(n), p) < clear * clear && is_candidate(other, n);
    });
  });
}

// Where the pitch is of a constant, the lattice's triangles have at most its area.
template <int D>
bool Search<D>::fits(const Lattice& lattice, const Node& q, const Simplex& t) {
  const auto nodes = Lattice::around(q);
  CornersOf<D> corners{lattice.place(q)};
  for (std::size_t i = 0; i < D; ++i) corners[i + 1] = lattice.place(nodes[t[i]]);
  const Point<D> middle = centroid(corners);
  grow(looked_at_, middle);
  if (limits_.constant_pitch(middle) == lattice.pitch()) return true;
  return lattice_measure<D>(lattice.pitch()) <= limits_.measure(middle) * kFits;
}

// Whether a candidate of another lattice is in the circumsphere of a simplex at q: as near to one
// of its corners as the circumradius.
template <int D>
bool Search<D>::is_between(const Lattice& lattice, const Node& q) {
  const double own = lattice.pitch(), radius = Lattice::kCircumradius * own;
  const Point<D> p = lattice.place(q);
  const auto near_corner = [&](const Point<D>& x) {
    const auto nodes = Lattice::around(q);
    return squared_distance(p, x) < radius * radius ||
           std::any_of(nodes.begin(), nodes.end(), [&](const Node& n) {
             return squared_distance(lattice.place(n), x) < radius * radius;
           });
  };
  const Box<D> near = around(p, 2 * radius);
  return limits_.visit_pitches(pitches_in(near), [&](double pitch) {
    const Lattice other(pitch);
    return pitch != own && other.visit_in(near, [&](const Node& n) {
      return near_corner(other.place(n)) && is_candidate(other, n);
    });
  });
}

template <int D>
bool Search<D>::is_amid(const Lattice& lattice, const Node& q) {
  for (const Node& n : Lattice::around(q)) {
    if (!is_candidate(lattice, n)) return false;
  }
  if (limits_.uniform()) return true;
  for (const Simplex& t : Lattice::kSimplices) {
    if (!fits(lattice, q, t)) return false;
  }
  return !is_between(lattice, q);
}

template <int D>
auto Search<D>::in_cell(const MeshBox<D>& box, const Cell<D>& c, const Box<D>& area) -> Candidates {
  Candidates found;
  limits_.visit_pitches(pitches_in(area), [&](double pitch) {
    const Lattice lattice(pitch);
    lattice.visit_in(area, [&](const Node& q) {
      const Point<D> p = lattice.place(q);
      const bool here = box.contains(p) && MeshBox<D>::cell(box.fixed(p), c.level) == c;
      if (here && is_candidate(lattice, q)) found.push_back({p, pitch, is_amid(lattice, q)});
      return false;
    });
    return false;
  });
  return found;
}

}  // namespace

template <int D>
CellPlan<D> plan_of(const Limits<D>& limits, const MeshBox<D>& box, const Cell<D>& c) {
  const Box<D> area = box.box_of(c);
  Search<D> search(limits, area);
  CellPlan<D> plan;
  const double least = search.pitches_in(area).least;
  if (least != Limits<D>::kNone) {
    plan.parts = box.cell_side(c.level) > kFilledAtOnce<D> * least;
    if (!plan.parts) plan.candidates = search.in_cell(box, c, area);
  }
  plan.looked_at = search.looked_at();
  return plan;
}
template CellPlan<2> plan_of(const Limits<2>&, const MeshBox<2>&, const Cell<2>&);
#ifndef MESHER_PLANE_ONLY
template CellPlan<3> plan_of(const Limits<3>&, const MeshBox<3>&, const Cell<3>&);
#endif

}  // namespace mesher::detail
