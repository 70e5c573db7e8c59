// Whether triangles are good, but those that small angles of the input force to be bad.
//
// A triangle is excused if its shortest edge joins two segments that leave one point o at under 60
// degrees, at equal distances from o, or at the far end of one of them [RULES A5].
#include <cmath>
#include <map>

#include "check/checked_mesh.hpp"
#include "geometry/distance_rounding.hpp"
#include "text/text.hpp"

namespace mesher::detail {
namespace {

constexpr double kRounding = 1e-9;  // far above the error of radius_edge, far below any use
constexpr double kEqual = 1e-6;     // of distances that are equal but for rounding

double distance(const Point<2>& a, const Point<2>& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1]);
}

class SmallAngles {
 public:
  SmallAngles(const CheckedMesh<2>& mesh, const std::vector<LinePath>& paths)
      : mesh_(mesh), paths_(paths) {
    for (std::size_t i = 0; i < paths.size(); ++i) {
      for (const std::uint32_t v : paths[i].vertices) through_[v].push_back(i);
    }
  }

  // Whether the edge pq joins two segments that leave a point at a small angle.
  [[nodiscard]] bool excuse(std::uint32_t p, std::uint32_t q) const {
    const auto of_p = through_.find(p), of_q = through_.find(q);
    if (of_p == through_.end() || of_q == through_.end()) return false;
    for (const std::size_t s : of_p->second) {
      for (const std::size_t t : of_q->second) {
        if (s != t && excuse(paths_[s], p, paths_[t], q)) return true;
      }
    }
    return false;
  }

 private:
  [[nodiscard]] bool excuse(const LinePath& s, std::uint32_t p, const LinePath& t,
                            std::uint32_t q) const {
    for (const auto& [o, s_far] : {std::pair(s.from, s.to), std::pair(s.to, s.from)}) {
      for (const auto& [t_near, t_far] : {std::pair(t.from, t.to), std::pair(t.to, t.from)}) {
        if (o != t_near || mesh_.at(p) == o || mesh_.at(q) == o) continue;
        const double to_p = distance(o, mesh_.at(p)), to_q = distance(o, mesh_.at(q));
        const bool far = mesh_.at(p) == s_far || mesh_.at(q) == t_far;
        const double tolerance = kEqual * std::max(to_p, to_q) + distance_rounding(o);
        if (!far && std::abs(to_p - to_q) > tolerance) continue;
        if (is_small(o, s_far, t_far)) return true;
      }
    }
    return false;
  }

  // cos 60 degrees = 1/2.
  static bool is_small(const Point<2>& o, const Point<2>& a, const Point<2>& b) {
    const double dot = (a[0] - o[0]) * (b[0] - o[0]) + (a[1] - o[1]) * (b[1] - o[1]);
    return dot > 0.5 * distance(o, a) * distance(o, b);
  }

  const CheckedMesh<2>& mesh_;
  const std::vector<LinePath>& paths_;
  std::map<std::uint32_t, std::vector<std::size_t>> through_;
};

std::pair<std::uint32_t, std::uint32_t> shortest_edge(const CheckedMesh<2>& mesh,
                                                      const Mesh<2>::Simplex& t) {
  std::pair best(t[0], t[1]);
  for (const auto& edge : {std::pair(t[1], t[2]), std::pair(t[2], t[0])}) {
    const double length = distance(mesh.at(edge.first), mesh.at(edge.second));
    if (length < distance(mesh.at(best.first), mesh.at(best.second))) best = edge;
  }
  return best;
}

}  // namespace

Verdict check_quality(const CheckedMesh<2>& mesh, double rho, const std::vector<LinePath>& paths) {
  const SmallAngles angles(mesh, paths);
  double worst = 0;
  std::size_t excused = 0;
  const auto& triangles = mesh.mesh().simplices;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const auto& t = triangles[i];
    const double ratio = radius_edge(mesh.at(t[0]), mesh.at(t[1]), mesh.at(t[2]));
    if (ratio > rho * (1 + kRounding)) {
      const auto [p, q] = shortest_edge(mesh, t);
      if (!angles.excuse(p, q)) {
        return Verdict::bad(mesh.simplex(i) + " has radius-edge " + text::to_text(ratio) +
                            ", above rho " + text::to_text(rho) + "; its shortest edge is from " +
                            mesh.vertex(p) + " to " + mesh.vertex(q));
      }
      ++excused;
      continue;
    }
    worst = std::max(worst, ratio);
  }
  const std::string rest =
      excused == 0 ? ""
                   : ", but " + std::to_string(excused) + " triangles at small angles of the input";
  return Verdict::good("radius-edge at most " + text::to_text(worst) + rest);
}

}  // namespace mesher::detail
