// Changes that are made of whole meshes.
#pragma once

#include <algorithm>
#include <iterator>
#include <vector>

#include "mesher/mesher.hpp"

namespace mesher::detail {

/// All of a mesh is new.
template <int D>
[[nodiscard]] Change<D> whole_change(const Mesh<D>& mesh) {
  Change<D> change;
  change.vertices_added = mesh.vertices;
  change.kinds_added = mesh.kinds;
  change.simplices_added.reserve(mesh.simplices.size());
  for (const auto& s : mesh.simplices) {
    auto& corners = change.simplices_added.emplace_back();
    for (std::size_t k = 0; k < s.size(); ++k) corners[k] = mesh.vertices[s[k]];
  }
  const auto& at = mesh.vertices;
  for (const auto& e : mesh.edges) {
    change.edges_added.push_back({at[e.low], at[e.high], e.feature});
  }
  for (const auto& f : mesh.faces) {
    const auto& [a, b, c] = f.corners;
    change.faces_added.push_back({{at[a], at[b], at[c]}, f.polygon});
  }
  return change;
}

/// What `come` has more than `was`, and the reverse; all ascending.
template <class T>
void keep_difference(std::vector<T>& come, const std::vector<T>& was, std::vector<T>& gone) {
  const std::vector<T> all = std::move(come);
  come.clear();
  std::set_difference(all.begin(), all.end(), was.begin(), was.end(), std::back_inserter(come));
  std::set_difference(was.begin(), was.end(), all.begin(), all.end(), std::back_inserter(gone));
}

/// Makes of the change from nothing to a mesh that from another, of which `was` is the change from
/// nothing, to it.
/// Cost: O(the size of both).
template <int D>
void count_from(Change<D> was, Change<D>& change) {
  const std::vector<Point<D>> vertices = std::move(change.vertices_added);
  const std::vector<VertexKind> kinds = std::move(change.kinds_added);
  change.vertices_added.clear();
  change.kinds_added.clear();
  std::size_t k = 0;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    for (; k < was.vertices_added.size() && was.vertices_added[k] < vertices[i]; ++k) {
      change.vertices_removed.push_back(was.vertices_added[k]);
    }
    if (k == was.vertices_added.size() || vertices[i] < was.vertices_added[k]) {
      change.vertices_added.push_back(vertices[i]);
      change.kinds_added.push_back(kinds[i]);
      continue;
    }
    if (was.kinds_added[k] != kinds[i]) {
      change.kinds_changed.push_back({vertices[i], was.kinds_added[k], kinds[i]});
    }
    ++k;
  }
  for (; k < was.vertices_added.size(); ++k) {
    change.vertices_removed.push_back(was.vertices_added[k]);
  }
  keep_difference(change.simplices_added, was.simplices_added, change.simplices_removed);
  std::sort(change.edges_added.begin(), change.edges_added.end());
  std::sort(was.edges_added.begin(), was.edges_added.end());
  keep_difference(change.edges_added, was.edges_added, change.edges_removed);
  std::sort(change.faces_added.begin(), change.faces_added.end());
  std::sort(was.faces_added.begin(), was.faces_added.end());
  keep_difference(change.faces_added, was.faces_added, change.faces_removed);
}
template <int D>
void count_from(const Mesh<D>& before, Change<D>& change) {
  count_from(whole_change(before), change);
}

}  // namespace mesher::detail
