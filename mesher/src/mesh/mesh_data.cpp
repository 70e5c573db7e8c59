// What follows from the triangles of a mesh: its edges, and who is next to whom.
#include "mesher/mesh_data.hpp"

#include <algorithm>

namespace mesher {
namespace {

// An edge of a triangle, across from its corner `corner`.
struct Side {
  std::uint32_t low, high;
  std::uint32_t triangle, corner;
  friend auto operator<=>(const Side&, const Side&) = default;
};

std::vector<Side> sides_of(const Mesh<2>& mesh) {
  std::vector<Side> sides;
  sides.reserve(3 * mesh.simplices.size());
  for (std::uint32_t t = 0; t < mesh.simplices.size(); ++t) {
    for (std::uint32_t i = 0; i < 3; ++i) {
      const auto [low, high] =
          std::minmax({mesh.simplices[t][(i + 1) % 3], mesh.simplices[t][(i + 2) % 3]});
      sides.push_back({low, high, t, i});
    }
  }
  std::sort(sides.begin(), sides.end());
  return sides;
}

bool same_edge(const Side& a, const Side& b) { return a.low == b.low && a.high == b.high; }

}  // namespace

std::vector<std::array<std::uint32_t, 3>> neighbours(const Mesh<2>& mesh) {
  std::vector<std::array<std::uint32_t, 3>> all(mesh.simplices.size());
  for (auto& three : all) three.fill(kNoTriangle);
  const auto sides = sides_of(mesh);
  for (std::size_t i = 1; i < sides.size(); ++i) {
    const Side &a = sides[i - 1], &b = sides[i];
    if (!same_edge(a, b)) continue;
    all[a.triangle][a.corner] = b.triangle;
    all[b.triangle][b.corner] = a.triangle;
  }
  return all;
}

std::vector<std::array<std::uint32_t, 2>> edges(const Mesh<2>& mesh) {
  std::vector<std::array<std::uint32_t, 2>> all;
  for (const Side& side : sides_of(mesh)) {
    const std::array<std::uint32_t, 2> edge{side.low, side.high};
    if (all.empty() || all.back() != edge) all.push_back(edge);
  }
  return all;
}

}  // namespace mesher
