// Changes of a mesh as those who follow its domain take them.
#pragma once

#include <algorithm>
#include <vector>

#include "facade/edited_table.hpp"
#include "mesher/domain_follower.hpp"

namespace mesher::detail {

[[nodiscard]] inline std::uint32_t index_of(const std::vector<Point<2>>& sorted,
                                            const Point<2>& p) {
  return static_cast<std::uint32_t>(std::lower_bound(sorted.begin(), sorted.end(), p) -
                                    sorted.begin());
}

/// The mesh that a first run brings.
[[nodiscard]] inline Mesh<2> mesh_of(const Change<2>& change) {
  Mesh<2> mesh;
  mesh.vertices = change.vertices_added;
  mesh.simplices.reserve(change.simplices_added.size());
  for (const auto& [a, b, c] : change.simplices_added) {
    const auto& all = mesh.vertices;
    mesh.simplices.push_back({index_of(all, a), index_of(all, b), index_of(all, c)});
  }
  return mesh;
}

[[nodiscard]] inline std::vector<MeshEdge> walls_of(const Change<2>& change) {
  std::vector<MeshEdge> walls;
  for (const auto& e : change.edges_added) {
    const auto& all = change.vertices_added;
    walls.push_back({index_of(all, e.low), index_of(all, e.high), e.line, 0});
  }
  return walls;
}

using EditedSeeds = EditedTable<SeedName, Seed>;

/// All seeds that shall be.
[[nodiscard]] inline std::vector<Seed> all_of(const EditedSeeds& seeds) {
  std::vector<Seed> all;
  for (const auto& [name, seed] : seeds.committed()) {
    if (const Seed* now = seeds.find(name)) all.push_back(*now);
  }
  seeds.for_each_edit([&](const SeedName&, const Seed* was, const Seed* is) {
    if (was == nullptr && is != nullptr) all.push_back(*is);
  });
  return all;
}

/// What comes and goes besides triangles.
[[nodiscard]] inline DomainEdits domain_edits(const Change<2>& change, const EditedSeeds& seeds) {
  const auto ends_of = [](const std::vector<LineEdge<2>>& edges) {
    std::vector<DomainEdits::Wall> walls;
    for (const auto& e : edges) walls.push_back({e.low, e.high});
    return walls;
  };
  DomainEdits edits;
  edits.walls_out = ends_of(change.edges_removed);
  edits.walls_in = ends_of(change.edges_added);
  seeds.for_each_edit([&](const SeedName& name, const Seed* was, const Seed* is) {
    if (was != nullptr) edits.seeds_out.push_back(name);
    if (is != nullptr) edits.seeds_in.push_back(*is);
  });
  return edits;
}

}  // namespace mesher::detail
