// Which poor triangles stay [rules A5.2; Miller, Pav, Walkington]: those on an edge that joins equal
// labels of two segments at under 60 degrees.
//
// Such an edge is as short as the angle makes it, and a vertex beside it would ask for a next edge of
// the shells to be split. An end of the edge may be the far end of a leg: then the triangle stays
// only on the side of the apex, since the other side is not between the segments.
//
// What it depends on is the roles of p and q, and the segments at them where they are input points:
// who sees a vertex sees these (vertex_index.hpp).
#pragma once

#include <array>
#include <cmath>

#include "index/vertex_search.hpp"
#include "mesher/predicates.hpp"
#include "segments/segment.hpp"

namespace mesher::detail {

/// Calls visit(leg, apex, distance): v is on `leg`, at this distance from its end `apex`; as the far
/// end of the leg if v is an input point. for_each_at(v, visit) visits the segments at an input point.
template <class ForEachAt, class Visit>
void for_each_leg(const VertexSearch& vertices, const SegmentPool& segments, const Vertex<2>& v,
                  ForEachAt&& for_each_at, Visit&& visit) {
  if (v.on_segment) {
    const Role role = vertices.role(v);
    const Segment& s = segments[role.on];
    visit(s, s.a, role.label.from(false, s.length));
    visit(s, s.b, role.label.from(true, s.length));
  } else if (v.input) {
    for_each_at(v.self, [&](SegmentHandle h) {
      const Segment& s = segments[h];
      visit(s, s.a == v.self ? s.b : s.a, s.length);
    });
  }
}

/// Whether two segments meet at their common end `apex` at under 60 degrees.
[[nodiscard]] inline bool meet_sharply(const VertexPool<2>& pool, const Segment& s,
                                       const Segment& t, VertexHandle apex) {
  const auto leg = [&](const Segment& l) {
    const Point<2>& p = pool[l.a == apex ? l.b : l.a].p;
    return Point<2>{p[0] - pool[apex].p[0], p[1] - pool[apex].p[1]};
  };
  const Point<2> u = leg(s);
  const Point<2> w = leg(t);
  const double dot = u[0] * w[0] + u[1] * w[1];
  const double cross = u[0] * w[1] - u[1] * w[0];
  return dot > 0 && cross * cross < 3 * (dot * dot);
}

/// Whether a poor triangle on the left of p -> q, its shortest edge, stays.
template <class ForEachAt>
[[nodiscard]] bool is_exempt(const VertexSearch& vertices, const SegmentPool& segments,
                             const Vertex<2>& p, const Vertex<2>& q, ForEachAt&& for_each_at) {
  const auto may_be = [](const Vertex<2>& v) { return v.on_segment || v.input; };
  if (!may_be(p) || !may_be(q)) return false;
  // Labels from the far ends are differences of rounded lengths.
  constexpr double kTolerance = 1e-9;
  const bool at_an_end = p.input || q.input;
  bool exempt = false;
  for_each_leg(vertices, segments, p, for_each_at,
               [&](const Segment& s, VertexHandle apex, double from_p) {
    for_each_leg(vertices, segments, q, for_each_at,
                 [&](const Segment& t, VertexHandle other, double from_q) {
      if (other != apex || s.self == t.self) return;
      if (std::abs(from_p - from_q) > kTolerance * (from_p + from_q)) return;
      if (!meet_sharply(vertices.pool(), s, t, apex)) return;
      exempt = exempt || !at_an_end ||
               predicates::orient2d(p.p, q.p, vertices.pool()[apex].p) > 0;
    });
  });
  return exempt;
}

}  // namespace mesher::detail
