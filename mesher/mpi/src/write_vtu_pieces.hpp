// A mesh in pieces: a .vtu file for each process, and a .pvtu file that lists them.
#pragma once

#include <functional>
#include <string>

#include "mesher/mesh.hpp"
#include "tiles/peers.hpp"

namespace mesher::detail {

/// Of all processes (peers.hpp). `own_mesh()`: the part of this one. The index appears last, and an
/// older one goes first, so that there is never one that lists files of different meshes.
/// Throws: Error (cannot_write, bad_option).
template <int D>
void write_vtu_pieces(Peers& peers, const std::function<Mesh<D>()>& own_mesh,
                      const std::string& path);

/// Removes a file that may be there. Throws: Error(cannot_write).
void remove_old(const std::string& path);

}  // namespace mesher::detail
