// Faults of seeds in words, and seeds that are none.
#include <algorithm>
#include <cmath>

#include "domain/labels.hpp"
#include "mesher/domain.hpp"
#include "text/text.hpp"

namespace mesher {
namespace {

template <int D>
std::string reason(const SeedFaultOf<D>& fault) {
  using SeedFault = SeedFaultOf<D>;
  const std::string wall = D == 2 ? "segment" : "polygon";
  switch (fault.kind) {
    case SeedFault::Kind::outside:
      return "is outside of what the " + wall + "s enclose";
    case SeedFault::Kind::on_segment:
      if (!fault.line) return "is on a " + wall;
      return "is on " + wall + " " + std::to_string(static_cast<std::int64_t>(*fault.line));
    case SeedFault::Kind::shared:
      return "is in one region with " + text_of(*fault.other) + ", which counts";
  }
  return {};
}

}  // namespace

std::string text_of(const SeedName& seed) {
  return (seed.kind == SeedKind::hole ? "hole " : "region ") +
         std::to_string(static_cast<std::int64_t>(seed.id));
}

template <int D>
std::string describe(const SeedFaultOf<D>& fault) {
  return "the seed of " + text_of(fault.seed) + " at " + text::to_text<D>(fault.at) + " " +
         reason(fault);
}

template std::string describe(const SeedFaultOf<2>&);
template std::string describe(const SeedFaultOf<3>&);

template <int D>
Error error_of(const SeedFaultOf<D>& fault) {
  std::vector<Feature> features{seed_named(fault.seed)};
  if (fault.other) features.push_back(seed_named(*fault.other));
  if (fault.line) features.push_back(D == 2 ? line_named(*fault.line) : polygon_named(*fault.line));
  return {ErrorCode::bad_seed, describe(fault), {}, std::move(features), {position_of(fault.at)}};
}
template Error error_of(const SeedFaultOf<2>&);
template Error error_of(const SeedFaultOf<3>&);

namespace detail {

template <int D>
void check_seed(const SeedOf<D>& seed) {
  const auto refuse = [&](ErrorCode code, const std::string& what) {
    throw Error(code, "the seed of " + text_of(seed.name) + " " + what, {}, {seed_named(seed.name)},
                {position_of(seed.at)});
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

template void check_seed(const SeedOf<2>&);
template void check_seed(const SeedOf<3>&);

template <int D>
void check_seeds(const std::vector<SeedOf<D>>& seeds) {
  std::vector<SeedName> names;
  for (const SeedOf<D>& seed : seeds) {
    check_seed(seed);
    names.push_back(seed.name);
  }
  std::sort(names.begin(), names.end());
  const auto twice = std::adjacent_find(names.begin(), names.end());
  if (twice == names.end()) return;
  throw Error(ErrorCode::repeated_id, text_of(*twice) + " has two seeds", {}, {seed_named(*twice)});
}
template void check_seeds(const std::vector<SeedOf<2>>&);
template void check_seeds(const std::vector<SeedOf<3>>&);

}  // namespace detail
}  // namespace mesher
