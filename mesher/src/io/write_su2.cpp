// Writes `.su2` files (SU2), numbered from 0: simplices, points, and the boundary by markers.
#include <map>
#include <string>
#include <vector>

#include "io/facet_sides.hpp"
#include "io/plain_names.hpp"
#include "io/vtk_grid.hpp"
#include "io/write_mesh.hpp"

namespace mesher {
namespace {

// SU2 numbers types of elements as VTK does.
constexpr int kSu2Line = static_cast<int>(VtkCell::line);
constexpr int kSu2Triangle = static_cast<int>(VtkCell::triangle);
constexpr int kSu2Tetrahedron = static_cast<int>(VtkCell::tetrahedron);

template <class Corners>
void write_su2_row(int type, const Corners& corners, TextFile& file) {
  file << type;
  for (const std::uint32_t v : corners) file << ' ' << v;
}

template <int D>
void write_su2_markers(const Mesh<D>& mesh, const MeshFeatures& features, TextFile& file) {
  std::map<std::int64_t, std::vector<FacetSide<D>>> by_marker;
  for (const FacetSide<D>& facet : facet_sides(mesh, features)) {
    if (facet.is_boundary) by_marker[facet.marker].push_back(facet);
  }
  PlainNames names{};
  file << "NMARK= " << by_marker.size() << '\n';
  for (const auto& [marker, facets] : by_marker) {
    file << "MARKER_TAG= " << names.make(features.names.of_facets(marker)) << '\n';
    file << "MARKER_ELEMS= " << facets.size() << '\n';
    for (const auto& facet : facets) {
      write_su2_row(D == 2 ? kSu2Line : kSu2Triangle, facet.corners, file);
      file << '\n';
    }
  }
}

}  // namespace

template <int D>
void write_su2(const Mesh<D>& mesh, const MeshFeatures& features, TextFile& file) {
  file << "NDIME= " << D << "\nNELEM= " << mesh.simplices.size() << '\n';
  for (std::size_t i = 0; i < mesh.simplices.size(); ++i) {
    write_su2_row(D == 2 ? kSu2Triangle : kSu2Tetrahedron, mesh.simplices[i], file);
    file << ' ' << i << '\n';
  }
  file << "NPOIN= " << mesh.vertices.size() << '\n';
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    for (const double x : mesh.vertices[i]) file << x << ' ';
    file << i << '\n';
  }
  write_su2_markers(mesh, features, file);
}

template void write_su2(const Mesh<2>&, const MeshFeatures&, TextFile&);
#ifndef MESHER_PLANE_ONLY
template void write_su2(const Mesh<3>&, const MeshFeatures&, TextFile&);
#endif

}  // namespace mesher
