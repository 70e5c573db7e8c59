// A mesh of the same input without limits of size, which tells what lines enclose: where limits
// count, and which largest areas hold there. It follows the input before the mesh with limits does,
// and is taken back with it.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "facade/followed.hpp"
#include "mesher/domain_mesher.hpp"
#include "sizes/region_limits.hpp"

namespace mesher::detail {

class UnlimitedMesh {
 public:
  using Seeds = EditedSeeds;

  UnlimitedMesh(const Options<2>& options, Extent extent, RegionAreas areas);

  /// For points and lines to be announced to.
  [[nodiscard]] Mesher<2>& mesher() noexcept { return mesher_; }

  /// The limits after an update, and where they differ from those before.
  using Then = std::function<void(const std::shared_ptr<const RegionLimits>& limits,
                                  const std::vector<Box<2>>& where)>;
  /// Brings all up to date with what is announced, then asks `then`: what that throws leaves
  /// update(), and all is as it was. `seeds`: as they shall be, with edits since the last update.
  void update(const Seeds& seeds, const RunControl& control, const Then& then);

  /// Adds the calls, edges and bytes of all this. Cost: O(triangles).
  void add_to(MeshStats& stats) const;

  void check_invariants() const;

 private:
  using Corners = DomainChange::Corners;
  void begin(const Change<2>& change, const Seeds& seeds, const Then& then);
  void follow(const Change<2>& change, const Seeds& seeds, const Then& then);
  [[nodiscard]] RegionLimits::Limit limit_of(const DomainFollower& follower, const Corners& t,
                                             const Seeds& seeds) const;
  void give_areas(RegionLimits& limits, const Seeds& seeds) const;
  [[nodiscard]] std::vector<Corners> staying(const Change<2>& change, const DomainChange& domain,
                                             const Seeds& seeds) const;

  Extent extent_;
  RegionAreas areas_;
  Mesher<2> mesher_;
  MeshBox<2> box_;
  std::optional<DomainFollower> follower_;  // from the first update on
  std::shared_ptr<const RegionLimits> limits_;
};

}  // namespace mesher::detail
