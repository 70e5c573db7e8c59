// The examples on maps (sac/examples) under random edits.
#include <catch2/catch.hpp>

#include "apps/maps.hpp"
#include "example_harness.hpp"

namespace {

using namespace apps;
using namespace support;

TEMPLATE_TEST_CASE("map examples run plainly give what naive programs give", "", ViewApp, RangesApp,
                   DifferencesApp, LeadersApp) {
  check_example_plain<TestType>(200, 60);
}

TEMPLATE_TEST_CASE("map examples under random edits", "", ViewApp, RangesApp, DifferencesApp,
                   LeadersApp) {
  check_example<TestType>(60, 40, 30);
}

TEMPLATE_TEST_CASE("map examples under many random edits", "[.soak]", ViewApp, RangesApp,
                   DifferencesApp, LeadersApp) {
  check_example<TestType>(300, 150, 60);
}

}  // namespace
