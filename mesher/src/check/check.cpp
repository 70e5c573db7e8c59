// Verifies a triangulation from its vertices and triangles, and the input it is of; see check.hpp.
#include "mesher/check.hpp"

#include <algorithm>
#include <utility>

#include "check/check_parts.hpp"
#include "check/check_regions.hpp"
#include "check/checked_mesh.hpp"
#include "check/marked.hpp"
#include "geometry/segment_tests.hpp"
#include "graph/has_features.hpp"
#include "mesher/predicates.hpp"
#include "text/text.hpp"

namespace mesher {
namespace {

using detail::HalfEdge;
using detail::Verdict;

class Checker {
 public:
  Checker(const Mesh<2>& mesh, const CheckOptions<2>& options)
      : mesh_(mesh), options_(options), checked_(mesh) {}

  std::vector<Finding> run() {
    const bool is_mesh = findings_.add("coordinates", detail::check_coordinates(mesh_)) &&
                         findings_.add("vertices", detail::check_vertices(mesh_)) &&
                         findings_.add("orientation", detail::check_orientation(mesh_)) &&
                         check("edges", &Checker::edges);
    if (is_mesh) collect_lines();
    const bool tiles =
        is_mesh && (options_.boundary == BoundaryRule::box ? tiles_box() : tiles_domain());
    if (tiles) check("delaunay", &Checker::delaunay);
    if (tiles && has_lines() && !options_.constrained) check("conforming", &Checker::conforming);
    if (options_.graph != nullptr) findings_.add("input", detail::check_input(checked_, options_));
    if (tiles && has_lines()) check("regions", &Checker::regions);
    if (tiles && has_paths_ && detail::tells_markers(options_)) {
      findings_.add("markers", detail::check_markers(checked_, paths_, options_));
    }
    if (tiles && options_.rho) check("quality", &Checker::quality);
    if (tiles && options_.max_measure) check("area", &Checker::area);
    return findings_.take();
  }

 private:
  static Verdict good(std::string detail) { return Verdict::good(std::move(detail)); }
  static Verdict bad(std::string detail) { return Verdict::bad(std::move(detail)); }

  bool check(const char* property, Verdict (Checker::*verify)()) {
    return findings_.add(property, (this->*verify)());
  }

  bool tiles_box() { return check("hull", &Checker::hull) && check("euler", &Checker::euler); }

  bool tiles_domain() {
    if (mesh_.simplices.empty() && options_.graph != nullptr &&
        !options_.graph->graph.holes().empty()) {
      return findings_.add("overlap", good("no triangles: lines enclose nothing but holes"));
    }
    if (!findings_.add("overlap", detail::check_overlap(checked_))) return false;
    if (options_.boundary == BoundaryRule::lines) check("boundary", &Checker::boundary);
    return true;
  }

  Verdict edges() {
    const detail::HalfEdges& all = checked_.sides();
    for (std::size_t i = 0; i < all.size(); i += all.partners(i)) {
      ++edges_;
      if (all.partners(i) > 2)
        return bad(checked_.side(all[i]) + " borders more than two triangles");
      if (all.partners(i) == 2 && all[i].from == all[i + 1].from) {
        return bad(checked_.side(all[i]) + " has both its triangles on one side");
      }
    }
    border_ = all.border();
    return good(std::to_string(edges_) + " edges, " + std::to_string(border_.size()) +
                " on the hull");
  }

  // Which edges are on lines: as the file says, and as the input's lines are found in it.
  void collect_lines() {
    if (options_.features != nullptr && !options_.features->edges.empty()) {
      check("lines", &Checker::lines);
      for (const MeshEdge& e : options_.features->edges) on_lines_.emplace_back(e.low, e.high);
    }
    if (options_.graph != nullptr) {
      auto [verdict, paths] = detail::check_segments(checked_, options_);
      has_paths_ = verdict.holds;
      if (!paths.empty()) findings_.add("segments", std::move(verdict));
      paths_ = std::move(paths);
    }
    for (const auto& path : paths_) {
      for (std::size_t i = 1; i < path.vertices.size(); ++i) {
        on_lines_.push_back(std::minmax(path.vertices[i - 1], path.vertices[i]));
      }
    }
    std::sort(on_lines_.begin(), on_lines_.end());
  }

  [[nodiscard]] bool has_lines() const {
    return !on_lines_.empty() ||
           (options_.features != nullptr && !options_.features->regions.empty());
  }

  Verdict lines() {
    for (const MeshEdge& e : options_.features->edges) {
      if (checked_.sides().has_edge(e.low, e.high)) continue;
      return bad(checked_.edge(e.low, e.high) + " is listed, but is no edge of a triangle");
    }
    return good(std::to_string(options_.features->edges.size()) + " edges on lines");
  }

  // Border edges that go counterclockwise along the box's sides, one leaving each of their
  // vertices, close to walks around the box; without coinciding vertices there is one walk.
  Verdict hull() {
    if (border_.empty()) return bad("no triangles");
    const Box<2> box = checked_.bounding_box();
    for (const auto& e : border_) {
      if (along_box(box, at(e.from), at(e.to))) continue;
      return bad(checked_.side(e) + " is not along a side of the box");
    }
    std::sort(border_.begin(), border_.end(),
              [](const HalfEdge& a, const HalfEdge& b) { return a.from < b.from; });
    for (std::size_t i = 1; i < border_.size(); ++i) {
      if (border_[i - 1].from != border_[i].from) continue;
      return bad("two edges of the hull leave " + checked_.vertex(border_[i].from));
    }
    return good("the box " + text::to_text<2>(box.lo) + " to " + text::to_text<2>(box.hi));
  }

