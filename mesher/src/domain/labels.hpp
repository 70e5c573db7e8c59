// What seeds may be; which seed of a region counts, what that makes of the region, what is kept,
// and which seeds are at fault.
#pragma once

#include <optional>
#include <vector>

#include "mesher/domain.hpp"

namespace mesher::detail {

/// Throws: Error (not_finite, magnitude, bad_number for a limit that is not > 0).
template <int D>
void check_seed(const SeedOf<D>& seed);
/// The same of each. Throws also: Error(repeated_id) for two of one name. Cost: O(s log s).
template <int D>
void check_seeds(const std::vector<SeedOf<D>>& seeds);

/// The seeds of one region that count, as they are met in any order.
class Counting {
 public:
  void add(const SeedName& seed) {
    auto& least = seed.kind == SeedKind::hole ? hole_ : region_;
    if (!least || seed.id < *least) least = seed.id;
  }
  [[nodiscard]] RegionLabel label(bool open) const {
    if (open) return {Zone::outside, region_};
    if (hole_) return {Zone::hole, hole_};
    return {Zone::inside, region_};
  }

 private:
  std::optional<FeatureId> hole_, region_;
};

/// Whether all is kept, where anything is enclosed or not.
[[nodiscard]] inline bool keeps_all(Extent extent, bool encloses) {
  return extent == Extent::box || !encloses;
}
[[nodiscard]] inline bool keeps(const RegionLabel& label, bool all) {
  return all || label.zone == Zone::inside;
}

/// The seed that a label is of.
[[nodiscard]] inline std::optional<SeedName> counting_seed(const RegionLabel& label) {
  if (!label.seed) return std::nullopt;
  return SeedName{label.zone == Zone::hole ? SeedKind::hole : SeedKind::region, *label.seed};
}

/// The fault of a seed in a region with this label; nothing if it has the region to itself.
template <int D>
[[nodiscard]] std::optional<SeedFaultOf<D>> fault_in(const SeedOf<D>& seed,
                                                     const RegionLabel& label, bool keeps_all) {
  using SeedFault = SeedFaultOf<D>;
  const bool hole = seed.name.kind == SeedKind::hole;
  if (label.zone == Zone::outside && (hole || !keeps_all)) {
    return SeedFault{SeedFault::Kind::outside, seed.name, seed.at, {}, {}};
  }
  const auto counts = counting_seed(label);
  if (counts == seed.name) return std::nullopt;
  return SeedFault{SeedFault::Kind::shared, seed.name, seed.at, counts, {}};
}

}  // namespace mesher::detail
