// A solver's field under edits of the mesh of a box (Extent::box): values by vertex slot stay where
// they are; new vertices get a first value, and the rest of the mesh is not visited.
#pragma once

#include <vector>

#include "mesher/mesher.hpp"

namespace example {

// Heat, 0 at the left of the unit square and 1 at the right.
struct Heat {
  mesher::Mesher<2>& m;
  std::vector<double> at;  // by vertex slot

  void update() {
    const mesher::SlotChange change = m.update().slots;
    const mesher::LiveMesh<2> mesh = m.live();
    at.resize(mesh.vertex_slots());
    for (const mesher::Slot v : change.vertices_added) at[v] = mesh.points()[v][0];
  }
};

// Every vertex between the sides gets the mean of what is around it.
inline void relax(const mesher::LiveMesh<2>& mesh, std::vector<double>& at) {
  std::vector<double> sum(at.size(), 0), weight(at.size(), 0);
  for (mesher::Slot t = 0; t < mesh.simplex_slots(); ++t) {
    if (!mesh.is_simplex(t)) continue;
    for (const mesher::Slot v : mesh.simplices()[t]) {
      for (const mesher::Slot w : mesh.simplices()[t]) {
        if (v != w) sum[v] += at[w], weight[v] += 1;
      }
    }
  }
  for (mesher::Slot v = 0; v < at.size(); ++v) {
    const double x = mesh.points()[v][0];
    if (mesh.is_vertex(v) && 0 < x && x < 1) at[v] = sum[v] / weight[v];
  }
}

}  // namespace example
