// A quality mesh and the domain in it, both following points, lines and seeds.
//
// Example:
//   DomainMesher lake(options);
//   announce(read_pslg("lake.poly").pslg, lake);
//   lake.update();                                     // first run
//   lake.move(FeatureId{17}, {0.25, 0.5});
//   lake.insert_hole(FeatureId{2}, {0.3, 0.7});
//   const DomainUpdate change = lake.update();         // work near the edits
//   ... change.domain.kept_added, change.domain.kept_removed ...
//   write_mesh(lake.domain_mesh().kept, "lake.vtu");
//
// Words as in domain.hpp; in space, where polygons enclose, read tetrahedra and faces for triangles
// and edges. Guarantees, after every update():
//   (1) the mesh is that of a Mesher with these points, lines and polygons, and with limits of size by
//       region_limits; the domain is that of find_domain in it;
//   (2) both are functions of the input and the options alone;
//   (3) what throws, for whatever reason, leaves mesh, domain, seeds and markers as they were:
//       points, lines, polygons and seeds of a batch come together or not at all.
// Cost of an update: that of Mesher, and that of DomainFollower for its change: that of a region
// where walls join or part regions, or where a seed gives one another label. The first line (in
// space polygon) or seed that comes to a mesh of points alone costs all its triangles, once.
//
// Limits of size count in what is wanted alone: where lines enclose something, in what they enclose.
// So where there are limits, a second mesh, without, follows the input to tell what that is; an
// update costs that of both, and where a region becomes or ceases to be wanted, or gets another
// largest area, the vertices in it; where lines at which limits begin or end are edited, the
// vertices in the triangles of the second mesh that this changes. A seed that changes nothing but
// its area costs a look at all triangles of the second mesh.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "mesher/domain_follower.hpp"
#include "mesher/domain_mesh.hpp"
#include "mesher/mesher.hpp"

namespace mesher {

/// The slots of what DomainChangeOf says is kept now, and what was, in the order there. What went
/// from the mesh is among the latter with the slot that it had.
struct KeptSlots {
  std::vector<Slot> added, removed;
  friend bool operator==(const KeptSlots&, const KeptSlots&) = default;
};

/// What an update did to the mesh, and to the domain.
template <int D>
struct DomainUpdateOf : Change<D> {
  DomainChangeOf<D> domain;
  KeptSlots kept;  ///< empty unless slots are kept
};
using DomainUpdate = DomainUpdateOf<2>;

template <int D>
class DomainMesherOf {
 public:
  /// Throws: as Mesher.
  explicit DomainMesherOf(const Options<D>& options, Extent extent = Extent::enclosed,
                          RegionAreas areas = RegionAreas::ignored);
  DomainMesherOf(DomainMesherOf&&) noexcept;
  DomainMesherOf& operator=(DomainMesherOf&&) noexcept;
  ~DomainMesherOf();

  /// Points, lines and polygons are announced as to a Mesher, with its errors. `marker`: what
  /// vertices, edges and faces get in domain_mesh(); a point keeps it when it moves.
  void insert(FeatureId id, const Point<D>& point, std::int64_t marker = 0);
  void remove(FeatureId id);
  void move(FeatureId id, const Point<D>& point);
  void insert_segment(FeatureId id, FeatureId from, FeatureId to, std::int64_t marker = 0);
  void insert_polyline(FeatureId id, const std::vector<FeatureId>& points, std::int64_t marker = 0);
  void remove_segment(FeatureId id);
  void remove_polyline(FeatureId id) { remove_segment(id); }
  void insert_polygon(const Polygon& polygon, std::int64_t marker = 0)
  requires(D == 3);
  void remove_polygon(FeatureId id)
  requires(D == 3);

  /// Announces a seed that shall be there. It may be anywhere: one without a region of its own is
  /// one of faults(). A seed that is removed and inserted in one batch moves.
  /// Throws: Error (repeated_id, and as find_domain). Cost: O(log s).
  void insert_seed(const SeedOf<D>& seed);
  void insert_hole(FeatureId id, const Point<D>& at);
  void insert_region(FeatureId id, const Point<D>& at, double attribute,
                     std::optional<double> max_measure = {});
  /// Announces that a seed goes. Throws: Error(unknown_id). Cost: O(log s).
  void remove_seed(const SeedName& name);
  void remove_hole(FeatureId id) { remove_seed({SeedKind::hole, id}); }
  void remove_region(FeatureId id) { remove_seed({SeedKind::region, id}); }

  /// Announces limits of size, as to a Mesher; they count in what is wanted.
  void limit(const SizeLimits<D>& limits);
  void limit(const Box<D>& box, const SizeLimits<D>& limits);

  /// Takes back every edit announced since the last update().
  void discard_edits() noexcept;

  /// As Mesher::update, of all that is announced. `domain` of the first: from nothing.
  DomainUpdateOf<D> update(const RunControl& control = {});

  /// The mesh of the last update() in the box, without features. Cost: O(m log m).
  [[nodiscard]] Mesh<D> mesh() const;
  /// The same in arrays by slot, as a Mesher's.
  [[nodiscard]] LiveMesh<D> live() const;
  void keep_slots(bool keep);
  [[nodiscard]] bool keeps_slots() const noexcept;
  /// The part that is wanted, with features: mesher::domain_mesh of mesh() and input().
  [[nodiscard]] DomainMeshOf<D> domain_mesh() const;
  /// The graph of the last update(), ascending by id; a line of two points is a segment. In space
  /// others are several of one id.
  /// Cost: O(n log n).
  [[nodiscard]] GraphOf<D> input() const;

  /// Requires: a triangle of the mesh, from any corner. Cost: O(1) for vertices of bounded degree.
  [[nodiscard]] RegionLabel label(const typename DomainChangeOf<D>::Corners& triangle) const;
  [[nodiscard]] bool keeps(const typename DomainChangeOf<D>::Corners& triangle) const;
  /// The same by its slot. Requires: live().is_simplex(simplex).
  [[nodiscard]] RegionLabel label(Slot simplex) const;
  [[nodiscard]] bool keeps(Slot simplex) const;
  /// Of the last update(); without the segments' ids. Cost: O(seeds).
  [[nodiscard]] std::vector<SeedFaultOf<D>> faults() const;

  /// Whether it is announced to be there.
  [[nodiscard]] bool contains(FeatureId id) const;
  [[nodiscard]] bool contains_line(FeatureId id) const;
  [[nodiscard]] bool contains_polygon(FeatureId id) const;
  [[nodiscard]] bool contains_seed(const SeedName& name) const;

  /// Of mesh(); calls, edges and bytes of the second mesh, too, if there is one.
  /// Cost: O(1); with a second mesh, O(its triangles).
  [[nodiscard]] MeshStats stats() const;
  [[nodiscard]] const Options<D>& options() const;
  [[nodiscard]] Extent extent() const;

  /// Throws std::logic_error naming the broken invariant. Cost: O(trace + m log m).
  void check_invariants() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};
using DomainMesher = DomainMesherOf<2>;

}  // namespace mesher
