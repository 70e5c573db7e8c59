// Whether a line of the input is a union of edges: a walk from end to end.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "geometry/box.hpp"
#include "geometry/space.hpp"
#include "io/text.hpp"
#include "mesh/check_parts.hpp"

namespace mesher::detail {

/// Vertices on lines are rounded: by this much of the largest coordinate.
inline constexpr double kOnLine = 0x1p-48;

/// Twice the area of the triangle opq.
[[nodiscard]] inline double twice_area(const Point<2>& o, const Point<2>& p, const Point<2>& q) {
  return std::abs((p[0] - o[0]) * (q[1] - o[1]) - (p[1] - o[1]) * (q[0] - o[0]));
}
[[nodiscard]] inline double twice_area(const Point<3>& o, const Point<3>& p, const Point<3>& q) {
  return std::sqrt(squared(cross(minus(p, o), minus(q, o))));
}

/// How far rounding may move a vertex of the mesh off what it is on.
template <int D>
[[nodiscard]] double rounding_of(const Mesh<D>& mesh) {
  double most = 0;
  for (const Point<D>& p : mesh.vertices) {
    for (const double x : p) most = std::max(most, std::abs(x));
  }
  return kOnLine * most;
}

template <int D>
class LineWalk {
 public:
  /// `mesh` must outlive this.
  explicit LineWalk(const Mesh<D>& mesh)
      : mesh_(mesh), neighbours_(mesh.vertices.size()), tolerance_(rounding_of(mesh)) {
    for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) vertex_[mesh.vertices[v]] = v;
  }
  /// An edge of the mesh; each once.
  void add_edge(std::uint32_t a, std::uint32_t b) {
    neighbours_[a].push_back(b);
    neighbours_[b].push_back(a);
  }
  [[nodiscard]] std::optional<std::uint32_t> vertex_at(const Point<D>& p) const {
    const auto found = vertex_.find(p);
    return found == vertex_.end() ? std::optional<std::uint32_t>() : found->second;
  }

  /// Fills path.vertices on the way from path.from to path.to; the trouble, if there is any.
  /// `is_known(a, b)`: whether that edge is said to be on the line.
  template <class Path, class IsKnown>
  [[nodiscard]] std::optional<std::string> find(Path& path, IsKnown&& is_known) const {
    const auto from = vertex_at(path.from), to = vertex_at(path.to);
    for (const auto& [found, end] : {std::pair(from, path.from), std::pair(to, path.to)}) {
      if (!found) return "its end at " + text::to_text<D>(end) + " is no vertex";
    }
    path.vertices = {*from};
    while (path.vertices.back() != *to) {
      const auto next = next_on(path, *to, is_known);
      if (!next) return "no edge on it goes on from " + vertex_name(mesh_, path.vertices.back());
      path.vertices.push_back(*next);
    }
    return std::nullopt;
  }

 private:
  static double dot(const Point<D>& o, const Point<D>& p, const Point<D>& q) {
    double sum = 0;
    for (int i = 0; i < D; ++i) sum += (p[i] - o[i]) * (q[i] - o[i]);
    return sum;
  }
  [[nodiscard]] const Point<D>& at(std::uint32_t v) const { return mesh_.vertices[v]; }

  // The neighbour of the path's last vertex that is on the line and nearer to its end: one that a
  // known edge leads to, else the one most nearly straight ahead.
  template <class Path, class IsKnown>
  [[nodiscard]] std::optional<std::uint32_t> next_on(const Path& path, std::uint32_t to,
                                                     IsKnown&& is_known) const {
    const std::uint32_t here = path.vertices.back();
    std::optional<std::uint32_t> best;
    std::pair<bool, double> best_key;
    for (const std::uint32_t v : neighbours_[here]) {
      if (v != to && !is_between(path, here, v)) continue;
      const Point<D>&o = at(here), &p = at(v), &end = at(to);
      const double ahead = dot(o, p, end);
      const std::pair key(!is_known(here, v), twice_area(o, p, end) / ahead);
      if (!best || key < best_key) {
        best = v;
        best_key = key;
      }
    }
    return best;
  }

  // On the line but for rounding, behind `here` and before the end.
  template <class Path>
  [[nodiscard]] bool is_between(const Path& path, std::uint32_t here, std::uint32_t v) const {
    const double length = std::sqrt(dot(path.from, path.to, path.to));
    if (twice_area(path.from, path.to, at(v)) > tolerance_ * length) return false;
    const double along = dot(path.from, at(v), path.to);
    return along > dot(path.from, at(here), path.to) && along < length * length;
  }

  const Mesh<D>& mesh_;
  std::map<Point<D>, std::uint32_t> vertex_;
  std::vector<std::vector<std::uint32_t>> neighbours_;
  double tolerance_;
};

}  // namespace mesher::detail
