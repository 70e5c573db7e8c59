// Whether the lines of the input are unions of edges: a walk from end to end of each.
#include <algorithm>
#include <map>
#include <optional>
#include <tuple>

#include "check/checked_mesh.hpp"
#include "check/line_walk.hpp"
#include "text/id_text.hpp"

namespace mesher::detail {
namespace {

LineWalk<2> walk_of(const CheckedMesh<2>& mesh) {
  LineWalk<2> walk(mesh.mesh());
  const HalfEdges& edges = mesh.sides();
  for (std::size_t i = 0; i < edges.size(); i += edges.partners(i)) {
    walk.add_edge(edges[i].from, edges[i].to);
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

std::vector<LinePath> pieces_of(const Graph<2>& graph) {
  std::map<PointId, Point<2>> place;
  for (const GraphPoint<2>& p : graph.points) place[p.id] = p.at;
  std::vector<LinePath> pieces;
  for (const mesher::Segment& s : segments_of(graph)) {
    pieces.push_back({s.id, place.at(s.from), place.at(s.to), {}});
  }
  return pieces;
}

// Each edge that names a line is on it.
Verdict check_names(const CheckedMesh<2>& mesh, const MeshFeatures& features,
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
    return Verdict::bad(mesh.edge(e.low, e.high) + " is not on line " + id_text(*e.line) +
                        ", which it names");
  }
  return Verdict::good("");
}

}  // namespace

PathsVerdict check_segments(const CheckedMesh<2>& mesh, const CheckOptions<2>& options) {
  const LineWalk<2> walk = walk_of(mesh);
  const LinesOfEdges lines = lines_of(options.features);
  const Outside<2> outside(mesh, walk, options.boundary);
  WalkedLines<2> all;
  std::vector<LinePath> paths;
  for (const LinePath& piece : pieces_of(options.graph->graph)) {
    const auto is_known = [&](std::uint32_t a, std::uint32_t b) {
      const auto found = lines.find(std::minmax(a, b));
      return found != lines.end() && found->second == piece.line;
    };
    auto way = walk.find(piece.from, piece.to, is_known, outside);
    all.add("line " + id_text(piece.line), piece.from, piece.to, way);
    if (way.runs.empty()) paths.push_back(piece);
    for (auto& run : way.runs) paths.push_back({piece.line, piece.from, piece.to, std::move(run)});
    if (!paths.empty()) paths.back().alone = std::move(way.alone);
  }
  Verdict verdict = all.verdict("segments");
  if (verdict.holds && !paths.empty() && options.features != nullptr) {
    const Verdict names = check_names(mesh, *options.features, paths);
    if (!names.holds) verdict = names;
  }
  return {std::move(verdict), std::move(paths)};
}

}  // namespace mesher::detail
