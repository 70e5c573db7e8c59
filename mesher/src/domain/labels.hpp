// Rules for seeds: valid seeds, the seed of a region that counts, the label that it gives the
// region, the kept regions, and the seeds at fault.
#pragma once

#include <optional>
#include <vector>

#include "mesher/domain.hpp"

namespace mesher::detail {

/// Throws: Error (not_finite, magnitude, bad_number for a limit that is not > 0).
template <int D>
void check_seed(const Seed<D>& seed);
/// The same of each. Throws also: Error(repeated_id) for two of one name. Cost: O(s log s).
template <int D>
void check_seeds(const std::vector<Seed<D>>& seeds);

/// The seeds of one region that count, as they are met in any order.
class Counting {
 public:
  void add(const SeedId& seed) {
    auto& least = seed.kind == SeedKind::hole ? hole_ : region_;
    if (!least || seed < *least) least = seed;
  }
  [[nodiscard]] RegionLabel label(bool open) const {
    if (open) return {Zone::outside, region_};
    if (hole_) return {Zone::hole, hole_};
    return {Zone::inside, region_};
  }

 private:
  std::optional<SeedId> hole_, region_;
};

/// Whether all is kept, where anything is enclosed or not.
[[nodiscard]] inline bool keeps_all(Extent extent, bool encloses) {
  return extent == Extent::box || !encloses;
}
[[nodiscard]] inline bool keeps(const RegionLabel& label, bool all) {
  return all || label.zone == Zone::inside;
}

/// The seed that a label is of.
[[nodiscard]] inline std::optional<SeedId> counting_seed(const RegionLabel& label) {
  return label.seed;
}

/// The fault of a seed in a region with this label; nothing if it has the region to itself.
template <int D>
[[nodiscard]] std::optional<SeedFault<D>> fault_in(const Seed<D>& seed, const RegionLabel& label,
                                                   bool keeps_all) {
  const bool hole = seed.id.kind == SeedKind::hole;
  if (label.zone == Zone::outside && (hole || !keeps_all)) {
    return SeedFault<D>{SeedFault<D>::Kind::outside, seed.id, seed.at, {}, {}};
  }
  const auto counts = counting_seed(label);
  if (counts == seed.id) return std::nullopt;
  return SeedFault<D>{SeedFault<D>::Kind::shared, seed.id, seed.at, counts, {}};
}

}  // namespace mesher::detail
