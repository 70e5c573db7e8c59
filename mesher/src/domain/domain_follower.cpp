// Regions by places: vertices get numbers as they come, which are used again when they have gone.
#include "mesher/domain_follower.hpp"

#include <algorithm>
#include <bit>
#include <unordered_map>

#include "domain/regions.hpp"
#include "mesh/canonical.hpp"
#include "sac/label.hpp"

namespace mesher {
namespace {

using detail::Corners;
using detail::Edge;

struct PlaceHash {
  std::size_t operator()(const Point<2>& p) const noexcept {
    const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x + 0.0); };
    return sac::mix(sac::mix(bits(p[0])) + bits(p[1]));
  }
};

// The vertices of a mesh by number.
class Numbering {
 public:
  explicit Numbering(const std::vector<Point<2>>& places) : places_(places) {
    numbers_.reserve(places.size());
    for (std::uint32_t v = 0; v < places.size(); ++v) numbers_.emplace(places[v], v);
  }

  [[nodiscard]] const Point<2>& place(std::uint32_t v) const { return places_[v]; }
  [[nodiscard]] std::uint32_t number(const Point<2>& p) const {
    const auto it = numbers_.find(p);
    SAC_EXPECTS(it != numbers_.end());
    return it->second;
  }

  /// Numbers for new vertices, or for none of them. Afterwards forget() needs no memory for
  /// `leaving` vertices.
  void add(const std::vector<Point<2>>& places, std::size_t leaving) {
    free_.reserve(free_.size() + places.size() + leaving);
    std::size_t done = 0;
    try {
      for (; done < places.size(); ++done) add(places[done]);
    } catch (...) {
      forget({places.begin(), places.begin() + static_cast<std::ptrdiff_t>(done)});
      throw;
    }
  }
  void forget(std::span<const Point<2>> places) noexcept {
    for (const Point<2>& p : places) {
      const auto it = numbers_.find(p);
      if (it == numbers_.end()) continue;
      free_.push_back(it->second);
      numbers_.erase(it);
    }
  }

 private:
  void add(const Point<2>& p) {
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

  std::vector<Point<2>> places_;
  std::unordered_map<Point<2>, std::uint32_t, PlaceHash> numbers_;
  std::vector<std::uint32_t> free_;
};

}  // namespace

struct DomainFollower::Impl {
  Impl(const Mesh<2>& mesh, const std::vector<MeshEdge>& walls, const std::vector<Seed>& seeds,
       Extent wanted)
      : numbers(mesh.vertices),
        regions(mesh.simplices, detail::corners_of(walls), seeds,
                [this](std::uint32_t v) { return numbers.place(v); }),
        extent(wanted) {}

  [[nodiscard]] Corners number(const DomainChange::Corners& t) const {
    return {numbers.number(t[0]), numbers.number(t[1]), numbers.number(t[2])};
  }
  [[nodiscard]] DomainChange::Corners places(const Corners& t) const {
    return detail::smallest_first(
        DomainChange::Corners{numbers.place(t[0]), numbers.place(t[1]), numbers.place(t[2])});
  }
  [[nodiscard]] std::vector<Corners> number(const std::vector<DomainChange::Corners>& all) const {
    std::vector<Corners> numbered;
    for (const auto& t : all) numbered.push_back(number(t));
    return numbered;
  }
  [[nodiscard]] std::vector<Edge> number(const std::vector<DomainEdits::Wall>& all) const {
    std::vector<Edge> numbered;
    for (const auto& e : all) numbered.push_back({numbers.number(e[0]), numbers.number(e[1])});
    return numbered;
  }

  [[nodiscard]] std::vector<DomainChange::Corners> places(const std::vector<Corners>& all) const {
    std::vector<DomainChange::Corners> placed;
    for (const Corners& t : all) placed.push_back(places(t));
    std::sort(placed.begin(), placed.end());
    return placed;
  }
  [[nodiscard]] DomainChange report(const detail::RegionsDifference& difference) const {
    const auto kept = kept_difference(regions, difference, extent);
    DomainChange change{places(kept.added), places(kept.removed), {}, difference.visited};
    for (const auto& t : difference.relabelled) {
      change.relabelled.push_back({places(t.corners), t.before, t.after});
    }
    std::sort(change.relabelled.begin(), change.relabelled.end(),
              [](const auto& a, const auto& b) { return a.corners < b.corners; });
    return change;
  }

  DomainChange update(const Change<2>& change, const DomainEdits& edits, const Accept& accept) {
    const auto difference = regions.update(
        {number(change.simplices_removed), number(change.simplices_added), number(edits.walls_out),
         number(edits.walls_in), edits.seeds_out, edits.seeds_in});
    try {
      DomainChange domain = report(difference);
      if (accept) accept(domain);
      return domain;
    } catch (...) {
      regions.roll_back();
      throw;
    }
  }

  Numbering numbers;
  detail::Regions regions;
  Extent extent;
};

DomainFollower::DomainFollower(const Mesh<2>& mesh, const std::vector<MeshEdge>& walls,
                               const std::vector<Seed>& seeds, Extent extent)
    : impl_(std::make_unique<Impl>(mesh, walls, seeds, extent)) {}
DomainFollower::DomainFollower(DomainFollower&&) noexcept = default;
DomainFollower& DomainFollower::operator=(DomainFollower&&) noexcept = default;
DomainFollower::~DomainFollower() = default;

DomainChange DomainFollower::update(const Change<2>& change, const DomainEdits& edits) {
  return update(change, edits, {});
}

DomainChange DomainFollower::update(const Change<2>& change, const DomainEdits& edits,
                                    const Accept& accept) {
  Numbering& numbers = impl_->numbers;
  numbers.add(change.vertices_added, change.vertices_removed.size());
  try {
    DomainChange result = impl_->update(change, edits, accept);
    numbers.forget(change.vertices_removed);
    return result;
  } catch (...) {
    numbers.forget(change.vertices_added);
    throw;
  }
}

RegionLabel DomainFollower::label(const DomainChange::Corners& triangle) const {
  return impl_->regions.label(impl_->number(triangle));
}

bool DomainFollower::keeps(const DomainChange::Corners& triangle) const {
  return impl_->regions.keeps(label(triangle), impl_->extent);
}

std::vector<SeedFault> DomainFollower::faults() const {
  return impl_->regions.faults(impl_->extent);
}

void DomainFollower::check_invariants() const { impl_->regions.check_invariants(); }

}  // namespace mesher
