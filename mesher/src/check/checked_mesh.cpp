// Half-edges by edge, and names of parts.
#include "check/checked_mesh.hpp"

#include "check/check_parts.hpp"
#include "geometry/box.hpp"
#include "mesher/predicates.hpp"

namespace mesher::detail {

CheckedMesh::CheckedMesh(const Mesh<2>& mesh) : mesh_(mesh) {
  half_edges_.reserve(3 * mesh_.simplices.size());
  for (std::size_t i = 0; i < mesh_.simplices.size(); ++i) {
    const auto& [a, b, c] = mesh_.simplices[i];
    half_edges_.insert(half_edges_.end(), {{a, b, c, i}, {b, c, a, i}, {c, a, b, i}});
  }
  std::sort(half_edges_.begin(), half_edges_.end(),
            [](const HalfEdge& a, const HalfEdge& b) { return a.edge() < b.edge(); });
}

std::size_t CheckedMesh::partners(std::size_t i) const {
  std::size_t end = i + 1;
  while (end < half_edges_.size() && half_edges_[i].edge() == half_edges_[end].edge()) ++end;
  return end - i;
}

bool CheckedMesh::has_edge(std::uint32_t low, std::uint32_t high) const {
  const std::pair edge(low, high);
  const auto found =
      std::lower_bound(half_edges_.begin(), half_edges_.end(), edge,
                       [](const HalfEdge& e, const auto& key) { return e.edge() < key; });
  return found != half_edges_.end() && found->edge() == edge;
}

std::vector<HalfEdge> CheckedMesh::border() const {
  std::vector<HalfEdge> border;
  for (std::size_t i = 0; i < half_edges_.size(); i += partners(i)) {
    if (partners(i) == 1) border.push_back(half_edges_[i]);
  }
  return border;
}

Box<2> CheckedMesh::bounding_box() const { return detail::bounding_box<2>(mesh_.vertices); }

std::optional<std::size_t> CheckedMesh::triangle_at(const Point<2>& p) const {
  for (std::size_t i = 0; i < mesh_.simplices.size(); ++i) {
    const auto& [a, b, c] = mesh_.simplices[i];
    const auto left = [&](std::uint32_t u, std::uint32_t v) {
      return predicates::orient2d(at(u), at(v), p) >= 0;
    };
    if (left(a, b) && left(b, c) && left(c, a)) return i;
  }
  return std::nullopt;
}

std::string CheckedMesh::vertex(std::size_t v) const { return vertex_name(mesh_, v); }

std::string CheckedMesh::edge(std::uint32_t from, std::uint32_t to) const {
  return "the edge from " + vertex(from) + " to " + vertex(to);
}

std::string CheckedMesh::edge(const HalfEdge& e) const { return edge(e.from, e.to); }

std::string CheckedMesh::triangle(std::size_t i) const { return simplex_name(mesh_, i); }

}  // namespace mesher::detail
