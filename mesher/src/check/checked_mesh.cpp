// Half-edges by edge, and where places are.
#include "check/checked_mesh.hpp"

#include "mesh/locate.hpp"
#include "text/id_text.hpp"
#include "text/text.hpp"

namespace mesher::detail {

HalfEdges::HalfEdges(const std::vector<Mesh<2>::Simplex>& triangles) {
  all_.reserve(3 * triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const auto& [a, b, c] = triangles[i];
    all_.insert(all_.end(), {{a, b, c, i}, {b, c, a, i}, {c, a, b, i}});
  }
  std::sort(all_.begin(), all_.end(),
            [](const HalfEdge& a, const HalfEdge& b) { return a.edge() < b.edge(); });
}

std::size_t HalfEdges::partners(std::size_t i) const {
  std::size_t end = i + 1;
  while (end < all_.size() && all_[i].edge() == all_[end].edge()) ++end;
  return end - i;
}

bool HalfEdges::has_edge(std::uint32_t low, std::uint32_t high) const {
  const std::pair edge(low, high);
  const auto found =
      std::lower_bound(all_.begin(), all_.end(), edge,
                       [](const HalfEdge& e, const auto& key) { return e.edge() < key; });
  return found != all_.end() && found->edge() == edge;
}

std::vector<HalfEdge> HalfEdges::border() const {
  std::vector<HalfEdge> border;
  for (std::size_t i = 0, n = 0; i < all_.size(); i += n) {
    n = partners(i);
    if (n == 1) border.push_back(all_[i]);
  }
  return border;
}

template <int D>
std::optional<std::size_t> CheckedMesh<D>::simplex_at(const Point<D>& p) const {
  for (std::size_t i = 0; i < mesh_.simplices.size(); ++i) {
    const auto corners = places_of(mesh_.simplices[i]);
    if (D == 3 && !contains(detail::bounding_box<D>(corners), p)) continue;  // signs cost more
    if (sides_at<D + 1>(corners, p)) return i;
  }
  return std::nullopt;
}

template <int D>
BoundaryRule rule_of(const CheckedMesh<D>& mesh, const Graph<D>& graph) {
  const Box<D> box = mesh.bounding_box();
  const auto border = mesh.sides().border();
  const bool fills = std::all_of(border.begin(), border.end(), [&](const HalfSide<D>& side) {
    return is_on_side<D>(box, mesh.places_of(corners_of(side)));
  });
  return fills && !has_corners<D>(box, graph.points) ? BoundaryRule::box : BoundaryRule::lines;
}

namespace {

// "input point 7 at (0, 1) (line 8)"
template <int D>
std::string input_name(const GraphFile<D>& file, std::size_t i) {
  const GraphPoint<D>& point = file.graph.points[i];
  const long line = i < file.points.size() ? file.points[i].line : 0;
  return "input point " + id_text(point.id) + " at " + text::to_text<D>(point.at) +
         (line > 0 ? " (line " + std::to_string(line) + ")" : "");
}

}  // namespace

template <int D>
Verdict check_input(const CheckedMesh<D>& mesh, const CheckOptions<D>& options) {
  const auto& points = options.graph->graph.points;
  std::vector<Point<D>> sorted = mesh.mesh().vertices;
  std::sort(sorted.begin(), sorted.end());
  std::size_t outside = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point<D>& p = points[i].at;
    if (std::binary_search(sorted.begin(), sorted.end(), p)) continue;
    if (!may_leave_out(options) || mesh.simplex_at(p)) {
      return Verdict::bad(input_name(*options.graph, i) + " is no vertex");
    }
    ++outside;
  }
  return Verdict::good(std::to_string(points.size() - outside) + " points are vertices" +
                       (outside > 0 ? ", " + std::to_string(outside) + " are outside" : ""));
}

template class CheckedMesh<2>;
template BoundaryRule rule_of(const CheckedMesh<2>&, const Graph<2>&);
template Verdict check_input(const CheckedMesh<2>&, const CheckOptions<2>&);
#ifndef MESHER_PLANE_ONLY
template class CheckedMesh<3>;
template BoundaryRule rule_of(const CheckedMesh<3>&, const Graph<3>&);
template Verdict check_input(const CheckedMesh<3>&, const CheckOptions<3>&);
#endif

}  // namespace mesher::detail
