// Who gives markers to the parts of a mesh, and whether a part has one that it may have.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "mesher/domain.hpp"
#include "mesher/graph.hpp"
#include "text/id_text.hpp"

namespace mesher::detail {

// Who has a marker, for messages: "line 11 (line 24)".
struct Marked {
  std::int64_t marker = 0;
  std::string name;
};
using Givers = std::vector<const Marked*>;

/// The i-th, of those that stand at `positions`, where these are known.
[[nodiscard]] inline Marked marked(std::int64_t marker, const char* what, auto id,
                                   const std::vector<FilePosition>& positions, std::size_t i) {
  std::string name = std::string(what) + " " + id_text(id);
  if (i < positions.size()) name += " (line " + std::to_string(positions[i].line) + ")";
  return {marker, std::move(name)};
}

/// What is wrong with a marker, if one of `givers`, each a `what`, which are there, should give it;
/// "" if nothing is.
[[nodiscard]] inline std::string marker_trouble(std::int64_t marker, const Givers& givers,
                                                bool at_border, const std::string& what) {
  const Marked* expected = nullptr;
  for (const Marked* giver : givers) {
    if (giver->marker == 0) continue;
    if (giver->marker == marker) return "";
    if (expected == nullptr) expected = giver;
  }
  const std::string has = " has the marker " + std::to_string(marker);
  if (expected != nullptr) {
    return has + ", but is on " + expected->name + ", which has " +
           std::to_string(expected->marker);
  }
  if (marker == 0 || (at_border && marker == kBoundaryMarker)) return "";
  return has + ", but is on no " + what + (at_border ? " with that one" : " with one");
}

[[nodiscard]] bool has_marker(const auto& parts) {
  return std::any_of(parts.begin(), parts.end(), [](const auto& part) { return part.marker != 0; });
}

}  // namespace mesher::detail
