// Regions of a triangulation that segments (in space polygons) enclose, holes, and the part of a
// mesh that is kept.
//
// The mesher refines the whole box; a flood that does not cross segments then finds the triangles
// of the domain [rules A6].
//
// Example:
//   const Domain<2> domain = find_domain(whole, whole.features.edges, seeds, Extent::enclosed);
//   for (const SeedFault<2>& fault : domain.faults) std::cerr << describe(fault) << '\n';
//   write_mesh(extract(whole, domain).mesh, "lake.vtu");
//
// A *wall* is an edge of the mesh that is a part of a segment. A *region* is a largest set of
// triangles that are connected across edges that are no walls. It is *open* if it reaches the
// boundary of the triangulation at an edge that is no wall, else *closed*. In space read
// tetrahedra, faces and polygons for triangles, edges and segments.
//
// Guarantees:
//   (1) an open region is outside. A closed region that contains a hole's seed is a hole; every
//       other closed region is inside. So loose segments change nothing, and a hole is as large as
//       its region;
//   (2) the inside is kept. If no region is closed, or the whole box is requested, everything is
//   kept,
//       holes included;
//   (3) a region has the attribute and the limit of its region seed, whether it is inside or
//       outside;
//   (4) a seed is in a region if the region's closed triangles contain it and it is on no wall: a
//       seed on an edge or a vertex is in the one region around it. Exact signs decide;
//   (5) of several seeds in a region one counts: a hole's seed first, then the least id; the others
//       are faults. A seed on a wall or in a region that is not kept is a fault, and changes
//       nothing;
//   (6) everything is a function of the sets of triangles, walls and seeds. A region is named by
//       its seed; a region without a seed is identified by its smallest triangle.
#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "mesher/error.hpp"
#include "mesher/graph.hpp"
#include "mesher/mesh.hpp"

namespace mesher {

enum class Zone : std::uint8_t { outside, hole, inside };

/// The zone and seed of the region that a simplex is in.
struct RegionLabel {
  Zone zone = Zone::outside;
  std::optional<SeedId> seed;  ///< in a hole its seed, else the region seed if there is one
  friend bool operator==(const RegionLabel&, const RegionLabel&) = default;
};

struct Region {
  RegionLabel label;
  std::uint32_t smallest = 0;  ///< simplex
  std::size_t triangles = 0;   ///< or tetrahedra
  double attribute = 0;        ///< 0 without a region seed
  std::optional<double> max_measure;
  friend bool operator==(const Region&, const Region&) = default;
};

/// A seed that has no region of its own.
template <int D>
struct SeedFault {
  enum class Kind : std::uint8_t {
    outside,     ///< outside the part that is kept, possibly outside the box
    on_segment,  ///< on a wall
    shared,      ///< in the region of `other`
  };
  Kind kind = Kind::outside;
  SeedId seed;
  Point<D> at{};
  std::optional<SeedId> other;  ///< the seed that counts
  /// The line with the least id that the seed is on, in space the polygon; none if not known.
  Feature wall{};
  friend bool operator==(const SeedFault&, const SeedFault&) = default;
};

/// One sentence with the ids and the position.
template <int D>
[[nodiscard]] std::string describe(const SeedFault<D>& fault);
/// The fault as an error of code bad_seed, for callers that refuse such input.
template <int D>
[[nodiscard]] Error error_of(const SeedFault<D>& fault);

inline constexpr std::uint32_t kNoRegion = UINT32_MAX;

/// The regions of a mesh.
template <int D>
struct Domain {
  std::vector<std::array<std::uint32_t, D + 1>> neighbours;  ///< across from each corner;
                                                             ///< kNoTriangle
  std::vector<std::uint32_t> region_of;  ///< one per simplex: number in `regions`
  std::vector<Region> regions;           ///< ascending by their smallest simplex
  std::vector<SeedFault<D>> faults;      ///< ascending by seed
  bool keeps_all = true;                 ///< the box is requested, or nothing is enclosed

  [[nodiscard]] bool keeps(const Region& region) const {
    return keeps_all || region.label.zone == Zone::inside;
  }
  [[nodiscard]] bool keeps(std::uint32_t simplex) const {
    return keeps(regions[region_of[simplex]]);
  }
};

/// A part of the border between regions: an edge on a line, or in space a face in a polygon.
template <int D>
using WallOf = std::conditional_t<D == 2, MeshEdge, MeshFace>;

/// Finds the regions. `walls`: edges (or faces) of the mesh, in any order. D is 2 or 3.
/// Requires: simplices are positively oriented; no edge (or face) borders more than two.
/// Throws: Error: bad_mesh for a wall that is no edge of the mesh; repeated_id for two seeds with
/// one id; not_finite, magnitude, bad_number for a seed with a bad position, attribute or limit.
/// Cost: O(m log d) for vertices of degree d (in space O(m log m)), and for each seed O(simplices
/// above and below it).
template <int D>
[[nodiscard]] Domain<D> find_domain(const Mesh<D>& mesh, const std::vector<WallOf<D>>& walls,
                                    const std::vector<Seed<D>>& seeds, Extent extent);

/// An edge with the regions beside it: numbers in Domain::regions, or kNoRegion.
struct SidedEdge : MeshEdge {
  std::uint32_t left = kNoRegion;  ///< seen from `low` towards `high`
  std::uint32_t right = kNoRegion;
  friend bool operator==(const SidedEdge&, const SidedEdge&) = default;
};

/// The marker of boundary parts without a marker of their own, as in Triangle.
inline constexpr std::int64_t kBoundaryMarker = 1;

/// The walls, and the edges with a kept region on one side only, ascending by (low, high). An edge
/// of the second kind has kBoundaryMarker if it has no other marker. A side whose triangle is not
/// kept is kNoRegion. `domain`: found with these walls. Cost: O(m + w log w).
[[nodiscard]] std::vector<SidedEdge> sided_edges(const Mesh<2>& mesh,
                                                 const std::vector<MeshEdge>& walls,
                                                 const Domain<2>& domain);

/// A part of a mesh as a mesh of its own, with the numbers that its parts had in the whole.
template <int D>
struct Extract {
  MeshData<D> mesh;
  std::vector<std::array<std::uint32_t, D + 1>> neighbours;  ///< across from each corner
  std::vector<std::uint32_t> vertices;   ///< one per vertex: its number in the whole, ascending
  std::vector<std::uint32_t> triangles;  ///< or tetrahedra; likewise
};

/// Extracts the part of `whole` that `domain` keeps. Vertices and triangles keep the order of the
/// whole, so the result is canonical if the whole is. Vertices without a triangle are dropped. The
/// edges are those of sided_edges with a kept side. As in Triangle, a vertex without a marker gets
/// that of a segment that it is on (the least), else kBoundaryMarker on the boundary. Attributes of
/// regions are filled in if there is a region seed.
/// In space the faces are the walls with a kept side and the boundary of the kept part; boundary
/// faces without another marker have kBoundaryMarker. The edges are those of the whole that a kept
/// tetrahedron has; a vertex on no segment with a marker gets that of a polygon that it is on (the
/// least).
/// `domain`: found with whole.features.edges, or .faces. Cost: O(m + w log w); in space O(m log w).
template <int D>
[[nodiscard]] Extract<D> extract(const MeshData<D>& whole, const Domain<D>& domain);

}  // namespace mesher
