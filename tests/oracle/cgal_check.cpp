// Judges a quality mesh with exact arithmetic; shares no code with the mesher.
//
//   cgal_check MESH.node MESH.ele [--input FILE.node] [--rho R]
//   cgal_check --batch FILE     each line of FILE (or of stdin: '-') holds such arguments
//
// A mesh is good when
//   (1) no two vertices coincide, and every vertex is a corner of a triangle;
//   (2) every triangle is positively oriented;
//   (3) the triangles tile the box of the vertices: an edge has one triangle on each side, or one
//       and lies on the box's boundary; the areas add up to the box's area exactly;
//   (4) it is Delaunay: no vertex opposite an edge lies inside the circle on its other side;
//   (5) every point of --input is a vertex with the same coordinates (the sign of 0 aside);
//   (6) no triangle has circumradius > R times its shortest edge (R the double nearest to what is
//       written; no bound without --rho).
//
// Prints `ok MESH.node: ...`, or a line for each of the first failures of every kind and then
// `FAILED MESH.node: ...`. Exit code: 0 all good, 1 some mesh is not, 2 cannot be judged.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/Interval_nt.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "judge_main.hpp"
#include "node_file.hpp"

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Exact = CGAL::Exact_rational;
using Interval = CGAL::Interval_nt<>;
using oracle::Job;
using oracle::Site;

class Judge {
 public:
  explicit Judge(const Job& job)
      : job_(job),
        nodes_(oracle::read_node(job.nodes)),
        elements_(oracle::read_ele<3>(job.elements, nodes_.ids)) {
    for (const Site& s : nodes_.sites) points_.emplace_back(s.x, s.y);
  }

  bool verdict() {
    if (points_.empty() || elements_.items.empty()) {
      fail("empty", "no vertices or no triangles");
    } else {
      find_box();
      check_vertices();
      check_triangles();
      check_edges();
      check_area();
      if (!job_.input.empty()) check_input();
    }
    failures_.report(description());
    return failures_.none();
  }

 private:
  using Triangle = std::array<std::size_t, 3>;
  struct Side {
    std::size_t triangle;
    std::size_t opposite;
  };
  using DirectedEdge = std::pair<std::size_t, std::size_t>;
  struct EdgeHash {
    std::size_t operator()(const DirectedEdge& e) const {
      return e.first * 0x9e3779b97f4a7c15ULL ^ (e.second * 0xc2b2ae3d27d4eb4fULL);
    }
  };

  void fail(const std::string& kind, const std::string& what) { failures_.add(kind, what); }

  std::string name(std::size_t vertex) const {
    std::ostringstream out;
    const Site& s = nodes_.sites[vertex];
    out << "vertex " << nodes_.ids[vertex] << std::setprecision(17) << " (" << s.x << ", " << s.y
        << ')';
    return out.str();
  }

  std::string triangle_name(std::size_t t) const {
    const Triangle& c = elements_.items[t];
    return "triangle " + std::to_string(elements_.ids[t]) + " of vertices " +
           std::to_string(nodes_.ids[c[0]]) + ' ' + std::to_string(nodes_.ids[c[1]]) + ' ' +
           std::to_string(nodes_.ids[c[2]]);
  }

  void find_box() {
    lo_ = hi_ = nodes_.sites[0];
    for (const Site& s : nodes_.sites) {
      lo_ = {std::min(lo_.x, s.x), std::min(lo_.y, s.y)};
      hi_ = {std::max(hi_.x, s.x), std::max(hi_.y, s.y)};
    }
  }

  /// Both ends on one side of the box.
  bool on_box(std::size_t u, std::size_t v) const {
    const Site& a = nodes_.sites[u];
    const Site& b = nodes_.sites[v];
    return (a.x == b.x && (a.x == lo_.x || a.x == hi_.x)) ||
           (a.y == b.y && (a.y == lo_.y || a.y == hi_.y));
  }

  // (1)
  void check_vertices() {
    std::map<std::pair<double, double>, std::size_t> seen;
    for (std::size_t v = 0; v < nodes_.sites.size(); ++v) {
      const auto [other, is_new] = seen.insert({{nodes_.sites[v].x, nodes_.sites[v].y}, v});
      if (!is_new) fail("coincident", name(v) + " and " + name(other->second));
    }
    std::vector<bool> used(nodes_.sites.size());
    for (const Triangle& corners : elements_.items)
      for (const std::size_t v : corners) used[v] = true;
    for (std::size_t v = 0; v < used.size(); ++v)
      if (!used[v]) fail("unused", name(v) + " is in no triangle");
  }

  // (2), (6)
  void check_triangles() {
    for (std::size_t t = 0; t < elements_.items.size(); ++t) {
      const auto& [a, b, c] = elements_.items[t];
      if (CGAL::orientation(points_[a], points_[b], points_[c]) != CGAL::LEFT_TURN)
        fail("orientation", triangle_name(t));
      else
        check_quality(t);
    }
  }

  void check_quality(std::size_t t) {
    const double ratio = approximate_ratio(t);
    worst_ratio_ = std::max(worst_ratio_, ratio);
    if (!job_.rho || within_bound(t)) return;
    std::ostringstream what;
    what << triangle_name(t) << ": " << std::setprecision(17) << ratio << " > " << *job_.rho;
    fail("radius-edge", what.str());
  }

