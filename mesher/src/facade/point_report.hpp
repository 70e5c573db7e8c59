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
auto PointState<D>::simplices() const -> std::vector<Simplex> {
  std::vector<Simplex> all;
  vertices().for_each_simplex([&](const Simplex& t) { all.push_back(t); });
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
  return canonical(pool(), vertices().live_vertices(), all, on_features(all));
}

template <int D>
MeshStats PointState<D>::stats() const {
  MeshStats s = stats_;
  s.calls = engine_->live_calls();
  s.edges = engine_->live_edges();
  s.trace_bytes = engine_->bytes() + pool().bytes() + vertices().tree().bytes() +
                  vertices().triangulation_bytes() + vertices().roles().bytes() +
                  world_->features.bytes() + feature_bytes();
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

template <int D>
void PointState<D>::report_simplices(const Log& log, Change<D>& change) const {
  const auto list = [&](const std::vector<Simplex>& simplices, auto& places) {
    places.reserve(simplices.size());
    for (const Simplex& t : simplices) places.push_back(corners(t));
    std::sort(places.begin(), places.end());
  };
  list(log.simplices_come, change.simplices_added);
  list(log.simplices_gone, change.simplices_removed);
}

template <int D>
void PointState<D>::judge_new(Change<D>& change) const {
  if constexpr (D == 3) {
    std::vector<Simplex> come;
    const auto& added = change.simplices_added;  // ascending
    vertices().for_each_simplex([&](const Simplex& s) {
      if (std::binary_search(added.begin(), added.end(), corners(s))) come.push_back(s);
    });
    change.guard = {};
    find_angles(come, change);
  }
}

template <int D>
void PointState<D>::check_invariants() const {
  engine_->check_invariants();
  vertices().check_invariants();
  for (const auto& [id, h] : ids_) {
    const Vertex<D>& v = pool()[h];
    SAC_INVARIANT(v.alive && v.input && v.feature && names_[h] == id);
  }
  SAC_INVARIANT(stats_.vertices == vertices().live_vertices().size());
  SAC_INVARIANT(stats_.simplices == simplices().size());
  check_features();
}

}  // namespace mesher::detail
