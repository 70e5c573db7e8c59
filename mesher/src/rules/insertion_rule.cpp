// What the rules share: their margins, new vertices, and their names.
#include "rules/insertion_rule.hpp"

#include <cmath>

#include "mesher/error.hpp"
#include "rules/radius_edge.hpp"
#include "rules/voronoi_aspect.hpp"

namespace mesher::detail {

namespace {

// Circumradii and edges of the triangles in question are computed to within 2^-45 (their
// coordinates relative to v are exact to the last place, and their angles are not small where the
// outcome is close), so what passes as good here is good in exact arithmetic.
constexpr double kSlack = 1 - 0x1p-40;

// All that depends on a rule's name.
template <int D>
struct Policy {
  Promise (*promise)(double rho);
  std::unique_ptr<const InsertionRule<D>> (*make)(const Options<D>&, const MeshBox<D>&,
                                                  const LimitsOf<D>&);
};

template <int D, class R>
Policy<D> policy_of() {
  return {R::promise_for,
          [](const Options<D>& options, const MeshBox<D>& box, const LimitsOf<D>& limits) {
            return std::unique_ptr<const InsertionRule<D>>(
                std::make_unique<const R>(options, box, limits));
          }};
}

template <int D>
Policy<D> policy(Rule rule) {
  switch (rule) {
    case Rule::radius_edge:
      return policy_of<D, RadiusEdge<D>>();
    case Rule::voronoi_aspect:
      return policy_of<D, VoronoiAspect<D>>();
  }
  throw Error(ErrorCode::bad_option, "there is no such rule");
}

}  // namespace

template <int D>
InsertionRule<D>::InsertionRule(const Options<D>& options, const MeshBox<D>& box,
                                const Promise& promise)
    : promise_(promise),
      buckets_(options.rho, promise, box),
      box_(box),
      rho2_(options.rho * options.rho * kSlack),
      growth2_((1 + options.rho) * (1 + options.rho) / 4),
      tiny_(box.side * 0x1p-60) {}

// Gap balls have radii of a step of the boundary grid there, so their centres are not near a side:
// rounding does not matter (paper map (i)).
template <int D>
bool InsertionRule<D>::is_centre(const CellOf<D>& cell, int corner) const {
  return box_.contains(plus(cell.center().p, cell.corner(corner)));
}

// Sums that cancel near an axis leave noise in the last places; a vertex beside such a one has
// noise in places as far down again. Zero is as near, and keeps coordinates within a range of bits.
template <int D>
Point<D> InsertionRule<D>::rounded(Point<D> p) const {
  for (double& x : p) x = std::abs(x) < tiny_ ? 0 : x;
  return p;
}

// In exact arithmetic p is at least rho lengths from every vertex. The rounded place must keep half
// of the growth: lengths that grow by a factor are what ends the refinement.
template <int D>
auto InsertionRule<D>::new_point(const CellOf<D>& cell, const Point<D>& p, double length2,
                                 double growth2) const -> NewPoint {
  NewPoint point{rounded(p), 0, false};
  point.nearest2 = squared_distance(point.p, cell.center().p);
  for (int i = 0; i < cell.size(); ++i) {
    if (!cell.real(i)) continue;
    point.nearest2 = std::min(point.nearest2, squared_distance(point.p, cell.place(i)));
  }
  point.farther = point.nearest2 > growth2 * length2;
  return point;
}

template <int D>
std::unique_ptr<const InsertionRule<D>> insertion_rule(const Options<D>& options,
                                                       const MeshBox<D>& box,
                                                       const LimitsOf<D>& limits) {
  if constexpr (D == 3) {
    if (options.min_dihedral != 0 && options.rule != Rule::radius_edge) {
      throw Error(
          ErrorCode::bad_option,
          "min_dihedral, by gap-balls and in a mesh under edits, needs the rule radius-edge");
    }
  }
  if (options.growth != 0) {
    throw Error(ErrorCode::bad_option,
                "gap-balls, and so a mesh under edits, has no bound of growth: growth must be 0");
  }
  return policy<D>(options.rule).make(options, box, limits);
}

template <int D>
Promise promise(Rule rule, double rho) {
  return policy<D>(rule).promise(rho);
}

template class InsertionRule<2>;
template std::unique_ptr<const InsertionRule<2>> insertion_rule<2>(const Options<2>&,
                                                                   const MeshBox<2>&,
                                                                   const LimitsOf<2>&);
template Promise promise<2>(Rule, double);
#ifndef MESHER_PLANE_ONLY
template class InsertionRule<3>;
template class InsertionRule<4>;
template std::unique_ptr<const InsertionRule<3>> insertion_rule<3>(const Options<3>&,
                                                                   const MeshBox<3>&,
                                                                   const LimitsOf<3>&);
template std::unique_ptr<const InsertionRule<4>> insertion_rule<4>(const Options<4>&,
                                                                   const MeshBox<4>&,
                                                                   const LimitsOf<4>&);
template Promise promise<3>(Rule, double);
template Promise promise<4>(Rule, double);
#endif

}  // namespace mesher::detail
