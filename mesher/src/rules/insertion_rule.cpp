// What the rules share: their margins, new vertices, and their names.
#include "rules/insertion_rule.hpp"

#include <cmath>

#include "mesher/error.hpp"
#include "geometry/plane.hpp"
#include "rules/radius_edge.hpp"
#include "rules/voronoi_aspect.hpp"

namespace mesher::detail {

namespace {

// Circumradii and edges of the triangles in question are computed to within 2^-45 (their
// coordinates relative to v are exact to the last place, and their angles are not small where the
// outcome is close), so what passes as good here is good in exact arithmetic.
constexpr double kSlack = 1 - 0x1p-40;

// All that depends on a rule's name.
struct Policy {
  Promise (*promise)(double rho);
  std::unique_ptr<const InsertionRule> (*make)(const Options<2>&, const MeshBox<2>&, const Limits&);
};

template <class R>
Policy policy_of() {
  return {R::promise_for,
          [](const Options<2>& options, const MeshBox<2>& box, const Limits& limits) {
            return std::unique_ptr<const InsertionRule>(
                std::make_unique<const R>(options, box, limits));
          }};
}

Policy policy(Rule rule) {
  switch (rule) {
    case Rule::radius_edge:
      return policy_of<RadiusEdge>();
    case Rule::voronoi_aspect:
      return policy_of<VoronoiAspect>();
  }
  throw Error(ErrorCode::bad_option, "there is no such rule");
}

}  // namespace

InsertionRule::InsertionRule(const Options<2>& options, const MeshBox<2>& box,
                             const Promise& promise)
    : promise_(promise),
      buckets_(options.rho, promise, box),
      box_(box),
      rho2_(options.rho * options.rho * kSlack),
      growth2_((1 + options.rho) * (1 + options.rho) / 4),
      tiny_(box.side * 0x1p-60) {}

// Gap balls have radii of a step of the boundary grid there, so their centres are not near a side:
// rounding does not matter (paper map (i)).
bool InsertionRule::is_centre(const VoronoiCell& cell, int corner) const {
  return box_.contains(plus(cell.center().p, cell.corner(corner)));
}

// Sums that cancel near an axis leave noise in the last places; a vertex beside such a one has
// noise in places as far down again. Zero is as near, and keeps coordinates within a range of bits.
Point<2> InsertionRule::rounded(const Point<2>& p) const {
  return {std::abs(p[0]) < tiny_ ? 0 : p[0], std::abs(p[1]) < tiny_ ? 0 : p[1]};
}

// In exact arithmetic p is at least rho lengths from every vertex. The rounded place must keep half
// of the growth: lengths that grow by a factor are what ends the refinement.
InsertionRule::NewPoint InsertionRule::new_point(const VoronoiCell& cell, const Point<2>& p,
                                                 double length2, double growth2) const {
  NewPoint point{rounded(p), 0, false};
  point.nearest2 = squared_distance(point.p, cell.center().p);
  for (int i = 0; i < cell.size(); ++i) {
    if (!cell.real(i)) continue;
    point.nearest2 = std::min(point.nearest2, squared_distance(point.p, cell.place(i)));
  }
  point.farther = point.nearest2 > growth2 * length2;
  return point;
}

std::unique_ptr<const InsertionRule> insertion_rule(const Options<2>& options,
                                                    const MeshBox<2>& box, const Limits& limits) {
  return policy(options.rule).make(options, box, limits);
}

Promise promise(Rule rule, double rho) { return policy(rule).promise(rho); }

}  // namespace mesher::detail
