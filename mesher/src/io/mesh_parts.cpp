// The mesh of one dimension that the parts make.
#include "io/mesh_parts.hpp"

#include "io/names_read.hpp"
#include "text/text.hpp"

namespace mesher {

template <int D>
void drop_midpoints(MeshData<D>& mesh, const std::vector<bool>& is_midpoint) {
  std::vector<bool> stays(mesh.vertices.size(), true);
  for (std::size_t v = 0; v < is_midpoint.size(); ++v) stays[v] = !is_midpoint[v];
  auto& edges = mesh.features.edges;
  auto& faces = mesh.features.faces;
  for (const auto& s : mesh.simplices) {
    for (const std::uint32_t v : s) stays[v] = true;
  }
  for (const MeshEdge& e : edges) stays[e.low] = stays[e.high] = true;
  for (const MeshFace& f : faces) {
    for (const std::uint32_t v : f.corners) stays[v] = true;
  }
  std::vector<std::uint32_t> number(stays.size());
  std::uint32_t next = 0;
  for (std::size_t v = 0; v < stays.size(); ++v) number[v] = stays[v] ? next++ : 0;
  const auto thin_out = [&](auto& values) {
    if (values.empty()) return;
    for (std::size_t v = 0; v < stays.size(); ++v) {
      if (stays[v]) values[number[v]] = values[v];
    }
    values.resize(next);
  };
  thin_out(mesh.vertices);
  thin_out(mesh.kinds);
  thin_out(mesh.features.origins);
  thin_out(mesh.features.markers);
  for (auto& s : mesh.simplices) {
    for (std::uint32_t& v : s) v = number[v];
  }
  for (MeshEdge& e : edges) e.low = number[e.low], e.high = number[e.high];
  for (MeshFace& f : faces) {
    for (std::uint32_t& v : f.corners) v = number[v];
  }
}

template void drop_midpoints(MeshData<2>&, const std::vector<bool>&);
#ifndef MESHER_PLANE_ONLY
template void drop_midpoints(MeshData<3>&, const std::vector<bool>&);
#endif

template <int D>
GroupNames MeshParts::take_names() {
  GroupNames names;
  for (const auto& [dimension, number, name, place] : names_) {
    if (dimension == D) {
      mesher::add_name(names, names.regions, static_cast<double>(number), name, place, notes);
    } else if (dimension == D - 1) {
      mesher::add_name(names, names.facets, number, name, place, notes);
    } else if (dimension == 1) {
      mesher::add_name(names, names.lines, number, name, place, notes);
    }
  }
  return names;
}

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
  if (!is_midpoint_.empty()) drop_midpoints(mesh, is_midpoint_);
  mesh.features.names = take_names<D>();
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
