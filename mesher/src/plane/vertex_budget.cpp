// Counting vertices by line.
#include "plane/vertex_budget.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace mesher::detail {

namespace {

// The lines that are split more than once, by the number of vertices on them, most first; of equal
// ones the smallest id first. (Others are not to blame.)
std::vector<std::pair<std::size_t, LineId>> lines_by_vertices(
    const std::map<LineId, std::size_t>& counts) {
  std::vector<std::pair<std::size_t, LineId>> lines;
  for (const auto& [id, count] : counts) {
    if (count > 1) lines.emplace_back(count, id);
  }
  std::stable_sort(lines.begin(), lines.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  return lines;
}

}  // namespace

Error too_many_vertices(const VertexSearch<2>& vertices, const Names* names, std::size_t most) {
  std::map<LineId, std::size_t> counts;
  if (names != nullptr) {
    vertices.pool().for_each([&](const Vertex<2>& v) {
      if (v.alive && v.on_segment) ++counts[names->line(vertices.role(v).on)];
    });
  }
  return too_many_vertices(counts, most);
}

Error too_many_vertices(const std::map<LineId, std::size_t>& on_lines, std::size_t most) {
  std::string text = "more than " + std::to_string(most) + " vertices are needed";
  std::vector<mesher::Feature> lines;
  for (const auto& [count, id] : lines_by_vertices(on_lines)) {
    text += (lines.empty() ? "; so far " : " and ") + std::to_string(count);
    if (lines.empty()) text += " are";
    lines.push_back(mesher::Feature(id));
    text += " on " + text_of(lines.back());
    if (lines.size() == 2) break;
  }
  return Error(ErrorCode::too_many, text, {}, std::move(lines));
}

}  // namespace mesher::detail
