// A mesh in pieces: a .msh file for each process.
#pragma once

#include <string>

#include "facade/joint_numbers.hpp"
#include "mesher/mesh.hpp"
#include "tiles/peers.hpp"

namespace mesher::detail {

/// The name of the `.msh` piece of a process: as Gmsh calls it, from 1.
[[nodiscard]] std::string msh_piece_name(const std::string& path, std::size_t process);

/// Of all: the part of this process, with its numbers in the whole mesh, in a file as Gmsh's
/// -part_split writes (version 4.1, ASCII): an entity of a partition, with the nodes that it needs.
/// A piece is there whole, or not at all; older ones go before new ones appear. Throws: Error
/// (cannot_write, bad_option).
template <int D>
void write_msh_pieces(Peers& peers, const Mesh<D>& own, const JointNumbers& numbers,
                      const std::string& path);

}  // namespace mesher::detail
