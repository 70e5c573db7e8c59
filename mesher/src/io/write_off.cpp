// Writes `.off` files (Geomview), numbered from 0, z = 0.
#include "io/write_mesh.hpp"

namespace mesher {

void write_off(const Mesh<2>& mesh, TextFile& file) {
  file << "OFF\n" << mesh.vertices.size() << ' ' << mesh.simplices.size() << " 0\n";
  for (const auto& [x, y] : mesh.vertices) file << x << ' ' << y << " 0\n";
  for (const auto& [a, b, c] : mesh.simplices) file << "3 " << a << ' ' << b << ' ' << c << '\n';
}

}  // namespace mesher
