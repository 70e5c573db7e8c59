// Meshes of more points than memory holds a run for, made tile after tile.
//
// The points' bounding box is cut into tiles. Each is meshed by itself, with a halo of the points
// around it, and put into a folder; then tiles are compared. Where two disagree about what is at
// their border, halos are made wider, until all agree: then the mesh is that of one run for all
// points, to the last bit.
//
// Example:
//   auto mesh = mesher::box_mesh_out_of_core<2>(std::move(points), {}, {.folder = "scratch"});
//
// Guarantees:
//   (1) the mesh is box_mesh of the same points with Algorithm::gap_balls, whatever the tiles and
//       the threads;
//   (2) a process that ends before it is done, by an error or by a kill, leaves a folder that a
//       later call with the same points and options goes on with: tiles that are there are not made
//       again. A file that was cut off or changed counts as not there.
//
// Memory: the points and, at the end, the mesh (with D = 2 some 85 bytes for each of its vertices);
// meanwhile for each thread a run of the points of one tile and its halo, without a trace, and
// the births across the tiles' borders. The folder needs some 110 bytes a vertex in the plane, up
// to 600 in space.
// Cost: for points that lie evenly, the calls near borders run twice. Where points surround empty
// parts as large as a tile, all of them may come to be in its halo.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mesher/meshing.hpp"

namespace mesher {

struct OutOfCore {
  std::string folder{};   ///< made if it is not there; empty: tiles are kept in memory
  std::size_t tiles = 0;  ///< 0: so many that each has at most kPointsOfTile points
  int threads = 1;        ///< from 1 to kMostThreads: as many tiles at a time

  template <int D>
  static constexpr std::size_t kPointsOfTile = D == 2 ? 1000000 : 500000;
};

/// What was done.
struct OutOfCoreReport {
  std::size_t tiles = 0;        ///< one more than asked for: the part outside the points' box
  std::size_t tiles_found = 0;  ///< in the folder
  std::size_t runs = 0;         ///< of tiles, with those that had to be made again
  std::size_t rounds = 0;       ///< comparisons of all tiles
  std::size_t most_points = 0;  ///< of a tile with its halo
  std::size_t all_points = 0;   ///< of all runs, with halos
  std::uint64_t calls = 0;      ///< of all runs
};

/// The mesh of the box around these points. `points`: n x D. `ids`: as many, for messages; empty:
/// 1 .. n. D is 2 or 3.
/// Throws: Error as box_mesh (of several mistakes any); Error(bad_option) for limits of size,
/// growth, min_dihedral, a rule or an algorithm that is not radius_edge or gap_balls;
/// Error(cannot_write) if the folder cannot be written, or has tiles of something else;
/// Error(cannot_read) if a file of it is changed meanwhile; std::bad_alloc; what control.progress
/// throws.
template <int D>
[[nodiscard]] Mesh<D> box_mesh_out_of_core(std::vector<Point<D>> points, const Options<D>& options,
                                           const OutOfCore& how,
                                           const std::vector<PointId>& ids = {},
                                           OutOfCoreReport* report = nullptr,
                                           const RunControl& control = {});

}  // namespace mesher