  /// Squared edge lengths, and twice the area.
  template <class Number>
  std::pair<std::array<Number, 3>, Number> measure(std::size_t t) const {
    std::array<Number, 3> x, y, squares;
    for (std::size_t k = 0; k < 3; ++k) {
      const Site& s = nodes_.sites[elements_.items[t][k]];
      x[k] = Number(s.x);
      y[k] = Number(s.y);
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const Number dx = x[(k + 1) % 3] - x[k];
      const Number dy = y[(k + 1) % 3] - y[k];
      squares[k] = dx * dx + dy * dy;
    }
    return {squares, (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0])};
  }

  double approximate_ratio(std::size_t t) const {
    const auto [squares, d] = measure<double>(t);
    const auto [p, q, r] = squares;
    return std::sqrt(std::max({p * q, q * r, r * p})) / (2 * d);
  }

  /// circumradius <= rho * every edge. With squared edges p, q, r and twice the area d, the
  /// circumradius is sqrt(p q r) / (2 d), so for the edge of p this is q r <= 4 rho^2 d^2.
  bool within_bound(std::size_t t) const {
    try {
      return within_bound_in<Interval>(t);
    } catch (const CGAL::Uncertain_conversion_exception&) {
      return within_bound_in<Exact>(t);
    }
  }

  template <class Number>
  bool within_bound_in(std::size_t t) const {
    const auto [squares, d] = measure<Number>(t);
    const auto& [p, q, r] = squares;
    const Number rho(*job_.rho);
    const Number bound = Number(4) * rho * rho * d * d;
    return CGAL::make_certain(q * r <= bound) && CGAL::make_certain(r * p <= bound) &&
           CGAL::make_certain(p * q <= bound);
  }

  // (3), (4)
  void check_edges() {
    std::unordered_map<DirectedEdge, Side, EdgeHash> sides;
    sides.reserve(3 * elements_.items.size());
    for (std::size_t t = 0; t < elements_.items.size(); ++t) {
      const Triangle& c = elements_.items[t];
      for (std::size_t k = 0; k < 3; ++k) {
        const DirectedEdge edge{c[k], c[(k + 1) % 3]};
        if (!sides.insert({edge, {t, c[(k + 2) % 3]}}).second)
          fail("edge", name(edge.first) + " to " + name(edge.second) + " twice on one side");
      }
    }
    for (const auto& [edge, side] : sides) {
      const auto twin = sides.find({edge.second, edge.first});
      if (twin != sides.end()) {
        if (edge.first < edge.second) check_delaunay(side, twin->second);
      } else if (!on_box(edge.first, edge.second)) {
        fail("edge", name(edge.first) + " to " + name(edge.second) + " has only one side");
      }
    }
  }

  void check_delaunay(const Side& side, const Side& twin) {
    const auto& [a, b, c] = elements_.items[side.triangle];
    if (CGAL::side_of_oriented_circle(points_[a], points_[b], points_[c], points_[twin.opposite]) ==
        CGAL::ON_POSITIVE_SIDE)
      fail("delaunay", name(twin.opposite) + " in the circle of " + triangle_name(side.triangle));
  }

  // (3)
  void check_area() {
    Exact twice = 0;
    for (const auto& [a, b, c] : elements_.items) {
      const Exact ax = nodes_.sites[a].x, ay = nodes_.sites[a].y;
      twice += (nodes_.sites[b].x - ax) * (nodes_.sites[c].y - ay) -
               (nodes_.sites[c].x - ax) * (nodes_.sites[b].y - ay);
    }
    const Exact box = (Exact(hi_.x) - Exact(lo_.x)) * (Exact(hi_.y) - Exact(lo_.y));
    if (twice != 2 * box)
      fail("area", "the triangles' areas differ from the box by " +
                       std::to_string(CGAL::to_double(twice / 2 - box)));
  }

  // (5)
  void check_input() {
    std::set<std::pair<double, double>> vertices;
    for (const Site& s : nodes_.sites) vertices.insert({s.x, s.y});
    const oracle::NodeFile input = oracle::read_node(job_.input);
    for (std::size_t i = 0; i < input.sites.size(); ++i) {
      const Site& s = input.sites[i];
      if (vertices.count({s.x, s.y})) continue;
      std::ostringstream what;
      what << "input point " << input.ids[i] << std::setprecision(17) << " (" << s.x << ", " << s.y
           << ") is no vertex";
      fail("input", what.str());
    }
  }

  std::string description() const {
    std::ostringstream out;
    out << nodes_.sites.size() << " vertices, " << elements_.items.size()
        << " triangles, radius-edge at most " << std::setprecision(6) << worst_ratio_;
    return out.str();
  }

  Job job_;
  oracle::NodeFile nodes_;
  oracle::EleFile<3> elements_;
  std::vector<Kernel::Point_2> points_;
  Site lo_, hi_;
  double worst_ratio_ = 0;  // for people; nothing is decided by it
  oracle::Failures failures_{job_.nodes};
};

}  // namespace

int main(int argc, char** argv) {
  return oracle::judge_main<Judge>("cgal_check", {argv + 1, argv + argc});
}
