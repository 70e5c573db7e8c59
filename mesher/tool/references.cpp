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

void forget_markers(mesher::MeshFeatures& features) {
  features.markers.clear();
  for (auto& edge : features.edges) edge.marker = 0;
  for (auto& face : features.faces) face.marker = 0;
}

void note(const std::string& path, const char* what, std::vector<mesher::Note>& notes) {
  notes.push_back({std::string(what) + " are not compared: .mesh counts those of INPUT", {path}});
}

template <class Regions>
bool are_attributes(const Regions& regions) {
  return are_references(regions, [](const auto& region) { return region.attribute; });
}

}  // namespace

void forget_counted_values(const std::string& path, MeshData& mesh, mesher::PslgFile& graph) {
  if (mesher::format_of(path) != ".mesh") return;
  Pslg& pslg = graph.pslg;
  const auto marker = [](const auto& part) { return part.marker; };
  if (!are_references(pslg.points, marker) || !are_references(pslg.segments, marker) ||
      !are_references(pslg.polylines, marker)) {
    forget_markers(mesh.features);
    note(path, "markers", mesh.notes);
  }
  if (!are_attributes(pslg.regions)) {
    pslg.regions.clear();
    graph.regions.clear();
    note(path, "attributes of regions", mesh.notes);
  }
}

void forget_counted_values(const std::string& path, mesher::MeshDataOf<3>& mesh,
                           mesher::PlcFile& complex) {
  if (mesher::format_of(path) != ".mesh") return;
  const mesher::Plc& plc = complex.plc;
  const auto marker = [](const auto& part) { return part.marker; };
  if (!are_references(plc.points, marker) || !are_references(plc.segments, marker) ||
      !are_references(plc.facets, marker)) {
    forget_markers(mesh.features);
    note(path, "markers", mesh.notes);
  }
  if (are_attributes(plc.regions)) return;
  complex.plc.regions.clear();
  complex.regions.clear();
  note(path, "attributes of regions", mesh.notes);
}

}  // namespace tool
