// Faults of seeds in words, and seeds that are none.
#include <algorithm>
#include <cmath>

#include "domain/labels.hpp"
#include "io/text.hpp"
#include "mesher/domain.hpp"

namespace mesher {
namespace {

std::string reason(const SeedFault& fault) {
  switch (fault.kind) {
    case SeedFault::Kind::outside:
      return "is outside of what the segments enclose";
    case SeedFault::Kind::on_segment:
      if (!fault.line) return "is on a segment";
      return "is on segment " + std::to_string(static_cast<std::int64_t>(*fault.line));
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

std::string describe(const SeedFault& fault) {
  return "the seed of " + text_of(fault.seed) + " at " + text::to_text<2>(fault.at) + " " +
         reason(fault);
}

Error error_of(const SeedFault& fault) {
  std::vector<FeatureId> ids{fault.seed.id};
  if (fault.other) ids.push_back(fault.other->id);
  if (fault.line) ids.push_back(*fault.line);
  return {ErrorCode::bad_seed, describe(fault), {}, std::move(ids)};
}

namespace detail {

void check_seed(const Seed& seed) {
  const auto refuse = [&](ErrorCode code, const std::string& what) {
    throw Error(code, "the seed of " + text_of(seed.name) + " " + what, {}, {seed.name.id});
  };
  for (const double x : seed.at) {
    if (!std::isfinite(x)) refuse(ErrorCode::not_finite, "has a coordinate that is not finite");
    if (!text::is_coordinate(x)) {
      refuse(ErrorCode::magnitude, "at " + text::to_text<2>(seed.at) +
                                       " has a coordinate beyond the magnitudes 2^-100 to 2^100");
    }
  }
  if (!std::isfinite(seed.attribute)) {
    refuse(ErrorCode::not_finite, "has an attribute that is not finite");
  }
  if (seed.max_area && !(*seed.max_area > 0)) {
    refuse(ErrorCode::bad_number, "has an area limit that is not positive");
  }
}

void check_seeds(const std::vector<Seed>& seeds) {
  std::vector<SeedName> names;
  for (const Seed& seed : seeds) {
    check_seed(seed);
    names.push_back(seed.name);
  }
  std::sort(names.begin(), names.end());
  const auto twice = std::adjacent_find(names.begin(), names.end());
  if (twice == names.end()) return;
  throw Error(ErrorCode::repeated_id, text_of(*twice) + " has two seeds", {}, {twice->id});
}

}  // namespace detail
}  // namespace mesher
