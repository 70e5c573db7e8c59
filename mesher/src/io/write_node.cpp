// Writes `.node` and `.ele` files (Triangle), numbered from 1.
#include "mesher/io.hpp"
#include "io/write_mesh.hpp"

namespace mesher {

void write_node(const Mesh<2>& mesh, TextFile& file) {
  file << mesh.vertices.size() << " 2 1 1\n";
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const auto& [x, y] = mesh.vertices[i];
    file << i + 1 << ' ' << x << ' ' << y;
    file << (mesh.kinds[i] == VertexKind::input ? " 1" : " 0");
    file << (mesh.kinds[i] == VertexKind::boundary ? " 1\n" : " 0\n");
  }
}

void write_ele(const Mesh<2>& mesh, TextFile& file) {
  file << mesh.simplices.size() << " 3 0\n";
  for (std::size_t i = 0; i < mesh.simplices.size(); ++i) {
    file << i + 1;
    for (const auto corner : mesh.simplices[i]) file << ' ' << corner + std::size_t{1};
    file << '\n';
  }
}

template <int D>
void write_points(const std::vector<Point<D>>& points, TextFile& file) {
  file << points.size() << ' ' << D << " 0 0\n";
  for (std::size_t i = 0; i < points.size(); ++i) {
    file << i + 1;
    for (const double x : points[i]) file << ' ' << x;
    file << '\n';
  }
}

template void write_points<2>(const std::vector<Point<2>>&, TextFile&);
template void write_points<3>(const std::vector<Point<3>>&, TextFile&);

}  // namespace mesher
