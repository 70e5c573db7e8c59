// What a mesh of a planar straight-line graph must be, told from its vertices, triangles and edges
// alone.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "geometry/centroid.hpp"
#include "geometry/diametral_ball.hpp"
#include "geometry/plane_vectors.hpp"
#include "mesher/predicates.hpp"
#include "mesher/sizes.hpp"
#include "random_pslg.hpp"

namespace support {

class PslgJudge {
 public:
  PslgJudge(const mesher::Mesh<2>& mesh, const Pslg& pslg) : mesh_(mesh), pslg_(pslg) {
    for (const auto& [id, p] : pslg.points) points_[p] = id;
    for (const auto& e : mesh.edges) {
      by_line_[e.feature.number].push_back({e.low, e.high});
    }
    for (const auto& [ends, line] : pslg.segments) {
      for (const auto& e : by_line_[line]) {
        for (const std::uint32_t v : e) {
          auto& on = on_[v];
          if (std::find(on.begin(), on.end(), ends) == on.end()) on.push_back(ends);
        }
      }
    }
    for (const auto& t : mesh.simplices) {
      for (std::size_t i = 0; i < 3; ++i) {
        const auto [low, high] = std::minmax(t[(i + 1) % 3], t[(i + 2) % 3]);
        across_[{low, high}].push_back(t[i]);
      }
    }
  }

  /// What is wrong first, "" if nothing is: input points and no others are of that kind; each
  /// segment is a chain of edges from end to end; every such edge has an empty closed diametral
  /// ball, but for rounding at tiny angles; no triangle is larger than its limit; triangles keep
  /// the bound but where a small angle of the input forces them not to.
  [[nodiscard]] std::string fault(const mesher::Options<2>& options) const {
    std::string what = wrong_kinds();
    if (what.empty()) what = wrong_lines();
    if (what.empty()) what = encroached();
    if (what.empty()) what = large(options);
    return what.empty() ? poor(options.rho) : what;
  }
  /// Triangles that small angles force to be poor, counted by fault().
  [[nodiscard]] std::size_t forced() const noexcept { return forced_; }

 private:
  using P = mesher::Point<2>;
  using Edge = std::array<std::uint32_t, 2>;

  [[nodiscard]] const P& at(std::uint32_t v) const { return mesh_.vertices[v]; }
  static double apart(const P& a, const P& b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }
  static std::string text(const P& p) {
    return "(" + std::to_string(p[0]) + " " + std::to_string(p[1]) + ")";
  }

  [[nodiscard]] std::string wrong_kinds() const {
    std::size_t inputs = 0;
    for (std::uint32_t v = 0; v < mesh_.vertices.size(); ++v) {
      const bool input = mesh_.kinds[v] == mesher::VertexKind::input;
      const bool on_segment = mesh_.kinds[v] == mesher::VertexKind::segment;
      if (input != points_.contains(at(v))) return "kind of " + text(at(v));
      if (on_segment && !on_.contains(v)) return "not on a segment: " + text(at(v));
      if (!on_segment && !input && on_.contains(v)) return "on a segment: " + text(at(v));
      inputs += input;
    }
    return inputs == pslg_.points.size() ? "" : "input points are missing";
  }

  [[nodiscard]] std::string wrong_lines() const {
    std::size_t edges = 0;
    for (const auto& [ends, line] : pslg_.segments) {
      const auto chain = by_line_.find(line);
      if (chain == by_line_.end()) return "no edges of segment " + std::to_string(line);
      edges += chain->second.size();
      if (!is_chain(chain->second, pslg_.points.at(ends.first), pslg_.points.at(ends.second))) {
        return "segment " + std::to_string(line) + " is not a chain of its edges";
      }
    }
    return edges == mesh_.edges.size() ? "" : "edges on no segment";
  }
  // Edges that follow each other from a to b, each vertex on ab but for rounding.
  [[nodiscard]] bool is_chain(std::vector<Edge> edges, const P& a, const P& b) const {
    const P along{b[0] - a[0], b[1] - a[1]};
    const auto place = [&](std::uint32_t v) {
      return (at(v)[0] - a[0]) * along[0] + (at(v)[1] - a[1]) * along[1];
    };
    for (Edge& e : edges) {
      if (place(e[1]) < place(e[0])) std::swap(e[0], e[1]);
    }
    std::sort(edges.begin(), edges.end(),
              [&](const Edge& x, const Edge& y) { return place(x[0]) < place(y[0]); });
    for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
      if (edges[i][1] != edges[i + 1][0]) return false;
      if (mesher::detail::distance2(at(edges[i][1]), a, b) > 1e-20 * 256) return false;
    }
    return at(edges.front()[0]) == a && at(edges.back()[1]) == b;
  }

  [[nodiscard]] std::string encroached() const {
    for (const auto& e : mesh_.edges) {
      const auto it = across_.find({e.low, e.high});
      if (it == across_.end()) return "no edge of the mesh: " + text(at(e.low)) + text(at(e.high));
      for (const std::uint32_t v : it->second) {
        if (mesher::detail::in_diametral_ball(at(v), at(e.low), at(e.high)) &&
            !is_beside_by_rounding(v, {e.low, e.high})) {
          return text(at(v)) + " in the ball of " + text(at(e.low)) + text(at(e.high));
        }
      }
    }
    return "";
  }

