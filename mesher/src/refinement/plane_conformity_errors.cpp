// What is said where doubles or the budget of vertices do not suffice.
#include <map>
#include <set>

#include "plane/lost_edge.hpp"
#include "plane/vertex_budget.hpp"
#include "program/world.hpp"
#include "refinement/plane_conformity.hpp"

namespace mesher::detail {

/// Of a piece that is no edge: that there is a vertex in its ball. Cost: O(vertices), if labels
/// have ever overruled places beside it.
void PlaneConformity::require_edge(std::uint32_t piece) const {
  if (piece >= overruled_.size() || !overruled_[piece]) return;
  std::set<SegmentHandle> others;
  for (std::uint32_t v = 1; v < vertices_.size(); ++v) {
    const Relation is = relation_to(piece, v);
    if (is == Relation::in_ball) return;
    if (is == Relation::beside) others.insert(vertices_[v].role.on);
  }
  throw lost_edge(leaf(piece), others, store_.segments.pool(), store_.names);
}

void PlaneConformity::fail_occupied(const Placed& place) const {
  store_.fail_near(place.p, 0, "a new vertex would coincide with another");
}

void PlaneConformity::fail_too_many(std::size_t most) const {
  std::map<LineId, std::size_t> counts;
  for (const Known& v : vertices_) {
    if (v.role.on != 0) ++counts[store_.names->line(v.role.on)];
  }
  throw too_many_vertices(counts, most);
}

}  // namespace mesher::detail
