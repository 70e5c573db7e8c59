// Limits of regions, triangle by triangle.
#include "facade/unlimited_mesh.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "geometry/box.hpp"
#include "make_set.hpp"
#include "program/world.hpp"
#include "sizes/all_limits.hpp"

namespace mesher::detail {

namespace {

Options<2> unlimited(Options<2> options) {
  AllLimits().apply_to(options);
  options.record_weights = false;
  return options;
}

using Corners = DomainChange::Corners;

std::vector<Corners> without(const std::vector<Corners>& all, const std::vector<Corners>& some) {
  std::vector<Corners> rest;
  std::set_difference(all.begin(), all.end(), some.begin(), some.end(), std::back_inserter(rest));
  return rest;
}

// Triangles that came and went. Those that hang together cover the same places before and after: if
// one limit is said of all of them, nothing has changed there.
class Retiled {
 public:
  void add(const Corners& t, const RegionLimits::Limit& limit) {
    const auto number = static_cast<std::uint32_t>(all_.size());
    all_.push_back({t, limit, number});
    for (const Point<2>& p : t) {
      const std::uint32_t other = first_at_.emplace(p, number).first->second;
      all_[root(other)].group = root(number);
    }
  }
  void report(std::vector<Box<2>>& where) {
    std::vector<bool> mixed(all_.size(), false);
    for (std::uint32_t i = 0; i < all_.size(); ++i) {
      const std::uint32_t r = root(i);
      if (!all_[i].limit.as(all_[r].limit)) mixed[r] = true;
    }
    for (std::uint32_t i = 0; i < all_.size(); ++i) {
      if (mixed[root(i)]) where.push_back(bounding_box<2>(all_[i].corners));
    }
  }

 private:
  struct Tile {
    Corners corners;
    RegionLimits::Limit limit;
    std::uint32_t group;  // another of the same, or itself
  };
  std::uint32_t root(std::uint32_t i) {
    while (all_[i].group != i) i = all_[i].group = all_[all_[i].group].group;
    return i;
  }
  std::vector<Tile> all_;
  std::map<Point<2>, std::uint32_t> first_at_;
};

}  // namespace

UnlimitedMesh::UnlimitedMesh(const Options<2>& options, Extent extent, RegionAreas areas)
    : extent_(extent), areas_(areas), mesher_(unlimited(options)), box_(mesh_box(options)) {}

void UnlimitedMesh::update(const Seeds& seeds, const RunControl& control, const Then& then) {
  mesher_.update(control, [&](const Change<2>& change) {
    follower_ ? follow(change, seeds, then) : begin(change, seeds, then);
  });
}

RegionLimits::Limit UnlimitedMesh::limit_of(const DomainFollower& follower, const Corners& t,
                                            const Seeds& seeds) const {
  RegionLimits::Limit limit{follower.keeps(t), RegionLimits::kNone, {}};
  if (areas_ == RegionAreas::ignored) return limit;
  const RegionLabel label = follower.label(t);
  if (label.zone == Zone::hole || !label.seed) return limit;
  limit.region = label.seed;
  const Seed* seed = seeds.find({SeedKind::region, *label.seed});
  if (seed != nullptr && seed->max_area) limit.area = *seed->max_area;
  return limit;
}

void UnlimitedMesh::give_areas(RegionLimits& limits, const Seeds& seeds) const {
  std::vector<double> areas;
  for (const Seed& seed : all_of(seeds)) {
    if (areas_ == RegionAreas::limits && seed.max_area) areas.push_back(*seed.max_area);
  }
  limits.set_areas(std::move(areas));
}

// The first update. What is kept is set when nothing can fail any more.
void UnlimitedMesh::begin(const Change<2>& change, const Seeds& seeds, const Then& then) {
  DomainFollower first(mesh_of(change), walls_of(change), all_of(seeds), extent_);
  const auto limits = std::make_shared<RegionLimits>(box_);
  for (const Corners& t : change.simplices_added) limits->insert(t, limit_of(first, t, seeds));
  give_areas(*limits, seeds);
  then(limits, {mesher_.options().domain});
  follower_.emplace(std::move(first));
  limits_ = limits;
}

// Triangles there before and after of which something else may be said: those with another label,
// those that begin or cease to be kept, and those of regions of which only the area has changed.
std::vector<Corners> UnlimitedMesh::staying(const Change<2>& change, const DomainChange& domain,
                                            const Seeds& seeds) const {
  std::vector<Corners> all = domain.kept_added;
  all.insert(all.end(), domain.kept_removed.begin(), domain.kept_removed.end());
  for (const auto& t : domain.relabelled) all.push_back(t.corners);
  std::set<FeatureId> changed;
  seeds.for_each_edit([&](const SeedName& name, const Seed* was, const Seed* is) {
    if (name.kind == SeedKind::region && was != nullptr && is != nullptr &&
        was->max_area != is->max_area) {
      changed.insert(name.id);
    }
  });
  if (!changed.empty() && areas_ == RegionAreas::limits) {
    limits_->for_each([&](const Corners& t, const RegionLimits::Limit& limit) {
      if (limit.region && changed.contains(*limit.region)) all.push_back(t);
    });
  }
  make_set(all);
  return without(without(all, change.simplices_added), change.simplices_removed);
}

void UnlimitedMesh::follow(const Change<2>& change, const Seeds& seeds, const Then& then) {
  follower_->update(change, domain_edits(change, seeds), [&](const DomainChange& domain) {
    const auto limits = std::make_shared<RegionLimits>(*limits_);
    std::vector<Box<2>> where;
    for (const Corners& t : staying(change, domain, seeds)) {
      const RegionLimits::Limit was = limits->erase(t), is = limit_of(*follower_, t, seeds);
      limits->insert(t, is);
      if (!is.as(was)) where.push_back(bounding_box<2>(t));
    }
    Retiled retiled;
    for (const Corners& t : change.simplices_removed) retiled.add(t, limits->erase(t));
    for (const Corners& t : change.simplices_added) {
      const RegionLimits::Limit is = limit_of(*follower_, t, seeds);
      limits->insert(t, is);
      retiled.add(t, is);
    }
    retiled.report(where);
    give_areas(*limits, seeds);
    then(limits, where);
    limits_ = limits;
  });
}

void UnlimitedMesh::add_to(MeshStats& stats) const {
  const MeshStats own = mesher_.stats();
  stats.calls += own.calls;
  stats.edges += own.edges;
  stats.trace_bytes += own.trace_bytes + (limits_ == nullptr ? 0 : limits_->bytes());
}

void UnlimitedMesh::check_invariants() const {
  mesher_.check_invariants();
  if (follower_) follower_->check_invariants();
}

}  // namespace mesher::detail
