// The poor triangles that are left [rules A5.2; Miller, Pav, Walkington]: those on an edge that
// joins equal labels of two segments at under 60 degrees.
//
// Such an edge is as short as the angle makes it, and a vertex beside it would ask for a next edge
// of the shells to be split. An end of the edge may be the far end of a leg: then the triangle
// stays only on the side of the apex, since the other side is not between the segments.
//
// It depends on the roles of p and q, and on the segments at them if they are input points: a call
// that observes a vertex observes these (vertex_index.hpp).
#pragma once

#include <vector>

#include "index/vertex_search.hpp"
#include "plane/segment_store.hpp"

namespace mesher::detail {

/// A vertex as far as this rule asks: its place on a segment, or the input point that it is.
struct VertexOnLines {
  Point<2> p;
  Role role;
  VertexHandle point = 0;
};

/// Whether a live segment at `apex`, an end of s, meets s there at under 60 degrees. If none does,
/// no triangle stays or not for the sake of s as a leg from that apex. Cost: O(segments at it).
[[nodiscard]] bool has_sharp_neighbour(const SegmentStore& segments, const Segment& s,
                                       VertexHandle apex);

/// Whether a poor triangle on the left of p -> q, its shortest edge, stays.
[[nodiscard]] bool is_exempt(const SegmentStore& segments, const VertexOnLines& p,
                             const VertexOnLines& q);
[[nodiscard]] bool is_exempt(const VertexSearch<2>& vertices, const SegmentStore& segments,
                             const Vertex<2>& p, const Vertex<2>& q);

/// Two segments with a common end.
struct Wedge {
  SegmentHandle s, t;
  VertexHandle apex;
};
/// Those for the sake of which it stays; `any_side`: or a triangle on the right of p -> q.
[[nodiscard]] std::vector<Wedge> wedges_across(const SegmentStore& segments, const VertexOnLines& p,
                                               const VertexOnLines& q, bool any_side);

}  // namespace mesher::detail
