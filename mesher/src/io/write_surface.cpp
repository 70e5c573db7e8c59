// Writes boundaries as `.off` (numbered from 0), `.obj` (from 1) and `.stl`.
#include "io/write_surface.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "geometry/space_vectors.hpp"
#include "mesh/boundary_faces.hpp"
#include "mesher/write.hpp"

namespace mesher {
namespace {

struct Surface {
  std::vector<Point<3>> vertices;
  std::vector<std::array<std::uint32_t, 3>> faces;
};

// The faces of the boundary and the vertices on it, in their order.
Surface surface_of(const Mesh<3>& mesh) {
  Surface surface{{}, boundary_faces(mesh)};
  std::vector<std::uint32_t> number(mesh.vertices.size(), 0);
  for (const auto& face : surface.faces) {
    for (const std::uint32_t v : face) number[v] = 1;
  }
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (number[v] == 0) continue;
    number[v] = static_cast<std::uint32_t>(surface.vertices.size());
    surface.vertices.push_back(mesh.vertices[v]);
  }
  for (auto& face : surface.faces) {
    for (std::uint32_t& v : face) v = number[v];
  }
  return surface;
}

void write_place(const Point<3>& p, TextFile& file) { file << p[0] << ' ' << p[1] << ' ' << p[2]; }

// Of length 1, or 0 if rounding leaves no normal.
Point<3> normal_of(const Point<3>& a, const Point<3>& b, const Point<3>& c) {
  Point<3> n = detail::cross(detail::minus(b, a), detail::minus(c, a));
  const double length = std::sqrt(detail::dot(n, n));
  for (double& x : n) x = length > 0 ? x / length + 0.0 : 0;
  return n;
}

}  // namespace

void write_surface_off(const Mesh<3>& mesh, TextFile& file) {
  const Surface surface = surface_of(mesh);
  file << "OFF\n" << surface.vertices.size() << ' ' << surface.faces.size() << " 0\n";
  for (const Point<3>& p : surface.vertices) {
    write_place(p, file);
    file << '\n';
  }
  for (const auto& [a, b, c] : surface.faces) file << "3 " << a << ' ' << b << ' ' << c << '\n';
}

void write_surface_obj(const Mesh<3>& mesh, TextFile& file) {
  constexpr std::size_t kFirst = 1;
  const Surface surface = surface_of(mesh);
  for (const Point<3>& p : surface.vertices) {
    file << "v ";
    write_place(p, file);
    file << '\n';
  }
  for (const auto& [a, b, c] : surface.faces) {
    file << "f " << a + kFirst << ' ' << b + kFirst << ' ' << c + kFirst << '\n';
  }
}

void write_surface_stl(const Mesh<3>& mesh, TextFile& file) {
  file << "solid mesh\n";
  for (const auto& face : boundary_faces(mesh)) {
    const Point<3>&a = mesh.vertices[face[0]], &b = mesh.vertices[face[1]],
          &c = mesh.vertices[face[2]];
    file << "facet normal ";
    write_place(normal_of(a, b, c), file);
    file << "\nouter loop\n";
    for (const Point<3>* const p : {&a, &b, &c}) {
      file << "vertex ";
      write_place(*p, file);
      file << '\n';
    }
    file << "endloop\nendfacet\n";
  }
  file << "endsolid mesh\n";
}

}  // namespace mesher
