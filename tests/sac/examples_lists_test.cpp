// The examples on lists, arrays and points (sac/examples) under random edits.
#include "apps/lists.hpp"

#include <catch2/catch.hpp>

#include "example_harness.hpp"

using namespace apps;
using namespace support;

#define LIST_EXAMPLES                                                                      \
  ArrayApp, MapApp, FilterApp, ReverseApp, SumApp, MinimumApp, QuicksortApp, MergesortApp, \
      QuickhullApp<any_point>, QuickhullApp<spread_point>, DiameterApp<any_point>,         \
      DiameterApp<spread_point>, DistanceApp<8>, DistanceApp<1000>

TEMPLATE_TEST_CASE("list examples run plainly give what naive programs give", "", LIST_EXAMPLES) {
  check_example_plain<TestType>(100, 100);
  check_example_plain<TestType>(5, 2000);
}

TEMPLATE_TEST_CASE("list examples follow random edits as if run from scratch", "", LIST_EXAMPLES) {
  check_example<TestType>(60, 300, 9);
  check_example<TestType>(3, 4000, 6);
}

TEMPLATE_TEST_CASE("list examples follow many random edits", "[.soak]", LIST_EXAMPLES) {
  check_example<TestType>(2000, 500, 15);
}
