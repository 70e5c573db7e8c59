// Reading the mesh out of the program's world, and what an update has changed in it.
#include <algorithm>
#include <iterator>

#include "facade/state.hpp"
#include "program/world_impl.hpp"

namespace mesher::detail {

std::array<Point<2>, 3> State::corners(const Triangle& t) const {
  return smallest_first(std::array{pool()[t[0]].p, pool()[t[1]].p, pool()[t[2]].p});
}

std::vector<VertexHandle> State::live_vertices() const {
  std::vector<VertexHandle> all;
  pool().for_each([&](const Vertex<2>& v) {
    if (v.alive) all.push_back(v.self);
  });
  return all;
}

std::vector<State::Triangle> State::triangles() const {
  std::vector<Triangle> all;
  pool().for_each([&](const Vertex<2>& v) {
    for_each_own_simplex(pool(), v, vertices().ring(v),
                         [&](const Triangle& t) { all.push_back(t); });
  });
  return all;
}

std::vector<detail::LineEdge> State::line_edges() const {
  std::vector<detail::LineEdge> all;
  const auto& tree = vertices().tree();
  world_->leaves.for_each([&](const Leaf& leaf) {
    all.push_back({tree.find(leaf.lo)->self, tree.find(leaf.hi)->self, lines_[leaf.piece.segment]});
  });
  return all;
}

std::vector<InputPoint<2>> State::points() const {
  std::vector<InputPoint<2>> all;
  all.reserve(ids_.size());
  for (const auto& [id, h] : ids_) all.push_back({id, pool()[h].p});
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
  return all;
}

std::vector<InputLine> State::lines() const {
  std::vector<InputLine> all;
  all.reserve(line_points_.size());
  for (const auto& [id, points] : line_points_) all.push_back({id, points});
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
  return all;
}

Mesh<2> State::mesh() const {
  return canonical(pool(), live_vertices(), triangles(), line_edges());
}

MeshStats State::stats() const {
  MeshStats s = stats_;
  s.calls = engine_->live_calls();
  s.edges = engine_->live_edges();
  s.trace_bytes = engine_->bytes() + pool().bytes() + vertices().tree().bytes() +
                  world_->segments.bytes() + world_->leaves.bytes() + vertices().roles().bytes() +
                  world_->features.bytes();
  return s;
}

void State::report_vertices(const Log& log, Change<2>& change) const {
  for (const VertexHandle h : log.touched) {
    const Vertex<2>& v = pool()[h];
    if (v.alive && !v.committed) change.vertices_added.push_back(v.p);
    if (!v.alive && v.committed) change.vertices_removed.push_back(v.p);
    if (v.alive && v.committed && v.kind() != v.committed_kind) {
      change.kinds_changed.push_back({v.p, v.committed_kind, v.kind()});
    }
  }
  std::sort(change.vertices_added.begin(), change.vertices_added.end());
  std::sort(change.vertices_removed.begin(), change.vertices_removed.end());
  std::sort(change.kinds_changed.begin(), change.kinds_changed.end(),
            [](const auto& a, const auto& b) { return a.vertex < b.vertex; });
}

// The triangles that v outputs in its star of these neighbours, in the order of corners.
void State::own_triangles(const ChangeLog::Star& star, std::vector<Triangle>& all) const {
  all.clear();
  for_each_own_simplex(pool(), pool()[star.center], star.ring,
                       [&](const Triangle& t) { all.push_back(t); });
}

// Triangles of stars that went or came, without those that did both: these are output by the same
// vertex, so stars are compared with that of the same vertex only.
void State::report_stars(Log log, Change<2>& change) const {
  const auto by_center = [](const auto& a, const auto& b) { return a.center < b.center; };
  std::sort(log.stars_gone.begin(), log.stars_gone.end(), by_center);
  std::sort(log.stars_come.begin(), log.stars_come.end(), by_center);
  std::vector<Triangle> gone;
  std::vector<Triangle> come;
  const auto report = [&](const auto& these, const auto& those, auto& out) {
    for (const Triangle& t : these) {
      if (std::find(those.begin(), those.end(), t) == those.end()) out.push_back(corners(t));
    }
  };
  auto old = log.stars_gone.begin();
  auto now = log.stars_come.begin();
  while (old != log.stars_gone.end() || now != log.stars_come.end()) {
    const bool went =
        now == log.stars_come.end() || (old != log.stars_gone.end() && old->center <= now->center);
    const bool came =
        old == log.stars_gone.end() || (now != log.stars_come.end() && now->center <= old->center);
    went ? own_triangles(*old++, gone) : gone.clear();
    came ? own_triangles(*now++, come) : come.clear();
    report(come, gone, change.simplices_added);
    report(gone, come, change.simplices_removed);
  }
  std::sort(change.simplices_added.begin(), change.simplices_added.end());
  std::sort(change.simplices_removed.begin(), change.simplices_removed.end());
}

// Leaves that stay, of segments that are now of another line. That is so rare that all leaves are
// looked at then.
void State::report_renamed(std::vector<mesher::LineEdge<2>>& gone,
                           std::vector<mesher::LineEdge<2>>& come) const {
  const auto is_renamed = [&](SegmentHandle s) {
    return taken_.find(s) != taken_.end() && lines_[s] != line(s);
  };
  const bool any = std::any_of(new_segments_.begin(), new_segments_.end(), is_renamed);
  if (!any) return;
  world_->leaves.for_each([&](const Leaf& leaf) {
    if (!leaf.committed || !is_renamed(leaf.piece.segment)) return;
    const auto& [low, high] = std::minmax(leaf.lo, leaf.hi);
    gone.push_back({low, high, lines_[leaf.piece.segment]});
    come.push_back({low, high, line(leaf.piece.segment)});
  });
}

// Leaves that ended or began, without those of which another piece is in the same place.
void State::report_edges(Change<2>& change) const {
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

void State::check_invariants() const {
  engine_->check_invariants();
  vertices().check_invariants();
  for (const auto& [id, h] : ids_) {
    const Vertex<2>& v = pool()[h];
    SAC_INVARIANT(v.alive && v.input && v.feature && names_[h] == id);
  }
  SAC_INVARIANT(stats_.vertices == live_vertices().size());
  SAC_INVARIANT(stats_.simplices == triangles().size());
}

}  // namespace mesher::detail
