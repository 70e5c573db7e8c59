// Nearest neighbours against local feature sizes, of a whole mesh. Segments are found by their
// edges, which are about as long as the disc's radius.
#include "check/shrunk_vertices.hpp"

#include <cmath>
#include <limits>

#include "check/shrink_test.hpp"
#include "geometry/cube_around.hpp"
#include "records/reach_tree.hpp"

namespace mesher::detail {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The input as a mesh has it.
class MeshInput {
 public:
  MeshInput(const Mesh<2>& mesh, const MeshLines& lines, const MeshBox<2>& box)
      : mesh_(mesh), lines_(lines), tree_(box) {
    const auto& places = mesh.vertices;
    for (std::uint32_t e = 0; e < mesh.edges.size(); ++e) {
      const Point<2>&a = places[mesh.edges[e].low], &b = places[mesh.edges[e].high];
      const Point<2> middle{a[0] + (b[0] - a[0]) / 2, a[1] + (b[1] - a[1]) / 2};
      tree_.insert(middle, std::sqrt(distance2(a, b, b)) / 2 * (1 + 0x1p-40), lines.of_edges()[e]);
    }
    for (std::uint32_t v = 0; v < places.size(); ++v) {
      const bool point =
          mesh.kinds[v] == VertexKind::input || mesh.kinds[v] == VertexKind::boundary;
      if (point) tree_.insert(places[v], 0, kPointFeature | v);
    }
  }

  [[nodiscard]] const Point<2>& place(std::uint32_t v) const { return mesh_.vertices[v]; }
  [[nodiscard]] std::vector<std::uint32_t> codes_near(const Point<2>& p, double r) const {
    std::vector<std::uint32_t> near;
    tree_.visit_near(p, p, r, [&](std::uint32_t code) { near.push_back(code); });
    return near;
  }
  [[nodiscard]] std::uint32_t through(std::uint32_t v) const { return lines_.through(v); }
  [[nodiscard]] std::array<std::uint32_t, 2> ends(std::uint32_t s) const {
    return {lines_.segments()[s].a, lines_.segments()[s].b};
  }
  [[nodiscard]] LineId line(std::uint32_t s) const { return lines_.segments()[s].line; }
  template <class Visit>
  void for_each_ending_at(std::uint32_t v, Visit&& visit) const {
    for (const std::uint32_t s : lines_.ending_at(v)) visit(s);
  }
  [[nodiscard]] double degrees(std::uint32_t s, std::uint32_t t, std::uint32_t apex) const {
    return lines_.degrees(s, t, apex);
  }

 private:
  const Mesh<2>& mesh_;
  const MeshLines& lines_;
  ReachTree<std::uint32_t> tree_;
};

// The distances of the nearest neighbours that count.
std::vector<double> nearest_of_all(const Mesh<2>& mesh, const MeshLines& lines) {
  std::vector<double> nearest(mesh.vertices.size(), kInfinity);
  const auto meet = [&](std::uint32_t v, std::uint32_t w) {
    const double length = lines.distance(v, w);
    if (length >= nearest[v] && length >= nearest[w]) return;
    if (!lines.wedges_across(v, w, true).empty()) return;
    nearest[v] = std::min(nearest[v], length);
    nearest[w] = std::min(nearest[w], length);
  };
  for (const auto& t : mesh.simplices) {
    for (std::size_t i = 0; i < 3; ++i) meet(t[i], t[(i + 1) % 3]);
  }
  return nearest;
}

}  // namespace

std::vector<ShrunkVertex> shrunk_vertices(const Mesh<2>& mesh, const MeshLines& lines,
                                          double allowed) {
  const MeshBox<2> box = cube_around<2>(mesh.vertices);
  const MeshInput input(mesh, lines, box);
  const ShrinkTest<MeshInput> test(input, allowed, box.side);
  const std::vector<double> nearest = nearest_of_all(mesh, lines);
  std::vector<ShrunkVertex> found;
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
    if (mesh.kinds[v] == VertexKind::boundary || nearest[v] == kInfinity) continue;
    if (test.has_shrunk(v, nearest[v])) found.push_back(test.report(v, nearest[v]));
  }
  return found;
}

}  // namespace mesher::detail
