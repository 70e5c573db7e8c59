// The regions of a changing triangulation, and the exact difference of labels.
//
// Example:
//   Regions regions(triangles, walls, seeds, places);
//   const RegionsDifference d = regions.update({.triangles_out = ..., .triangles_in = ...});
//   for (const auto& t : d.relabelled) ... t.corners, t.before, t.after ...
//
// Words as in mesher/domain.hpp, for space too. Guarantees, after every update:
//   (1) labels and faults are those of find_domain on the same triangles, walls and seeds, however
//       they were reached;
//   (2) the difference names every triangle that came, went, or has another label than before;
//   (3) an update that throws leaves everything as it was; one that succeeds can be undone once.
//
// Cost of an update by c triangles and walls, with s seeds in what it touches:
//   - O(c log c) and O(s), if no region is parted, joined or labelled anew, however large it is;
//   - regions are joined: and the triangles of all of them but the largest;
//   - a region is parted: and the triangles of all parts but the largest, at most p times for p
//     parts. A wall that might part a region, and does not because there is a way around, costs the
//     search for that way, at most the triangles of the region;
//   - a region's label changes: and its triangles, all of which are reported;
//   - a seed comes: and a walk through the triangulation. One comes or goes: and O(log) of all.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "domain/regroup.hpp"
#include "domain/seed_table.hpp"

namespace mesher::detail {

/// What comes and goes. Triangles counterclockwise, from any corner; walls in either direction. A
/// wall or seed that goes and comes is one that stays (a wall) or moves (a seed).
template <int D>
struct RegionsChangeOf {
  std::vector<CornersOf<D>> triangles_out, triangles_in;
  std::vector<SideOf<D>> walls_out, walls_in;
  std::vector<SeedId> seeds_out;
  std::vector<Seed<D>> seeds_in;
};
using RegionsChange = RegionsChangeOf<2>;

/// Triangles by their vertices, counterclockwise from the smallest number, in ascending order.
template <int D>
struct RegionsDifferenceOf {
  using Corners = CornersOf<D>;
  struct Labelled {
    Corners corners;
    RegionLabel label;
    friend bool operator==(const Labelled&, const Labelled&) = default;
  };
  struct Relabelled {
    Corners corners;
    RegionLabel before, after;
    friend bool operator==(const Relabelled&, const Relabelled&) = default;
  };
  std::vector<Labelled> removed;       // with what they were
  std::vector<Labelled> added;         // with what they are
  std::vector<Relabelled> relabelled;  // there before and after
  bool enclosed_before = false;        // whether any region was closed, and
  bool encloses = false;               // is: if this changes, so does what Extent::enclosed keeps
  std::uint64_t visited = 0;           // triangles looked at beyond the change itself
};
using RegionsDifference = RegionsDifferenceOf<2>;

/// The exact difference of what is kept; triangles as in RegionsDifference.
template <int D>
struct KeptDifference {
  std::vector<CornersOf<D>> removed, added;
};

/// A region by name.
template <int D>
struct NamedRegion {
  RegionLabel label;
  CornersOf<D> smallest{};  // by its corners' places, from the smallest
  std::size_t triangles = 0;
  double attribute = 0;
  std::optional<double> max_measure;
  friend bool operator==(const NamedRegion&, const NamedRegion&) = default;
};

template <int D>
class RegionsOf {
 public:
  using Corners = CornersOf<D>;
  using Wall = SideOf<D>;
  using RegionsChange = RegionsChangeOf<D>;
  using RegionsDifference = RegionsDifferenceOf<D>;
  /// Where a vertex is; asked of vertices of triangles that are there.
  using Places = std::function<Point<D>(std::uint32_t)>;

  /// Throws: Error as find_domain.
  /// Cost: O(m), and as find_domain for the seeds.
  RegionsOf(const std::vector<Corners>& triangles, const std::vector<Wall>& walls,
            const std::vector<Seed<D>>& seeds, Places places);

  /// Requires: triangles and walls that go are there, those that come are not; what comes covers
  /// what goes; every wall is an edge afterwards.
  /// Throws: sac::UsageError if not, Error (unknown_id, and as find_domain) of seeds,
  /// std::bad_alloc.
  RegionsDifference update(const RegionsChange& change);
  /// Takes the last update back, or does nothing if that has been done. Cost: O(that update).
  void roll_back() noexcept;

  /// Requires: the triangle is there. Cost: O(degree).
  [[nodiscard]] RegionLabel label(const Corners& triangle) const;
  [[nodiscard]] bool encloses() const noexcept { return closed_[0] > 0; }
  [[nodiscard]] bool keeps(const RegionLabel& label, Extent extent) const noexcept;
  /// As find_domain's, but without the segments' ids. Cost: O(seeds).
  [[nodiscard]] std::vector<SeedFault<D>> faults(Extent extent) const;
  /// Ascending by their smallest triangles. Cost: O(m).
  [[nodiscard]] std::vector<NamedRegion<D>> regions() const;
  /// Calls visit(corners, label) for every triangle, in no order that means anything.
  template <class Visit>
  void for_each(Visit&& visit) const {
    for (Slot s = 0; s < tiles_.slots(); ++s) {
      if (!tiles_[s].is_free()) visit(tiles_[s].corners, components_[tiles_[s].component].label);
    }
  }

  [[nodiscard]] std::size_t triangles() const noexcept { return tiles_.live(); }
  [[nodiscard]] std::size_t bytes() const noexcept { return tiles_.bytes() + marks_.bytes(); }
  /// Compares all with find_domain. Throws: sac::InvariantError.
  void check_invariants() const;

 private:
  class Update;

  void flood_all(const std::vector<Corners>& triangles);
  void place_all(const std::vector<Seed<D>>& seeds);
  void keep() noexcept;
  [[nodiscard]] std::array<Point<D>, D + 1> corners_of(Slot s) const;
  [[nodiscard]] Slot locate(const Point<D>& p) const;
  [[nodiscard]] std::uint32_t component_at(const Point<D>& p, Slot s) const;
  [[nodiscard]] RegionLabel label_of(const Component& component) const;

  Places places_;
  TilesOf<D> tiles_;
  Components components_;
  SeedTableOf<D> seeds_;
  Journal<std::uint32_t> closed_;  // one: how many regions are closed
  Marks marks_;
};
using Regions = RegionsOf<2>;

/// What the update that gave `difference`, the last one, did to the part that is kept.
/// Cost: O(difference); where the input begins or ceases to enclose anything, O(m log m).
template <int D>
[[nodiscard]] KeptDifference<D> kept_difference(const RegionsOf<D>& regions,
                                                const RegionsDifferenceOf<D>& difference,
                                                Extent extent);

}  // namespace mesher::detail
