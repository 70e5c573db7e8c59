// Meshes a file with a bound on the smallest angle.
#pragma once

#include <cstdio>
#include <string>

#include "mesher/all.hpp"

namespace example {

inline void mesh_a_file(const std::string& input, const std::string& output) {
  const mesher::GraphFile<2> lake = mesher::read<2>(input);
  const mesher::Meshed<2> made = mesher::mesh(lake.graph, {.min_angle = 28});
  for (const auto& fault : made.faults) std::puts(mesher::describe(fault).c_str());
  mesher::write_mesh(made.mesh, output);
}

}  // namespace example
