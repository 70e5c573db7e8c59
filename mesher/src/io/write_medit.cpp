// Writes `.mesh` files (Medit), numbered from 1, z = 0: Gmsh takes the third number of a vertex for
// z whatever the dimension is.
#include "io/write_mesh.hpp"

namespace mesher {

void write_medit(const Mesh<2>& mesh, const MeshFeatures& features, TextFile& file) {
  constexpr std::size_t kFirst = 1;
  const GroupNumbers<double> regions(features.regions);
  std::vector<std::int64_t> all = features.markers;
  for (const MeshEdge& e : features.edges) all.push_back(e.marker);
  const GroupNumbers<std::int64_t> markers(std::move(all));
  file << "MeshVersionFormatted 2\n\nDimension 3\n\nVertices\n" << mesh.vertices.size() << '\n';
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const auto& [x, y] = mesh.vertices[i];
    const std::int64_t marker = features.markers.empty() ? 0 : features.markers[i];
    file << x << ' ' << y << " 0 " << markers.of(marker) << '\n';
  }
  if (!features.edges.empty()) file << "\nEdges\n" << features.edges.size() << '\n';
  for (const MeshEdge& e : features.edges) {
    file << e.low + kFirst << ' ' << e.high + kFirst << ' ' << markers.of(e.marker) << '\n';
  }
  file << "\nTriangles\n" << mesh.simplices.size() << '\n';
  for (std::size_t i = 0; i < mesh.simplices.size(); ++i) {
    for (const auto corner : mesh.simplices[i]) file << corner + kFirst << ' ';
    file << (features.regions.empty() ? 0 : regions.of(features.regions[i])) << '\n';
  }
  file << "\nEnd\n";
}

}  // namespace mesher
