// The mesh of one dimension that the parts make.
#include "io/mesh_parts.hpp"

#include "text/text.hpp"

namespace mesher {

template <int D>
MeshData<D> MeshParts::take() {
  MeshData<D> mesh;
  mesh.vertices.reserve(vertices_.size());
  for (const Point<3>& p : vertices_) {
    std::copy_n(p.begin(), D, mesh.vertices.emplace_back().begin());
  }
  mesh.simplices = std::move(cells<D>().simplices);
  mesh.kinds = std::move(kinds);
  mesh.kinds.resize(vertices_.size(), VertexKind::steiner);
  mesh.features.origins = std::move(origins);
  mesh.features.markers = std::move(markers);
  mesh.features.regions = std::move(cells<D>().regions);
  mesh.features.edges = std::move(edges);
  if (D == 3) mesh.features.faces = std::move(faces_);
  mesh.notes = notes.notes();
  return mesh;
}

AnyMesh MeshParts::finish() {
  const bool is_empty = vertices_.empty() && triangles_.simplices.empty();
  if (tetrahedra_.simplices.empty() && !(is_in_space && is_empty)) {
    height_.require_same();
    return take<2>();
  }
  return take<3>();
}

void detail::fail_other_height(double z, double first, const FileLocation& place) {
  throw Error(
      ErrorCode::bad_dimension,
      "z is not the same everywhere: " + text::to_text(z) + ", at first " + text::to_text(first),
      place);
}

}  // namespace mesher
