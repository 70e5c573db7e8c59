// sac/README.md tells the truth: its snippets are those of sac/examples/readme_snippets.cpp, which
// holds.
#define SAC_README_WITHOUT_MAIN
#include "../../sac/examples/readme_snippets.cpp"

#include "snippets.hpp"

TEST_CASE("the snippets of the README hold") { CHECK_NOTHROW(readme::run_all()); }

TEST_CASE("every snippet in the README is a part of the program") {
  CHECK(support::require_snippets("README.md", "examples/readme_snippets.cpp") > 8);
}
