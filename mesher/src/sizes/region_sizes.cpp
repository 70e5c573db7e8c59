// Fields from the regions of a mesh, and the least of several.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "mesher/domain_mesh.hpp"
#include "mesher/sizes.hpp"
#include "sizes/facet_sizes.hpp"

namespace mesher {

namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

class LeastSizes final : public SizeField<2> {
 public:
  explicit LeastSizes(std::vector<std::shared_ptr<const SizeField<2>>> fields)
      : fields_(std::move(fields)) {}

  [[nodiscard]] double at(const Point<2>& p) const override {
    double least = kInfinite;
    for (const auto& f : fields_) least = std::min(least, f->at(p));
    return least;
  }
  [[nodiscard]] SizeRange range(const Box<2>& box) const override {
    SizeRange least{kInfinite, kInfinite};
    for (const auto& f : fields_) {
      const SizeRange r = f->range(box);
      least = {std::min(least.least, r.least), std::min(least.most, r.most)};
    }
    return least;
  }

 private:
  std::vector<std::shared_ptr<const SizeField<2>>> fields_;
};

}  // namespace

double size_of_area(double area) { return std::sqrt(area / kAreaOfSize); }

std::shared_ptr<const SizeField<2>> least_sizes(
    std::vector<std::shared_ptr<const SizeField<2>>> fields) {
  std::erase(fields, nullptr);
  if (fields.size() < 2) return fields.empty() ? nullptr : fields.front();
  return std::make_shared<LeastSizes>(std::move(fields));
}

std::shared_ptr<const SizeField<2>> region_sizes(const Mesh<2>& mesh, const Domain& domain) {
  std::vector<detail::Facet> facets;
  std::vector<double> sizes;
  const auto limited = [&](const Region& r) { return r.max_area && domain.keeps(r); };
  for (const Region& r : domain.regions) {
    if (limited(r)) sizes.push_back(size_of_area(*r.max_area));
  }
  for (std::size_t t = 0; t < mesh.simplices.size(); ++t) {
    const Region& region = domain.regions[domain.region_of[t]];
    if (!limited(region)) continue;
    const auto& [a, b, c] = mesh.simplices[t];
    const double h = size_of_area(*region.max_area);
    facets.emplace_back(std::array{mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]},
                        std::array{h, h, h});
  }
  if (facets.empty()) return nullptr;
  return std::make_shared<detail::FacetSizes>(std::move(facets), std::move(sizes));
}

std::shared_ptr<const SizeField<2>> region_sizes(const Pslg& graph, Options<2> options) {
  const auto has_limit = [](const Pslg::Region& r) { return r.max_area.has_value(); };
  if (std::none_of(graph.regions.begin(), graph.regions.end(), has_limit)) return nullptr;
  options.max_area = 0;
  options.sizes = nullptr;
  const MeshData whole = with_features(mesh_statically(graph, options), graph);
  return region_sizes(
      whole, find_domain(whole, whole.features.edges, seeds_of(graph), Extent::enclosed));
}

}  // namespace mesher