  Verdict euler() {
    const auto v = static_cast<long long>(mesh_.vertices.size());
    const auto t = static_cast<long long>(mesh_.simplices.size());
    const long long sum = v - edges_ + t;
    const std::string detail = std::to_string(v) + " - " + std::to_string(edges_) + " + " +
                               std::to_string(t) + " = " + std::to_string(sum);
    return sum == 1 ? good(detail) : bad(detail + ", expected 1");
  }

  Verdict boundary() {
    const Box<2> box = checked_.bounding_box();
    for (const auto& e : border_) {
      if (detail::contains(on_lines_, e) || along_box(box, at(e.from), at(e.to))) continue;
      return bad(checked_.side(e) + " has one triangle, but is on no line and no side of the box");
    }
    return good(std::to_string(border_.size()) + " edges of the boundary on lines");
  }

  Verdict delaunay() {
    return locally_delaunay([&](const HalfEdge& e) { return !detail::contains(on_lines_, e); });
  }
  Verdict conforming() {
    return locally_delaunay([&](const HalfEdge& e) { return detail::contains(on_lines_, e); });
  }

  template <class IsMeant>
  Verdict locally_delaunay(IsMeant is_meant) const {
    const detail::HalfEdges& half_edges = checked_.sides();
    long long inner = 0;
    for (std::size_t i = 0; i < half_edges.size(); i += half_edges.partners(i)) {
      if (half_edges.partners(i) != 2 || !is_meant(half_edges[i])) continue;
      ++inner;
      const HalfEdge& e = half_edges[i];
      const auto other = half_edges[i + 1].opposite;
      if (predicates::incircle(at(e.from), at(e.to), at(e.opposite), at(other)) <= 0) continue;
      return bad(checked_.vertex(other) + " is inside the circumcircle of " +
                 checked_.simplex(e.triangle) + " across " + checked_.side(e));
    }
    return good(std::to_string(inner) + " inner edges");
  }

  Verdict regions() {
    const auto is_on_line = [&](const HalfEdge& e) { return detail::contains(on_lines_, e); };
    const auto seeded_by = [&](const Point<2>& seed) {
      const bool on_line = std::any_of(on_lines_.begin(), on_lines_.end(), [&](const auto& e) {
        return detail::on_segment(seed, at(e.first), at(e.second));
      });
      return on_line ? std::nullopt : checked_.simplex_at(seed);
    };
    return detail::RegionCheck(checked_, options_, is_on_line, seeded_by).run();
  }
  // Small angles are those between the input's lines, or, without an input, between the mesh's own.
  Verdict quality() {
    if (options_.graph == nullptr && options_.features != nullptr) {
      paths_ = detail::drawn_paths(checked_, options_.features->edges);
    }
    return detail::check_quality(checked_, *options_.rho, paths_);
  }

  Verdict area() {
    constexpr double kRounding = 1e-9;  // of areas, as of radius-edge ratios
    double largest = 0;
    for (std::size_t i = 0; i < mesh_.simplices.size(); ++i) {
      const auto& [a, b, c] = mesh_.simplices[i];
      const Point<2>&p = at(a), &q = at(b), &r = at(c);
      const double area = ((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])) / 2;
      largest = std::max(largest, area);
      if (area <= *options_.max_measure * (1 + kRounding)) continue;
      return bad(checked_.simplex(i) + " has the area " + text::to_text(area) + ", above " +
                 text::to_text(*options_.max_measure));
    }
    return good("areas at most " + text::to_text(largest));
  }

  [[nodiscard]] static bool along_box(const Box<2>& box, const Point<2>& from, const Point<2>& to) {
    const auto both_at = [&](int axis, double value) {
      return from[axis] == value && to[axis] == value;
    };
    return (both_at(1, box.lo[1]) && from[0] < to[0]) ||
           (both_at(0, box.hi[0]) && from[1] < to[1]) ||
           (both_at(1, box.hi[1]) && from[0] > to[0]) || (both_at(0, box.lo[0]) && from[1] > to[1]);
  }

  [[nodiscard]] const Point<2>& at(std::size_t v) const { return checked_.at(v); }

  const Mesh<2>& mesh_;
  const CheckOptions<2>& options_;
  detail::CheckedMesh<2> checked_;
  detail::Findings findings_;
  std::vector<HalfEdge> border_;  // of edges with one triangle
  detail::LineEdges on_lines_;
  std::vector<detail::LinePath> paths_;  // of the input's lines
  bool has_paths_ = false;               // all of them
  long long edges_ = 0;
};

}  // namespace

BoundaryRule boundary_rule(const MeshData<2>& mesh, const GraphFile<2>* graph) {
  const bool has_lines =
      !mesh.features.edges.empty() || (graph != nullptr && has_features(graph->graph));
  if (!has_lines) return BoundaryRule::box;
  if (graph == nullptr || mesh.simplices.empty()) return BoundaryRule::lines;
  return detail::rule_of(detail::CheckedMesh<2>(mesh), graph->graph);
}

std::vector<Finding> check_mesh(const Mesh<2>& mesh, const CheckOptions<2>& options) {
  return Checker(mesh, options).run();
}

}  // namespace mesher
