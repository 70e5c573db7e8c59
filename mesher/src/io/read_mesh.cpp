// Reads meshes of any known format; sorts their edges and faces and drops arrays that say nothing.
#include "io/read_mesh.hpp"

#include <algorithm>
#include <utility>
#include <variant>

namespace mesher {
namespace {

using Read = AnyMesh (*)(const std::string&);

constexpr std::pair<std::string_view, Read> kReaders[] = {
    {".node", read_node_mesh}, {".ele", read_node_mesh}, {".vtu", read_vtu_mesh},
    {".vtk", read_vtk_mesh},   {".msh", read_msh},       {".mesh", read_medit},
    {".off", read_off},        {".obj", read_obj_mesh}};

Read reader_of(const std::string& path) {
  const std::string extension = text::extension(path);
  for (const auto& [known, read] : kReaders) {
    if (extension == known) return read;
  }
  throw Error(ErrorCode::unknown_format,
              "meshes are read from .node, .ele, .vtu, .vtk, .msh, .mesh, .off and .obj, not " +
                  text::quoted(extension),
              {path});
}

// Throws: Error(bad_mesh) for an edge that is given twice.
void sort_edges(std::vector<MeshEdge>& edges, const std::string& path) {
  const auto key = [](const MeshEdge& e) { return std::pair(e.low, e.high); };
  std::sort(edges.begin(), edges.end(),
            [&](const MeshEdge& a, const MeshEdge& b) { return key(a) < key(b); });
  const auto twice =
      std::adjacent_find(edges.begin(), edges.end(),
                         [&](const MeshEdge& a, const MeshEdge& b) { return key(a) == key(b); });
  if (twice == edges.end()) return;
  throw Error(ErrorCode::bad_mesh,
              "the edge of vertices " + std::to_string(twice->low + std::size_t{1}) + " and " +
                  std::to_string(twice->high + std::size_t{1}) + " (counted from 1) is given twice",
              {path});
}

// Likewise.
void sort_faces(std::vector<MeshFace>& faces, const std::string& path) {
  std::sort(faces.begin(), faces.end(),
            [](const MeshFace& a, const MeshFace& b) { return a.key() < b.key(); });
  const auto twice =
      std::adjacent_find(faces.begin(), faces.end(),
                         [](const MeshFace& a, const MeshFace& b) { return a.key() == b.key(); });
  if (twice == faces.end()) return;
  std::string names;
  for (const std::uint32_t v : twice->key()) names += ' ' + std::to_string(v + std::size_t{1});
  throw Error(ErrorCode::bad_mesh,
              "the face of vertices" + names + " (counted from 1) is given twice", {path});
}

template <class T>
void clear_if_zero(std::vector<T>& values) {
  if (std::all_of(values.begin(), values.end(), [](T v) { return v == T{}; })) values.clear();
}

// What of its kind each origin is: files have numbers alone. In space a vertex between the ends of
// a line is on an edge that names it; others of that kind are in polygons.
template <int D>
void name_origins(MeshData<D>& mesh) {
  auto& origins = mesh.features.origins;
  std::vector<bool> on_line(D == 3 ? origins.size() : 0);
  if (D == 3) {
    for (const MeshEdge& e : mesh.features.edges) {
      for (const std::uint32_t v : {e.low, e.high}) {
        if (e.line && v < origins.size() && origins[v].number == Feature(*e.line).number) {
          on_line[v] = true;
        }
      }
    }
  }
  for (std::size_t v = 0; v < origins.size(); ++v) {
    if (mesh.kinds[v] == VertexKind::input) origins[v].kind = FeatureKind::point;
    if (mesh.kinds[v] != VertexKind::segment) continue;
    origins[v].kind = D == 2 || on_line[v] ? FeatureKind::line : FeatureKind::polygon;
  }
}

template <int D>
void tidy(MeshData<D>& mesh, const std::string& path) {
  auto& features = mesh.features;
  sort_edges(features.edges, path);
  sort_faces(features.faces, path);
  clear_if_zero(features.origins);
  name_origins(mesh);
  clear_if_zero(features.markers);
  clear_if_zero(features.regions);
}

}  // namespace

AnyMesh read_any_mesh(const std::string& path) {
  AnyMesh any = reader_of(path)(path);
  std::visit([&](auto& mesh) { tidy(mesh, path); }, any);
  return any;
}

template <int D>
MeshData<D> read_mesh(const std::string& path) {
  AnyMesh any = read_any_mesh(path);
  if (auto* const mesh = std::get_if<MeshData<D>>(&any)) return std::move(*mesh);
  throw Error(ErrorCode::bad_dimension,
              "a mesh of " + std::string(kSimplicesName<5 - D>) + ", expected " + kSimplicesName<D>,
              {path});
}

template MeshData<2> read_mesh<2>(const std::string&);
#ifndef MESHER_PLANE_ONLY
template MeshData<3> read_mesh<3>(const std::string&);
#endif

void detail::fail_no_vertex(std::int64_t value, std::size_t count, std::int64_t first,
                            const FileLocation& place) {
  throw Error(ErrorCode::bad_mesh,
              "no vertex " + std::to_string(value) + ": there are " + std::to_string(count) +
                  ", from " + std::to_string(first),
              place);
}

}  // namespace mesher
