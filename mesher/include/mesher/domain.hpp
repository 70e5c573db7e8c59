// What segments enclose, or in space polygons: regions of a triangulation, holes, and the part of a
// mesh that is wanted.
//
// Everything is refined in the box; which triangles belong to the domain is found afterwards by a
// flood that does not cross segments [rules A6].
//
// Example:
//   const Domain<2> domain = find_domain(whole, whole.features.edges, seeds, Extent::enclosed);
//   for (const SeedFault<2>& fault : domain.faults) std::cerr << describe(fault) << '\n';
//   write_mesh(extract(whole, domain).mesh, "lake.vtu");
//
// A *wall* is an edge of the mesh that is a part of a segment. A *region* is what triangles reach
// from each other across edges that are no walls. It is *open* if it reaches the boundary of the
// triangulation at an edge that is no wall, else *closed*. In space read tetrahedra, faces and
// polygons for triangles, edges and segments.
//
// Guarantees:
//   (1) an open region is outside. A closed one with a hole's seed in it is a hole, any other is
//       inside. So loose segments change nothing, and a hole is as large as its region;
//   (2) what is kept is the inside. Where no region is closed, or the whole box is wanted, all is
//       kept, holes too;
//   (3) a region's attribute and limit are those of its region seed, inside or outside;
//   (4) a seed is in a region if the region's closed triangles hold it and it is on no wall: on an
//       edge or a vertex it is in the one region around. That is decided by exact signs;
//   (5) of several seeds in a region one counts: a hole's, then the least id; the others are
//       faults. A seed on a wall or in a region that is not kept is a fault, and changes nothing;
//   (6) everything is a function of the sets of triangles, walls and seeds. A region has the name
//       of its seed; one without is known by its smallest triangle.
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

/// What a simplex is part of.
struct RegionLabel {
  Zone zone = Zone::outside;
  std::optional<SeedId> seed;  ///< the hole of a hole, else the region seed if there is one
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
    outside,     ///< outside of what is kept; of the box, perhaps
    on_segment,  ///< on a wall
    shared,      ///< in the region of `other`
  };
  Kind kind = Kind::outside;
  SeedId seed;
  Point<D> at{};
  std::optional<SeedId> other;  ///< the seed that counts
  /// The least line that it is on, in space the least polygon; none if not known.
  Feature wall{};
  friend bool operator==(const SeedFault&, const SeedFault&) = default;
};

/// One sentence with ids and place.
template <int D>
[[nodiscard]] std::string describe(const SeedFault<D>& fault);
/// The same as an error of code bad_seed, for those who refuse such input.
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
  bool keeps_all = true;                 ///< the box is wanted, or nothing enclosed

  [[nodiscard]] bool keeps(const Region& region) const {
    return keeps_all || region.label.zone == Zone::inside;
  }
  [[nodiscard]] bool keeps(std::uint32_t simplex) const {
    return keeps(regions[region_of[simplex]]);
  }
};

/// What simplices are parted by: an edge on a line, or in space a face in a polygon.
template <int D>
using WallOf = std::conditional_t<D == 2, MeshEdge, MeshFace>;

/// Finds the regions. `walls`: edges (or faces) of the mesh, in any order. D is 2 or 3.
/// Requires: simplices are positively oriented; no edge (or face) borders more than two.
/// Throws: Error: bad_mesh for a wall that is no edge of the mesh; repeated_id for two seeds of one
/// name; not_finite, magnitude, bad_number for a seed that is not as described.
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

/// Triangle's marker of what is on the boundary and has none.
inline constexpr std::int64_t kBoundaryMarker = 1;

/// The walls, and the edges with what is kept on one side only, ascending by (low, high). The
/// latter have kBoundaryMarker where they have no other. A triangle that is not kept is no side.
/// `domain`: found with these walls. Cost: O(m + w log w).
[[nodiscard]] std::vector<SidedEdge> sided_edges(const Mesh<2>& mesh,
                                                 const std::vector<MeshEdge>& walls,
                                                 const Domain<2>& domain);

/// A part of a mesh as a mesh of its own, and where its parts were.
template <int D>
struct Extract {
  MeshData<D> mesh;
  std::vector<std::array<std::uint32_t, D + 1>> neighbours;  ///< across from each corner
  std::vector<std::uint32_t> vertices;   ///< one per vertex: its number in the whole, ascending
  std::vector<std::uint32_t> triangles;  ///< or tetrahedra; likewise
};

/// What `domain` keeps of `whole`, with vertices and triangles in the order of the whole: canonical
/// if that is. Vertices without a triangle go. Edges are those of sided_edges with a kept side. As
/// Triangle does, a vertex without a marker gets that of a segment that it is on (the least), else
/// kBoundaryMarker on the boundary. Attributes of regions are filled in if there is a region seed.
/// In space faces are the walls with a kept side and the boundary of what is kept, which has
/// kBoundaryMarker where it has no other; edges are those of the whole that a kept tetrahedron has;
/// a vertex on no segment with a marker gets that of a polygon that it is on (the least).
/// `domain`: found with whole.features.edges, or .faces. Cost: O(m + w log w); in space O(m log w).
template <int D>
[[nodiscard]] Extract<D> extract(const MeshData<D>& whole, const Domain<D>& domain);

}  // namespace mesher
