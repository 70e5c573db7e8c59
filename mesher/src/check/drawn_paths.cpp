// The lines that a mesh itself tells of: edges on lines, joined where they go straight on.
#include <cmath>

#include "check/checked_mesh.hpp"
#include "geometry/distance_rounding.hpp"

namespace mesher::detail {
namespace {

constexpr double kStraight = 1e-6;  // sine of what may be rounding in a file

class Drawing {
 public:
  Drawing(const CheckedMesh<2>& mesh, const std::vector<MeshEdge>& edges)
      : mesh_(mesh), edges_(edges), at_(mesh.mesh().vertices.size()), used_(edges.size()) {
    for (std::size_t e = 0; e < edges.size(); ++e) {
      at_[edges[e].low].push_back(e);
      at_[edges[e].high].push_back(e);
    }
  }

  // What goes straight on has two ends.
  std::vector<LinePath> paths() {
    std::vector<LinePath> all;
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      for (const std::uint32_t v : {edges_[e].low, edges_[e].high}) {
        if (!used_[e] && !goes_on_at(v)) all.push_back(follow(v, e));
      }
    }
    return all;
  }

 private:
  [[nodiscard]] std::uint32_t other(std::size_t e, std::uint32_t v) const {
    return edges_[e].low == v ? edges_[e].high : edges_[e].low;
  }

  [[nodiscard]] bool goes_on_at(std::uint32_t v) const {
    if (at_[v].size() != 2 || edges_[at_[v][0]].line != edges_[at_[v][1]].line) return false;
    const Point<2>&o = mesh_.at(v), &p = mesh_.at(other(at_[v][0], v)),
          &q = mesh_.at(other(at_[v][1], v));
    const double ux = p[0] - o[0], uy = p[1] - o[1], wx = q[0] - o[0], wy = q[1] - o[1];
    const double dot = ux * wx + uy * wy;
    const double rounding = distance_rounding(o) * (std::hypot(ux, uy) + std::hypot(wx, wy));
    return dot < 0 && std::abs(ux * wy - uy * wx) <= rounding - kStraight * dot;
  }

  LinePath follow(std::uint32_t from, std::size_t e) {
    LinePath path{edges_[e].line.value_or(LineId{}), mesh_.at(from), {}, {from}};
    for (std::uint32_t v = from;;) {
      used_[e] = true;
      v = other(e, v);
      path.vertices.push_back(v);
      path.to = mesh_.at(v);
      if (!goes_on_at(v)) return path;
      e = at_[v][0] == e ? at_[v][1] : at_[v][0];
    }
  }

  const CheckedMesh<2>& mesh_;
  const std::vector<MeshEdge>& edges_;
  std::vector<std::vector<std::size_t>> at_;  // the edges at each vertex
  std::vector<bool> used_;
};

}  // namespace

std::vector<LinePath> drawn_paths(const CheckedMesh<2>& mesh, const std::vector<MeshEdge>& edges) {
  return Drawing(mesh, edges).paths();
}

}  // namespace mesher::detail
