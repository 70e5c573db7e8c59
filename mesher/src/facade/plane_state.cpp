// Lines of the mesh, and what an update has changed of them.
#include "facade/plane_state.hpp"

#include <algorithm>

#include "facade/angle_finder.hpp"
#include "plane/lost_edge.hpp"
#include "plane/require_planar.hpp"
#include "program/world_impl.hpp"
#include "sets/make_set.hpp"
#include "sets/report_difference.hpp"

namespace mesher::detail {

void PlaneState::require_fit() {
  PlanarityCheck(world_->segments.store(), pool(), features(), ask_)
      .require({segment_names_.added(), arrivals()}, *this);
}

// Leaves' records refer to those of segments, and these to those of vertices.
void PlaneState::free_features() noexcept {
  world_->leaves.commit();
  world_->segments.commit();
}

// --- Leaves ----------------------------------------------------------------------------------

OnFeatures PlaneState::on_features(const std::vector<Simplex>&) const {
  OnFeatures all;
  const auto& tree = vertices().tree();
  world_->leaves.for_each([&](const Leaf& leaf) {
    all.edges.push_back(
        {tree.find(leaf.lo)->self, tree.find(leaf.hi)->self, old_line(leaf.piece.segment)});
  });
  return all;
}

bool PlaneState::any_renamed() const {
  const auto& added = segment_names_.added();
  return std::any_of(added.begin(), added.end(), [&](SegmentHandle s) { return is_renamed(s); });
}

// Leaves that stay, of segments that are now of another line. That is so rare that all leaves are
// looked at then.
void PlaneState::report_renamed(LineEdges& gone, LineEdges& come) const {
  if (!any_renamed()) return;
  world_->leaves.for_each([&](const Leaf& leaf) {
    const SegmentHandle s = leaf.piece.segment;
    if (!leaf.committed || !is_renamed(s)) return;
    gone.push_back(edge_between(leaf.lo, leaf.hi, old_line(s)));
    come.push_back(edge_between(leaf.lo, leaf.hi, line(s)));
  });
}

// Leaves that ended or began, without those of which another piece is in the same place.
void PlaneState::report_features(const Log&, Change<2>& change) {
  LineEdges gone;
  LineEdges come;
  world_->leaves.for_each_changed([&](const Leaf& leaf) {
    const bool now = world_->leaves.is_leaf(leaf);
    if (now == leaf.committed) return;
    const SegmentHandle s = leaf.piece.segment;
    (now ? come : gone).push_back(edge_between(leaf.lo, leaf.hi, now ? line(s) : old_line(s)));
  });
  report_renamed(gone, come);
  report_difference(std::move(come), std::move(gone), change.edges_added, change.edges_removed);
}

bool PlaneState::is_edge(const Leaf& leaf) const {
  const auto& tree = vertices().tree();
  const VertexHandle other = tree.find(leaf.hi)->self;
  bool is = false;
  vertices().for_each_simplex_at(
      *tree.find(leaf.lo), [&](const Simplex& t) { is = is || t[1] == other || t[2] == other; });
  return is;
}

void PlaneState::require_features() const {
  if (!world_->leaves.may_lose()) return;
  LostEdge lost;
  world_->leaves.for_each([&](const Leaf& leaf) { lost.look(leaf, is_edge(leaf)); });
  lost.require_none(vertices(), world_->segments.pool(), this);
}

// Of leaves that have come, and those at vertices with another star.
void PlaneState::require_features(const Log& log) const {
  if (!world_->leaves.may_lose()) return;
  LostEdge lost;
  const auto look = [&](const Leaf& leaf) { lost.look(leaf, is_edge(leaf)); };
  world_->leaves.for_each_changed([&](const Leaf& leaf) {
    if (world_->leaves.is_leaf(leaf)) look(leaf);
  });
  std::vector<VertexHandle> corners;
  for (const Simplex& t : log.simplices_come) corners.insert(corners.end(), t.begin(), t.end());
  make_set(corners);
  for (const VertexHandle h : corners) {
    const Vertex<2>& v = pool()[h];
    if (v.input || v.on_segment) world_->leaves.for_each_ending_at(v.p, look);
  }
  lost.require_none(vertices(), world_->segments.pool(), this);
}

void PlaneState::find_angles(const std::vector<Simplex>& come, Change<2>& change) const {
  const WorldMesh mesh(*world_);
  change.angles = AngleFinder<WorldMesh>(mesh, rho_).news(come);
}

}  // namespace mesher::detail
