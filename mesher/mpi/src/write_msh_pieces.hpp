// A mesh for Gmsh whose partitions are the parts of the processes: a file for each, or one file.
#pragma once

#include <string>

#include "facade/joint_numbers.hpp"
#include "mesher/mesh.hpp"
#include "tiles/peers.hpp"

namespace mesher::detail {

/// NAME_K.msh for NAME.msh, K from 1.
[[nodiscard]] std::string msh_piece_name(const std::string& path, std::size_t process);

/// Of all processes (peers.hpp): a file for each. `own`: the part of this one, `numbers`: of it.
/// Older pieces of these names go before new ones appear, so that two pieces are never of different
/// meshes. Throws: Error(cannot_write).
template <int D>
void write_msh_pieces(Peers& peers, const Mesh<D>& own, const JointNumbers<D>& numbers,
                      const std::string& path);

/// The same in one file, which the first process writes as the others send it their lines, 4 MB at
/// a time: nobody has more of them at once.
template <int D>
void write_msh_partitions(Peers& peers, const Mesh<D>& own, const JointNumbers<D>& numbers,
                          const std::string& path);

}  // namespace mesher::detail
