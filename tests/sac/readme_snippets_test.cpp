// sac/README.md tells the truth: its snippets are those of sac/examples/readme_snippets.cpp, which
// holds.
#define SAC_README_WITHOUT_MAIN
#include "../../sac/examples/readme_snippets.cpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <fstream>

#include "test_paths.hpp"

namespace {

std::vector<std::string> lines_of(const std::string& path) {
  std::ifstream file(std::string(test_paths::kData) + "/../../sac/" + path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) {
    const auto first = line.find_first_not_of(' ');
    lines.push_back(first == line.npos ? "" : line.substr(first));
  }
  return lines;
}

}  // namespace

TEST_CASE("the snippets of the README hold") { CHECK_NOTHROW(readme::run_all()); }

TEST_CASE("every line of a snippet in the README is a line of the program, in order") {
  const auto program = lines_of("examples/readme_snippets.cpp");
  auto at = program.begin();
  bool inside = false;
  int compared = 0;
  for (const std::string& line : lines_of("README.md")) {
    if (line.starts_with("```")) {
      inside = line == "```cpp";
    } else if (inside && !line.empty()) {
      INFO(line);
      at = std::find(at, program.end(), line);
      REQUIRE(at != program.end());
      ++compared;
    }
  }
  CHECK(compared > 50);
}
