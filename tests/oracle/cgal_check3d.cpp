// Judges a quality mesh of tetrahedra with exact arithmetic; shares no code with the mesher.
//
//   cgal_check3d MESH.node MESH.ele [--input FILE.node] [--rho R] [--complex FILE.poly]
//   cgal_check3d --batch FILE     each line of FILE (or of stdin: '-') holds such arguments
//
// A mesh is good when
//   (1) no two vertices coincide, and every vertex is a corner of a tetrahedron;
//   (2) every tetrahedron is positively oriented;
//   (3) the tetrahedra tile the box of the vertices: a face has one on each side, or one and lies
//       on the box's boundary; the volumes add up to the box's exactly;
//   (4) it is Delaunay: no vertex opposite a face lies inside the sphere on its other side. Where
//       it lies on that sphere, the greatest of the five in lexicographic order counts as outside
//       of the sphere of the others (if those are in one plane, the next greatest, and so on);
//   (5) every point of --input is a vertex with the same coordinates (the sign of 0 aside);
//   (6) no tetrahedron has circumradius > R times its shortest edge (R the double nearest to what
//       is written; no bound without --rho);
//   (7) the polygons and segments of --complex, a .poly file of TetGen, are unions of faces and
//       edges: of those that MESH.face names, see complex_judge.hpp.
//
// Prints `ok MESH.node: ...`, or a line for each of the first failures of every kind and then
// `FAILED MESH.node: ...`. Exit code: 0 all good, 1 some mesh is not, 2 cannot be judged.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/Interval_nt.h>

#include <algorithm>
#include <array>
#include <iomanip>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "complex_judge.hpp"
#include "judge_main.hpp"
#include "node_file.hpp"

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Exact = CGAL::Exact_rational;
using Interval = CGAL::Interval_nt<>;
using oracle::Job;
using Place = std::array<double, 3>;
using Corners = std::array<std::size_t, 4>;

template <class Number>
using Vector = std::array<Number, 3>;

