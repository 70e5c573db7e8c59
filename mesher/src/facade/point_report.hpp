// The parts of PointState that read: the mesh out of the program's world, and what an update has
// changed in it.
#pragma once

#include <algorithm>

#include "facade/point_state.hpp"
#include "program/world_impl.hpp"

namespace mesher::detail {

template <int D>
std::array<Point<D>, D + 1> PointState<D>::corners(const Simplex& s) const {
  std::array<Point<D>, D + 1> places;
  for (std::size_t k = 0; k < s.size(); ++k) places[k] = pool()[s[k]].p;
  return smallest_first(places);
}

template <int D>
std::vector<VertexHandle> PointState<D>::live_vertices() const {
  std::vector<VertexHandle> all;
  pool().for_each([&](const Vertex<D>& v) {
    if (v.alive) all.push_back(v.self);
  });
  return all;
}

template <int D>
auto PointState<D>::simplices() const -> std::vector<Simplex> {
  std::vector<Simplex> all;
  pool().for_each([&](const Vertex<D>& v) {
    if (!v.alive) return;
    for_each_own_simplex(pool(), v, vertices().ring(v),
                         [&](const Simplex& t) { all.push_back(t); });
  });
  return all;
}

template <int D>
std::vector<GraphPoint<D>> PointState<D>::points() const {
  std::vector<GraphPoint<D>> all;
  all.reserve(ids_.size());
  for (const auto& [id, h] : ids_) all.push_back({id, pool()[h].p});
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
  return all;
}

template <int D>
Mesh<D> PointState<D>::mesh() const {
  const std::vector<Simplex> all = simplices();
  return canonical(pool(), live_vertices(), all, on_features(all));
}

template <int D>
MeshStats PointState<D>::stats() const {
  MeshStats s = stats_;
  s.calls = engine_->live_calls();
  s.edges = engine_->live_edges();
  s.trace_bytes = engine_->bytes() + pool().bytes() + vertices().tree().bytes() +
                  vertices().roles().bytes() + world_->features.bytes() + feature_bytes();
  return s;
}

template <int D>
void PointState<D>::report_vertices(const Log& log, Change<D>& change) const {
  std::vector<std::pair<Point<D>, VertexKind>> come;
  for (const VertexHandle h : log.touched) {
    const Vertex<D>& v = pool()[h];
    if (v.alive && !v.committed) come.emplace_back(v.p, v.kind());
    if (!v.alive && v.committed) change.vertices_removed.push_back(v.p);
    if (v.alive && v.committed && v.kind() != v.committed_kind) {
      change.kinds_changed.push_back({v.p, v.committed_kind, v.kind()});
    }
  }
  std::sort(come.begin(), come.end());
  for (const auto& [p, kind] : come) {
    change.vertices_added.push_back(p);
    change.kinds_added.push_back(kind);
  }
  std::sort(change.vertices_removed.begin(), change.vertices_removed.end());
  std::sort(change.kinds_changed.begin(), change.kinds_changed.end(),
            [](const auto& a, const auto& b) { return a.vertex < b.vertex; });
}

// The simplices that v outputs in its star, in canonical order.
template <int D>
void PointState<D>::own_simplices(const typename ChangeLog<D>::Star& star,
                                  std::vector<Simplex>& all) const {
  all.clear();
  for_each_own_simplex(pool(), pool()[star.center], star.ring,
                       [&](const Simplex& t) { all.push_back(t); });
}

// Simplices of stars that went or came, without those that did both: these are output by the same
// vertex, so stars are compared with that of the same vertex only. Returns those that came.
template <int D>
auto PointState<D>::report_stars(Log log, Change<D>& change) const -> std::vector<Simplex> {
  const auto by_center = [](const auto& a, const auto& b) { return a.center < b.center; };
  std::sort(log.stars_gone.begin(), log.stars_gone.end(), by_center);
  std::sort(log.stars_come.begin(), log.stars_come.end(), by_center);
  std::vector<Simplex> gone;
  std::vector<Simplex> come;
  std::vector<Simplex> all_come;
  const auto report = [&](const auto& these, const auto& those, auto&& out) {
    for (const Simplex& t : these) {
      if (std::find(those.begin(), those.end(), t) == those.end()) out(t);
    }
  };
  auto old = log.stars_gone.begin();
  auto now = log.stars_come.begin();
  while (old != log.stars_gone.end() || now != log.stars_come.end()) {
    const bool went =
        now == log.stars_come.end() || (old != log.stars_gone.end() && old->center <= now->center);
    const bool came =
        old == log.stars_gone.end() || (now != log.stars_come.end() && now->center <= old->center);
    went ? own_simplices(*old++, gone) : gone.clear();
    came ? own_simplices(*now++, come) : come.clear();
    report(come, gone, [&](const Simplex& t) {
      change.simplices_added.push_back(corners(t));
      all_come.push_back(t);
    });
    report(gone, come, [&](const Simplex& t) { change.simplices_removed.push_back(corners(t)); });
  }
  std::sort(change.simplices_added.begin(), change.simplices_added.end());
  std::sort(change.simplices_removed.begin(), change.simplices_removed.end());
  return all_come;
}

template <int D>
void PointState<D>::check_invariants() const {
  engine_->check_invariants();
  vertices().check_invariants();
  for (const auto& [id, h] : ids_) {
    const Vertex<D>& v = pool()[h];
    SAC_INVARIANT(v.alive && v.input && v.feature && names_[h] == id);
  }
  SAC_INVARIANT(stats_.vertices == live_vertices().size());
  SAC_INVARIANT(stats_.simplices == simplices().size());
  check_features();
}

}  // namespace mesher::detail
