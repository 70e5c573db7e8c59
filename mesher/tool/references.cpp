// `.mesh` has whole numbers from 1 on; the writer counts other values.
#include "references.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesher/write.hpp"

namespace tool {
namespace {

// 0 stays 0, and is what there is without any.
bool is_reference(double value) {
  return value >= 0 && value < std::numeric_limits<std::int32_t>::max() &&
         value == std::floor(value);
}

bool are_references(const auto& parts, auto value_of) {
  return std::all_of(parts.begin(), parts.end(), [&](const auto& part) {
    return is_reference(static_cast<double>(value_of(part)));
  });
}

void forget_markers(mesher::MeshFeatures& features) {
  features.markers.clear();
  for (auto& edge : features.edges) edge.marker = 0;
  for (auto& face : features.faces) face.marker = 0;
}

void note(const std::string& path, const char* what, std::vector<mesher::Note>& notes) {
  notes.push_back({std::string(what) + " are not compared: .mesh counts those of INPUT", {path}});
}

}  // namespace

template <int D>
void forget_counted_values(const std::string& path, mesher::MeshData<D>& mesh,
                           mesher::GraphFile<D>& file) {
  if (mesher::format_of(path) != ".mesh") return;
  mesher::Graph<D>& graph = file.graph;
  const auto marker = [](const auto& part) { return part.marker; };
  bool are_whole = are_references(graph.points, marker) && are_references(graph.segments, marker) &&
                   are_references(graph.polylines, marker);
  if constexpr (D == 3) are_whole = are_whole && are_references(graph.polygons, marker);
  if (!are_whole) {
    forget_markers(mesh.features);
    note(path, "markers", mesh.notes);
  }
  if (are_references(graph.regions(), [](const auto& region) { return region.attribute; })) return;
  graph.seeds = graph.holes();
  file.seeds.clear();
  note(path, "attributes of regions", mesh.notes);
}

template void forget_counted_values(const std::string&, mesher::MeshData<2>&,
                                    mesher::GraphFile<2>&);
template void forget_counted_values(const std::string&, mesher::MeshData<3>&,
                                    mesher::GraphFile<3>&);

}  // namespace tool
