// Whether vertices and edges have the markers of the input's points and lines.
#include <algorithm>
#include <map>
#include <set>

#include "check/checked_mesh.hpp"
#include "check/marked.hpp"

namespace mesher::detail {
namespace {

class MarkerCheck {
 public:
  MarkerCheck(const CheckedMesh<2>& mesh, const std::vector<LinePath>& paths,
              const CheckOptions<2>& options)
      : mesh_(mesh), features_(*options.features), points_(*options.graph) {
    add(options.graph->graph.segments, options.graph->segments);
    add(options.graph->graph.polylines, options.graph->polylines);
    for (const LinePath& path : paths) add(path);
    for (const HalfEdge& e : mesh.sides().border()) {
      border_.insert(e.edge());
      border_vertices_.insert({e.from, e.to});
    }
  }

  [[nodiscard]] Verdict run() const {
    std::size_t vertices = 0, edges = 0;
    for (std::uint32_t v = 0; v < features_.markers.size(); ++v) {
      const std::string trouble = trouble_at(v);
      if (!trouble.empty()) return Verdict::bad(mesh_.vertex(v) + trouble);
      if (features_.markers[v] != 0) ++vertices;
    }
    const auto markers = markers_of_edges();
    for (const auto& [edge, marker] : markers) {
      const std::string trouble = trouble_at(edge, marker);
      if (!trouble.empty()) return Verdict::bad(mesh_.edge(edge.first, edge.second) + trouble);
      if (marker != 0) ++edges;
    }
    return Verdict::good(std::to_string(vertices) + " vertices and " + std::to_string(edges) +
                         " edges have one");
  }

 private:
  using Edge = std::pair<std::uint32_t, std::uint32_t>;

  template <class Line>
  void add(const std::vector<Line>& lines, const std::vector<FilePosition>& positions) {
    for (std::size_t i = 0; i < lines.size(); ++i) {
      lines_[lines[i].id] = marked(lines[i].marker, "line", lines[i].id, positions, i);
    }
  }
  void add(const LinePath& path) {
    const Marked* const line = &lines_.at(path.line);
    for (const std::uint32_t v : path.alone) at_vertex_[v].push_back(line);
    for (std::size_t i = 0; i < path.vertices.size(); ++i) {
      at_vertex_[path.vertices[i]].push_back(line);
      if (i > 0) at_edge_[std::minmax(path.vertices[i - 1], path.vertices[i])].push_back(line);
    }
  }

  [[nodiscard]] std::string trouble_at(std::uint32_t v) const {
    const std::int64_t marker = features_.markers[v];
    if (const auto trouble = points_.trouble(marker, mesh_.at(v))) return *trouble;
    const auto lines = at_vertex_.find(v);
    return marker_trouble(marker, lines == at_vertex_.end() ? Givers() : lines->second,
                          border_vertices_.contains(v), "line");
  }

  [[nodiscard]] std::string trouble_at(const Edge& edge, std::int64_t marker) const {
    const auto lines = at_edge_.find(edge);
    return marker_trouble(marker, lines == at_edge_.end() ? Givers() : lines->second,
                          border_.contains(edge), "line");
  }

  // Of the edges that the mesh lists and of those on lines; nothing if no edge has a marker: then
  // the file does not tell them.
  [[nodiscard]] std::map<Edge, std::int64_t> markers_of_edges() const {
    std::map<Edge, std::int64_t> markers;
    if (!has_marker(features_.edges)) return markers;
    for (const auto& [edge, lines] : at_edge_) markers[edge] = 0;
    for (const MeshEdge& e : features_.edges) markers[{e.low, e.high}] = e.marker;
    return markers;
  }

  const CheckedMesh<2>& mesh_;
  const MeshFeatures& features_;
  MarkedPoints<2> points_;
  std::map<LineId, Marked> lines_;
  std::map<std::uint32_t, Givers> at_vertex_;
  std::map<Edge, Givers> at_edge_;
  std::set<Edge> border_;
  std::set<std::uint32_t> border_vertices_;
};

}  // namespace

Verdict check_markers(const CheckedMesh<2>& mesh, const std::vector<LinePath>& paths,
                      const CheckOptions<2>& options) {
  return MarkerCheck(mesh, paths, options).run();
}

}  // namespace mesher::detail
