// A mesh of the same input without limits of size, which tells what lines and polygons enclose:
// where limits count, and which largest measures hold there. It follows the input before the mesh
// with limits does, and is taken back with it.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "facade/box_mesher.hpp"
#include "facade/followed.hpp"
#include "sizes/region_limits.hpp"

namespace mesher::detail {

template <int D>
class UnsizedMesh {
 public:
  using Seeds = EditedSeedsOf<D>;

  UnsizedMesh(const Options<D>& options, Extent extent, RegionAreas areas);

  /// For the input to be announced to.
  [[nodiscard]] BoxMesher<D>& mesher() noexcept { return mesher_; }

  /// The limits after an update, and where they differ from those before.
  using Then = std::function<void(const std::shared_ptr<const RegionLimits<D>>& limits,
                                  const std::vector<Box<D>>& where)>;
  /// Brings all up to date with what is announced, then asks `then`: what that throws leaves
  /// update(), and all is as it was. `seeds`: as they shall be, with edits since the last update.
  void update(const Seeds& seeds, const RunControl& control, const Then& then);

  /// Adds the calls, edges and bytes of all this. Cost: O(simplices).
  void add_to(MeshStats& stats) const;

  void check_invariants() const;

 private:
  using Corners = typename DomainChange<D>::Corners;
  void begin(const Change<D>& change, const Seeds& seeds, const Then& then);
  void follow(const Change<D>& change, const Seeds& seeds, const Then& then);
  [[nodiscard]] typename RegionLimits<D>::Limit limit_of(const DomainFollower<D>& follower,
                                                         const Corners& t,
                                                         const Seeds& seeds) const;
  void give_measures(RegionLimits<D>& limits, const Seeds& seeds) const;
  [[nodiscard]] std::vector<Corners> staying(const Change<D>& change, const DomainChange<D>& domain,
                                             const Seeds& seeds) const;

  Extent extent_;
  RegionAreas areas_;
  BoxMesher<D> mesher_;
  MeshBox<D> box_;
  std::optional<DomainFollower<D>> follower_;  // from the first update on
  std::shared_ptr<const RegionLimits<D>> limits_;
};

}  // namespace mesher::detail
