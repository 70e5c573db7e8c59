// Fields from the regions of a mesh, the least of several, and limits of options.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "mesher/domain_mesh.hpp"
#include "mesher/sizes.hpp"
#include "sizes/all_limits.hpp"
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

void set_limits(Options<2>& options, const SizeLimits<2>& limits) {
  detail::AllLimits{limits, {}}.apply_to(options);
}
void set_limits(Options<2>& options, const Box<2>& box, const SizeLimits<2>& limits) {
  auto all = detail::AllLimits::of(options);
  all.set_within(box, limits);
  std::move(all).apply_to(options);
}

double size_of_area(double area) { return std::sqrt(area / kAreaOfSize); }

std::shared_ptr<const SizeField<2>> least_sizes(
    std::vector<std::shared_ptr<const SizeField<2>>> fields) {
  std::erase(fields, nullptr);
  if (fields.size() < 2) return fields.empty() ? nullptr : fields.front();
  return std::make_shared<LeastSizes>(std::move(fields));
}

namespace {

// Of what `domain` keeps; `area_of` says a region's limit, infinite if it has none.
template <class AreaOf>
std::shared_ptr<const SizeField<2>> sizes_of_kept(const Mesh<2>& mesh, const Domain& domain,
                                                  AreaOf&& area_of) {
  std::vector<double> size, plateaus;  // of the regions; of those with a limit
  for (const Region& r : domain.regions) {
    size.push_back(domain.keeps(r) ? size_of_area(area_of(r)) : kInfinite);
    if (size.back() < kInfinite) plateaus.push_back(size.back());
  }
  if (plateaus.empty()) return nullptr;
  std::vector<detail::Facet> facets;
  for (std::size_t t = 0; t < mesh.simplices.size(); ++t) {
    const double h = size[domain.region_of[t]];
    const auto& [a, b, c] = mesh.simplices[t];
    if (h == kInfinite) continue;
    facets.emplace_back(std::array{mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]},
                        std::array{h, h, h});
  }
  return std::make_shared<detail::FacetSizes>(std::move(facets), std::move(plateaus));
}

}  // namespace

std::shared_ptr<const SizeField<2>> region_sizes(const Mesh<2>& mesh, const Domain& domain) {
  return sizes_of_kept(mesh, domain,
                       [](const Region& r) { return r.max_area.value_or(kInfinite); });
}

std::shared_ptr<const SizeField<2>> region_sizes(const Pslg& graph, Options<2> options) {
  const double all = options.max_area > 0 ? options.max_area : kInfinite;
  options.max_area = 0;
  options.sizes = nullptr;
  const MeshData whole = with_features(mesh_statically(graph, options), graph);
  const Domain domain = find_domain(whole, whole.features.edges, seeds_of(graph), Extent::enclosed);
  return sizes_of_kept(whole, domain, [all](const Region& r) {
    return std::min(all, r.max_area.value_or(kInfinite));
  });
}

}  // namespace mesher
