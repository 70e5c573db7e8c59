// sac/docs/propagate.md tells the truth: its snippets are those of sac/examples/propagate.cpp,
// which holds, and the traces and the log that it shows are what that prints.
#include <sstream>

#include "../../sac/examples/propagate.cpp"
#include "snippets.hpp"

TEST_CASE("what the program of a propagation prints is what the document shows") {
  std::ostringstream printed;
  REQUIRE_NOTHROW(propagate::run_all(printed));
  std::vector<std::string> lines;
  std::istringstream text(printed.str());
  for (std::string line; std::getline(text, line);) {
    lines.push_back(line.substr(line.find_first_not_of(' ')));
  }
  std::vector<std::string> shown;
  for (const auto& block : support::blocks_of("docs/propagate.md", "text")) {
    shown.insert(shown.end(), block.begin(), block.end());
  }
  CHECK(lines == shown);
}

TEST_CASE("every snippet on a propagation is a part of the program") {
  CHECK(support::require_snippets("docs/propagate.md", "examples/propagate.cpp") > 3);
}
