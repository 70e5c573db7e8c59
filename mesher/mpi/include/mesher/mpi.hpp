// A mesh of points, lines and polygons that the ranks of a communicator keep together. It follows
// edits, and is that of one process, to the last bit, whatever the number of ranks.
//
// Example:
//   mesher::MpiMesher<2> m(MPI_COMM_WORLD, {.domain = {{0, 0}, {1, 1}}});
//   if (rank == 3) m.insert(mesher::PointId{1}, {0.25, 0.5});
//   m.update();                            // of all ranks
//   solve(m.own_mesh());                   // the part of this rank
//   mesher::write_mesh(m, "mesh.pvtu");    // a piece for each rank
//
// What is divided are the simplices and the trace by which the mesh follows edits, which is 10 to
// 20 times larger than the points; and these, if they are all that there is. Else the input is held
// by all ranks; where there are lines or polygons in space, so is the mesh.
//
// Functions "of all" are called by all ranks, in the same order, with equal arguments; each comes
// to its end in all, and throws in all or in none: an Error of one rank is thrown in all. MPI is
// used on the calling thread alone.
//
// Guarantees, beside those of a Mesher (mesher.hpp):
//   (1) the mesh and its changes are functions of the input and the options alone: not of the
//       ranks, or of which of them announced what;
//   (2) an update that one rank stops, or that fails in one, leaves the mesh in all;
//   (3) each simplex is on exactly one rank.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "mesher/graph.hpp"
#include "mesher/mesher.hpp"
#include "mesher/read.hpp"

namespace mesher {

/// Which change update() returns: on each rank that of its own part, or the whole change on rank 0
/// and nothing on others, or on all ranks. (The first change is the whole mesh.)
enum class Told : std::uint8_t { own, first, all };

/// What ranks have told each other since the first update began. Sums over ranks, unless said
/// otherwise.
struct MpiCounts {
  std::uint64_t rounds = 0;          ///< of each rank: exchanges of messages
  std::uint64_t horizons = 0;        ///< of each rank: steps of the first update
  std::uint64_t messages = 0;        ///< from one rank to another
  std::uint64_t bytes = 0;           ///< of these
  std::uint64_t most_bytes = 0;      ///< from one rank, in one round
  std::uint64_t seen = 0;            ///< vertices that came to be known beyond their tile
  std::uint64_t vertices = 0;        ///< of the mesh
  std::uint64_t least_vertices = 0;  ///< of a rank
  std::uint64_t most_vertices = 0;   ///< of a rank
};

/// D is 2 or 3.
template <int D>
class MpiMesher {
 public:
  /// Of all, with equal options. Each rank has options.threads threads, and as many tiles.
  /// Requires: MPI is initialized; for several threads with MPI_THREAD_FUNNELED.
  /// Throws: Error(bad_option): as Mesher; for options that differ between ranks (of functions of
  /// size in what they say in a few places); for record_weights, and another rule than radius_edge.
  MpiMesher(MPI_Comm communicator, const Options<D>& options);
  MpiMesher(MpiMesher&&) noexcept;
  MpiMesher& operator=(MpiMesher&&) noexcept;
  /// Of all, before MPI_Finalize.
  ~MpiMesher();

  /// Announces an edit, on any rank, for the next update(), which judges it.
  void insert(PointId id, const Point<D>& point);
  void remove(PointId id);
  void move(PointId id, const Point<D>& point);
  /// Likewise; D is 3 for polygons. Points are edited before lines, and lines before polygons. The
  /// mesh is that of the box (Mesher::box_mesh): what they enclose is not cut out of it.
  void insert_segment(LineId id, PointId from, PointId to);
  void insert_polyline(LineId id, const std::vector<PointId>& points);
  void remove_line(LineId id);
  void insert_polygon(const Polygon& polygon);
  void remove_polygon(PolygonId id);
  /// Announces limits of size in place of all that there were, or in a closed box, as the functions
  /// of a Mesher of the same names. Numbers and backgrounds (sampled_sizes) are announced on any
  /// rank. Functions, such as SlopedSizes, cannot be sent: limits with one are announced on all
  /// ranks, in one order and with functions that say the same; all other edits of limits announced
  /// on a rank before one are made before it.
  void limit(const SizeLimits<D>& limits);
  void limit(const Box<D>& box, const SizeLimits<D>& limits);
  /// Discards the edits that this rank has announced.
  void discard_edits() noexcept;

