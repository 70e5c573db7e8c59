// Writes `.node`, `.ele`, `.edge`, `.poly` and `.neigh` files (Triangle), and `.face` (TetGen),
// numbered from 1.
#include <algorithm>

#include "io/write_mesh.hpp"
#include "mesh/boundary_faces.hpp"
#include "mesher/read.hpp"
#include "mesher/write.hpp"
#include "text/digits.hpp"

namespace mesher {
namespace {

constexpr std::uint32_t kFirst = 1;

// Kind, origin and marker: what read_mesh gives back.
template <int D>
void write_vertex_features(const Mesh<D>& mesh, const MeshFeatures& features, std::size_t i,
                           TextFile& file) {
  const bool has_origins = !features.origins.empty(), has_markers = !features.markers.empty();
  file << ' ' << static_cast<int>(mesh.kinds[i]);
  file << ' ' << (has_origins ? features.origins[i].number : 0);
  file << ' ' << (has_markers ? features.markers[i] : 0) << '\n';
}

void write_kind(VertexKind kind, TextFile& file) {
  file << (kind == VertexKind::input ? " 1" : " 0");
  file << (kind == VertexKind::boundary ? " 1\n" : " 0\n");
}

// Vertices, each after a blank.
template <std::size_t N>
void add_corners(const std::array<std::uint32_t, N>& corners, TextFile& file) {
  constexpr std::size_t kMostDigits = 10;
  file.add_up_to(N * (1 + kMostDigits), [&](char* at) {
    for (const std::uint32_t v : corners) {
      *at++ = ' ';
      at = detail::put_number(at, v + kFirst);
    }
    return at;
  });
}

// Of second order in the order of Triangle (each midpoint across from a corner) and of TetGen (the
// midpoints of cd, ad, ab, bc, bd, ca). Ours are those of ab, bc, ca, ad, bd, cd.
void add_ordered(const std::array<std::uint32_t, 6>& n, TextFile& file) {
  add_corners(std::array{n[0], n[1], n[2], n[4], n[5], n[3]}, file);
}
[[maybe_unused]] void add_ordered(const std::array<std::uint32_t, 10>& n, TextFile& file) {
  add_corners(std::array{n[0], n[1], n[2], n[3], n[9], n[7], n[4], n[5], n[8], n[6]}, file);
}
template <std::size_t N>
void add_ordered(const std::array<std::uint32_t, N>& nodes, TextFile& file) {
  add_corners(nodes, file);
}

template <int D, class Part>
void add_nodes(const Part& part, const WriteHow<D>& how, TextFile& file) {
  visit_nodes<D>(part, how, [&](const auto& nodes) { add_ordered(nodes, file); });
}

}  // namespace

template <int D>
void write_node(const Mesh<D>& mesh, const MeshFeatures& features, TextFile& file) {
  const bool plain = features.origins.empty() && features.markers.empty();
  file << mesh.vertices.size() << ' ' << D << (plain ? " 1 1\n" : " 2 1\n");
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    file << i + kFirst;
    for (const double x : mesh.vertices[i]) file << ' ' << x;
    plain ? write_kind(mesh.kinds[i], file) : write_vertex_features(mesh, features, i, file);
  }
}

template void write_node(const Mesh<2>&, const MeshFeatures&, TextFile&);
#ifndef MESHER_PLANE_ONLY
template void write_node(const Mesh<3>&, const MeshFeatures&, TextFile&);
#endif

template <int D>
void write_ele(const Mesh<D>& mesh, const MeshFeatures& features, const WriteHow<D>& how,
               TextFile& file) {
  const bool has_regions = !features.regions.empty();
  const std::size_t nodes = how.second == nullptr ? D + 1 : SecondOrder<D>::kCellNodes;
  file << mesh.simplices.size() << ' ' << nodes << (has_regions ? " 1\n" : " 0\n");
  for (std::size_t i = 0; i < mesh.simplices.size(); ++i) {
    file << i + kFirst;
    add_nodes<D>(mesh.simplices[i], how, file);
    if (has_regions) file << ' ' << features.regions[i];
    file << '\n';
  }
}

