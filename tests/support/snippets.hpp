// Documents whose snippets are parts of a program that the tests run.
#pragma once

#include <algorithm>
#include <catch2/catch.hpp>
#include <fstream>
#include <string>
#include <vector>

#include "test_paths.hpp"

namespace support {

/// The lines of a file, without indentation. `path`: from the folder of the module, sac.
inline std::vector<std::string> lines_of(const std::string& path,
                                         const std::string& module = "sac") {
  std::ifstream file(std::string(test_paths::kData) + "/../../" + module + "/" + path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) {
    const auto first = line.find_first_not_of(' ');
    lines.push_back(first == line.npos ? "" : line.substr(first));
  }
  return lines;
}

/// The blocks of a document that are fenced as `language`.
inline std::vector<std::vector<std::string>> blocks_of(const std::string& document,
                                                       const std::string& language,
                                                       const std::string& module = "sac") {
  std::vector<std::vector<std::string>> blocks;
  bool inside = false;
  for (const std::string& line : lines_of(document, module)) {
    if (line.starts_with("```")) {
      inside = line == "```" + language;
      if (inside) blocks.emplace_back();
    } else if (inside) {
      blocks.back().push_back(line);
    }
  }
  return blocks;
}

/// Requires every C++ block of the document to be a stretch of one of the programs. Returns their
/// number.
template <class... Programs>
std::size_t require_snippets(const std::string& document, const Programs&... programs) {
  const auto blocks = blocks_of(document, "cpp");
  for (const auto& block : blocks) {
    std::string text;
    for (const std::string& line : block) text += line + '\n';
    INFO(text);
    const auto is_part_of = [&](const std::string& program) {
      const auto lines = lines_of(program);
      return std::search(lines.begin(), lines.end(), block.begin(), block.end()) != lines.end();
    };
    REQUIRE((is_part_of(programs) || ...));
  }
  return blocks.size();
}

/// Whether the C++ block of the mesher's document that begins with the line `first` is a stretch of
/// the program. Requires: there is one.
inline bool is_mesher_snippet(const std::string& document, const std::string& first,
                              const std::string& program) {
  for (const auto& block : blocks_of(document, "cpp", "mesher")) {
    if (block.empty() || block[0] != first) continue;
    const auto lines = lines_of(program, "mesher");
    return std::search(lines.begin(), lines.end(), block.begin(), block.end()) != lines.end();
  }
  FAIL("no block begins with " << first);
  return false;
}

}  // namespace support