  // At equal distances from a common apex a vertex is outside of the ball, at an angle so small
  // that rounded coordinates may say that it is right.
  [[nodiscard]] bool is_beside_by_rounding(std::uint32_t v, const Edge& e) const {
    const P &x = at(v), &a = at(e[0]), &b = at(e[1]);
    const double dot = (a[0] - x[0]) * (b[0] - x[0]) + (a[1] - x[1]) * (b[1] - x[1]);
    if (dot < -kRounding * apart(a, b)) return false;
    return std::any_of(e.begin(), e.end(), [&](std::uint32_t w) { return are_level(v, w); });
  }
  // Whether both are equally far from a common end of segments that they are on.
  [[nodiscard]] bool are_level(std::uint32_t v, std::uint32_t w) const {
    return any_apex(v, w, [&](const P& apex) {
      return std::abs(apart(apex, at(v)) - apart(apex, at(w))) <= kRounding;
    });
  }
  // Whether accept(apex) is true of a common end of two segments, one through v and one through w.
  template <class Accept>
  [[nodiscard]] bool any_apex(std::uint32_t v, std::uint32_t w, Accept&& accept) const {
    if (!on_.contains(v) || !on_.contains(w)) return false;
    for (const Pslg::Ends& s : on_.at(v)) {
      for (const Pslg::Ends& t : on_.at(w)) {
        for (const std::int64_t o : {s.first, s.second}) {
          if (s == t || (o != t.first && o != t.second)) continue;
          if (accept(pslg_.points.at(o))) return true;
        }
      }
    }
    return false;
  }

  // The largest area of a triangle with its centroid at p.
  static double limit(const mesher::Options<2>& options, const P& p) {
    for (std::size_t i = 0; i < 2; ++i) {
      if (p[i] < options.domain.lo[i] || p[i] > options.domain.hi[i]) return 1e300;
    }
    mesher::SizeLimits<2> there{options.max_measure, options.sizes};
    for (const auto& part : options.box_limits) {
      if (mesher::detail::contains(part.box, p)) there = part.limits;
    }
    const double h = there.sizes == nullptr ? 1e150 : there.sizes->at(p);
    return std::min(there.max_measure == 0 ? 1e300 : there.max_measure, std::sqrt(3.0) / 4 * h * h);
  }
  [[nodiscard]] std::string large(const mesher::Options<2>& options) const {
    for (const auto& t : mesh_.simplices) {
      const P &p = at(t[0]), &q = at(t[1]), &r = at(t[2]);
      const double area = ((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])) / 2;
      if (area > limit(options, mesher::detail::centroid(mesher::detail::CornersOf<2>{p, q, r}))) {
        return "large: " + text(p) + text(q) + text(r);
      }
    }
    return "";
  }

  [[nodiscard]] std::string poor(double rho) const {
    forced_ = 0;
    for (const auto& t : mesh_.simplices) {
      std::array<double, 3> opposite;
      for (std::size_t i = 0; i < 3; ++i)
        opposite[i] = apart(at(t[(i + 1) % 3]), at(t[(i + 2) % 3]));
      const auto i = static_cast<std::size_t>(std::min_element(opposite.begin(), opposite.end()) -
                                              opposite.begin());
      const P &r = at(t[i]), &p = at(t[(i + 1) % 3]), &q = at(t[(i + 2) % 3]);
      const double area2 = (p[0] - r[0]) * (q[1] - r[1]) - (p[1] - r[1]) * (q[0] - r[0]);
      const double radius = opposite[0] * opposite[1] * opposite[2] / (2 * area2);
      if (radius <= rho * opposite[i] * (1 + 1e-9)) continue;
      if (!is_forced(t[(i + 1) % 3], t[(i + 2) % 3])) {
        return "poor: " + text(r) + text(p) + text(q);
      }
      ++forced_;
    }
    return "";
  }
  // The shortest edge p -> q of a triangle on its left joins equal distances on two segments that
  // meet at under 60 degrees.
  [[nodiscard]] bool is_forced(std::uint32_t p, std::uint32_t q) const {
    const bool inside = mesh_.kinds[p] == mesher::VertexKind::segment &&
                        mesh_.kinds[q] == mesher::VertexKind::segment;
    return any_apex(p, q, [&](const P& apex) {
      const double from_p = apart(apex, at(p)), from_q = apart(apex, at(q));
      if (from_p == 0 || from_q == 0) return false;
      const P u{(at(p)[0] - apex[0]) / from_p, (at(p)[1] - apex[1]) / from_p};
      const P w{(at(q)[0] - apex[0]) / from_q, (at(q)[1] - apex[1]) / from_q};
      if (u[0] * w[0] + u[1] * w[1] <= 0.5 - 1e-9) return false;
      if (std::abs(from_p - from_q) > 1e-8 * (from_p + from_q) + kRounding) return false;
      return inside || mesher::predicates::orient2d(at(p), at(q), apex) > 0;
    });
  }

  // Of coordinates up to 16: a vertex on a segment is within 2^-48 of its place in each, by the
  // rounding of the segment's difference, of the part of it, of their product, and of the sum; so
  // two distances from an apex differ by 2 sqrt 2 times that at most.
  static constexpr double kRounding = 0x1p-46;

  const mesher::Mesh<2>& mesh_;
  const Pslg& pslg_;
  std::map<P, std::int64_t> points_;
  std::map<std::int64_t, std::vector<Edge>> by_line_;
  std::map<std::uint32_t, std::vector<Pslg::Ends>> on_;  // segments at each vertex
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> across_;
  mutable std::size_t forced_ = 0;
};

}  // namespace support
