// sac/docs/errors.md tells the truth: its snippets are those of sac/examples/errors.cpp, which
// holds, and the output that it shows is what that prints.
#include <sstream>

#include "../../sac/examples/errors.cpp"
#include "snippets.hpp"

TEST_CASE("what the snippets on errors print is what the document shows") {
  std::ostringstream printed;
  REQUIRE_NOTHROW(errors::run_all(printed));
  std::string shown;
  for (const auto& block : support::blocks_of("docs/errors.md", "text")) {
    for (const std::string& line : block) shown += line + '\n';
  }
  CHECK(printed.str() == shown);
}

TEST_CASE("every snippet on errors is a part of the program") {
  CHECK(support::require_snippets("docs/errors.md", "examples/errors.cpp") > 5);
}
