// sac/README.md and the documents that it was divided into tell the truth: their snippets are those
// of sac/examples/readme_snippets.cpp, which holds.
#define SAC_README_WITHOUT_MAIN
#include "../../sac/examples/readme_snippets.cpp"

#include "snippets.hpp"

TEST_CASE("the snippets of the README hold") { CHECK_NOTHROW(readme::run_all()); }

TEST_CASE("every snippet in the README is a part of the program") {
  CHECK(support::require_snippets("README.md", "examples/readme_snippets.cpp") > 8);
}

TEST_CASE("every snippet on sequences and on events is a part of the program") {
  CHECK(support::require_snippets("docs/sequences.md", "examples/readme_snippets.cpp") > 3);
  CHECK(support::require_snippets("docs/events.md", "examples/readme_snippets.cpp") > 0);
}
