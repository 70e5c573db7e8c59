// Meshes of the plane whose sides fit together: the edges on one side are those of the other,
// moved.
//
// A pair of sides is two markers of lines. The lines of the second must be those of the first,
// moved by one translation, up to rounding; the mesher finds the translation.
//
// Example: a cell that repeats to the right and upward.
//   const auto cell = mesher::periodic_mesh(graph, {{.from = 4, .to = 2}, {.from = 1, .to = 3}});
//   for (const auto& sides : cell.mesh.features.periodic) ... sides.vertices ...
//   mesher::write_mesh(cell.mesh, "cell.msh");  // with the section $Periodic
//
// Guarantees:
//   (1) each vertex p of a mesh on a line of `from` has one twin on a line of `to`, and each vertex
//       there is a twin; p and q are joined by an edge exactly if their twins are;
//   (2) the twin of an input point is an input point; the twin of any other p is p + translation,
//       rounded, and within the box of the edge of the input that it is on: where that edge is
//       parallel to an axis, it is on it, and coordinates in which sides do not differ are equal
//       bits;
//   (3) the mesh is that of a graph which has more points on its sides, and so has the guarantees
//       of mesh(); it is a function of the graph, the pairs and the options.
//
// How: mesh; where the pieces of twin sides are divided in different ways, both get the vertices of
// the one with more of them as points of the input; mesh again, until they agree. Points come from
// one side at a time, so none is nearer to another than in a mesh of that side; a piece that has
// its points is divided again only if the mesh beside one of the twins needs that.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "mesher/meshing.hpp"

namespace mesher {

/// Two markers of lines, each in no other pair.
struct PeriodicMarkers {
  std::int64_t from = 0, to = 0;
  friend bool operator==(const PeriodicMarkers&, const PeriodicMarkers&) = default;
};

/// The mesh of the box, as from box_mesh, with what pairs its sides.
struct PeriodicBox {
  Mesh<2> mesh;
  Graph<2> graph;          ///< with the points that sides have got: `mesh` is its box_mesh
  std::size_t rounds = 0;  ///< how many meshes were made
  struct Twins {
    PeriodicMarkers markers;
    Point<2> translation{};
    std::vector<std::array<Point<2>, 2>> points;  ///< of `from`, of `to`; ascending
  };
  std::vector<Twins> sides;          ///< as the pairs
  std::map<PointId, LineId> points;  ///< those that sides have got, and their lines
};

/// The first step of periodic_mesh.
/// Throws: as box_mesh; Error(bad_option) for markers that no line has, that are in two pairs, or
/// whose lines are not the same but for a translation; Error(too_many) if sides differ after
/// kMostPeriodicRounds meshes.
[[nodiscard]] PeriodicBox periodic_box_mesh(const Graph<2>& graph,
                                            const std::vector<PeriodicMarkers>& pairs,
                                            const Options<2>& options = {},
                                            RunReport* report = nullptr,
                                            const RunControl& control = {},
                                            bool refinement = false);

/// The second step: the kept part, with MeshFeatures::periodic. Points that sides have got are
/// vertices on their lines.
[[nodiscard]] DomainMesh<2> periodic_domain_mesh(PeriodicBox box, Extent extent);

struct PeriodicMesh : Meshed<2> {
  std::size_t rounds = 0;
};

/// Makes the mesh of what a graph encloses, with sides that fit together. Throws: as
/// periodic_box_mesh and domain_mesh. Cost: that of mesh() for each round, mostly two to four.
[[nodiscard]] PeriodicMesh periodic_mesh(const Graph<2>& graph,
                                         const std::vector<PeriodicMarkers>& pairs,
                                         const Options<2>& options = {},
                                         const RunControl& control = {});

inline constexpr std::size_t kMostPeriodicRounds = 64;

}  // namespace mesher
