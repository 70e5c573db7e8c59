// Changes of a mesh as those who follow its domain take them.
#pragma once

#include <algorithm>
#include <vector>

#include "domain/domain_follower.hpp"
#include "facade/staged.hpp"

namespace mesher::detail {

template <class Point>
[[nodiscard]] std::uint32_t index_of(const std::vector<Point>& sorted, const Point& p) {
  return static_cast<std::uint32_t>(std::lower_bound(sorted.begin(), sorted.end(), p) -
                                    sorted.begin());
}

/// The mesh that a first run brings.
template <int D>
[[nodiscard]] Mesh<D> mesh_of(const Change<D>& change) {
  Mesh<D> mesh;
  mesh.vertices = change.vertices_added;
  mesh.simplices.reserve(change.simplices_added.size());
  for (const auto& corners : change.simplices_added) {
    auto& simplex = mesh.simplices.emplace_back();
    for (std::size_t i = 0; i < corners.size(); ++i) {
      simplex[i] = index_of(mesh.vertices, corners[i]);
    }
  }
  return mesh;
}

/// The walls that a first run brings.
[[nodiscard]] inline std::vector<MeshEdge> walls_of(const Change<2>& change) {
  std::vector<MeshEdge> walls;
  for (const auto& e : change.edges_added) {
    const auto& all = change.vertices_added;
    walls.push_back({index_of(all, e.low), index_of(all, e.high), e.feature.line(), 0});
  }
  return walls;
}

[[nodiscard]] inline std::vector<MeshFace> walls_of(const Change<3>& change) {
  std::vector<MeshFace> walls;
  for (const auto& f : change.faces_added) {
    const auto& all = change.vertices_added;
    const auto& [a, b, c] = f.corners;
    walls.push_back({{index_of(all, a), index_of(all, b), index_of(all, c)}, f.polygon, 0});
  }
  return walls;
}

template <int D>
using EditedSeedsOf = Staged<SeedId, Seed<D>>;
using EditedSeeds = EditedSeedsOf<2>;

/// All seeds that shall be.
template <int D>
[[nodiscard]] std::vector<Seed<D>> all_of(const Staged<SeedId, Seed<D>>& seeds) {
  std::vector<Seed<D>> all;
  for (const auto& [name, seed] : seeds.committed()) {
    if (const Seed<D>* now = seeds.find(name)) all.push_back(*now);
  }
  seeds.for_each_edit([&](const SeedId&, const Seed<D>* was, const Seed<D>* is) {
    if (was == nullptr && is != nullptr) all.push_back(*is);
  });
  return all;
}

[[nodiscard]] inline std::vector<DomainEdits<2>::Wall> ends_of(
    const std::vector<mesher::LineEdge<2>>& edges) {
  std::vector<DomainEdits<2>::Wall> walls;
  for (const auto& e : edges) walls.push_back({e.low, e.high});
  return walls;
}
[[nodiscard]] inline std::vector<DomainEdits<3>::Wall> ends_of(
    const std::vector<mesher::PolygonFace<3>>& faces) {
  std::vector<DomainEdits<3>::Wall> walls;
  for (const auto& f : faces) walls.push_back(f.corners);
  return walls;
}

/// What comes and goes besides triangles.
template <int D>
[[nodiscard]] DomainEdits<D> domain_edits(const Change<D>& change, const EditedSeedsOf<D>& seeds) {
  DomainEdits<D> edits;
  if constexpr (D == 2) {
    edits.walls_out = ends_of(change.edges_removed);
    edits.walls_in = ends_of(change.edges_added);
  } else {
    edits.walls_out = ends_of(change.faces_removed);
    edits.walls_in = ends_of(change.faces_added);
  }
  seeds.for_each_edit([&](const SeedId& name, const Seed<D>* was, const Seed<D>* is) {
    if (was != nullptr) edits.seeds_out.push_back(name);
    if (is != nullptr) edits.seeds_in.push_back(*is);
  });
  return edits;
}

}  // namespace mesher::detail
