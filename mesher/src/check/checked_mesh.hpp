// What the single checks of a mesh share: its sides, which are edges of triangles and faces of
// tetrahedra, and how parts are named to people. D is 2 or 3.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "check/check_parts.hpp"
#include "check/verdict.hpp"
#include "geometry/box.hpp"
#include "mesh/half_faces.hpp"
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

/// The half-edges of one edge are neighbours, edges ascend by (low, high).
class HalfEdges {
 public:
  explicit HalfEdges(const std::vector<Mesh<2>::Simplex>& triangles);

  [[nodiscard]] std::size_t size() const { return all_.size(); }
  [[nodiscard]] const HalfEdge& operator[](std::size_t i) const { return all_[i]; }
  /// How many half-edges from i on are of i's edge.
  [[nodiscard]] std::size_t partners(std::size_t i) const;
  [[nodiscard]] bool has_edge(std::uint32_t low, std::uint32_t high) const;
  /// The half-edges that have no partner.
  [[nodiscard]] std::vector<HalfEdge> border() const;

 private:
  std::vector<HalfEdge> all_;
};

template <int D>
using HalfSide = std::conditional_t<D == 2, HalfEdge, HalfFace>;
template <int D>
using HalfSides = std::conditional_t<D == 2, HalfEdges, HalfFaces>;

[[nodiscard]] inline std::array<std::uint32_t, 2> corners_of(const HalfEdge& e) {
  return {e.from, e.to};
}
[[nodiscard]] inline std::array<std::uint32_t, 3> corners_of(const HalfFace& f) { return f.face; }
[[nodiscard]] inline std::size_t simplex_of(const HalfEdge& e) { return e.triangle; }
[[nodiscard]] inline std::size_t simplex_of(const HalfFace& f) { return f.tetrahedron; }

/// A mesh with its half-sides by side. Requires: corners name vertices.
template <int D>
class CheckedMesh {
 public:
  explicit CheckedMesh(const Mesh<D>& mesh) : mesh_(mesh), sides_(mesh.simplices) {}

  [[nodiscard]] const Mesh<D>& mesh() const { return mesh_; }
  [[nodiscard]] const Point<D>& at(std::size_t v) const { return mesh_.vertices[v]; }
  [[nodiscard]] const HalfSides<D>& sides() const { return sides_; }
  template <std::size_t N>
  [[nodiscard]] std::array<Point<D>, N> places_of(const std::array<std::uint32_t, N>& all) const {
    std::array<Point<D>, N> places;
    for (std::size_t i = 0; i < N; ++i) places[i] = at(all[i]);
    return places;
  }
  [[nodiscard]] Box<D> bounding_box() const { return detail::bounding_box<D>(mesh_.vertices); }
  /// The first simplex that holds p, its boundary included. Cost: O(m).
  [[nodiscard]] std::optional<std::size_t> simplex_at(const Point<D>& p) const;

  /// "vertex 5 at (0, 1)", counted from 1, and the like.
  [[nodiscard]] std::string vertex(std::size_t v) const { return vertex_name(mesh_, v); }
  [[nodiscard]] std::string edge(std::uint32_t from, std::uint32_t to) const {
    return "the edge from " + vertex(from) + " to " + vertex(to);
  }
  [[nodiscard]] std::string side(const HalfEdge& e) const { return edge(e.from, e.to); }
  [[nodiscard]] std::string side(const HalfFace& f) const { return face(f.key()); }
  [[nodiscard]] std::string face(const Face& key) const {
    const auto [a, b, c] = key;
    return "the face of " + vertex(a) + ", " + vertex(b) + " and " + vertex(c);
  }
  [[nodiscard]] std::string simplex(std::size_t i) const { return simplex_name(mesh_, i); }

 private:
  const Mesh<D>& mesh_;
  HalfSides<D> sides_;
};

/// `box` if the mesh fills its bounding box, of which a corner is no point of the graph; else
/// `lines`.
template <int D>
[[nodiscard]] BoundaryRule rule_of(const CheckedMesh<D>& mesh, const Graph<D>& graph);

/// Whether the mesh need not have what lines, or polygons, do not enclose. (In space `any` is a
/// convex body, that of all.)
template <int D>
[[nodiscard]] bool may_leave_out(const CheckOptions<D>& options) {
  return D == 2 ? options.boundary != BoundaryRule::box : options.boundary == BoundaryRule::lines;
}

/// Whether all points of the input are vertices, bit for bit, but those that may be outside and
/// are. Requires: options.graph.
template <int D>
[[nodiscard]] Verdict check_input(const CheckedMesh<D>& mesh, const CheckOptions<D>& options);

// --- Of triangles ----------------------------------------------------------------------------

/// Edges on lines of the input, as pairs (low, high), ascending.
using LineEdges = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

[[nodiscard]] inline bool contains(const LineEdges& edges, const HalfEdge& e) {
  return std::binary_search(edges.begin(), edges.end(), e.edge());
}

/// (5') Requires: (1) to (4).
[[nodiscard]] Verdict check_overlap(const CheckedMesh<2>& mesh);

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
[[nodiscard]] PathsVerdict check_segments(const CheckedMesh<2>& mesh,
                                          const CheckOptions<2>& options);

/// The lines that a mesh itself tells of: its edges on lines, ascending, joined where two of one
/// line go straight on. Several segments in a row may be one path.
[[nodiscard]] std::vector<LinePath> drawn_paths(const CheckedMesh<2>& mesh,
                                                const std::vector<MeshEdge>& edges);

/// (f), with the paths of all lines. Requires: tells_markers(options) (marked.hpp).
[[nodiscard]] Verdict check_markers(const CheckedMesh<2>& mesh, const std::vector<LinePath>& paths,
                                    const CheckOptions<2>& options);

/// (9), with triangles excused whose shortest edge joins two of `paths` that leave one point at
/// under 60 degrees.
[[nodiscard]] Verdict check_quality(const CheckedMesh<2>& mesh, double rho,
                                    const std::vector<LinePath>& paths);

}  // namespace mesher::detail
