// Lines of the mesh, and what an update has changed of them.
#include <algorithm>
#include <iterator>

#include "facade/angle_finder.hpp"
#include "facade/state.hpp"
#include "plane/lost_edge.hpp"
#include "program/world_impl.hpp"

namespace mesher::detail {

OnFeatures State::on_features(const std::vector<Simplex>&) const {
  OnFeatures all;
  const auto& tree = vertices().tree();
  world_->leaves.for_each([&](const Leaf& leaf) {
    all.edges.push_back(
        {tree.find(leaf.lo)->self, tree.find(leaf.hi)->self, lines_[leaf.piece.segment]});
  });
  return all;
}

std::vector<Polyline> State::lines() const {
  std::vector<Polyline> all;
  all.reserve(line_points_.size());
  for (const auto& [id, points] : line_points_) all.push_back({id, points});
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
  return all;
}

// Leaves that stay, of segments that are now of another line. That is so rare that all leaves are
// looked at then.
void State::report_renamed(std::vector<mesher::LineEdge<2>>& gone,
                           std::vector<mesher::LineEdge<2>>& come) const {
  const auto is_renamed = [&](SegmentHandle s) {
    return news_.taken.find(s) != news_.taken.end() && lines_[s] != line(s);
  };
  const bool any = std::any_of(news_.segments.begin(), news_.segments.end(), is_renamed);
  if (!any) return;
  world_->leaves.for_each([&](const Leaf& leaf) {
    if (!leaf.committed || !is_renamed(leaf.piece.segment)) return;
    const auto& [low, high] = std::minmax(leaf.lo, leaf.hi);
    gone.push_back({low, high, lines_[leaf.piece.segment]});
    come.push_back({low, high, line(leaf.piece.segment)});
  });
}

// Leaves that ended or began, without those of which another piece is in the same place.
void State::report_others(const Log&, Change<2>& change) {
  std::vector<mesher::LineEdge<2>> gone;
  std::vector<mesher::LineEdge<2>> come;
  world_->leaves.for_each_changed([&](const Leaf& leaf) {
    const bool now = world_->leaves.is_leaf(leaf);
    if (now == leaf.committed) return;
    const auto& [low, high] = std::minmax(leaf.lo, leaf.hi);
    const SegmentHandle s = leaf.piece.segment;
    (now ? come : gone).push_back({low, high, now ? line(s) : lines_[s]});
  });
  report_renamed(gone, come);
  std::sort(gone.begin(), gone.end());
  std::sort(come.begin(), come.end());
  std::set_difference(come.begin(), come.end(), gone.begin(), gone.end(),
                      std::back_inserter(change.edges_added));
  std::set_difference(gone.begin(), gone.end(), come.begin(), come.end(),
                      std::back_inserter(change.edges_removed));
}

bool State::is_edge(const Leaf& leaf) const {
  const auto& tree = vertices().tree();
  const auto ring = vertices().ring(*tree.find(leaf.lo));
  const VertexHandle other = tree.find(leaf.hi)->self;
  return std::find(ring.begin(), ring.end(), other) != ring.end();
}

void State::require_others() const {
  if (!world_->leaves.may_lose()) return;
  LostEdge lost;
  world_->leaves.for_each([&](const Leaf& leaf) { lost.look(leaf, is_edge(leaf)); });
  lost.require_none(vertices(), segments().pool(), this);
}

// Of leaves that have come, and those at vertices with another star.
void State::require_others(const Log& log) const {
  if (!world_->leaves.may_lose()) return;
  LostEdge lost;
  const auto look = [&](const Leaf& leaf) { lost.look(leaf, is_edge(leaf)); };
  world_->leaves.for_each_changed([&](const Leaf& leaf) {
    if (world_->leaves.is_leaf(leaf)) look(leaf);
  });
  for (const auto& star : log.stars_come) {
    const Vertex<2>& v = pool()[star.center];
    if (v.input || v.on_segment) world_->leaves.for_each_ending_at(v.p, look);
  }
  lost.require_none(vertices(), segments().pool(), this);
}

void State::find_angles(const std::vector<Simplex>& come, Change<2>& change) const {
  change.angles = AngleFinder(*world_, rho_).news(come);
}

}  // namespace mesher::detail
