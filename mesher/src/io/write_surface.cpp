// Writes boundaries as `.off` (numbered from 0), `.obj` (from 1) and `.stl`.
#include "io/write_surface.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "geometry/space_vectors.hpp"
#include "mesh/boundary_faces.hpp"
#include "mesher/domain.hpp"
#include "mesher/write.hpp"

namespace mesher {
namespace {

using Faces = std::vector<std::array<std::uint32_t, 3>>;

struct Surface {
  std::vector<Point<3>> vertices;
  Faces faces;
};

// These faces of the boundary and the vertices on it, in their order.
Surface surface_of(const Mesh<3>& mesh, Faces faces) {
  Surface surface{{}, std::move(faces)};
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

// The boundary, one group after the other: its name, and where it ends. If no marker has a name,
// all of it is one group without a name.
struct GroupedFaces {
  Faces faces;
  std::vector<std::pair<std::string, std::size_t>> groups;
};

GroupedFaces grouped_boundary(const Mesh<3>& mesh, const MeshFeatures& features) {
  Faces all = boundary_faces(mesh);
  if (features.names.facets.empty() || all.empty()) {
    const std::size_t count = all.size();
    return {std::move(all), {{"", count}}};
  }
  std::map<std::array<std::uint32_t, 3>, std::int64_t> markers;
  for (const MeshFace& face : features.faces) markers[face.key()] = face.marker;
  std::map<std::int64_t, Faces> by_marker;
  for (const auto& face : all) {
    const auto found = markers.find(MeshFace{face}.key());
    by_marker[found == markers.end() ? kBoundaryMarker : found->second].push_back(face);
  }
  GroupedFaces grouped;
  for (const auto& [marker, faces] : by_marker) {
    grouped.faces.insert(grouped.faces.end(), faces.begin(), faces.end());
    grouped.groups.emplace_back(features.names.of_facets(marker), grouped.faces.size());
  }
  return grouped;
}

void write_place(const Point<3>& p, TextFile& file) { file << p[0] << ' ' << p[1] << ' ' << p[2]; }

// Of length 1, or 0 if rounding leaves no normal.
Point<3> normal_of(const Point<3>& a, const Point<3>& b, const Point<3>& c) {
  Point<3> n = detail::cross(detail::minus(b, a), detail::minus(c, a));
  const double length = std::sqrt(detail::dot(n, n));
  for (double& x : n) x = length > 0 ? x / length + 0.0 : 0;
  return n;
}

void write_facet(const Mesh<3>& mesh, const std::array<std::uint32_t, 3>& face, TextFile& file) {
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

}  // namespace

void write_surface_off(const Mesh<3>& mesh, TextFile& file) {
  const Surface surface = surface_of(mesh, boundary_faces(mesh));
  file << "OFF\n" << surface.vertices.size() << ' ' << surface.faces.size() << " 0\n";
  for (const Point<3>& p : surface.vertices) {
    write_place(p, file);
    file << '\n';
  }
  for (const auto& [a, b, c] : surface.faces) file << "3 " << a << ' ' << b << ' ' << c << '\n';
}

void write_surface_obj(const Mesh<3>& mesh, const MeshFeatures& features, TextFile& file) {
  constexpr std::size_t kFirst = 1;
  GroupedFaces boundary = grouped_boundary(mesh, features);
  const Surface surface = surface_of(mesh, std::move(boundary.faces));
  for (const Point<3>& p : surface.vertices) {
    file << "v ";
    write_place(p, file);
    file << '\n';
  }
  std::size_t i = 0;
  for (const auto& [name, end] : boundary.groups) {
    if (!name.empty()) file << "g " << name << '\n';
    for (; i < end; ++i) {
      const auto& [a, b, c] = surface.faces[i];
      file << "f " << a + kFirst << ' ' << b + kFirst << ' ' << c + kFirst << '\n';
    }
  }
}

void write_surface_stl(const Mesh<3>& mesh, const MeshFeatures& features, TextFile& file) {
  const GroupedFaces boundary = grouped_boundary(mesh, features);
  std::size_t i = 0;
  for (const auto& [name, end] : boundary.groups) {
    const std::string solid = name.empty() ? "mesh" : name;
    file << "solid " << solid << '\n';
    for (; i < end; ++i) write_facet(mesh, boundary.faces[i], file);
    file << "endsolid " << solid << '\n';
  }
}

}  // namespace mesher
