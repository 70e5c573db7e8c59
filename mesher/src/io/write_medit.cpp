// Writes `.mesh` files (Medit), numbered from 1; in the plane z = 0: Gmsh takes the third number of
// a vertex for z whatever the dimension is.
#include "io/write_mesh.hpp"

namespace mesher {
namespace {

constexpr std::size_t kFirst = 1;

template <class Corners>
void write_row(const Corners& corners, std::int32_t reference, TextFile& file) {
  for (const std::uint32_t corner : corners) file << corner + kFirst << ' ';
  file << reference << '\n';
}

std::vector<std::int64_t> all_markers(const MeshFeatures& features) {
  std::vector<std::int64_t> all = features.markers;
  for (const MeshEdge& e : features.edges) all.push_back(e.marker);
  for (const MeshFace& f : features.faces) all.push_back(f.marker);
  return all;
}

}  // namespace

template <int D>
void write_medit(const Mesh<D>& mesh, const MeshFeatures& features, TextFile& file) {
  const GroupNumbers<double> regions(features.regions);
  const GroupNumbers<std::int64_t> markers(all_markers(features));
  file << "MeshVersionFormatted 2\n\nDimension 3\n\nVertices\n" << mesh.vertices.size() << '\n';
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const std::int64_t marker = features.markers.empty() ? 0 : features.markers[i];
    write_in_space(mesh.vertices[i], file);
    file << ' ' << markers.of(marker) << '\n';
  }
  if (!features.edges.empty()) file << "\nEdges\n" << features.edges.size() << '\n';
  for (const MeshEdge& e : features.edges) {
    write_row(std::array{e.low, e.high}, markers.of(e.marker), file);
  }
  if (!features.faces.empty()) file << "\nTriangles\n" << features.faces.size() << '\n';
  for (const MeshFace& f : features.faces) write_row(f.corners, markers.of(f.marker), file);
  file << (D == 2 ? "\nTriangles\n" : "\nTetrahedra\n") << mesh.simplices.size() << '\n';
  for (std::size_t i = 0; i < mesh.simplices.size(); ++i) {
    const double region = features.regions.empty() ? 0 : features.regions[i];
    write_row(mesh.simplices[i], regions.of(region), file);
  }
  file << "\nEnd\n";
}

template void write_medit(const Mesh<2>&, const MeshFeatures&, TextFile&);
#ifndef MESHER_PLANE_ONLY
template void write_medit(const Mesh<3>&, const MeshFeatures&, TextFile&);
#endif

}  // namespace mesher
