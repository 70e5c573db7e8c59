// Writes `.mesh` files (Medit), numbered from 1, in the plane.
#include "io/write_mesh.hpp"

namespace mesher {

void write_medit(const Mesh<2>& mesh, const MeshFeatures& features, TextFile& file) {
  constexpr std::size_t kFirst = 1;
  const GroupNumbers regions(features.regions);
  file << "MeshVersionFormatted 2\n\nDimension 2\n\nVertices\n" << mesh.vertices.size() << '\n';
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const auto& [x, y] = mesh.vertices[i];
    file << x << ' ' << y << ' ' << (features.markers.empty() ? 0 : features.markers[i]) << '\n';
  }
  if (!features.edges.empty()) file << "\nEdges\n" << features.edges.size() << '\n';
  for (const MeshEdge& e : features.edges) {
    file << e.low + kFirst << ' ' << e.high + kFirst << ' ' << e.marker << '\n';
  }
  file << "\nTriangles\n" << mesh.simplices.size() << '\n';
  for (std::size_t i = 0; i < mesh.simplices.size(); ++i) {
    for (const auto corner : mesh.simplices[i]) file << corner + kFirst << ' ';
    file << (features.regions.empty() ? 0 : regions.of(features.regions[i])) << '\n';
  }
  file << "\nEnd\n";
}

}  // namespace mesher
