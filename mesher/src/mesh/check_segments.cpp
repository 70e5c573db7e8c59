// Whether the lines of the input are unions of edges: a walk from end to end of each.
#include <algorithm>
#include <map>
#include <optional>
#include <tuple>

#include "io/text.hpp"
#include "mesh/checked_mesh.hpp"
#include "mesh/line_walk.hpp"

namespace mesher::detail {
namespace {

LineWalk<2> walk_of(const CheckedMesh& mesh) {
  LineWalk<2> walk(mesh.mesh());
  for (std::size_t i = 0; i < mesh.half_edges().size(); i += mesh.partners(i)) {
    walk.add_edge(mesh.half_edges()[i].from, mesh.half_edges()[i].to);
  }
  return walk;
}

using LinesOfEdges = std::map<std::pair<std::uint32_t, std::uint32_t>, FeatureId>;
LinesOfEdges lines_of(const MeshFeatures* features) {
  LinesOfEdges lines;
  if (features == nullptr) return lines;
  for (const MeshEdge& e : features->edges) {
    if (e.line) lines[{e.low, e.high}] = *e.line;
  }
  return lines;
}

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
  const LineWalk<2> walk = walk_of(mesh);
  const LinesOfEdges lines = lines_of(options.features);
  PathsVerdict all{Verdict::good(""), pieces_of(options.graph->pslg)};
  std::size_t edges = 0, outside = 0;
  for (LinePath& path : all.paths) {
    const auto trouble = walk.find(path, [&](std::uint32_t a, std::uint32_t b) {
      const auto found = lines.find(std::minmax(a, b));
      return found != lines.end() && found->second == path.line;
    });
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
