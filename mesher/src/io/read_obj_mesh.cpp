// Reads the triangles and lines of `.obj` files.
#include "io/obj_file.hpp"
#include "io/read_mesh.hpp"

namespace mesher {

AnyMesh read_obj_mesh(const std::string& path) {
  ObjFile obj = read_obj_file(path, CoordinateRule::finite);
  MeshData<2> mesh;
  mesh.vertices = std::move(obj.vertices);
  mesh.kinds.assign(mesh.vertices.size(), VertexKind::steiner);
  mesh.notes = std::move(obj.notes);
  for (const ObjFile::Element& element : obj.elements) {
    const FileLocation place{path, element.position.line, element.position.column};
    const auto& v = element.vertices;
    if (element.kind == 'l') {
      for (std::size_t i = 1; i < v.size(); ++i) {
        mesh.features.edges.push_back(edge_of(v[i - 1], v[i], [&] { return place; }));
      }
    } else if (element.kind == 'f') {
      if (v.size() != 3 || v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) {
        throw Error(ErrorCode::bad_mesh, "a face that does not have three different corners",
                    place);
      }
      mesh.simplices.push_back({v[0], v[1], v[2]});
    }
  }
  return mesh;
}

}  // namespace mesher
