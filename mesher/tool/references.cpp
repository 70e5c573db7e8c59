// `.mesh` has whole numbers from 1 on; the writer counts other values.
#include "references.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tool {
namespace {

using mesher::MeshData;
using mesher::Pslg;

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

void forget_markers(MeshData& mesh) {
  mesh.features.markers.clear();
  for (auto& edge : mesh.features.edges) edge.marker = 0;
}

}  // namespace

void forget_counted_values(const std::string& path, MeshData& mesh, mesher::PslgFile& graph) {
  if (mesher::format_of(path) != ".mesh") return;
  Pslg& pslg = graph.pslg;
  const auto note = [&](const char* what) {
    mesh.notes.push_back(
        {std::string(what) + " are not compared: .mesh counts those of INPUT", {path}});
  };
  const auto marker = [](const auto& part) { return part.marker; };
  if (!are_references(pslg.points, marker) || !are_references(pslg.segments, marker) ||
      !are_references(pslg.polylines, marker)) {
    forget_markers(mesh);
    note("markers");
  }
  if (!are_references(pslg.regions, [](const auto& region) { return region.attribute; })) {
    pslg.regions.clear();
    graph.regions.clear();
    note("attributes of regions");
  }
}

}  // namespace tool
