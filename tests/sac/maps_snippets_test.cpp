// sac/docs/maps.md tells the truth: its snippets are those of sac/examples/maps.cpp, which holds,
// and the output that it shows is what that prints.
#include <sstream>

#include "../../sac/examples/maps.cpp"
#include "snippets.hpp"

TEST_CASE("what the snippets on maps print is what the document shows") {
  std::ostringstream printed;
  REQUIRE_NOTHROW(maps::run_all(printed));
  std::string shown;
  for (const auto& block : support::blocks_of("docs/maps.md", "text")) {
    for (const std::string& line : block) shown += line + '\n';
  }
  CHECK(printed.str() == shown);
}

TEST_CASE("every snippet on maps is a part of the program") {
  CHECK(support::require_snippets("docs/maps.md", "examples/maps.cpp") > 6);
}
