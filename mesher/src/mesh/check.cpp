// Verifies a triangulation of a box from its vertices and triangles alone; see check.hpp.
#include "mesher/check.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>

#include "mesher/predicates.hpp"
#include "io/text.hpp"

namespace mesher {
namespace {

// A directed edge of a triangle, and the triangle's corner opposite to it.
struct HalfEdge {
  std::uint32_t from, to, opposite;
  std::size_t triangle;

  [[nodiscard]] std::uint32_t low() const { return std::min(from, to); }
  [[nodiscard]] std::uint32_t high() const { return std::max(from, to); }
  [[nodiscard]] bool same_edge(const HalfEdge& other) const {
    return low() == other.low() && high() == other.high();
  }
};

class Checker {
 public:
  Checker(const Mesh<2>& mesh, const CheckOptions& options) : mesh_(mesh), options_(options) {}

  std::vector<Finding> run() {
    const bool tiles =
        check("coordinates", &Checker::coordinates) && check("vertices", &Checker::vertices) &&
        check("orientation", &Checker::orientation) && check("edges", &Checker::edges) &&
        check("hull", &Checker::hull) && check("euler", &Checker::euler);
    if (tiles) check("delaunay", &Checker::delaunay);
    if (options_.input) check("input", &Checker::input);
    if (tiles && options_.rho) check("quality", &Checker::quality);
    return std::move(findings_);
  }

 private:
  // What a property's check says: nothing wrong and what was looked at, or the first violation.
  struct Verdict {
    bool holds;
    std::string detail;
  };
  static Verdict good(std::string detail) { return {true, std::move(detail)}; }
  static Verdict bad(std::string detail) { return {false, std::move(detail)}; }

  bool check(const char* property, Verdict (Checker::*verify)()) {
    Verdict verdict = (this->*verify)();
    findings_.push_back({property, verdict.holds, std::move(verdict.detail)});
    return verdict.holds;
  }

  // What the predicates can judge.
  static bool in_range(double x) {
    return x == 0 || (std::abs(x) >= 0x1p-160 && std::abs(x) <= 0x1p101);
  }

  Verdict coordinates() {
    for (std::size_t v = 0; v < mesh_.vertices.size(); ++v) {
      const auto& p = mesh_.vertices[v];
      if (in_range(p[0]) && in_range(p[1])) continue;
      return bad(vertex(v) + " is beyond the magnitudes 2^-160 to 2^101");
    }
    return good(std::to_string(mesh_.vertices.size()) + " vertices");
  }

  Verdict vertices() {
    std::vector<std::uint32_t> order(mesh_.vertices.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](auto a, auto b) { return at(a) < at(b); });
    for (std::size_t i = 1; i < order.size(); ++i) {
      if (at(order[i - 1]) != at(order[i])) continue;
      return bad(vertex(order[i - 1]) + " and " + vertex(order[i]) + " coincide");
    }
    std::vector<bool> used(mesh_.vertices.size());
    for (const auto& t : mesh_.simplices) {
      for (const auto corner : t) used[corner] = true;
    }
    const auto unused = std::find(used.begin(), used.end(), false);
    if (unused == used.end()) return good("all distinct, all used");
    return bad(vertex(unused - used.begin()) + " is in no triangle");
  }

  Verdict orientation() {
    for (std::size_t i = 0; i < mesh_.simplices.size(); ++i) {
      const auto& t = mesh_.simplices[i];
      if (predicates::orient2d(at(t[0]), at(t[1]), at(t[2])) > 0) continue;
      return bad(triangle(i) + " is not counterclockwise");
    }
    return good(std::to_string(mesh_.simplices.size()) + " triangles counterclockwise");
  }

  // Afterwards the half-edges of one edge are neighbours in half_edges_.
  Verdict edges() {
    collect_half_edges();
    for (std::size_t i = 0; i < half_edges_.size(); i += partners(i)) {
      ++edges_;
      if (partners(i) == 1) border_.push_back(half_edges_[i]);
      if (partners(i) > 2) return bad(edge(half_edges_[i]) + " borders more than two triangles");
      if (partners(i) == 2 && half_edges_[i].from == half_edges_[i + 1].from) {
        return bad(edge(half_edges_[i]) + " has both its triangles on one side");
      }
    }
    return good(std::to_string(edges_) + " edges, " + std::to_string(border_.size()) +
                " on the hull");
  }

  // Border edges that go counterclockwise along the box's sides, one leaving each of their
  // vertices, close to walks around the box; without coinciding vertices there is one walk.
  Verdict hull() {
    if (border_.empty()) return bad("no triangles");
    box_ = Box<2>{at(border_.front().from), at(border_.front().from)};
    for (const auto& p : mesh_.vertices) {
      for (int i = 0; i < 2; ++i) {
        box_.lo[i] = std::min(box_.lo[i], p[i]);
        box_.hi[i] = std::max(box_.hi[i], p[i]);
      }
    }
    for (const auto& e : border_) {
      if (!along_box(at(e.from), at(e.to))) return bad(edge(e) + " is not along a side of the box");
    }
    std::sort(border_.begin(), border_.end(),
              [](const HalfEdge& a, const HalfEdge& b) { return a.from < b.from; });
    for (std::size_t i = 1; i < border_.size(); ++i) {
      if (border_[i - 1].from != border_[i].from) continue;
      return bad("two edges of the hull leave " + vertex(border_[i].from));
    }
    return good("the box " + text::to_text<2>(box_.lo) + " to " + text::to_text<2>(box_.hi));
  }

