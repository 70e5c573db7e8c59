// Regions by places: vertices get numbers as they come, which are used again when they have gone.
#include "domain/domain_follower.hpp"

#include <algorithm>
#include <bit>
#include <unordered_map>

#include "domain/regions.hpp"
#include "mesh/canonical.hpp"
#include "sac/label.hpp"

namespace mesher {
namespace {

struct PlaceHash {
  template <std::size_t D>
  std::size_t operator()(const std::array<double, D>& p) const noexcept {
    std::uint64_t h = 0;
    for (const double x : p) h = sac::mix(h) + std::bit_cast<std::uint64_t>(x + 0.0);
    return sac::mix(h);
  }
};

// The vertices of a mesh by number.
template <int D>
class Numbering {
 public:
  explicit Numbering(const std::vector<Point<D>>& places) : places_(places) {
    numbers_.reserve(places.size());
    for (std::uint32_t v = 0; v < places.size(); ++v) numbers_.emplace(places[v], v);
  }

  [[nodiscard]] const Point<D>& place(std::uint32_t v) const { return places_[v]; }
  [[nodiscard]] std::uint32_t number(const Point<D>& p) const {
    const auto it = numbers_.find(p);
    SAC_EXPECTS(it != numbers_.end());
    return it->second;
  }

  /// Numbers for new vertices, or for none of them. Afterwards forget() needs no memory for
  /// `leaving` vertices.
  void add(const std::vector<Point<D>>& places, std::size_t leaving) {
    free_.reserve(free_.size() + places.size() + leaving);
    std::size_t done = 0;
    try {
      for (; done < places.size(); ++done) add(places[done]);
    } catch (...) {
      forget({places.begin(), places.begin() + static_cast<std::ptrdiff_t>(done)});
      throw;
    }
  }
  void forget(std::span<const Point<D>> places) noexcept {
    for (const Point<D>& p : places) {
      const auto it = numbers_.find(p);
      if (it == numbers_.end()) continue;
      free_.push_back(it->second);
      numbers_.erase(it);
    }
  }

 private:
  void add(const Point<D>& p) {
    const auto next = static_cast<std::uint32_t>(places_.size());
    const std::uint32_t v = free_.empty() ? next : free_.back();
    if (v == next) places_.push_back(p);
    try {
      SAC_EXPECTS(numbers_.emplace(p, v).second);
    } catch (...) {
      if (v == next) places_.pop_back();
      throw;
    }
    places_[v] = p;
    if (v != next) free_.pop_back();
  }

  std::vector<Point<D>> places_;
  std::unordered_map<Point<D>, std::uint32_t, PlaceHash> numbers_;
  std::vector<std::uint32_t> free_;
};

}  // namespace

template <int D>
struct DomainFollower<D>::Impl {
  using Corners = detail::CornersOf<D>;
  Impl(const Mesh<D>& mesh, const std::vector<WallOf<D>>& walls, const std::vector<Seed<D>>& seeds,
       Extent wanted)
      : numbers(mesh.vertices),
        regions(mesh.simplices, detail::corners_of(walls), seeds,
                [this](std::uint32_t v) { return numbers.place(v); }),
        extent(wanted) {}

  template <std::size_t N>
  [[nodiscard]] std::array<std::uint32_t, N> number(const std::array<Point<D>, N>& t) const {
    std::array<std::uint32_t, N> corners;
    for (std::size_t i = 0; i < N; ++i) corners[i] = numbers.number(t[i]);
    return corners;
  }
  template <std::size_t N>
  [[nodiscard]] auto number(const std::vector<std::array<Point<D>, N>>& all) const {
    std::vector<std::array<std::uint32_t, N>> numbered;
    for (const auto& t : all) numbered.push_back(number(t));
    return numbered;
  }
  [[nodiscard]] typename DomainChange<D>::Corners places(const Corners& t) const {
    typename DomainChange<D>::Corners corners;
    for (std::size_t i = 0; i < t.size(); ++i) corners[i] = numbers.place(t[i]);
    return detail::smallest_first(corners);
  }

  [[nodiscard]] std::vector<typename DomainChange<D>::Corners> places(
      const std::vector<Corners>& all) const {
    std::vector<typename DomainChange<D>::Corners> placed;
    for (const Corners& t : all) placed.push_back(places(t));
    std::sort(placed.begin(), placed.end());
    return placed;
  }
  [[nodiscard]] DomainChange<D> report(const detail::RegionsDifferenceOf<D>& difference) const {
    const auto kept = kept_difference(regions, difference, extent);
    DomainChange<D> change{places(kept.added), places(kept.removed), {}, difference.visited};
    for (const auto& t : difference.relabelled) {
      change.relabelled.push_back({places(t.corners), t.before, t.after});
    }
    std::sort(change.relabelled.begin(), change.relabelled.end(),
              [](const auto& a, const auto& b) { return a.corners < b.corners; });
    return change;
  }

  DomainChange<D> update(const Change<D>& change, const DomainEdits<D>& edits,
                         const Accept& accept) {
    const auto difference = regions.update(
        {number(change.simplices_removed), number(change.simplices_added), number(edits.walls_out),
         number(edits.walls_in), edits.seeds_out, edits.seeds_in});
    try {
      DomainChange<D> domain = report(difference);
      if (accept) accept(domain);
      return domain;
    } catch (...) {
      regions.roll_back();
      throw;
    }
  }

  Numbering<D> numbers;
  detail::RegionsOf<D> regions;
  Extent extent;
};

template <int D>
DomainFollower<D>::DomainFollower(const Mesh<D>& mesh, const std::vector<WallOf<D>>& walls,
                                  const std::vector<Seed<D>>& seeds, Extent extent)
    : impl_(std::make_unique<Impl>(mesh, walls, seeds, extent)) {}
template <int D>
DomainFollower<D>::DomainFollower(DomainFollower&&) noexcept = default;
template <int D>
DomainFollower<D>& DomainFollower<D>::operator=(DomainFollower&&) noexcept = default;
template <int D>
DomainFollower<D>::~DomainFollower() = default;

template <int D>
auto DomainFollower<D>::update(const Change<D>& change, const DomainEdits<D>& edits)
    -> DomainChange<D> {
  return update(change, edits, {});
}

template <int D>
auto DomainFollower<D>::update(const Change<D>& change, const DomainEdits<D>& edits,
                               const Accept& accept) -> DomainChange<D> {
  Numbering<D>& numbers = impl_->numbers;
  numbers.add(change.vertices_added, change.vertices_removed.size());
  try {
    DomainChange<D> result = impl_->update(change, edits, accept);
    numbers.forget(change.vertices_removed);
    return result;
  } catch (...) {
    numbers.forget(change.vertices_added);
    throw;
  }
}

template <int D>
RegionLabel DomainFollower<D>::label(const typename DomainChange<D>::Corners& triangle) const {
  return impl_->regions.label(impl_->number(triangle));
}

template <int D>
bool DomainFollower<D>::keeps(const typename DomainChange<D>::Corners& triangle) const {
  return impl_->regions.keeps(label(triangle), impl_->extent);
}

template <int D>
std::vector<SeedFault<D>> DomainFollower<D>::faults() const {
  return impl_->regions.faults(impl_->extent);
}

template <int D>
void DomainFollower<D>::check_invariants() const {
  impl_->regions.check_invariants();
}

template class DomainFollower<2>;
#ifndef MESHER_PLANE_ONLY
template class DomainFollower<3>;
#endif

}  // namespace mesher
