// A grid of n x n unit squares, each cut in two by a diagonal, with walls between squares.
#pragma once

#include <array>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "mesher/domain.hpp"

namespace support {

using Corners = std::array<std::uint32_t, 3>;
using Edge = std::array<std::uint32_t, 2>;

/// Vertices are numbered in lexicographic order of their places, so the mesh is canonical.
class WalledGrid {
 public:
  explicit WalledGrid(int n) : n_(n) {}

  [[nodiscard]] std::uint32_t vertex(int x, int y) const {
    return static_cast<std::uint32_t>(x * (n_ + 1) + y);
  }
  [[nodiscard]] mesher::Point<2> place(std::uint32_t v) const {
    const int i = static_cast<int>(v);
    return {static_cast<double>(i / (n_ + 1)), static_cast<double>(i % (n_ + 1))};
  }
  /// The two triangles of a square, cut from (x, y) to (x + 1, y + 1) or, flipped, the other way.
  [[nodiscard]] std::array<Corners, 2> square(int x, int y, bool flipped = false) const {
    const std::uint32_t a = vertex(x, y), b = vertex(x + 1, y), c = vertex(x + 1, y + 1),
                        d = vertex(x, y + 1);
    if (flipped) return {Corners{a, b, d}, Corners{d, b, c}};
    return {Corners{a, b, c}, Corners{a, c, d}};
  }
  [[nodiscard]] std::vector<Corners> triangles() const {
    std::vector<Corners> all;
    for (int x = 0; x < n_; ++x) {
      for (int y = 0; y < n_; ++y) {
        for (const Corners& t : square(x, y)) all.push_back(t);
      }
    }
    return all;
  }
  /// The sides of a rectangle of squares, lower left to upper right.
  [[nodiscard]] std::vector<Edge> rectangle(int x0, int y0, int x1, int y1) const {
    std::vector<Edge> all;
    append(all, line(x0, y0, x1, y0));
    append(all, line(x0, y1, x1, y1));
    append(all, line(x0, y0, x0, y1));
    append(all, line(x1, y0, x1, y1));
    return all;
  }
  /// Upright or level, both ends' coordinates ascending.
  [[nodiscard]] std::vector<Edge> line(int x0, int y0, int x1, int y1) const {
    std::vector<Edge> all;
    for (int x = x0; x < x1; ++x) all.push_back({vertex(x, y0), vertex(x + 1, y0)});
    for (int y = y0; y < y1; ++y) all.push_back({vertex(x0, y), vertex(x0, y + 1)});
    return all;
  }
  static void append(std::vector<Edge>& to, const std::vector<Edge>& more) {
    to.insert(to.end(), more.begin(), more.end());
  }

  /// The mesh in canonical form.
  [[nodiscard]] mesher::Mesh<2> mesh() const {
    mesher::Mesh<2> m;
    for (std::uint32_t v = 0; v < vertex(n_, n_) + 1; ++v) m.vertices.push_back(place(v));
    m.kinds.assign(m.vertices.size(), mesher::VertexKind::steiner);
    m.simplices = triangles();
    for (auto& t : m.simplices)
      std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    std::sort(m.simplices.begin(), m.simplices.end());
    return m;
  }
  [[nodiscard]] static std::vector<mesher::MeshEdge> as_walls(
      const std::vector<Edge>& edges, mesher::LineId line = mesher::LineId{1},
      std::int64_t marker = 0) {
    std::vector<mesher::MeshEdge> walls;
    for (const Edge& e : std::set<Edge>(edges.begin(), edges.end())) {
      walls.push_back({std::min(e[0], e[1]), std::max(e[0], e[1]), line, marker});
    }
    return walls;
  }
  [[nodiscard]] int size() const { return n_; }

 private:
  int n_;
};

[[nodiscard]] inline mesher::Seed<2> hole(std::int64_t id, double x, double y) {
  return mesher::hole_seed<2>(id, {x, y});
}
[[nodiscard]] inline mesher::Seed<2> region(std::int64_t id, double x, double y,
                                            double attribute = 0) {
  return mesher::region_seed<2>(id, {x, y}, attribute);
}

}  // namespace support