  Verdict euler() {
    const auto v = static_cast<long long>(mesh_.vertices.size());
    const auto t = static_cast<long long>(mesh_.simplices.size());
    const long long sum = v - edges_ + t;
    const std::string detail = std::to_string(v) + " - " + std::to_string(edges_) + " + " +
                               std::to_string(t) + " = " + std::to_string(sum);
    return sum == 1 ? good(detail) : bad(detail + ", expected 1");
  }

  Verdict delaunay() {
    for (std::size_t i = 0; i < half_edges_.size(); i += partners(i)) {
      if (partners(i) != 2) continue;
      const HalfEdge& e = half_edges_[i];
      const auto other = half_edges_[i + 1].opposite;
      if (predicates::incircle(at(e.from), at(e.to), at(e.opposite), at(other)) <= 0) continue;
      return bad(vertex(other) + " is inside the circumcircle of " + triangle(e.triangle));
    }
    return good(std::to_string(edges_ - static_cast<long long>(border_.size())) + " inner edges");
  }

  Verdict input() {
    std::vector<Point<2>> sorted = mesh_.vertices;
    std::sort(sorted.begin(), sorted.end());
    const PointFile<2>& file = *options_.input;
    for (std::size_t i = 0; i < file.points.size(); ++i) {
      if (std::binary_search(sorted.begin(), sorted.end(), file.points[i])) continue;
      return bad("input point " + std::to_string(static_cast<std::int64_t>(file.ids[i])) + " at " +
                 text::to_text<2>(file.points[i]) + " (line " + std::to_string(file.lines[i]) +
                 ") is no vertex");
    }
    return good(std::to_string(file.points.size()) + " points are vertices");
  }

  Verdict quality() {
    constexpr double kRounding = 1e-9;  // far above the error of radius_edge, far below any use
    double worst = 0;
    for (std::size_t i = 0; i < mesh_.simplices.size(); ++i) {
      const auto& t = mesh_.simplices[i];
      const double ratio = radius_edge(at(t[0]), at(t[1]), at(t[2]));
      worst = std::max(worst, ratio);
      if (ratio <= *options_.rho * (1 + kRounding)) continue;
      return bad(triangle(i) + " has radius-edge " + text::to_text(ratio) + ", above rho " +
                 text::to_text(*options_.rho));
    }
    return good("radius-edge at most " + text::to_text(worst));
  }

  void collect_half_edges() {
    half_edges_.reserve(3 * mesh_.simplices.size());
    for (std::size_t i = 0; i < mesh_.simplices.size(); ++i) {
      const auto& [a, b, c] = mesh_.simplices[i];
      half_edges_.insert(half_edges_.end(), {{a, b, c, i}, {b, c, a, i}, {c, a, b, i}});
    }
    std::sort(half_edges_.begin(), half_edges_.end(), [](const HalfEdge& a, const HalfEdge& b) {
      return std::pair(a.low(), a.high()) < std::pair(b.low(), b.high());
    });
  }

  // How many half-edges from i on are of i's edge.
  [[nodiscard]] std::size_t partners(std::size_t i) const {
    std::size_t end = i + 1;
    while (end < half_edges_.size() && half_edges_[i].same_edge(half_edges_[end])) ++end;
    return end - i;
  }

  [[nodiscard]] bool along_box(const Point<2>& from, const Point<2>& to) const {
    const auto both_at = [&](int axis, double value) {
      return from[axis] == value && to[axis] == value;
    };
    return (both_at(1, box_.lo[1]) && from[0] < to[0]) ||
           (both_at(0, box_.hi[0]) && from[1] < to[1]) ||
           (both_at(1, box_.hi[1]) && from[0] > to[0]) ||
           (both_at(0, box_.lo[0]) && from[1] > to[1]);
  }

  [[nodiscard]] const Point<2>& at(std::size_t v) const { return mesh_.vertices[v]; }
  [[nodiscard]] std::string vertex(std::size_t v) const {
    return "vertex " + std::to_string(v + 1) + " at " + text::to_text<2>(at(v));
  }
  [[nodiscard]] std::string edge(const HalfEdge& e) const {
    return "the edge from " + vertex(e.from) + " to " + vertex(e.to);
  }
  [[nodiscard]] std::string triangle(std::size_t i) const {
    const auto& [a, b, c] = mesh_.simplices[i];
    return "triangle " + std::to_string(i + 1) + " with the vertices " + std::to_string(a + 1) +
           ", " + std::to_string(b + 1) + ", " + std::to_string(c + 1);
  }

  const Mesh<2>& mesh_;
  const CheckOptions& options_;
  std::vector<Finding> findings_;
  std::vector<HalfEdge> half_edges_;  // by edge
  std::vector<HalfEdge> border_;      // of edges with one triangle
  long long edges_ = 0;
  Box<2> box_;
};

}  // namespace

std::vector<Finding> check_mesh(const Mesh<2>& mesh, const CheckOptions& options) {
  return Checker(mesh, options).run();
}

}  // namespace mesher