template void write_ele(const Mesh<2>&, const MeshFeatures&, const WriteHow<2>&, TextFile&);
#ifndef MESHER_PLANE_ONLY
template void write_ele(const Mesh<3>&, const MeshFeatures&, const WriteHow<3>&, TextFile&);
#endif

#ifndef MESHER_PLANE_ONLY
void write_face(const Mesh<3>& mesh, const MeshFeatures& features, const WriteHow<3>& how,
                TextFile& file) {
  std::vector<MeshFace> faces = features.faces;
  if (features.empty()) {
    for (const auto& corners : boundary_faces(mesh)) faces.push_back({corners, {}, 1});
  }
  file << faces.size() << " 1\n";
  for (std::size_t i = 0; i < faces.size(); ++i) {
    file << i + kFirst;
    add_nodes<3>(faces[i], how, file);
    file << ' ' << faces[i].marker;
    if (faces[i].polygon) file << ' ' << static_cast<std::int64_t>(*faces[i].polygon);
    file << '\n';
  }
}

void write_edge(const MeshFeatures& features, const WriteHow<3>& how, TextFile& file) {
  file << features.edges.size() << " 1\n";
  std::size_t number = kFirst;
  for (const MeshEdge& e : features.edges) {
    file << number++;
    add_nodes<3>(e, how, file);
    file << ' ' << e.marker;
    if (e.line) file << ' ' << static_cast<std::int64_t>(*e.line);
    file << '\n';
  }
}
#endif

void write_edge(const Mesh<2>& mesh, const MeshFeatures& features, TextFile& file) {
  const auto all = edges(mesh);
  auto known = features.edges.begin();
  file << all.size() << " 1\n";
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::uint32_t low = all[i][0];
    const std::uint32_t high = all[i][1];
    file << i + kFirst << ' ' << low + kFirst << ' ' << high + kFirst;
    const auto is_before = [&](const MeshEdge& e) {
      return e.low < low || (e.low == low && e.high < high);
    };
    while (known != features.edges.end() && is_before(*known)) ++known;
    const bool found = known != features.edges.end() && known->low == low && known->high == high;
    file << ' ' << (found ? known->marker : 0);
    if (found && known->line) file << ' ' << static_cast<std::int64_t>(*known->line);
    file << '\n';
  }
}

void write_poly(const MeshFeatures& features, TextFile& file) {
  file << "0 2 0 1\n" << features.edges.size() << " 1\n";
  std::size_t number = kFirst;
  for (const MeshEdge& e : features.edges) {
    file << number++ << ' ' << e.low + kFirst << ' ' << e.high + kFirst << ' ' << e.marker << '\n';
  }
  file << "0\n";
}

void write_neigh(const Mesh<2>& mesh, TextFile& file) {
  const auto all = neighbours(mesh);
  file << all.size() << " 3\n";
  for (std::size_t i = 0; i < all.size(); ++i) {
    file << i + kFirst;
    for (const auto t : all[i]) {
      file << ' ' << (t == kNoTriangle ? -1 : static_cast<std::int64_t>(t + kFirst));
    }
    file << '\n';
  }
}

template <int D>
void write_points(const std::vector<Point<D>>& points, TextFile& file) {
  file << points.size() << ' ' << D << " 0 0\n";
  for (std::size_t i = 0; i < points.size(); ++i) {
    file << i + kFirst;
    for (const double x : points[i]) file << ' ' << x;
    file << '\n';
  }
}

template void write_points<2>(const std::vector<Point<2>>&, TextFile&);
#ifndef MESHER_PLANE_ONLY
template void write_points<3>(const std::vector<Point<3>>&, TextFile&);
#endif

}  // namespace mesher
