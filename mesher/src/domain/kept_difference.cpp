// What a difference of labels means for the triangles that are kept.
#include <algorithm>

#include "domain/labels.hpp"
#include "domain/regions.hpp"
#include "mesh/canonical.hpp"

namespace mesher::detail {
namespace {

template <int D>
class Comparison {
 public:
  using Corners = CornersOf<D>;
  using RegionsDifference = RegionsDifferenceOf<D>;

  Comparison(const RegionsDifference& difference, Extent extent)
      : difference_(difference), extent_(extent) {}

  KeptDifference<D> run(const RegionsOf<D>& regions) {
    for (const auto& t : difference_.removed) {
      if (was_kept(t.label)) kept_.removed.push_back(t.corners);
    }
    for (const auto& t : difference_.added) {
      if (is_kept(t.label)) kept_.added.push_back(t.corners);
    }
    for (const auto& t : difference_.relabelled) compare(t.corners, t.before, t.after);
    if (extent_ == Extent::enclosed && difference_.enclosed_before != difference_.encloses) {
      compare_others(regions);
    }
    std::sort(kept_.removed.begin(), kept_.removed.end());
    std::sort(kept_.added.begin(), kept_.added.end());
    return std::move(kept_);
  }

 private:
  [[nodiscard]] bool was_kept(const RegionLabel& label) const {
    return keeps(label, keeps_all(extent_, difference_.enclosed_before));
  }
  [[nodiscard]] bool is_kept(const RegionLabel& label) const {
    return keeps(label, keeps_all(extent_, difference_.encloses));
  }
  void compare(const Corners& t, const RegionLabel& before, const RegionLabel& after) {
    if (was_kept(before) == is_kept(after)) return;
    (was_kept(before) ? kept_.removed : kept_.added).push_back(t);
  }

  // Triangles whose labels are what they were.
  void compare_others(const RegionsOf<D>& regions) {
    std::vector<Corners> named;
    for (const auto& t : difference_.added) named.push_back(t.corners);
    for (const auto& t : difference_.relabelled) named.push_back(t.corners);
    std::sort(named.begin(), named.end());
    regions.for_each([&](const Corners& corners, const RegionLabel& label) {
      const Corners t = smallest_first(corners);
      if (!std::binary_search(named.begin(), named.end(), t)) compare(t, label, label);
    });
  }

  const RegionsDifference& difference_;
  Extent extent_;
  KeptDifference<D> kept_;
};

}  // namespace

template <int D>
KeptDifference<D> kept_difference(const RegionsOf<D>& regions,
                                  const RegionsDifferenceOf<D>& difference, Extent extent) {
  return Comparison<D>(difference, extent).run(regions);
}
template KeptDifference<2> kept_difference(const RegionsOf<2>&, const RegionsDifferenceOf<2>&,
                                           Extent);
#ifndef MESHER_PLANE_ONLY
template KeptDifference<3> kept_difference(const RegionsOf<3>&, const RegionsDifferenceOf<3>&,
                                           Extent);
#endif

}  // namespace mesher::detail
