// The exact difference of two meshes, as a mesher's update would report it.
#pragma once

#include <algorithm>
#include <array>
#include <iterator>
#include <vector>

#include "mesher/mesher.hpp"

namespace tool {

/// By their corners' places. In order: vertices are, so simplices given by places are as those
/// given by indices.
template <int D>
[[nodiscard]] std::vector<std::array<mesher::Point<D>, D + 1>> simplices_of(
    const mesher::Mesh<D>& mesh) {
  std::vector<std::array<mesher::Point<D>, D + 1>> simplices;
  simplices.reserve(mesh.simplices.size());
  for (const auto& s : mesh.simplices) {
    auto& corners = simplices.emplace_back();
    for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = mesh.vertices[s[i]];
  }
  return simplices;
}

/// Requires: both ascend.
template <class T>
[[nodiscard]] std::vector<T> difference(const std::vector<T>& all, const std::vector<T>& without) {
  std::vector<T> rest;
  std::set_difference(all.begin(), all.end(), without.begin(), without.end(),
                      std::back_inserter(rest));
  return rest;
}

/// Vertices of both that have another kind now.
template <int D>
[[nodiscard]] std::vector<mesher::KindChange<D>> kinds_changed(const mesher::Mesh<D>& before,
                                                               const mesher::Mesh<D>& after) {
  std::vector<mesher::KindChange<D>> changes;
  std::size_t i = 0;
  for (std::size_t k = 0; k < after.vertices.size(); ++k) {
    while (i < before.vertices.size() && before.vertices[i] < after.vertices[k]) ++i;
    if (i == before.vertices.size() || before.vertices[i] != after.vertices[k]) continue;
    if (before.kinds[i] == after.kinds[k]) continue;
    changes.push_back({after.vertices[k], before.kinds[i], after.kinds[k]});
  }
  return changes;
}

/// Of vertices and simplices.
template <int D>
[[nodiscard]] mesher::Change<D> change_between(const mesher::Mesh<D>& before,
                                               const mesher::Mesh<D>& after) {
  const auto old_simplices = simplices_of(before), new_simplices = simplices_of(after);
  mesher::Change<D> change;
  change.vertices_added = difference(after.vertices, before.vertices);
  change.vertices_removed = difference(before.vertices, after.vertices);
  change.kinds_changed = kinds_changed(before, after);
  change.simplices_added = difference(new_simplices, old_simplices);
  change.simplices_removed = difference(old_simplices, new_simplices);
  return change;
}

}  // namespace tool
