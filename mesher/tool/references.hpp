// Values that a `.mesh` file cannot hold, and counts instead.
#pragma once

#include <string>

#include "mesher/graph.hpp"
#include "mesher/mesh.hpp"

namespace tool {

/// Where `path` is of a format that counts values which are no whole numbers from 1 on, and `file`
/// has such: what would be compared with them is taken out of both, and a note of the mesh says so.
template <int D>
void forget_counted_values(const std::string& path, mesher::MeshData<D>& mesh,
                           mesher::GraphFile<D>& file);

}  // namespace tool
