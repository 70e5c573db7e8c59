// Follows the regions of an edited mesh from its changes: the effect of an update on labels, and on
// the kept part of the mesh.
//
// Example:
//   DomainFollower lake(m.mesh(), walls, seeds, Extent::enclosed);
//   m.insert(id, point);
//   const DomainChange change = lake.update(m.update(), {.seeds_in = {seed}});
//   ... change.kept_added, change.kept_removed, change.relabelled ...
//
// Words, and what is kept, as in domain.hpp: in space read tetrahedra and faces for triangles and
// edges. Guarantees:
//   (1) labels and faults are those of find_domain on the mesh, walls and seeds of the moment;
//   (2) the change is exact: no triangle is missing, none is named twice, all are in canonical
//       order;
//   (3) a function that throws leaves everything as it was.
// Cost of an update by c triangles and walls: O(c log c), however large the regions are around it.
// Where regions are joined, and the triangles of all of them but the largest; where one is parted,
// the triangles of all its parts but the largest, times their number; where a wall might part one
// but there is a way around, at most the triangles of that region; where a region's label changes,
// its triangles. Where the input begins or ceases to enclose anything, all triangles.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "mesher/domain.hpp"
#include "mesher/mesher.hpp"

namespace mesher {

/// What comes and goes besides triangles. A wall in both lists stays, a seed moves.
template <int D>
struct DomainEdits {
  using Wall = std::array<Point<D>, D>;  // its ends, in any order
  std::vector<Wall> walls_out, walls_in;
  std::vector<SeedId> seeds_out;
  std::vector<Seed<D>> seeds_in;
};

template <int D>
class DomainFollower {
 public:
  /// `walls`: edges of the mesh. Throws: Error as find_domain. Cost: as find_domain.
  DomainFollower(const Mesh<D>& mesh, const std::vector<WallOf<D>>& walls,
                 const std::vector<Seed<D>>& seeds, Extent extent);
  DomainFollower(DomainFollower&&) noexcept;
  DomainFollower& operator=(DomainFollower&&) noexcept;
  ~DomainFollower();

  /// Requires: `change` is that of the mesh followed; afterwards all walls are edges of it.
  /// Throws: sac::UsageError if not, Error (unknown_id, and as find_domain) of seeds,
  /// std::bad_alloc.
  DomainChange<D> update(const Change<D>& change, const DomainEdits<D>& edits = {});

  /// The same, with a last word on it: what `accept` throws leaves all as it was. It may ask for
  /// labels.
  using Accept = std::function<void(const DomainChange<D>&)>;
  DomainChange<D> update(const Change<D>& change, const DomainEdits<D>& edits,
                         const Accept& accept);

  /// Requires: a triangle of the mesh, from any corner. Cost: O(1) for vertices of bounded degree.
  [[nodiscard]] RegionLabel label(const typename DomainChange<D>::Corners& triangle) const;
  [[nodiscard]] bool keeps(const typename DomainChange<D>::Corners& triangle) const;
  /// As find_domain's, but without the segments' ids. Cost: O(seeds).
  [[nodiscard]] std::vector<SeedFault<D>> faults() const;

  /// Throws std::logic_error naming the broken invariant. Cost: O(m log m).
  void check_invariants() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mesher
