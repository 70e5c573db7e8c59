// Finds leaves that are no edges of the mesh, as at angles below double precision.
//
// A leaf whose closed ball has no vertex is an edge of the Delaunay triangulation. A vertex that is
// outside by its label may be inside by its rounded coordinates (leaf.hpp), which costs the edge
// only if there are others on both sides of it: of three or more segments that leave a point at a
// tiny angle. So edges have to be looked for where a label has overruled coordinates, and only
// there.
#pragma once

#include <set>

#include "index/vertex_search.hpp"
#include "mesher/error.hpp"
#include "plane/leaf.hpp"
#include "plane/planarity.hpp"

namespace mesher::detail {

/// A leaf that is no edge, named with its line and `others`, the segments that have vertices in its
/// ball. `names`: null if features have none.
[[nodiscard]] Error lost_edge(const Leaf& leaf, const std::set<SegmentHandle>& others,
                              const SegmentPool& segments, const Names* names);

/// The first in canonical order of the leaves that are found to be no edges.
class LostEdge {
 public:
  void look(const Leaf& leaf, bool is_edge) {
    if (!is_edge && (first_ == nullptr || order(leaf, *first_) < 0)) first_ = &leaf;
  }
  /// Throws: Error(too_close) if there is one, with the ids of its line and of those with vertices
  /// in its ball. `names`: null if features have none.
  void require_none(const VertexSearch<2>& vertices, const SegmentPool& segments,
                    const Names* names) const;

 private:
  const Leaf* first_ = nullptr;
};

}  // namespace mesher::detail
