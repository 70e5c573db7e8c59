// The option --no-flat: the output has no flat tetrahedra.
#pragma once

#include <cstdio>
#include <utility>

#include "arguments.hpp"
#include "mesher/improve.hpp"
#include "mesher/meshing.hpp"

namespace tool {

inline mesher::Mesh<2> without_flat(const MeshArguments&, mesher::Mesh<2> all, double) {
  return all;
}
/// None above `rho` comes. Says how many stay.
inline mesher::Mesh<3> without_flat(const MeshArguments& args, mesher::Mesh<3> all, double rho) {
  if (!args.no_flat) return all;
  mesher::Unflattened result = mesher::without_flat_tetrahedra(std::move(all), rho);
  if (result.left > 0 && !args.quiet) {
    std::fprintf(stderr, "%s: note: %zu flat tetrahedra stay\n", args.source.c_str(), result.left);
  }
  return std::move(result.mesh);
}

/// What a mesher has made, a Mesher or one like it.
template <int D, class Target>
mesher::DomainMesh<D> kept_of(const MeshArguments& args, const Target& target) {
  if constexpr (D == 3) {
    if (args.no_flat) {
      return mesher::domain_mesh(without_flat(args, target.box_mesh(), target.options().rho),
                                 target.input(), target.options().extent);
    }
  }
  return target.domain_mesh();
}

}  // namespace tool
