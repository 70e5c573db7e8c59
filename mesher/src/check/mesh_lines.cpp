// Paths of edges, followed from one input point to the next.
#include "check/mesh_lines.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "check/forced.hpp"
#include "geometry/distance_rounding.hpp"
#include "geometry/segment_tests.hpp"

namespace mesher::detail {

namespace {

constexpr double kEqualEdges = 1e-9;  // distances that differ by no more are of equal labels

}  // namespace

MeshLines::MeshLines(const Mesh<2>& mesh)
    : mesh_(mesh),
      through_(mesh.vertices.size(), kNone),
      ending_at_(mesh.vertices.size()),
      of_edges_(mesh.edges.size(), kNone),
      edges_(2 * mesh.edges.size()),
      first_(mesh.vertices.size() + 1) {
  for (const auto& e : mesh.edges) ++first_[e.low + 1], ++first_[e.high + 1];
  for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::uint32_t e = 0; e < mesh.edges.size(); ++e) {
    edges_[next[mesh.edges[e].low]++] = e;
    edges_[next[mesh.edges[e].high]++] = e;
  }
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
    if (mesh.kinds[v] == VertexKind::segment) continue;
    for (std::uint32_t i = first_[v]; i < first_[v + 1]; ++i) {
      if (of_edges_[edges_[i]] == kNone) follow(v, edges_[i]);
    }
  }
}

// The segment that leaves an input point along an edge.
void MeshLines::follow(std::uint32_t from, std::uint32_t edge) {
  const auto segment = static_cast<std::uint32_t>(segments_.size());
  std::uint32_t at = from;
  for (;;) {
    of_edges_[edge] = segment;
    at = mesh_.edges[edge].low == at ? mesh_.edges[edge].high : mesh_.edges[edge].low;
    if (mesh_.kinds[at] != VertexKind::segment) break;
    through_[at] = segment;
    edge = edges_[first_[at]] == edge ? edges_[first_[at] + 1] : edges_[first_[at]];
  }
  segments_.push_back({from, at, LineId{mesh_.edges[edge].feature.number}, distance(from, at)});
  ending_at_[from].push_back(segment);
  ending_at_[at].push_back(segment);
}

double MeshLines::distance(std::uint32_t v, std::uint32_t w) const {
  return std::sqrt(distance2(mesh_.vertices[v], mesh_.vertices[w], mesh_.vertices[w]));
}

Point<2> MeshLines::along(std::uint32_t s, std::uint32_t apex) const {
  const MeshSegment& segment = segments_[s];
  const Point<2>& o = mesh_.vertices[apex];
  const Point<2>& e = mesh_.vertices[segment.a == apex ? segment.b : segment.a];
  return {e[0] - o[0], e[1] - o[1]};
}

double MeshLines::degrees(std::uint32_t s, std::uint32_t t, std::uint32_t apex) const {
  return degrees_between(along(s, apex), along(t, apex));
}

std::vector<MeshLines::Wedge> MeshLines::wedges_across(std::uint32_t p, std::uint32_t q,
                                                       bool any_side) const {
  std::vector<Wedge> found;
  const bool both_inside = through_[p] != kNone && through_[q] != kNone;
  for_each_leg(p, [&](std::uint32_t s, std::uint32_t apex, double from_p) {
    for_each_leg(q, [&](std::uint32_t t, std::uint32_t other, double from_q) {
      const double tolerance =
          kEqualEdges * (from_p + from_q) + distance_rounding(mesh_.vertices[apex]);
      if (s == t || apex != other || std::abs(from_p - from_q) > tolerance) return;
      const double angle = degrees(s, t, apex);
      if (angle >= kSmall) return;
      const bool left =
          predicates::orient2d(mesh_.vertices[p], mesh_.vertices[q], mesh_.vertices[apex]) > 0;
      if (any_side || both_inside || left) found.push_back({s, t, apex, angle});
    });
  });
  return found;
}

}  // namespace mesher::detail
