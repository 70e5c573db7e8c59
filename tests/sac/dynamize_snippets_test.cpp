// sac/docs/dynamize.md tells the truth: its snippets are those of sac/examples/dynamize.cpp, which
// holds, and the output that it shows is what that prints.
#include <sstream>

#include "../../sac/examples/dynamize.cpp"
#include "snippets.hpp"

TEST_CASE("what the steps of dynamizing print is what the document shows") {
  std::ostringstream printed;
  REQUIRE_NOTHROW(dynamize::run_all(printed));
  std::string shown;
  for (const auto& block : support::blocks_of("docs/dynamize.md", "text")) {
    for (const std::string& line : block) shown += line + '\n';
  }
  CHECK(printed.str() == shown);
}

TEST_CASE("every snippet on dynamizing is a part of the program") {
  CHECK(support::require_snippets("docs/dynamize.md", "examples/dynamize.cpp") > 10);
}
