// Random programs under random edits, compared with a run from scratch after every propagation.
#include <catch2/catch.hpp>

#include "program_case.hpp"
#include "program_oracle.hpp"

namespace {

using namespace support;

void check_seeds(std::uint64_t from, std::uint64_t to) {
  for (std::uint64_t seed = from; seed < to; ++seed) {
    const Case c = random_case(seed);
    if (fault_of(c).empty()) continue;
    const Case small = shrink(c, [](const Case& other) { return !fault_of(other).empty(); });
    FAIL("seed " << seed << '\n' << describe(small) << fault_of(small));
  }
}

TEST_CASE(
    "random programs under random edits and failures equal a run from scratch and a plain run") {
  check_seeds(0, 400);
}

TEST_CASE("many random programs equal a run from scratch and a plain run", "[.soak]") {
  check_seeds(1000, 40000);
}

TEST_CASE("a case written as bytes is the same case") {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const Case c = random_case(seed);
    REQUIRE(describe(decode(encode(c))) == describe(c));
  }
}

}  // namespace
