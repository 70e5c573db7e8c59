// Legs of vertices, in pairs.
#include "segments/exempt.hpp"

#include <cmath>

#include "geometry/segment_tests.hpp"

namespace mesher::detail {

namespace {

// Calls visit(leg, apex, distance): v is on `leg`, at this distance from its end `apex`; as the far
// end of the leg if v is an input point.
template <class Visit>
void for_each_leg(const VertexSearch<2>& vertices, const SegmentStore& segments, const Vertex<2>& v,
                  Visit&& visit) {
  if (v.on_segment) {
    const Role role = vertices.role(v);
    const Segment& s = segments[role.on];
    visit(s, s.a, role.label.from(false, s.length));
    visit(s, s.b, role.label.from(true, s.length));
  } else if (v.input) {
    segments.visit_at(v.self, [&](const Segment& s) { visit(s, s.other(v.self), s.length); });
  }
}

// Whether they meet at their common end at under 60 degrees.
bool meet_sharply(const Segment& s, const Segment& t, VertexHandle apex) {
  constexpr double kTan60 = 1.7320508075688772;
  const auto along = [&](const Segment& leg) {
    const Point<2>& o = leg.a == apex ? leg.place_a : leg.place_b;
    const Point<2>& e = leg.a == apex ? leg.place_b : leg.place_a;
    return Point<2>{e[0] - o[0], e[1] - o[1]};
  };
  return is_narrower(along(s), along(t), kTan60);
}

// Labels from the far ends are differences of rounded lengths.
bool equally_far(double x, double y) { return std::abs(x - y) <= 1e-9 * (x + y); }

}  // namespace

bool has_sharp_neighbour(const SegmentStore& segments, const Segment& s, VertexHandle apex) {
  return segments.visit_at(
      apex, [&](const Segment& t) { return t.self != s.self && meet_sharply(s, t, apex); });
}

namespace {

// Calls visit(s, t, apex) for segments s and t that meet sharply at `apex`, p on s and q on t
// equally far from it.
template <class Visit>
void for_each_wedge(const VertexSearch<2>& vertices, const SegmentStore& segments,
                    const Vertex<2>& p, const Vertex<2>& q, Visit&& visit) {
  const auto may_be = [](const Vertex<2>& v) { return v.on_segment || v.input; };
  if (!may_be(p) || !may_be(q)) return;
  for_each_leg(vertices, segments, p, [&](const Segment& s, VertexHandle apex, double from_p) {
    for_each_leg(vertices, segments, q, [&](const Segment& t, VertexHandle other, double from_q) {
      if (other != apex || s.self == t.self || !equally_far(from_p, from_q)) return;
      if (meet_sharply(s, t, apex)) visit(s, t, apex);
    });
  });
}

}  // namespace

bool is_exempt(const VertexSearch<2>& vertices, const SegmentStore& segments, const Vertex<2>& p,
               const Vertex<2>& q) {
  const bool both_inside = p.on_segment && q.on_segment;
  bool exempt = false;
  for_each_wedge(vertices, segments, p, q, [&](const Segment&, const Segment&, VertexHandle apex) {
    exempt = exempt || both_inside || predicates::orient2d(p.p, q.p, vertices.pool()[apex].p) > 0;
  });
  return exempt;
}

std::vector<Wedge> wedges_across(const VertexSearch<2>& vertices, const SegmentStore& segments,
                                 const Vertex<2>& p, const Vertex<2>& q, bool any_side) {
  const bool both_inside = p.on_segment && q.on_segment;
  std::vector<Wedge> found;
  for_each_wedge(vertices, segments, p, q,
                 [&](const Segment& s, const Segment& t, VertexHandle apex) {
                   const bool left = predicates::orient2d(p.p, q.p, vertices.pool()[apex].p) > 0;
                   if (any_side || both_inside || left) found.push_back({s.self, t.self, apex});
                 });
  return found;
}

}  // namespace mesher::detail
