// What the single checks of a mesh share: its sides, by edge, and how parts are named to people.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "check/verdict.hpp"
#include "mesher/check.hpp"

namespace mesher::detail {

/// A directed edge of a triangle, and the triangle's corner opposite to it.
struct HalfEdge {
  std::uint32_t from, to, opposite;
  std::size_t triangle;

  [[nodiscard]] std::uint32_t low() const { return std::min(from, to); }
  [[nodiscard]] std::uint32_t high() const { return std::max(from, to); }
  [[nodiscard]] std::pair<std::uint32_t, std::uint32_t> edge() const { return {low(), high()}; }
};

/// A mesh with its half-edges by edge. Requires: corners name vertices.
class CheckedMesh {
 public:
  explicit CheckedMesh(const Mesh<2>& mesh);

  [[nodiscard]] const Mesh<2>& mesh() const { return mesh_; }
  [[nodiscard]] const Point<2>& at(std::size_t v) const { return mesh_.vertices[v]; }
  /// The half-edges of one edge are neighbours, edges ascend by (low, high).
  [[nodiscard]] const std::vector<HalfEdge>& half_edges() const { return half_edges_; }
  /// How many half-edges from i on are of i's edge.
  [[nodiscard]] std::size_t partners(std::size_t i) const;
  [[nodiscard]] bool has_edge(std::uint32_t low, std::uint32_t high) const;
  /// The half-edges that have no partner. Requires: no edge has more than two triangles.
  [[nodiscard]] std::vector<HalfEdge> border() const;
  [[nodiscard]] Box<2> bounding_box() const;
  /// The first triangle that holds p, its sides included. Cost: O(m).
  [[nodiscard]] std::optional<std::size_t> triangle_at(const Point<2>& p) const;

  /// "vertex 5 at (0, 1)", counted from 1, and the like.
  [[nodiscard]] std::string vertex(std::size_t v) const;
  [[nodiscard]] std::string edge(const HalfEdge& e) const;
  [[nodiscard]] std::string edge(std::uint32_t from, std::uint32_t to) const;
  [[nodiscard]] std::string triangle(std::size_t i) const;

 private:
  const Mesh<2>& mesh_;
  std::vector<HalfEdge> half_edges_;
};

/// Edges on lines of the input, as pairs (low, high), ascending.
using LineEdges = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

[[nodiscard]] inline bool contains(const LineEdges& edges, const HalfEdge& e) {
  return std::binary_search(edges.begin(), edges.end(), e.edge());
}

/// (5') Requires: (1) to (4).
[[nodiscard]] Verdict check_overlap(const CheckedMesh& mesh);

/// A segment of the input, or a piece of a polyline, and the vertices that make it up.
struct LinePath {
  LineId line;
  Point<2> from, to;
  std::vector<std::uint32_t> vertices;  ///< from end to end
  std::vector<std::uint32_t> alone{};   ///< on the line, but on no edge of it
};

/// What (b) says, and the paths as far as they were found.
struct PathsVerdict {
  Verdict verdict;
  std::vector<LinePath> paths;
};
/// Lines may lie outside of what is meshed, unless the mesh fills a box.
[[nodiscard]] PathsVerdict check_segments(const CheckedMesh& mesh, const CheckOptions<2>& options);

/// The lines that a mesh itself tells of: its edges on lines, ascending, joined where two of one
/// line go straight on. Several segments in a row may be one path.
[[nodiscard]] std::vector<LinePath> drawn_paths(const CheckedMesh& mesh,
                                                const std::vector<MeshEdge>& edges);

/// (d)
[[nodiscard]] Verdict check_regions(const CheckedMesh& mesh, const LineEdges& on_lines,
                                    const CheckOptions<2>& options);

/// Whether (f) is asked: the input has markers, and the mesh does.
[[nodiscard]] bool tells_markers(const CheckOptions<2>& options);
/// (f), with the paths of all lines. Requires: tells_markers(options).
[[nodiscard]] Verdict check_markers(const CheckedMesh& mesh, const std::vector<LinePath>& paths,
                                    const CheckOptions<2>& options);

/// (9), with triangles excused whose shortest edge joins two of `paths` that leave one point at
/// under 60 degrees.
[[nodiscard]] Verdict check_quality(const CheckedMesh& mesh, double rho,
                                    const std::vector<LinePath>& paths);

}  // namespace mesher::detail
