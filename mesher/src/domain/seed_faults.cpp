// Faults of seeds in words.
#include "io/text.hpp"
#include "mesher/domain.hpp"

namespace mesher {
namespace {

std::string words(const SeedName& seed) {
  return (seed.kind == SeedKind::hole ? "hole " : "region ") +
         std::to_string(static_cast<std::int64_t>(seed.id));
}

std::string reason(const SeedFault& fault) {
  switch (fault.kind) {
    case SeedFault::Kind::outside:
      return "is outside of what the segments enclose";
    case SeedFault::Kind::on_segment:
      if (!fault.line) return "is on a segment";
      return "is on segment " + std::to_string(static_cast<std::int64_t>(*fault.line));
    case SeedFault::Kind::shared:
      return "is in one region with " + words(*fault.other) + ", which counts";
  }
  return {};
}

}  // namespace

std::string describe(const SeedFault& fault) {
  return "the seed of " + words(fault.seed) + " at " + text::to_text<2>(fault.at) + " " +
         reason(fault);
}

Error error_of(const SeedFault& fault) {
  std::vector<FeatureId> ids{fault.seed.id};
  if (fault.other) ids.push_back(fault.other->id);
  if (fault.line) ids.push_back(*fault.line);
  return {ErrorCode::bad_seed, describe(fault), {}, std::move(ids)};
}

}  // namespace mesher
