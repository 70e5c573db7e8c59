// Boundary and segment edges with their sides.
#include <algorithm>

#include "mesh/adjacency.hpp"
#include "mesher/domain.hpp"

namespace mesher {
namespace {

bool before(const MeshEdge& a, const MeshEdge& b) {
  return std::pair(a.low, a.high) < std::pair(b.low, b.high);
}

class Sider {
 public:
  Sider(const Mesh<2>& mesh, const std::vector<MeshEdge>& walls, const Domain<2>& domain)
      : mesh_(mesh), walls_(walls), domain_(domain) {
    std::sort(walls_.begin(), walls_.end(), before);
  }

  std::vector<SidedEdge> run() {
    for (std::uint32_t t = 0; t < mesh_.simplices.size(); ++t) {
      for (int i = 0; i < 3; ++i) add(t, i);
    }
    std::sort(edges_.begin(), edges_.end(), before);
    return std::move(edges_);
  }

 private:
  [[nodiscard]] std::uint32_t side(std::uint32_t t) const {
    return t != kNoTriangle && domain_.keeps(t) ? domain_.region_of[t] : kNoRegion;
  }

  // Each edge is taken from the triangle left of it, or from the only one.
  void add(std::uint32_t t, int i) {
    const std::uint32_t from = mesh_.simplices[t][detail::next_corner(i)];
    const std::uint32_t to = mesh_.simplices[t][detail::previous_corner(i)];
    const std::uint32_t other = domain_.neighbours[t][i];
    if (from > to && other != kNoTriangle) return;
    SidedEdge edge{{std::min(from, to), std::max(from, to), {}, 0}, side(t), side(other)};
    if (from > to) std::swap(edge.left, edge.right);
    const bool boundary = (edge.left == kNoRegion) != (edge.right == kNoRegion);
    const bool wall = copy_wall(edge);
    if (boundary && edge.marker == 0) edge.marker = kBoundaryMarker;
    if (boundary || wall) edges_.push_back(edge);
  }

  // A wall is between two regions, at the boundary, or loose in one region.
  bool copy_wall(SidedEdge& edge) const {
    const auto it = std::lower_bound(walls_.begin(), walls_.end(), edge, before);
    if (it == walls_.end() || before(edge, *it)) return false;
    static_cast<MeshEdge&>(edge) = *it;
    return true;
  }

  const Mesh<2>& mesh_;
  std::vector<MeshEdge> walls_;
  const Domain<2>& domain_;
  std::vector<SidedEdge> edges_;
};

}  // namespace

std::vector<SidedEdge> sided_edges(const Mesh<2>& mesh, const std::vector<MeshEdge>& walls,
                                   const Domain<2>& domain) {
  return Sider(mesh, walls, domain).run();
}

}  // namespace mesher
