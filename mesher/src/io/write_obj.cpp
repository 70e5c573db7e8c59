// Writes meshes as `.obj` files (Wavefront), numbered from 1, z = 0.
#include "io/write_mesh.hpp"

namespace mesher {

void write_obj(const Mesh<2>& mesh, const MeshFeatures& features, TextFile& file) {
  constexpr std::size_t kFirst = 1;
  for (const auto& [x, y] : mesh.vertices) file << "v " << x << ' ' << y << " 0\n";
  for (const auto& [a, b, c] : mesh.simplices) {
    file << "f " << a + kFirst << ' ' << b + kFirst << ' ' << c + kFirst << '\n';
  }
  for (const MeshEdge& e : features.edges) {
    file << "l " << e.low + kFirst << ' ' << e.high + kFirst << '\n';
  }
}

}  // namespace mesher
