// What segments enclose: regions of a triangulation, holes, and the part of a mesh that is wanted.
//
// Everything is refined in the box; which triangles belong to the domain is found afterwards by a
// flood that does not cross segments [rules A6].
//
// Example:
//   const Domain domain = find_domain(whole, whole.features.edges, seeds, Extent::enclosed);
//   for (const SeedFault& fault : domain.faults) std::cerr << describe(fault) << '\n';
//   write_mesh(extract(whole, domain).mesh, "lake.vtu");
//
// A *wall* is an edge of the mesh that is a part of a segment. A *region* is what triangles reach
// from each other across edges that are no walls. It is *open* if it reaches the boundary of the
// triangulation at an edge that is no wall, else *closed*.
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
#include <vector>

#include "mesher/error.hpp"
#include "mesher/mesh.hpp"
#include "mesher/mesh_data.hpp"

namespace mesher {

enum class Zone : std::uint8_t { outside, hole, inside };

/// Which part of the mesh is wanted.
enum class Extent : std::uint8_t {
  enclosed,  ///< what segments enclose, less holes; all if they enclose nothing
  box,       ///< all
};

enum class SeedKind : std::uint8_t { hole, region };

/// Holes and regions are numbered apart.
struct SeedName {
  SeedKind kind = SeedKind::region;
  FeatureId id{};
  friend auto operator<=>(const SeedName&, const SeedName&) = default;
};

/// "hole 3", "region 3".
[[nodiscard]] std::string text_of(const SeedName& seed);

/// A place that stands for the region around it.
struct Seed {
  SeedName name;
  Point<2> at{};                   ///< finite; 0 or of magnitude 2^-100 to 2^100
  double attribute = 0;            ///< of a region; finite
  std::optional<double> max_area;  ///< of a region's triangles, input units squared, > 0
  friend bool operator==(const Seed&, const Seed&) = default;
};

/// What a triangle is part of.
struct RegionLabel {
  Zone zone = Zone::outside;
  std::optional<FeatureId> seed;  ///< the hole of a hole, else the region seed if there is one
  friend bool operator==(const RegionLabel&, const RegionLabel&) = default;
};

struct Region {
  RegionLabel label;
  std::uint32_t smallest = 0;  ///< triangle
  std::size_t triangles = 0;
  double attribute = 0;  ///< 0 without a region seed
  std::optional<double> max_area;
  friend bool operator==(const Region&, const Region&) = default;
};

/// A seed that has no region of its own.
struct SeedFault {
  enum class Kind : std::uint8_t {
    outside,     ///< outside of what is kept; of the box, perhaps
    on_segment,  ///< on a wall
    shared,      ///< in the region of `other`
  };
  Kind kind = Kind::outside;
  SeedName seed;
  Point<2> at{};
  std::optional<SeedName> other;  ///< the seed that counts
  std::optional<FeatureId> line;  ///< the least id of a segment that it is on, where known
  friend bool operator==(const SeedFault&, const SeedFault&) = default;
};

/// One sentence with ids and place.
[[nodiscard]] std::string describe(const SeedFault& fault);
/// The same as an error of code bad_seed, for those who refuse such input.
[[nodiscard]] Error error_of(const SeedFault& fault);

inline constexpr std::uint32_t kNoRegion = UINT32_MAX;

/// The regions of a mesh.
struct Domain {
  std::vector<std::array<std::uint32_t, 3>> neighbours;  ///< across from each corner; kNoTriangle
  std::vector<std::uint32_t> region_of;                  ///< one per triangle: number in `regions`
  std::vector<Region> regions;                           ///< ascending by their smallest triangle
  std::vector<SeedFault> faults;                         ///< ascending by seed
  bool keeps_all = true;                                 ///< the box is wanted, or nothing enclosed

  [[nodiscard]] bool keeps(const Region& region) const {
    return keeps_all || region.label.zone == Zone::inside;
  }
  [[nodiscard]] bool keeps(std::uint32_t triangle) const {
    return keeps(regions[region_of[triangle]]);
  }
};

/// Finds the regions. `walls`: edges of the mesh, in any order.
/// Requires: corners go round counterclockwise; no edge borders more than two triangles.
/// Throws: Error: bad_mesh for a wall that is no edge of the mesh; repeated_id for two seeds of one
/// name; not_finite, magnitude, bad_number for a seed that is not as described.
/// Cost: O(m log d) for vertices of degree d, and for each seed O(triangles above and below it).
[[nodiscard]] Domain find_domain(const Mesh<2>& mesh, const std::vector<MeshEdge>& walls,
                                 const std::vector<Seed>& seeds, Extent extent);

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
                                                 const Domain& domain);

/// A part of a mesh as a mesh of its own, and where its parts were.
struct Extract {
  MeshData mesh;
  std::vector<std::array<std::uint32_t, 3>> neighbours;  ///< across from each corner
  std::vector<std::uint32_t> vertices;   ///< one per vertex: its number in the whole, ascending
  std::vector<std::uint32_t> triangles;  ///< likewise
};

/// What `domain` keeps of `whole`, with vertices and triangles in the order of the whole: canonical
/// if that is. Vertices without a triangle go. Edges are those of sided_edges with a kept side. As
/// Triangle does, a vertex without a marker gets that of a segment that it is on (the least), else
/// kBoundaryMarker on the boundary. Attributes of regions are filled in if there is a region seed.
/// `domain`: found with whole.features.edges. Cost: O(m + w log w).
[[nodiscard]] Extract extract(const MeshData& whole, const Domain& domain);

}  // namespace mesher
