// Random programs under random edits, compared with a run from scratch after every propagation.
#include <catch2/catch.hpp>
#include <cstdint>
#include <vector>

#include "program_case.hpp"
#include "program_oracle.hpp"

namespace {

using namespace support;

using MakeCase = Case (*)(std::uint64_t seed, unsigned features);

void check_seeds(MakeCase make, unsigned features, std::uint64_t from, std::uint64_t to) {
  for (std::uint64_t seed = from; seed < to; ++seed) {
    CAPTURE(seed, features);  // for the case that it crashes
    const Case c = make(seed, features);
    if (fault_of(c).empty()) continue;
    const Case small = shrink(c, [](const Case& other) { return !fault_of(other).empty(); });
    FAIL("seed " << seed << ", features " << features << '\n'
                 << describe(small) << fault_of(small));
  }
}

// Each feature alone, each two of them, and all.
std::vector<unsigned> sets_of_features() {
  std::vector<unsigned> sets{0, kFeatures};
  for (unsigned a = 1; a <= kFeatures; a *= 2) {
    for (unsigned b = a; b <= kFeatures; b *= 2) {
      if (((a | b) & ~kFeatures) == 0) sets.push_back(a | b);
    }
  }
  return sets;
}

TEST_CASE(
    "random programs under random edits and failures equal a run from scratch and a plain run") {
  check_seeds(random_case, kFeatures, 0, 400);
}

TEST_CASE("small programs dense in features equal a run from scratch, or are refused as it is") {
  for (const unsigned features : sets_of_features()) check_seeds(focused_case, features, 0, 150);
}

TEST_CASE("many random programs equal a run from scratch and a plain run", "[.soak]") {
  check_seeds(random_case, kFeatures, 1000, 40000);
}

TEST_CASE("many small programs equal a run from scratch, or are refused as it is", "[.soak]") {
  for (const unsigned features : sets_of_features()) {
    check_seeds(focused_case, features, 1000, 6000);
  }
}

TEST_CASE("a case written as bytes is the same case") {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    for (const Case& c : {random_case(seed), focused_case(seed, kFeatures)}) {
      REQUIRE(describe(decode(encode(c))) == describe(c));
    }
  }
}

}  // namespace
