// Boundary and segment edges with their sides, and the kept part as a mesh of its own.
#include <algorithm>

#include "domain/adjacency.hpp"
#include "mesher/domain.hpp"

namespace mesher {
namespace {

bool before(const MeshEdge& a, const MeshEdge& b) {
  return std::pair(a.low, a.high) < std::pair(b.low, b.high);
}

class Sider {
 public:
  Sider(const Mesh<2>& mesh, const std::vector<MeshEdge>& walls, const Domain& domain)
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
  const Domain& domain_;
  std::vector<SidedEdge> edges_;
};

class Extractor {
 public:
  Extractor(const MeshData& whole, const Domain& domain) : whole_(whole), domain_(domain) {}

  Extract run() {
    choose();
    copy_vertices();
    copy_triangles();
    copy_attributes();
    copy_edges();
    return std::move(part_);
  }

 private:
  void choose() {
    new_vertex_.assign(whole_.vertices.size(), kAbsent);
    new_triangle_.assign(whole_.simplices.size(), kNoTriangle);
    for (std::uint32_t t = 0; t < whole_.simplices.size(); ++t) {
      if (!domain_.keeps(t)) continue;
      new_triangle_[t] = static_cast<std::uint32_t>(part_.triangles.size());
      part_.triangles.push_back(t);
      for (const std::uint32_t v : whole_.simplices[t]) new_vertex_[v] = 0;
    }
    for (std::uint32_t v = 0; v < whole_.vertices.size(); ++v) {
      if (new_vertex_[v] == kAbsent) continue;
      new_vertex_[v] = static_cast<std::uint32_t>(part_.vertices.size());
      part_.vertices.push_back(v);
    }
  }

  void copy_vertices() {
    auto& features = part_.mesh.features;
    const auto& from = whole_.features;
    for (const std::uint32_t v : part_.vertices) {
      part_.mesh.vertices.push_back(whole_.vertices[v]);
      if (!whole_.kinds.empty()) part_.mesh.kinds.push_back(whole_.kinds[v]);
      if (!from.origins.empty()) features.origins.push_back(from.origins[v]);
      features.markers.push_back(from.markers.empty() ? 0 : from.markers[v]);
    }
  }

  void copy_triangles() {
    for (const std::uint32_t t : part_.triangles) {
      auto corners = whole_.simplices[t];
      for (std::uint32_t& v : corners) v = new_vertex_[v];
      part_.mesh.simplices.push_back(corners);
      auto neighbours = domain_.neighbours[t];
      for (std::uint32_t& n : neighbours) n = n == kNoTriangle ? n : new_triangle_[n];
      part_.neighbours.push_back(neighbours);
    }
  }

  void copy_attributes() {
    const bool any =
        std::any_of(domain_.regions.begin(), domain_.regions.end(), [&](const Region& region) {
          return domain_.keeps(region) && region.label.seed && region.label.zone != Zone::hole;
        });
    if (!any) return;
    for (const std::uint32_t t : part_.triangles) {
      part_.mesh.features.regions.push_back(domain_.regions[domain_.region_of[t]].attribute);
    }
  }

  void copy_edges() {
    mark_lines();
    auto& features = part_.mesh.features;
    for (const SidedEdge& edge : sided_edges(whole_, whole_.features.edges, domain_)) {
      if (edge.left == kNoRegion && edge.right == kNoRegion) continue;
      MeshEdge kept = edge;
      kept.low = new_vertex_[kept.low];
      kept.high = new_vertex_[kept.high];
      features.edges.push_back(kept);
      if (edge.left != kNoRegion && edge.right != kNoRegion) continue;
      for (const std::uint32_t v : {kept.low, kept.high}) {
        if (features.markers[v] == 0) features.markers[v] = kBoundaryMarker;
      }
    }
  }

  // Vertices without a marker get the least of the segments that they are on.
  void mark_lines() {
    auto& markers = part_.mesh.features.markers;
    std::vector<std::int64_t> least(markers.size(), 0);
    for (const MeshEdge& edge : whole_.features.edges) {
      if (edge.marker == 0) continue;
      for (const std::uint32_t v : {new_vertex_[edge.low], new_vertex_[edge.high]}) {
        if (v == kAbsent) continue;
        if (least[v] == 0 || edge.marker < least[v]) least[v] = edge.marker;
      }
    }
    for (std::size_t v = 0; v < markers.size(); ++v) {
      if (markers[v] == 0) markers[v] = least[v];
    }
  }

  static constexpr std::uint32_t kAbsent = UINT32_MAX;
  const MeshData& whole_;
  const Domain& domain_;
  Extract part_;
  std::vector<std::uint32_t> new_vertex_, new_triangle_;
};

}  // namespace

std::vector<SidedEdge> sided_edges(const Mesh<2>& mesh, const std::vector<MeshEdge>& walls,
                                   const Domain& domain) {
  return Sider(mesh, walls, domain).run();
}

Extract extract(const MeshData& whole, const Domain& domain) {
  return Extractor(whole, domain).run();
}

}  // namespace mesher
