// The examples on lists, arrays and points (sac/examples) under random edits.
#include <catch2/catch.hpp>

#include "apps/lists.hpp"
#include "example_harness.hpp"

using namespace apps;
using namespace support;

#define LIST_EXAMPLES                                                                      \
  ArrayApp, MapApp, FilterApp, ReverseApp, SumApp, MinimumApp, QuicksortApp, MergesortApp, \
      QuicksortElementsApp, MergesortElementsApp, QuickhullApp<any_point>,                 \
      QuickhullApp<spread_point>, DiameterApp<any_point>, DiameterApp<spread_point>,       \
      DistanceApp<8>, DistanceApp<1000>

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

// Points over so large a square that hulls have many corners.
inline Point far_point(Random& random, std::uint32_t id) {
  return random_point(random, id, 0, 1 << 28);
}

template <class App>
void check_at_scale(int size, int edits) {
  Random random(5);
  auto input = App::random_input(random, size);
  sac::Engine engine;
  typename App::template World<sac::Engine> world(engine, input);
  REQUIRE(world.result() == App::oracle(input));
  for (int i = 0; i < edits; ++i) {
    const auto edit = App::random_edit(random, input);
    App::apply(input, edit);
    world.edit(edit);
    engine.propagate();
    INFO("edit " << i);
    REQUIRE(world.result() == App::oracle(input));
  }
  engine.check_invariants();
}

TEST_CASE("hulls of 10^5 points are right after every edit", "[.soak]") {
  check_at_scale<QuickhullApp<far_point>>(100'000, 1000);
  check_at_scale<DistanceApp<4000>>(100'000, 1000);
}

TEST_CASE("sorted lists of 10^5 elements are right after every edit", "[.soak]") {
  check_at_scale<QuicksortApp>(100'000, 500);
  check_at_scale<MergesortApp>(100'000, 500);
  check_at_scale<QuicksortElementsApp>(100'000, 500);
  check_at_scale<MergesortElementsApp>(100'000, 500);
}
