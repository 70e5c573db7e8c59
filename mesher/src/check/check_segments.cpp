// Whether the lines of the input are unions of edges: a walk from end to end of each.
#include <algorithm>
#include <map>
#include <optional>
#include <tuple>

#include "check/checked_mesh.hpp"
#include "check/line_walk.hpp"
#include "text/text.hpp"

namespace mesher::detail {
namespace {

LineWalk<2> walk_of(const CheckedMesh& mesh) {
  LineWalk<2> walk(mesh.mesh());
  for (std::size_t i = 0; i < mesh.half_edges().size(); i += mesh.partners(i)) {
    walk.add_edge(mesh.half_edges()[i].from, mesh.half_edges()[i].to);
  }
  return walk;
}

using LinesOfEdges = std::map<std::pair<std::uint32_t, std::uint32_t>, LineId>;
LinesOfEdges lines_of(const MeshFeatures* features) {
  LinesOfEdges lines;
  if (features == nullptr) return lines;
  for (const MeshEdge& e : features->edges) {
    if (e.line) lines[{e.low, e.high}] = *e.line;
  }
  return lines;
}

// Asks whether all between two places is outside of what is meshed.
class Outside {
 public:
  Outside(const CheckedMesh& mesh, const LineWalk<2>& walk, BoundaryRule rule)
      : mesh_(mesh), walk_(walk), rule_(rule) {
    border_ = mesh.border();
  }
  // Of a boundary that is not judged a piece between two vertices may be lost.
  [[nodiscard]] bool operator()(const Point<2>& p, const Point<2>& q) const {
    if (rule_ == BoundaryRule::any && walk_.vertex_at(p) && walk_.vertex_at(q)) return false;
    if (rule_ == BoundaryRule::box) return false;
    if (mesh_.triangle_at({p[0] / 2 + q[0] / 2, p[1] / 2 + q[1] / 2})) return false;
    return std::none_of(border_.begin(), border_.end(), [&](const HalfEdge& e) {
      return goes_through(p, q, {mesh_.at(e.from), mesh_.at(e.to)});
    });
  }

 private:
  const CheckedMesh& mesh_;
  const LineWalk<2>& walk_;
  BoundaryRule rule_;
  std::vector<HalfEdge> border_;
};

std::vector<LinePath> pieces_of(const Graph<2>& graph) {
  std::map<PointId, Point<2>> place;
  for (const GraphPoint<2>& p : graph.points) place[p.id] = p.at;
  std::vector<LinePath> pieces;
  for (const mesher::Segment& s : graph.segments) {
    pieces.push_back({s.id, place.at(s.from), place.at(s.to), {}});
  }
  for (const mesher::Polyline& line : graph.polylines) {
    for (std::size_t i = 1; i < line.points.size(); ++i) {
      pieces.push_back({line.id, place.at(line.points[i - 1]), place.at(line.points[i]), {}});
    }
  }
  return pieces;
}

// Each edge that names a line is on it.
Verdict check_names(const CheckedMesh& mesh, const MeshFeatures& features,
                    const std::vector<LinePath>& paths) {
  using Named = std::tuple<std::uint32_t, std::uint32_t, LineId>;
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

PathsVerdict check_segments(const CheckedMesh& mesh, const CheckOptions<2>& options) {
  const LineWalk<2> walk = walk_of(mesh);
  const LinesOfEdges lines = lines_of(options.features);
  const Outside outside(mesh, walk, options.boundary);
  PathsVerdict all{Verdict::good(""), {}};
  std::size_t segments = 0, edges = 0, left_out = 0, cut = 0;
  for (const LinePath& piece : pieces_of(options.graph->graph)) {
    const auto is_known = [&](std::uint32_t a, std::uint32_t b) {
      const auto found = lines.find(std::minmax(a, b));
      return found != lines.end() && found->second == piece.line;
    };
    auto way = walk.find(piece.from, piece.to, is_known, outside);
    if (way.trouble && all.verdict.holds) {
      all.verdict = Verdict::bad("line " + std::to_string(static_cast<std::int64_t>(piece.line)) +
                                 " from " + text::to_text<2>(piece.from) + " to " +
                                 text::to_text<2>(piece.to) + ": " + *way.trouble);
    }
    (way.runs.empty() ? left_out : segments) += 1;
    cut += way.runs.empty() || way.is_whole ? 0 : 1;
    if (way.runs.empty()) all.paths.push_back(piece);
    for (auto& run : way.runs) {
      edges += run.size() - 1;
      all.paths.push_back({piece.line, piece.from, piece.to, std::move(run)});
    }
    if (!all.paths.empty()) all.paths.back().alone = std::move(way.alone);
  }
  if (all.verdict.holds && !all.paths.empty() && options.features != nullptr) {
    all.verdict = check_names(mesh, *options.features, all.paths);
  }
  if (all.verdict.holds) {
    all.verdict.detail = std::to_string(segments) + " segments are unions of " +
                         std::to_string(edges) + " edges" + outside_text(left_out, cut);
  }
  return all;
}

}  // namespace mesher::detail
