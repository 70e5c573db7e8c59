// Faults of seeds in words, and seeds that are none.
#include <algorithm>
#include <cmath>

#include "domain/labels.hpp"
#include "mesher/domain.hpp"
#include "text/text.hpp"

namespace mesher {
namespace {

template <int D>
std::string reason(const SeedFault<D>& fault) {
  const std::string wall = D == 2 ? "segment" : "polygon";
  switch (fault.kind) {
    case SeedFault<D>::Kind::outside:
      return "is outside of what the " + wall + "s enclose";
    case SeedFault<D>::Kind::on_segment:
      return "is on " + (fault.wall == Feature() ? "a " + wall : text_of(fault.wall));
    case SeedFault<D>::Kind::shared:
      return "is in one region with " + text_of(*fault.other) + ", which counts";
  }
  return {};
}

}  // namespace

template <int D>
std::string describe(const SeedFault<D>& fault) {
  return "the seed of " + text_of(fault.seed) + " at " + text::to_text<D>(fault.at) + " " +
         reason(fault);
}

template std::string describe(const SeedFault<2>&);
#ifndef MESHER_PLANE_ONLY
template std::string describe(const SeedFault<3>&);
#endif

template <int D>
Error error_of(const SeedFault<D>& fault) {
  std::vector<Feature> features{mesher::Feature(fault.seed)};
  if (fault.other) features.push_back(mesher::Feature(*fault.other));
  if (fault.wall != Feature()) features.push_back(fault.wall);
  return {ErrorCode::bad_seed, describe(fault), {}, std::move(features), {position_of(fault.at)}};
}
template Error error_of(const SeedFault<2>&);
#ifndef MESHER_PLANE_ONLY
template Error error_of(const SeedFault<3>&);
#endif

namespace detail {

template <int D>
void check_seed(const Seed<D>& seed) {
  const auto refuse = [&](ErrorCode code, const std::string& what) {
    throw Error(code, "the seed of " + text_of(seed.id) + " " + what, {},
                {mesher::Feature(seed.id)}, {position_of(seed.at)});
  };
  for (const double x : seed.at) {
    if (!std::isfinite(x)) refuse(ErrorCode::not_finite, "has a coordinate that is not finite");
    if (!text::is_coordinate(x)) {
      refuse(ErrorCode::magnitude, "at " + text::to_text<D>(seed.at) +
                                       " has a coordinate beyond the magnitudes 2^-100 to 2^100");
    }
  }
  if (!std::isfinite(seed.attribute)) {
    refuse(ErrorCode::not_finite, "has an attribute that is not finite");
  }
  if (seed.max_measure && !(*seed.max_measure > 0)) {
    refuse(ErrorCode::bad_number, D == 2 ? "has an area limit that is not positive"
                                         : "has a volume limit that is not positive");
  }
}

template void check_seed(const Seed<2>&);
#ifndef MESHER_PLANE_ONLY
template void check_seed(const Seed<3>&);
#endif

template <int D>
void check_seeds(const std::vector<Seed<D>>& seeds) {
  std::vector<SeedId> names;
  for (const Seed<D>& seed : seeds) {
    check_seed(seed);
    names.push_back(seed.id);
  }
  std::sort(names.begin(), names.end());
  const auto twice = std::adjacent_find(names.begin(), names.end());
  if (twice == names.end()) return;
  throw Error(ErrorCode::repeated_id, text_of(*twice) + " has two seeds", {},
              {mesher::Feature(*twice)});
}
template void check_seeds(const std::vector<Seed<2>>&);
#ifndef MESHER_PLANE_ONLY
template void check_seeds(const std::vector<Seed<3>>&);
#endif

}  // namespace detail
}  // namespace mesher
