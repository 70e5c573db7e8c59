// Whether the lines of the input are unions of edges: a walk from end to end of each.
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>

#include "io/text.hpp"
#include "mesh/checked_mesh.hpp"

namespace mesher::detail {
namespace {

constexpr double kRounding = 0x1p-48;  // of the largest coordinate: vertices on lines are rounded

double cross(const Point<2>& o, const Point<2>& p, const Point<2>& q) {
  return (p[0] - o[0]) * (q[1] - o[1]) - (p[1] - o[1]) * (q[0] - o[0]);
}
double dot(const Point<2>& o, const Point<2>& p, const Point<2>& q) {
  return (p[0] - o[0]) * (q[0] - o[0]) + (p[1] - o[1]) * (q[1] - o[1]);
}

class SegmentWalk {
 public:
  SegmentWalk(const CheckedMesh& mesh, const MeshFeatures* features) : mesh_(mesh) {
    for (std::uint32_t v = 0; v < mesh.mesh().vertices.size(); ++v) vertex_[mesh.at(v)] = v;
    neighbours_.resize(mesh.mesh().vertices.size());
    for (std::size_t i = 0; i < mesh.half_edges().size(); i += mesh.partners(i)) {
      const HalfEdge& e = mesh.half_edges()[i];
      neighbours_[e.from].push_back(e.to);
      neighbours_[e.to].push_back(e.from);
    }
    if (features != nullptr) {
      for (const MeshEdge& e : features->edges) {
        if (e.line) line_[{e.low, e.high}] = *e.line;
      }
    }
    const Box<2> box = mesh.bounding_box();
    for (int i = 0; i < 2; ++i) {
      tolerance_ =
          std::max({tolerance_, kRounding * std::abs(box.lo[i]), kRounding * std::abs(box.hi[i])});
    }
  }

  // Fills path.vertices; the trouble, if there is any.
  std::optional<std::string> walk(LinePath& path) const {
    const auto from = vertex_.find(path.from), to = vertex_.find(path.to);
    for (const auto& [found, end] : {std::pair(from, path.from), std::pair(to, path.to)}) {
      if (found == vertex_.end()) return "its end at " + text::to_text<2>(end) + " is no vertex";
    }
    path.vertices = {from->second};
    while (path.vertices.back() != to->second) {
      const auto next = next_on(path, to->second);
      if (!next) return "no edge on it goes on from " + mesh_.vertex(path.vertices.back());
      path.vertices.push_back(*next);
    }
    return std::nullopt;
  }

 private:
  // The neighbour of the path's last vertex that is on the line and nearer to its end: one that an
  // edge of this line leads to, else the one most nearly straight ahead.
  [[nodiscard]] std::optional<std::uint32_t> next_on(const LinePath& path, std::uint32_t to) const {
    const std::uint32_t here = path.vertices.back();
    std::optional<std::uint32_t> best;
    std::pair<bool, double> best_key;
    for (const std::uint32_t v : neighbours_[here]) {
      if (v != to && !is_between(path, here, v)) continue;
      const Point<2>&o = mesh_.at(here), &p = mesh_.at(v), &end = mesh_.at(to);
      const double ahead = dot(o, p, end);
      const std::pair key(!has_line(here, v, path.line), std::abs(cross(o, p, end)) / ahead);
      if (!best || key < best_key) {
        best = v;
        best_key = key;
      }
    }
    return best;
  }

  // On the line but for rounding, behind `here` and before the end.
  [[nodiscard]] bool is_between(const LinePath& path, std::uint32_t here, std::uint32_t v) const {
    const double length = std::sqrt(dot(path.from, path.to, path.to));
    if (std::abs(cross(path.from, path.to, mesh_.at(v))) > tolerance_ * length) return false;
    const double along = dot(path.from, mesh_.at(v), path.to);
    return along > dot(path.from, mesh_.at(here), path.to) && along < length * length;
  }

  [[nodiscard]] bool has_line(std::uint32_t a, std::uint32_t b, FeatureId line) const {
    const auto found = line_.find(std::minmax(a, b));
    return found != line_.end() && found->second == line;
  }

  const CheckedMesh& mesh_;
  std::map<Point<2>, std::uint32_t> vertex_;
  std::vector<std::vector<std::uint32_t>> neighbours_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, FeatureId> line_;
  double tolerance_ = 0;
};

Point<2> middle(const LinePath& path) {
  return {path.from[0] / 2 + path.to[0] / 2, path.from[1] / 2 + path.to[1] / 2};
}

std::vector<LinePath> pieces_of(const Pslg& graph) {
  std::map<FeatureId, Point<2>> place;
  for (const Pslg::Vertex& p : graph.points) place[p.id] = p.at;
  std::vector<LinePath> pieces;
  for (const Pslg::Segment& s : graph.segments) {
    pieces.push_back({s.id, place.at(s.from), place.at(s.to), {}});
  }
  for (const Pslg::Polyline& line : graph.polylines) {
    for (std::size_t i = 1; i < line.points.size(); ++i) {
      pieces.push_back({line.id, place.at(line.points[i - 1]), place.at(line.points[i]), {}});
    }
  }
  return pieces;
}

// Each edge that names a line is on it.
Verdict check_names(const CheckedMesh& mesh, const MeshFeatures& features,
                    const std::vector<LinePath>& paths) {
  using Named = std::tuple<std::uint32_t, std::uint32_t, FeatureId>;
  std::vector<Named> on;
  for (const LinePath& path : paths) {
    for (std::size_t i = 1; i < path.vertices.size(); ++i) {
      const auto [low, high] = std::minmax(path.vertices[i - 1], path.vertices[i]);
      on.emplace_back(low, high, path.line);
    }
  }
  std::sort(on.begin(), on.end());
  for (const MeshEdge& e : features.edges) {
    if (!e.line || std::binary_search(on.begin(), on.end(), Named(e.low, e.high, *e.line))) {
      continue;
    }
    return Verdict::bad(mesh.edge(e.low, e.high) + " is not on line " +
                        std::to_string(static_cast<std::int64_t>(*e.line)) + ", which it names");
  }
  return Verdict::good("");
}

}  // namespace

PathsVerdict check_segments(const CheckedMesh& mesh, const CheckOptions& options) {
  const SegmentWalk walk(mesh, options.features);
  PathsVerdict all{Verdict::good(""), pieces_of(options.graph->pslg)};
  std::size_t edges = 0, outside = 0;
  for (LinePath& path : all.paths) {
    const auto trouble = walk.walk(path);
    edges += path.vertices.empty() ? 0 : path.vertices.size() - 1;
    if (!trouble || !all.verdict.holds) continue;
    if (path.vertices.empty() && options.boundary != BoundaryRule::box &&
        !mesh.triangle_at(middle(path))) {
      ++outside;
      continue;
    }
    all.verdict = Verdict::bad("line " + std::to_string(static_cast<std::int64_t>(path.line)) +
                               " from " + text::to_text<2>(path.from) + " to " +
                               text::to_text<2>(path.to) + ": " + *trouble);
  }
  if (all.verdict.holds && !all.paths.empty() && options.features != nullptr) {
    all.verdict = check_names(mesh, *options.features, all.paths);
  }
  if (all.verdict.holds) {
    all.verdict.detail = std::to_string(all.paths.size() - outside) + " segments are unions of " +
                         std::to_string(edges) + " edges" +
                         (outside > 0 ? ", " + std::to_string(outside) + " are outside" : "");
  }
  return all;
}

}  // namespace mesher::detail
