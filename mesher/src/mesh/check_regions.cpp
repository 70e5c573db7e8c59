// Whether regions end at lines alone, and are those of their seeds.
#include <map>
#include <numeric>
#include <set>

#include "io/text.hpp"
#include "mesh/checked_mesh.hpp"

namespace mesher::detail {
namespace {

// Triangles that hang together across edges on no line.
class Parts {
 public:
  explicit Parts(std::size_t n) : parent_(n) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t find(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::size_t a, std::size_t b) { parent_[find(a)] = find(b); }

 private:
  std::vector<std::size_t> parent_;
};

Verdict check_holes(const CheckedMesh& mesh, const Pslg& graph) {
  for (const Pslg::Hole& hole : graph.holes) {
    const auto triangle = mesh.triangle_at(hole.seed);
    if (!triangle) continue;
    return Verdict::bad(mesh.triangle(*triangle) + " holds the seed of hole " +
                        std::to_string(static_cast<std::int64_t>(hole.id)) + " at " +
                        text::to_text<2>(hole.seed));
  }
  return Verdict::good("");
}

Verdict check_seeds(const CheckedMesh& mesh, const Pslg& graph, const std::vector<double>& regions,
                    Parts& parts) {
  std::map<std::size_t, std::set<double>> seeded;
  std::vector<std::pair<const Pslg::Region*, std::size_t>> found;
  for (const Pslg::Region& region : graph.regions) {
    const auto triangle = mesh.triangle_at(region.seed);
    if (!triangle) continue;  // outside of what is meshed
    seeded[parts.find(*triangle)].insert(region.attribute);
    found.emplace_back(&region, *triangle);
  }
  for (const auto& [region, triangle] : found) {
    if (seeded[parts.find(triangle)].count(regions[triangle]) > 0) continue;
    return Verdict::bad(mesh.triangle(triangle) + " has the region " +
                        text::to_text(regions[triangle]) + ", the seed in it at " +
                        text::to_text<2>(region->seed) + " " + text::to_text(region->attribute));
  }
  return Verdict::good("");
}

}  // namespace

Verdict check_regions(const CheckedMesh& mesh, const LineEdges& on_lines,
                      const CheckOptions& options) {
  const std::size_t n = mesh.mesh().simplices.size();
  const bool known = options.features != nullptr && !options.features->regions.empty();
  const std::vector<double> regions = known ? options.features->regions : std::vector<double>(n);
  Parts parts(n);
  const auto& half_edges = mesh.half_edges();
  for (std::size_t i = 0; i < half_edges.size(); i += mesh.partners(i)) {
    if (mesh.partners(i) != 2 || contains(on_lines, half_edges[i])) continue;
    const std::size_t a = half_edges[i].triangle, b = half_edges[i + 1].triangle;
    parts.join(a, b);
    if (regions[a] == regions[b]) continue;
    return Verdict::bad("the regions " + text::to_text(regions[a]) + " and " +
                        text::to_text(regions[b]) + " meet at " + mesh.edge(half_edges[i]) +
                        ", which is on no line");
  }
  if (options.graph != nullptr) {
    const Verdict holes = check_holes(mesh, options.graph->pslg);
    if (!holes.holds) return holes;
    if (known) {
      const Verdict seeds = check_seeds(mesh, options.graph->pslg, regions, parts);
      if (!seeds.holds) return seeds;
    }
  }
  const std::set<double> distinct(regions.begin(), regions.end());
  return Verdict::good(std::to_string(distinct.size()) + " regions, none across an edge off lines");
}

}  // namespace mesher::detail
