// What does not fit into the key of an agenda.
#include "sac/key.hpp"

#include "sac/check.hpp"

namespace sac {

void KeyWidths::require_possible(const std::string& agenda) const {
  const bool possible =
      bucket >= 1 && bucket <= 32 && phase <= 31 && colour <= 31 && bucket + phase + colour <= 32;
  if (possible) return;
  throw UsageError("agenda '" + agenda + "' cannot have keys of " + std::to_string(bucket) + ", " +
                   std::to_string(phase) + " and " + std::to_string(colour) +
                   " bits: together at most 32, at least 1 of them for the bucket");
}

void KeyWidths::fail(const Key& key, const std::string& call, const std::string& agenda) const {
  const auto refuse = [&](const char* part, auto value, std::int64_t least, unsigned bits) {
    const std::int64_t most = least + ((std::int64_t{1} << bits) - 1);
    if (value >= least && value <= most) return;
    throw UsageError("agenda '" + agenda + "': " + call + " is posted at " + part + ' ' +
                     std::to_string(value) + ", which is not in " + std::to_string(least) + " .. " +
                     std::to_string(most) + ": KeyWidths of make_agenda sets the ranges");
  };
  refuse("bucket", std::int64_t{key.bucket}, -(std::int64_t{1} << (bucket - 1)), bucket);
  refuse("phase", std::int64_t{key.phase}, 0, phase);
  refuse("colour", std::int64_t{key.colour}, 0, colour);
  SAC_INVARIANT(false);  // it fits
  throw;
}

}  // namespace sac
