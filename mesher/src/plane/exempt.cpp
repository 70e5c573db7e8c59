// Legs of vertices, in pairs.
#include "plane/exempt.hpp"

#include <cmath>

#include "geometry/segment_tests.hpp"

namespace mesher::detail {

namespace {

// Calls visit(leg, apex, distance): v is on `leg`, at this distance from its end `apex`; as the far
// end of the leg if v is an input point.
template <class Visit>
void for_each_leg(const SegmentStore& segments, const VertexOnLines& v, Visit&& visit) {
  if (v.role.on != 0) {
    const Segment& s = segments[v.role.on];
    visit(s, s.a, v.role.label.from(false, s.length));
    visit(s, s.b, v.role.label.from(true, s.length));
  } else if (v.point != 0) {
    segments.visit_at(v.point, [&](const Segment& s) { visit(s, s.other(v.point), s.length); });
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

VertexOnLines on_lines(const VertexSearch<2>& vertices, const Vertex<2>& v) {
  return {v.p, vertices.role(v), v.input && !v.on_segment ? v.self : 0};
}

// Calls visit(s, t, apex) for segments s and t that meet sharply at `apex`, p on s and q on t
// equally far from it.
template <class Visit>
void for_each_wedge(const SegmentStore& segments, const VertexOnLines& p, const VertexOnLines& q,
                    Visit&& visit) {
  const auto may_be = [](const VertexOnLines& v) { return v.role.on != 0 || v.point != 0; };
  if (!may_be(p) || !may_be(q)) return;
  for_each_leg(segments, p, [&](const Segment& s, VertexHandle apex, double from_p) {
    for_each_leg(segments, q, [&](const Segment& t, VertexHandle other, double from_q) {
      if (other != apex || s.self == t.self || !equally_far(from_p, from_q)) return;
      if (meet_sharply(s, t, apex)) visit(s, t, apex);
    });
  });
}

// Whether the apex, an end of s, is on the left of p -> q.
bool is_left(const VertexOnLines& p, const VertexOnLines& q, const Segment& s, VertexHandle apex) {
  return predicates::orient2d(p.p, q.p, s.a == apex ? s.place_a : s.place_b) > 0;
}

}  // namespace

bool is_exempt(const SegmentStore& segments, const VertexOnLines& p, const VertexOnLines& q) {
  const bool both_inside = p.role.on != 0 && q.role.on != 0;
  bool exempt = false;
  for_each_wedge(segments, p, q, [&](const Segment& s, const Segment&, VertexHandle apex) {
    exempt = exempt || both_inside || is_left(p, q, s, apex);
  });
  return exempt;
}

bool is_exempt(const VertexSearch<2>& vertices, const SegmentStore& segments, const Vertex<2>& p,
               const Vertex<2>& q) {
  return is_exempt(segments, on_lines(vertices, p), on_lines(vertices, q));
}

std::vector<Wedge> wedges_across(const SegmentStore& segments, const VertexOnLines& p,
                                 const VertexOnLines& q, bool any_side) {
  const bool both_inside = p.role.on != 0 && q.role.on != 0;
  std::vector<Wedge> found;
  for_each_wedge(segments, p, q, [&](const Segment& s, const Segment& t, VertexHandle apex) {
    if (any_side || both_inside || is_left(p, q, s, apex)) {
      found.push_back({s.self, t.self, apex});
    }
  });
  return found;
}

}  // namespace mesher::detail
