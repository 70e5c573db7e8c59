// docs/queries.md and docs/changes.md tell the truth: their snippets are those of
// sac/examples/parts.cpp, which holds.
#define SAC_PARTS_WITHOUT_MAIN
#include "../../sac/examples/parts.cpp"
#include "snippets.hpp"

TEST_CASE("the snippets on queries, fixed points and changes hold") {
  CHECK_NOTHROW(parts::run_all());
}

TEST_CASE("every snippet on queries, fixed points and changes is a part of the program") {
  CHECK(support::require_snippets("docs/queries.md", "examples/parts.cpp") > 4);
  CHECK(support::require_snippets("docs/changes.md", "examples/parts.cpp") > 2);
}