  /// Of all; `control` may differ. Makes the edits of all ranks: by rank, and as announced there;
  /// at the end no two points may be at one place. Throws: Error as the functions of a Mesher of
  /// the same names, and its update(); what control.progress throws, on other ranks
  /// std::runtime_error with its message. The mesh is then as before, on all ranks. The edits are
  /// discarded; after Error(cancelled) they stay.
  /// Where limits of size change everywhere, all ranks begin anew: a change of `own` parts then has
  /// what a rank gives to another as removed, and what it gets as added. Angles and the guard's
  /// report are those of the whole change.
  Change<D> update(const RunControl& control = {}, Told told = Told::all);

  /// The simplices of this rank, edges and faces on features, each on one rank alone, and the
  /// vertices that they need, in canonical form. Empty before the first update, and on ranks beyond
  /// the number of points.
  [[nodiscard]] Mesh<D> own_mesh() const;
  /// Of all: the mesh on rank `to`, equal to that of one process; empty on others.
  [[nodiscard]] Mesh<D> gather(int to = 0) const;
  /// Of all: sums over ranks, but of seconds the most.
  [[nodiscard]] MeshStats stats() const;
  /// Of all.
  [[nodiscard]] MpiCounts counts() const;

  /// How many points there are on all ranks, of the last update.
  [[nodiscard]] std::size_t size() const noexcept;
  /// Of all: they, ascending by id, on rank `to`; none on others.
  [[nodiscard]] std::vector<GraphPoint<D>> gather_points(int to = 0) const;
  /// Those of the last update, on any rank.
  [[nodiscard]] std::vector<Polyline> lines() const;
  [[nodiscard]] std::vector<Polygon> polygons() const;
  /// With the limits of size of the last update.
  [[nodiscard]] const Options<D>& options() const noexcept;
  [[nodiscard]] int rank() const noexcept;
  [[nodiscard]] int ranks() const noexcept;
  /// Of all: compares what ranks have told each other with what they have heard, and with what they
  /// know now. Returns what does not fit, on all ranks; empty: nothing, and then the mesh is
  /// certain to be that of one process. Cost: O(vertices near borders), and 64 bytes for each two
  /// tiles.
  [[nodiscard]] std::string certificate() const;
  void check_invariants() const;

 private:
  template <int E>
  friend void write_mesh(const MpiMesher<E>&, const std::string&);
  template <int E>
  friend void write_pieces(const MpiMesher<E>&, const std::string&);
  template <int E>
  friend void write_partitions(const MpiMesher<E>&, const std::string&);
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Of all: writes the mesh, whole or not at all. A path that ends in .pvtu is an index of files
/// beside it, NAME_0.vtu, NAME_1.vtu, ..., one for each rank, and appears when these are complete;
/// other formats are written by rank 0, as write_mesh of the gathered mesh.
/// Throws: Error (unknown_format, cannot_write), std::bad_alloc.
template <int D>
void write_mesh(const MpiMesher<D>& mesher, const std::string& path);

/// Of all: writes the mesh in pieces, a file for each rank, whatever the format: .pvtu as
/// write_mesh; for NAME.msh the files NAME_1.msh, NAME_2.msh, ..., as `gmsh -part_split` writes
/// them (version 4.1, ASCII): the simplices of the rank in an entity of its partition, and their
/// nodes. Numbers are those in the whole mesh, so a node of two pieces has one number. A piece is
/// whole or not there; older ones of these names go before new ones appear. Throws: Error
/// (unknown_format, cannot_write), std::bad_alloc.
template <int D>
void write_pieces(const MpiMesher<D>& mesher, const std::string& path);

/// Of all: writes the mesh to one .msh file, as `gmsh -part` writes it: the simplices of each rank
/// are the entity of a partition. Numbers are as in pieces. Ranks send their lines to rank 0, some
/// megabytes at a time. Throws: as write_pieces.
template <int D>
void write_partitions(const MpiMesher<D>& mesher, const std::string& path);

// --- Input -----------------------------------------------------------------------------------

/// Of all: the dimension of the input in a file, as dimension_of (read.hpp).
[[nodiscard]] int dimension_of(MPI_Comm communicator, const std::string& path);

/// Of all: reads a graph, as read (read.hpp), with the same errors. Of points alone in a file with
/// a line for each (.node, .xyz, .csv) a rank gets those of its share of the lines; such a file all
/// ranks must be able to open. Of other files rank 0 gets all, and the others nothing. For insert()
/// on the rank that has a point. Throws: Error, on all ranks.
template <int D>
[[nodiscard]] GraphFile<D> read(MPI_Comm communicator, const std::string& path,
                                const ReadOptions& options = {});

/// Of all: an error that all have, with the locations of its features in the file, of which each
/// rank has what read() has given it; as located (graph.hpp).
template <int D>
[[nodiscard]] Error located(MPI_Comm communicator, const Error& error, const GraphFile<D>& share);

}  // namespace mesher
