// Limits of regions, simplex by simplex.
#include "facade/unsized_mesh.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "geometry/box.hpp"
#include "program/world.hpp"
#include "rules/mesh_box.hpp"
#include "sets/make_set.hpp"
#include "sizes/all_limits.hpp"

namespace mesher::detail {

namespace {

template <int D>
Options<D> unlimited(Options<D> options) {
  AllLimits<D>().apply_to(options);
  options.record_weights = false;
  return options;
}

template <class Corners>
std::vector<Corners> without(const std::vector<Corners>& all, const std::vector<Corners>& some) {
  std::vector<Corners> rest;
  std::set_difference(all.begin(), all.end(), some.begin(), some.end(), std::back_inserter(rest));
  return rest;
}

// Simplices that came and went. Those that hang together cover the same places before and after: if
// one limit is said of all of them, nothing has changed there.
template <int D>
class Retiled {
 public:
  using Corners = CornersOf<D>;
  using Limit = typename RegionLimits<D>::Limit;

  void add(const Corners& t, const Limit& limit) {
    const auto number = static_cast<std::uint32_t>(all_.size());
    all_.push_back({t, limit, number});
    for (const Point<D>& p : t) {
      const std::uint32_t other = first_at_.emplace(p, number).first->second;
      all_[root(other)].group = root(number);
    }
  }
  void report(std::vector<Box<D>>& where) {
    std::vector<bool> mixed(all_.size(), false);
    for (std::uint32_t i = 0; i < all_.size(); ++i) {
      const std::uint32_t r = root(i);
      if (!all_[i].limit.as(all_[r].limit)) mixed[r] = true;
    }
    for (std::uint32_t i = 0; i < all_.size(); ++i) {
      if (mixed[root(i)]) where.push_back(bounding_box<D>(all_[i].corners));
    }
  }

 private:
  struct Tile {
    Corners corners;
    Limit limit;
    std::uint32_t group;  // another of the same, or itself
  };
  std::uint32_t root(std::uint32_t i) {
    while (all_[i].group != i) i = all_[i].group = all_[all_[i].group].group;
    return i;
  }
  std::vector<Tile> all_;
  std::map<Point<D>, std::uint32_t> first_at_;
};

}  // namespace

template <int D>
UnsizedMesh<D>::UnsizedMesh(const Options<D>& options, Extent extent, RegionAreas areas)
    : extent_(extent), areas_(areas), mesher_(unlimited(options)), box_(mesh_box<D>(options)) {
  mesher_.keep_slots(false);
}

template <int D>
void UnsizedMesh<D>::update(const Seeds& seeds, const RunControl& control, const Then& then) {
  mesher_.update(control, [&](const Change<D>& change) {
    follower_ ? follow(change, seeds, then) : begin(change, seeds, then);
  });
}

template <int D>
auto UnsizedMesh<D>::limit_of(const DomainFollower<D>& follower, const Corners& t,
                              const Seeds& seeds) const -> typename RegionLimits<D>::Limit {
  typename RegionLimits<D>::Limit limit{follower.keeps(t), RegionLimits<D>::kNone, {}};
  if (areas_ == RegionAreas::ignored) return limit;
  const RegionLabel label = follower.label(t);
  if (label.zone == Zone::hole || !label.seed) return limit;
  limit.region = label.seed;
  const Seed<D>* seed = seeds.find(*label.seed);
  if (seed != nullptr && seed->max_measure) limit.measure = *seed->max_measure;
  return limit;
}

template <int D>
void UnsizedMesh<D>::give_measures(RegionLimits<D>& limits, const Seeds& seeds) const {
  std::vector<double> measures;
  for (const Seed<D>& seed : all_of(seeds)) {
    if (areas_ == RegionAreas::limits && seed.max_measure) measures.push_back(*seed.max_measure);
  }
  limits.set_measures(std::move(measures));
}

// The first update. What is kept is set when nothing can fail any more.
template <int D>
void UnsizedMesh<D>::begin(const Change<D>& change, const Seeds& seeds, const Then& then) {
  DomainFollower<D> first(mesh_of(change), walls_of(change), all_of(seeds), extent_);
  const auto limits = std::make_shared<RegionLimits<D>>(box_);
  for (const Corners& t : change.simplices_added) limits->insert(t, limit_of(first, t, seeds));
  give_measures(*limits, seeds);
  then(limits, {mesher_.options().domain});
  follower_.emplace(std::move(first));
  limits_ = limits;
}

// Simplices there before and after of which something else may be said: those with another label,
// those that begin or cease to be kept, and those of regions of which only the limit has changed.
template <int D>
auto UnsizedMesh<D>::staying(const Change<D>& change, const DomainChange<D>& domain,
                             const Seeds& seeds) const -> std::vector<Corners> {
  std::vector<Corners> all = domain.kept_added;
  all.insert(all.end(), domain.kept_removed.begin(), domain.kept_removed.end());
  for (const auto& t : domain.relabelled) all.push_back(t.corners);
  std::set<SeedId> changed;
  seeds.for_each_edit([&](const SeedId& name, const Seed<D>* was, const Seed<D>* is) {
    if (name.kind == SeedKind::region && was != nullptr && is != nullptr &&
        was->max_measure != is->max_measure) {
      changed.insert(name);
    }
  });
  if (!changed.empty() && areas_ == RegionAreas::limits) {
    limits_->for_each([&](const Corners& t, const typename RegionLimits<D>::Limit& limit) {
      if (limit.region && changed.contains(*limit.region)) all.push_back(t);
    });
  }
  make_set(all);
  return without(without(all, change.simplices_added), change.simplices_removed);
}

template <int D>
void UnsizedMesh<D>::follow(const Change<D>& change, const Seeds& seeds, const Then& then) {
  follower_->update(change, domain_edits<D>(change, seeds), [&](const DomainChange<D>& domain) {
    const auto limits = std::make_shared<RegionLimits<D>>(*limits_);
    std::vector<Box<D>> where;
    for (const Corners& t : staying(change, domain, seeds)) {
      const auto was = limits->erase(t), is = limit_of(*follower_, t, seeds);
      limits->insert(t, is);
      if (!is.as(was)) where.push_back(bounding_box<D>(t));
    }
    Retiled<D> retiled;
    for (const Corners& t : change.simplices_removed) retiled.add(t, limits->erase(t));
    for (const Corners& t : change.simplices_added) {
      const auto is = limit_of(*follower_, t, seeds);
      limits->insert(t, is);
      retiled.add(t, is);
    }
    retiled.report(where);
    give_measures(*limits, seeds);
    then(limits, where);
    limits_ = limits;
  });
}

template <int D>
void UnsizedMesh<D>::add_to(MeshStats& stats) const {
  const MeshStats own = mesher_.stats();
  stats.calls += own.calls;
  stats.edges += own.edges;
  stats.trace_bytes += own.trace_bytes + (limits_ == nullptr ? 0 : limits_->bytes());
}

template <int D>
void UnsizedMesh<D>::check_invariants() const {
  mesher_.check_invariants();
  if (follower_) follower_->check_invariants();
}

template class UnsizedMesh<2>;
#ifndef MESHER_PLANE_ONLY
template class UnsizedMesh<3>;
#endif

}  // namespace mesher::detail