template <class Number>
Vector<Number> cross(const Vector<Number>& a, const Vector<Number>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
template <class Number>
Number dot(const Vector<Number>& a, const Vector<Number>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

class Judge {
 public:
  explicit Judge(const Job& job)
      : job_(job),
        nodes_(oracle::read_places<3>(job.nodes)),
        tetrahedra_(oracle::read_ele<4>(job.elements, nodes_.ids).items) {
    for (const Place& p : nodes_.items) points_.emplace_back(p[0], p[1], p[2]);
  }

  bool verdict() {
    if (points_.empty() || tetrahedra_.empty()) {
      fail("empty", "no vertices or no tetrahedra");
    } else {
      find_box();
      check_vertices();
      for (std::size_t t = 0; t < tetrahedra_.size(); ++t) check_tetrahedron(t);
      check_faces();
      check_volume();
      if (!job_.input.empty()) check_input();
      if (!job_.complex.empty()) check_complex();
    }
    failures_.report(std::to_string(points_.size()) + " vertices, " +
                     std::to_string(tetrahedra_.size()) + " tetrahedra");
    return failures_.none();
  }

 private:
  using Face = std::array<std::size_t, 3>;
  struct Side {
    std::size_t tetrahedron, opposite;
    bool even;  // corners in the order of the sorted face, seen from the opposite corner
  };

  void fail(const std::string& kind, const std::string& what) { failures_.add(kind, what); }
  std::string name(std::size_t v) const {
    std::ostringstream out;
    const Place& p = nodes_.items[v];
    out << "vertex " << nodes_.ids[v] << std::setprecision(17) << " (" << p[0] << ", " << p[1]
        << ", " << p[2] << ')';
    return out.str();
  }
  std::string tetrahedron_name(std::size_t t) const {
    std::string text = "tetrahedron of vertices";
    for (const std::size_t v : tetrahedra_[t]) text += ' ' + std::to_string(nodes_.ids[v]);
    return text;
  }

  void find_box() {
    lo_ = hi_ = nodes_.items[0];
    for (const Place& p : nodes_.items) {
      for (std::size_t i = 0; i < 3; ++i) {
        lo_[i] = std::min(lo_[i], p[i]);
        hi_[i] = std::max(hi_[i], p[i]);
      }
    }
  }
  bool on_box(const Face& face) const {
    for (std::size_t i = 0; i < 3; ++i) {
      const double x = nodes_.items[face[0]][i];
      if (x != lo_[i] && x != hi_[i]) continue;
      if (nodes_.items[face[1]][i] == x && nodes_.items[face[2]][i] == x) return true;
    }
    return false;
  }

  // (1)
  void check_vertices() {
    std::map<Place, std::size_t> seen;
    for (std::size_t v = 0; v < nodes_.items.size(); ++v) {
      const auto [other, is_new] = seen.insert({nodes_.items[v], v});
      if (!is_new) fail("coincident", name(v) + " and " + name(other->second));
    }
    std::vector<bool> used(nodes_.items.size());
    for (const Corners& corners : tetrahedra_)
      for (const std::size_t v : corners) used[v] = true;
    for (std::size_t v = 0; v < used.size(); ++v)
      if (!used[v]) fail("unused", name(v) + " is in no tetrahedron");
  }

  // (2), (6)
  void check_tetrahedron(std::size_t t) {
    const auto& [a, b, c, d] = tetrahedra_[t];
    if (CGAL::orientation(points_[a], points_[b], points_[c], points_[d]) != CGAL::POSITIVE) {
      fail("orientation", tetrahedron_name(t));
    } else if (job_.rho && !within_bound(t)) {
      fail("radius-edge", tetrahedron_name(t));
    }
  }
  bool within_bound(std::size_t t) const {
    try {
      return within_bound_in<Interval>(t);
    } catch (const CGAL::Uncertain_conversion_exception&) {
      return within_bound_in<Exact>(t);
    }
  }
  /// circumradius <= rho * every edge. The centre is n / (2 det) relative to the first corner.
  template <class Number>
  bool within_bound_in(std::size_t t) const {
    std::array<Vector<Number>, 4> p;
    for (std::size_t k = 0; k < 4; ++k) {
      for (std::size_t i = 0; i < 3; ++i) p[k][i] = Number(nodes_.items[tetrahedra_[t][k]][i]);
    }
    const auto minus = [](const Vector<Number>& x, const Vector<Number>& y) {
      return Vector<Number>{x[0] - y[0], x[1] - y[1], x[2] - y[2]};
    };
    const auto a = minus(p[1], p[0]), b = minus(p[2], p[0]), c = minus(p[3], p[0]);
    const auto bc = cross(b, c), ca = cross(c, a), ab = cross(a, b);
    const Number det = dot(a, bc), a2 = dot(a, a), b2 = dot(b, b), c2 = dot(c, c);
    Vector<Number> n;
    for (std::size_t i = 0; i < 3; ++i) n[i] = a2 * bc[i] + b2 * ca[i] + c2 * ab[i];
    const Number rho(*job_.rho);
    const Number bound = Number(4) * rho * rho * det * det, radius = dot(n, n);
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = i + 1; j < 4; ++j) {
        const auto e = minus(p[i], p[j]);
        if (!CGAL::make_certain(radius <= bound * dot(e, e))) return false;
      }
    }
    return true;
  }

  // (3), (4)
  void check_faces() {
    std::map<Face, std::vector<Side>> faces;
    for (std::size_t t = 0; t < tetrahedra_.size(); ++t) {
      for (std::size_t k = 0; k < 4; ++k) add_face(t, k, faces);
    }
    for (const auto& [face, sides] : faces) {
      const std::string where = name(face[0]) + ", " + name(face[1]) + ", " + name(face[2]);
      if (sides.size() == 1) {
        if (!on_box(face)) fail("face", where + " has only one side");
      } else if (sides.size() > 2 || sides[0].even == sides[1].even) {
        fail("face", where + " twice on one side");
      } else {
        check_delaunay(sides[0].tetrahedron, sides[1].opposite);
      }
    }
  }
  void add_face(std::size_t t, std::size_t k, std::map<Face, std::vector<Side>>& faces) const {
    Corners c = tetrahedra_[t];
    bool even = k == 0;
    std::swap(c[0], c[k]);
    for (std::size_t i = 1; i < 4; ++i) {  // sorts the others, counting swaps
      for (std::size_t j = i; j > 1 && c[j] < c[j - 1]; --j) {
        std::swap(c[j], c[j - 1]);
        even = !even;
      }
    }
    faces[{c[1], c[2], c[3]}].push_back({t, c[0], even});
  }
  void check_delaunay(std::size_t t, std::size_t other) {
    const auto& [a, b, c, d] = tetrahedra_[t];
    const auto side = CGAL::side_of_oriented_sphere(points_[a], points_[b], points_[c], points_[d],
                                                    points_[other]);
    if (side == CGAL::ON_POSITIVE_SIDE || (side == CGAL::ON_ORIENTED_BOUNDARY && tie(t, other)))
      fail("delaunay", name(other) + " in the sphere of " + tetrahedron_name(t));
  }
  /// Whether e, on the sphere of t, counts as inside. If all five are lifted a little, e above the
  /// others' common paraboloid by less the smaller it is, the greatest that the other four's volume
  /// lets move decides.
  bool tie(std::size_t t, std::size_t e) const {
    std::array<std::size_t, 5> five{};
    std::copy(tetrahedra_[t].begin(), tetrahedra_[t].end(), five.begin());
    five[4] = e;
    std::array<std::size_t, 5> order{0, 1, 2, 3, 4};
    std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
      return nodes_.items[five[i]] > nodes_.items[five[j]];
    });
    for (const std::size_t i : order) {
      if (i == 4) return false;  // e itself is lifted the most: outside
      auto four = five;
      four[i] = e;  // corner i is lifted: e is inside if it is on the side of that corner
      const auto o =
          CGAL::orientation(points_[four[0]], points_[four[1]], points_[four[2]], points_[four[3]]);
      if (o != CGAL::ZERO) return o == CGAL::POSITIVE;
    }
    return false;
  }

  // (3)
  void check_volume() {
    Exact six = 0;
    for (const Corners& corners : tetrahedra_) {
      std::array<Vector<Exact>, 3> d;
      for (std::size_t k = 0; k < 3; ++k) {
        for (std::size_t i = 0; i < 3; ++i)
          d[k][i] = Exact(nodes_.items[corners[k + 1]][i]) - Exact(nodes_.items[corners[0]][i]);
      }
      six += dot(d[0], cross(d[1], d[2]));
    }
    Exact box = 6;
    for (std::size_t i = 0; i < 3; ++i) box *= Exact(hi_[i]) - Exact(lo_[i]);
    if (six != box) fail("volume", "the volumes do not add up to the box's");
  }

  // (5)
  void check_input() {
    const std::set<Place> vertices(nodes_.items.begin(), nodes_.items.end());
    const auto input = oracle::read_places<3>(job_.input);
    for (std::size_t i = 0; i < input.items.size(); ++i) {
      if (!vertices.count(input.items[i]))
        fail("input", "point " + std::to_string(input.ids[i]) + " is no vertex");
    }
  }

  // (7)
  void check_complex() {
    std::set<Face> faces;
    std::set<std::array<std::size_t, 2>> edges;
    for (Corners c : tetrahedra_) {
      std::sort(c.begin(), c.end());
      faces.insert(
          {{c[0], c[1], c[2]}, {c[0], c[1], c[3]}, {c[0], c[2], c[3]}, {c[1], c[2], c[3]}});
      for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t k = i + 1; k < 4; ++k) edges.insert({c[i], c[k]});
    }
    const std::string face_file = job_.nodes.substr(0, job_.nodes.rfind('.')) + ".face";
    oracle::ComplexJudge(nodes_.items, faces, edges, failures_)
        .judge(job_.complex, face_file, nodes_.ids);
  }

  Job job_;
  oracle::Numbered<Place> nodes_;
  std::vector<Corners> tetrahedra_;
  std::vector<Point> points_;
  Place lo_, hi_;
  oracle::Failures failures_{job_.nodes};
};

}  // namespace

int main(int argc, char** argv) {
  return oracle::judge_main<Judge>("cgal_check3d", {argv + 1, argv + argc});
}
