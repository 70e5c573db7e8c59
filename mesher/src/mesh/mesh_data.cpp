// What follows from the triangles of a mesh: its edges, and who is next to whom.
#include "mesh/sides.hpp"
#include "mesher/mesh.hpp"

namespace mesher {

detail::Joined detail::joined(const Sides& sides) {
  Joined result{std::vector<std::array<std::uint32_t, 3>>(sides.triangles())};
  for (auto& three : result.neighbours) three.fill(kNoTriangle);
  for (std::uint32_t v = 0; v < sides.vertices(); ++v) {
    const auto all = sides.at(v);
    for (std::size_t i = 1; i < all.size(); ++i) {
      const Side &a = all[i - 1], &b = all[i];
      if (a.high != b.high) continue;
      if (i > 1 && all[i - 2].high == b.high) result.in_pairs = false;
      result.neighbours[a.triangle][static_cast<std::size_t>(a.corner)] = b.triangle;
      result.neighbours[b.triangle][static_cast<std::size_t>(b.corner)] = a.triangle;
    }
  }
  return result;
}

std::vector<std::array<std::uint32_t, 3>> neighbours(const Mesh<2>& mesh) {
  return detail::joined(detail::Sides(mesh.simplices)).neighbours;
}

std::vector<std::array<std::uint32_t, 2>> edges(const Mesh<2>& mesh) {
  const detail::Sides sides(mesh.simplices);
  std::vector<std::array<std::uint32_t, 2>> all;
  for (std::uint32_t low = 0; low < sides.vertices(); ++low) {
    for (const detail::Side& side : sides.at(low)) {
      const std::array<std::uint32_t, 2> edge{low, side.high};
      if (all.empty() || all.back() != edge) all.push_back(edge);
    }
  }
  return all;
}

}  // namespace mesher
