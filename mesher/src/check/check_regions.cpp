// Whether regions end at lines alone, and are those of their seeds.
#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "check/checked_mesh.hpp"
#include "mesher/predicates.hpp"
#include "sets/union_find.hpp"
#include "text/text.hpp"

namespace mesher::detail {
namespace {

// The triangle that a seed stands for; nothing if it is outside, or on a line, where it stands for
// neither side.
std::optional<std::size_t> triangle_of(const Point<2>& seed, const CheckedMesh& mesh,
                                       const LineEdges& on_lines) {
  const auto is_on = [&](const auto& edge) {
    const Point<2>&a = mesh.at(edge.first), &b = mesh.at(edge.second);
    const auto [left, right] = std::minmax(a[0], b[0]);
    const auto [below, above] = std::minmax(a[1], b[1]);
    return seed[0] >= left && seed[0] <= right && seed[1] >= below && seed[1] <= above &&
           predicates::orient2d(a, b, seed) == 0;
  };
  if (std::any_of(on_lines.begin(), on_lines.end(), is_on)) return std::nullopt;
  return mesh.triangle_at(seed);
}

Verdict check_holes(const CheckedMesh& mesh, const LineEdges& on_lines, const Graph<2>& graph) {
  for (const Seed<2>& hole : graph.holes()) {
    const auto triangle = triangle_of(hole.at, mesh, on_lines);
    if (!triangle) continue;
    return Verdict::bad(mesh.triangle(*triangle) + " holds the seed of " + text_of(hole.id) +
                        " at " + text::to_text<2>(hole.at));
  }
  return Verdict::good("");
}

Verdict check_seeds(const CheckedMesh& mesh, const LineEdges& on_lines, const Graph<2>& graph,
                    const std::vector<double>& regions, UnionFind& parts) {
  std::map<std::uint32_t, std::set<double>> seeded;
  std::vector<std::pair<const Seed<2>*, std::uint32_t>> found;
  std::set<std::uint32_t> in_holes;  // parts, in which no region's seed stands for anything
  for (const Seed<2>& hole : graph.holes()) {
    const auto triangle = triangle_of(hole.at, mesh, on_lines);
    if (triangle) in_holes.insert(parts.find(static_cast<std::uint32_t>(*triangle)));
  }
  for (const Seed<2>& region : graph.seeds) {
    if (region.id.kind != SeedKind::region) continue;
    const auto seeded_triangle = triangle_of(region.at, mesh, on_lines);
    if (!seeded_triangle) continue;
    const auto triangle = static_cast<std::uint32_t>(*seeded_triangle);
    if (in_holes.count(parts.find(triangle)) > 0) continue;
    seeded[parts.find(triangle)].insert(region.attribute);
    found.emplace_back(&region, triangle);
  }
  for (const auto& [region, triangle] : found) {
    if (seeded[parts.find(triangle)].count(regions[triangle]) > 0) continue;
    return Verdict::bad(mesh.triangle(triangle) + " has the region " +
                        text::to_text(regions[triangle]) + ", the seed in it at " +
                        text::to_text<2>(region->at) + " " + text::to_text(region->attribute));
  }
  return Verdict::good("");
}

}  // namespace

Verdict check_regions(const CheckedMesh& mesh, const LineEdges& on_lines,
                      const CheckOptions<2>& options) {
  const std::size_t n = mesh.mesh().simplices.size();
  const bool known = options.features != nullptr && !options.features->regions.empty();
  const std::vector<double> regions = known ? options.features->regions : std::vector<double>(n);
  UnionFind parts(n);  // triangles that hang together across edges on no line
  const auto& half_edges = mesh.half_edges();
  for (std::size_t i = 0; i < half_edges.size(); i += mesh.partners(i)) {
    if (mesh.partners(i) != 2 || contains(on_lines, half_edges[i])) continue;
    const std::size_t a = half_edges[i].triangle, b = half_edges[i + 1].triangle;
    parts.unite(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b));
    if (regions[a] == regions[b]) continue;
    return Verdict::bad("the regions " + text::to_text(regions[a]) + " and " +
                        text::to_text(regions[b]) + " meet at " + mesh.edge(half_edges[i]) +
                        ", which is on no line");
  }
  if (options.graph != nullptr) {
    const Graph<2>& graph = options.graph->graph;
    if (options.boundary != BoundaryRule::box) {
      const Verdict holes = check_holes(mesh, on_lines, graph);
      if (!holes.holds) return holes;
    }
    if (known) {
      const Verdict seeds = check_seeds(mesh, on_lines, graph, regions, parts);
      if (!seeds.holds) return seeds;
    }
  }
  const std::set<double> distinct(regions.begin(), regions.end());
  return Verdict::good(std::to_string(distinct.size()) + " regions, none across an edge off lines");
}

}  // namespace mesher::detail
