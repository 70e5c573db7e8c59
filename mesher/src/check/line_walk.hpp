// Whether a line of the input is a union of edges: a walk from end to end, but where the line is
// outside of the mesh.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "check/check_parts.hpp"
#include "check/checked_mesh.hpp"
#include "geometry/box.hpp"
#include "geometry/space_vectors.hpp"
#include "mesher/predicates.hpp"
#include "text/text.hpp"

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

/// Whether the way from p to q goes through a side of the boundary.
[[nodiscard]] inline bool goes_through(const Point<2>& p, const Point<2>& q,
                                       const std::array<Point<2>, 2>& side) {
  const auto& [a, b] = side;
  return predicates::orient2d(p, q, a) * predicates::orient2d(p, q, b) < 0 &&
         predicates::orient2d(a, b, p) * predicates::orient2d(a, b, q) < 0;
}
[[nodiscard]] inline bool goes_through(const Point<3>& p, const Point<3>& q,
                                       const std::array<Point<3>, 3>& side) {
  const auto& [a, b, c] = side;
  if (predicates::orient3d(a, b, c, p) * predicates::orient3d(a, b, c, q) >= 0) return false;
  const auto [least, most] =
      std::minmax({predicates::orient3d(p, q, a, b), predicates::orient3d(p, q, b, c),
                   predicates::orient3d(p, q, c, a)});
  return least >= 0 || most <= 0;
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

  /// What of a line is in the mesh: `runs` of vertices that edges join, one after the other, and
  /// the vertices on it that are `alone`, with what is beside them outside; and the trouble, if
  /// there is any.
  struct Way {
    std::vector<std::vector<std::uint32_t>> runs;
    std::vector<std::uint32_t> alone;
    bool is_whole = false;  // one run from end to end
    std::optional<std::string> trouble;
  };
  /// `is_known(a, b)`: whether that edge is said to be on the line. `is_outside(p, q)`: whether all
  /// between these places is outside of the mesh, and may be.
  template <class IsKnown, class IsOutside>
  [[nodiscard]] Way find(const Point<D>& from, const Point<D>& to, IsKnown&& is_known,
                         IsOutside&& is_outside) const {
    Way way;
    const Line line{from, to, vertex_at(to)};
    std::optional<std::uint32_t> here = vertex_at(from);
    for (;;) {
      std::optional<std::uint32_t> next;
      if (here) {
        std::vector<std::uint32_t> run{*here};
        while (run.back() != line.last && (next = next_on(line, run.back(), is_known))) {
          run.push_back(*next);
        }
        here = run.back();
        if (run.size() > 1) {
          way.runs.push_back(std::move(run));
        } else {
          way.alone.push_back(*here);
        }
        if (here == line.last) break;
      }
      next = next_beyond(line, here);
      if (!is_outside(here ? at(*here) : from, next ? at(*next) : to)) {
        way.trouble = trouble_between(line, here, next);
        return way;
      }
      if (!next) return way;
      here = next;
    }
    way.is_whole = way.runs.size() == 1 && at(way.runs[0][0]) == from;
    return way;
  }

 private:
  static double dot(const Point<D>& o, const Point<D>& p, const Point<D>& q) {
    double sum = 0;
    for (int i = 0; i < D; ++i) sum += (p[i] - o[i]) * (q[i] - o[i]);
    return sum;
  }
  [[nodiscard]] const Point<D>& at(std::uint32_t v) const { return mesh_.vertices[v]; }

  struct Line {
    Point<D> from, to;
    std::optional<std::uint32_t> last;  // at its end
  };

  // The neighbour of `here` that is on the line and nearer to its end: one that a known edge leads
  // to, else the one most nearly straight ahead.
  template <class IsKnown>
  [[nodiscard]] std::optional<std::uint32_t> next_on(const Line& line, std::uint32_t here,
                                                     IsKnown&& is_known) const {
    std::optional<std::uint32_t> best;
    std::pair<bool, double> best_key;
    for (const std::uint32_t v : neighbours_[here]) {
      if (v != line.last && !is_between(line, at(here), v)) continue;
      const Point<D>&o = at(here), &p = at(v);
      const double ahead = dot(o, p, line.to);
      const std::pair key(!is_known(here, v), twice_area(o, p, line.to) / ahead);
      if (!best || key < best_key) {
        best = v;
        best_key = key;
      }
    }
    return best;
  }

  // The first vertex on the line behind `here`, or behind its beginning. Cost: O(n).
  [[nodiscard]] std::optional<std::uint32_t> next_beyond(const Line& line,
                                                         std::optional<std::uint32_t> here) const {
    const Point<D>& o = here ? at(*here) : line.from;
    std::optional<std::uint32_t> first = line.last;
    for (std::uint32_t v = 0; v < mesh_.vertices.size(); ++v) {
      if (v == here || !is_between(line, o, v)) continue;
      if (!first || dot(o, at(v), line.to) < dot(o, at(*first), line.to)) first = v;
    }
    return first;
  }

  [[nodiscard]] std::string trouble_between(const Line& line, std::optional<std::uint32_t> here,
                                            std::optional<std::uint32_t> next) const {
    if (here && next) return "no edge on it goes on from " + vertex_name(mesh_, *here);
    return "its end at " + text::to_text<D>(here ? line.to : line.from) + " is no vertex";
  }

  // On the line but for rounding, behind `here` and before the end.
  [[nodiscard]] bool is_between(const Line& line, const Point<D>& here, std::uint32_t v) const {
    const double length = std::sqrt(dot(line.from, line.to, line.to));
    if (twice_area(line.from, line.to, at(v)) > tolerance_ * length) return false;
    const double along = dot(line.from, at(v), line.to);
    return along > dot(line.from, here, line.to) && along < length * length;
  }

  const Mesh<D>& mesh_;
  std::map<Point<D>, std::uint32_t> vertex_;
  std::vector<std::vector<std::uint32_t>> neighbours_;
  double tolerance_;
};

