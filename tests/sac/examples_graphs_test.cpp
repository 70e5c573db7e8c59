// The examples on trees and graphs (sac/examples) under random edits.
#include <catch2/catch.hpp>

#include "apps/graphs.hpp"
#include "example_harness.hpp"

namespace {

using namespace apps;
using namespace support;

TEMPLATE_TEST_CASE("graph examples run plainly give what naive programs give", "", ExpressionApp,
                   ForestApp, SearchApp, ComponentsApp, CoreApp, SpanApp, BuildApp) {
  check_example_plain<TestType>(200, 60);
}

// A path of edges of length 1, with two edges of length 1000 hanging on it: the diameter lies
// inside of what was contracted.
TEST_CASE("two vertices that hang on contracted paths may be the farthest of their tree") {
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    const int n = 5 + random(40);
    ForestApp::Input input(static_cast<std::size_t>(n + 2));
    const auto link = [&](int v, int w, int length) {
      ForestApp::apply(input, {ForestApp::Edit::link, v, w, length});
    };
    for (int v = 1; v < n; ++v) link(v - 1, v, 1);
    const int left = 1 + random(n - 3);
    link(left, n, 1000);
    link(left + 1 + random(n - left - 2), n + 1, 1000);
    INFO(n << " vertices");
    CHECK(example::plain_fault<ForestApp>(input).empty());
  }
}

TEMPLATE_TEST_CASE("graph examples under random edits", "", ExpressionApp, ForestApp, SearchApp,
                   ComponentsApp, CoreApp, SpanApp, BuildApp) {
  check_example<TestType>(60, 40, 30);
}

TEMPLATE_TEST_CASE("graph examples under many random edits", "[.soak]", ExpressionApp, ForestApp,
                   SearchApp, ComponentsApp, CoreApp, SpanApp, BuildApp) {
  check_example<TestType>(300, 150, 60);
}

}  // namespace
