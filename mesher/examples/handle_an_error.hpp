// Handles an error by its typed parts, without parsing its message.
#pragma once

#include <string>
#include <vector>

#include "mesher/all.hpp"

namespace example {

// The lines of a file that keep it from being meshed; none if nothing does.
inline std::vector<mesher::LineId> lines_to_mark(const std::string& path) {
  const mesher::GraphFile<2> roads = mesher::read<2>(path);
  try {
    static_cast<void>(mesher::mesh(roads.graph));
    return {};
  } catch (const mesher::Error& error) {
    if (error.code() != mesher::ErrorCode::crossing_segments) throw mesher::located(error, roads);
    std::vector<mesher::LineId> lines;
    for (const mesher::Feature& f : error.features()) {
      if (const auto line = f.line()) lines.push_back(*line);
    }
    return lines;
  }
}

}  // namespace example