/// Whether all between two places is outside of the mesh, and may be. In the plane, of a boundary
/// that is not judged, no piece between two vertices may be lost.
template <int D>
class Outside {
 public:
  /// Both must outlive this.
  Outside(const CheckedMesh<D>& mesh, const LineWalk<D>& walk, BoundaryRule rule)
      : mesh_(mesh), walk_(walk), rule_(rule), border_(mesh.sides().border()) {}

  [[nodiscard]] bool operator()(const Point<D>& p, const Point<D>& q) const {
    if (rule_ == BoundaryRule::box) return false;
    if (D == 2 && rule_ == BoundaryRule::any && walk_.vertex_at(p) && walk_.vertex_at(q)) {
      return false;
    }
    Point<D> middle;
    for (int i = 0; i < D; ++i) middle[i] = p[i] / 2 + q[i] / 2;
    if (mesh_.simplex_at(middle)) return false;
    return std::none_of(border_.begin(), border_.end(), [&](const HalfSide<D>& side) {
      return goes_through(p, q, mesh_.places_of(corners_of(side)));
    });
  }

 private:
  const CheckedMesh<D>& mesh_;
  const LineWalk<D>& walk_;
  BoundaryRule rule_;
  std::vector<HalfSide<D>> border_;
};

/// What is said of all lines together.
template <int D>
class WalkedLines {
 public:
  void add(const std::string& name, const Point<D>& from, const Point<D>& to,
           const typename LineWalk<D>::Way& way) {
    if (way.trouble && !trouble_) {
      trouble_ = name + " from " + text::to_text<D>(from) + " to " + text::to_text<D>(to) + ": " +
                 *way.trouble;
    }
    (way.runs.empty() ? outside_ : there_) += 1;
    in_part_ += way.runs.empty() || way.is_whole ? 0 : 1;
    for (const auto& run : way.runs) edges_ += run.size() - 1;
  }
  /// `what`: the lines are.
  [[nodiscard]] Verdict verdict(const std::string& what) const {
    if (trouble_) return Verdict::bad(*trouble_);
    return Verdict::good(std::to_string(there_) + ' ' + what + " are unions of " +
                         std::to_string(edges_) + " edges" +
                         (outside_ > 0 ? ", " + std::to_string(outside_) + " are outside" : "") +
                         (in_part_ > 0 ? ", " + std::to_string(in_part_) + " in part" : ""));
  }

 private:
  std::optional<std::string> trouble_;  // the first
  std::size_t there_ = 0, edges_ = 0, outside_ = 0, in_part_ = 0;
};

}  // namespace mesher::detail
