// One update of regions: triangles and walls, then components, then seeds, then labels.
#include <algorithm>

#include "domain/labels.hpp"
#include "domain/regions.hpp"
#include "mesh/canonical.hpp"
#include "mesh/locate.hpp"
#include "sac/check.hpp"
#include "sets/make_set.hpp"

namespace mesher::detail {

template <int D>
class RegionsOf<D>::Update {
 public:
  explicit Update(RegionsOf& regions) : r_(regions) {}

  RegionsDifference run(const RegionsChange& change) {
    remove_seeds(change.seeds_out);
    seams_ = r_.tiles_.change(change.triangles_out, change.triangles_in, change.walls_out,
                              change.walls_in);
    drop_seeds();
    regrouped_ = regroup(r_.tiles_, r_.components_, r_.marks_, seams_);
    difference_.visited = regrouped_.visited;
    touch(regrouped_.touched);
    place_dropped();
    add_seeds(change.seeds_in);
    collect_disturbed();
    for (const std::uint32_t i : disturbed_) judge(i);
    label();
    report();
    settle();
    return std::move(difference_);
  }

 private:
  void touch(const std::vector<std::uint32_t>& components) {
    touched_.insert(touched_.end(), components.begin(), components.end());
  }
  void touch(std::uint32_t component) {
    if (component != kNone) touched_.push_back(component);
  }

  // --- Seeds ---------------------------------------------------------------------------------

  void remove_seeds(const std::vector<SeedId>& names) {
    for (const SeedId& name : names) {
      const std::uint32_t i = r_.seeds_.find(name);
      if (i == kNone)
        throw Error(ErrorCode::unknown_id, "seed is not there", {}, {mesher::Feature(name)});
      touch(r_.seeds_[i].component);
      r_.seeds_.let_go(r_.tiles_, i);
      r_.seeds_.enter(r_.components_, i, kNone);
      r_.seeds_.remove(i);
    }
  }

  void drop_seeds() {
    for (const TileOf<D>& tile : seams_.removed) {
      r_.seeds_.for_each_held(tile, [&](std::uint32_t i) {
        dropped_.push_back(i);
        r_.seeds_.drop(i);
      });
    }
  }

  // What comes covers what went.
  void place_dropped() {
    std::vector<Point<D>> places;
    for (const std::uint32_t i : dropped_) places.push_back(r_.seeds_[i].seed.at);
    const auto holders = first_holding<D>(
        places, seams_.added.size(), [&](std::size_t k) { return r_.corners_of(seams_.added[k]); },
        kNone);
    for (std::size_t k = 0; k < dropped_.size(); ++k) {
      SAC_EXPECTS(holders[k] != kNone);
      r_.seeds_.hold(r_.tiles_, dropped_[k], seams_.added[holders[k]]);
    }
    disturbed_ = dropped_;
  }

  void add_seeds(const std::vector<Seed<D>>& seeds) {
    for (const Seed<D>& seed : seeds) {
      check_seed(seed);
      if (r_.seeds_.find(seed.id) != kNone) {
        throw Error(ErrorCode::repeated_id, "seed is there already", {},
                    {mesher::Feature(seed.id)});
      }
      const std::uint32_t i = r_.seeds_.add(seed);
      const Slot holder = r_.locate(seed.at);
      if (holder != kNone) r_.seeds_.hold(r_.tiles_, i, holder);
      disturbed_.push_back(i);
    }
  }

  // Seeds in triangles that are in another region, and those near walls that came or went.
  void collect_disturbed() {
    const auto collect = [&](Slot s) {
      r_.seeds_.for_each_held(r_.tiles_[s], [&](std::uint32_t i) { disturbed_.push_back(i); });
      return true;
    };
    for (const auto& moved : regrouped_.moved) collect(moved.slot);
    if (r_.seeds_.size() == 0) return;
    for (const Wall& edge : seams_.toggled) {
      for (const std::uint32_t v : edge) r_.tiles_.for_each_around(v, collect);
    }
  }

  void judge(std::uint32_t i) {
    const auto& record = r_.seeds_[i];
    const std::uint32_t to =
        record.slot == kNone ? kNone : r_.component_at(record.seed.at, record.slot);
    touch(record.component);
    touch(to);
    r_.seeds_.enter(r_.components_, i, to);
  }

  // --- Labels --------------------------------------------------------------------------------

  void label() {
    make_set(touched_);
    for (const std::uint32_t c : touched_) labels_.push_back(r_.label_of(r_.components_[c]));
    arrived_.resize(touched_.size());
  }
  [[nodiscard]] std::size_t index_of(std::uint32_t component) const {
    return static_cast<std::size_t>(std::lower_bound(touched_.begin(), touched_.end(), component) -
                                    touched_.begin());
  }
  [[nodiscard]] const RegionLabel& before(std::uint32_t component) const {
    return r_.components_[component].label;
  }

  void report() {
    for (const TileOf<D>& t : seams_.removed) {
      difference_.removed.push_back({smallest_first(t.corners), before(t.component)});
    }
    for (const Slot s : seams_.added) {
      const std::size_t k = index_of(r_.tiles_[s].component);
      ++arrived_[k];
      difference_.added.push_back({smallest_first(r_.tiles_[s].corners), labels_[k]});
    }
    for (const auto& moved : regrouped_.moved) {
      const std::size_t k = index_of(r_.tiles_[moved.slot].component);
      ++arrived_[k];
      report_relabelled(moved.slot, before(moved.from), labels_[k]);
    }
    for (std::size_t k = 0; k < touched_.size(); ++k) {
      const bool has_old = r_.components_[touched_[k]].size > arrived_[k];
      if (has_old && before(touched_[k]) != labels_[k]) report_old(k);
    }
    sort_difference();
  }

  void report_relabelled(Slot s, const RegionLabel& was, const RegionLabel& is) {
    if (was == is) return;
    difference_.relabelled.push_back({smallest_first(r_.tiles_[s].corners), was, is});
  }

  // Those that arrived have been reported.
  void mark_arrived() {
    if (arrived_mark_ != 0) return;
    arrived_mark_ = r_.marks_.fresh(r_.tiles_.slots(), 2);
    for (const Slot s : seams_.added) r_.marks_[s] = arrived_mark_;
    for (const auto& moved : regrouped_.moved) r_.marks_[moved.slot] = arrived_mark_;
  }

  // A region has another label: so have its triangles that were in it before.
  void report_old(std::size_t k) {
    mark_arrived();
    const std::uint32_t seen = arrived_mark_ + 1;
    std::vector<Slot> reached;
    const auto take = [&](Slot s) {
      if (s == kNone || r_.marks_[s] == seen) return;
      if (r_.marks_[s] != arrived_mark_) {
        report_relabelled(s, before(touched_[k]), labels_[k]);
      }
      r_.marks_[s] = seen;
      reached.push_back(s);
    };
    take(r_.components_[touched_[k]].any);
    while (!reached.empty()) {
      const Slot s = reached.back();
      reached.pop_back();
      ++difference_.visited;
      for (int i = 0; i <= D; ++i) take(r_.tiles_[s].open_neighbour(i));
    }
  }

  void sort_difference() {
    const auto by_corners = [](const auto& a, const auto& b) { return a.corners < b.corners; };
    std::sort(difference_.removed.begin(), difference_.removed.end(), by_corners);
    std::sort(difference_.added.begin(), difference_.added.end(), by_corners);
    std::sort(difference_.relabelled.begin(), difference_.relabelled.end(), by_corners);
  }

  void settle() {
    std::uint32_t closed = r_.closed_[0];
    difference_.enclosed_before = closed > 0;
    for (std::size_t k = 0; k < touched_.size(); ++k) {
      const Component& c = r_.components_[touched_[k]];
      const bool was_closed = c.label.zone != Zone::outside;
      const bool is_closed = c.size > 0 && c.exits == 0;
      closed = closed + (is_closed ? 1 : 0) - (was_closed ? 1 : 0);
      if (c.size == 0) {
        r_.components_.release(touched_[k]);
      } else {
        r_.components_.edit(touched_[k]).label = labels_[k];
      }
    }
    r_.closed_.edit(0) = closed;
    difference_.encloses = closed > 0;
  }

  RegionsOf& r_;
  SeamsOf<D> seams_;
  Regrouped regrouped_;
  std::vector<std::uint32_t> dropped_;    // seeds whose triangle went
  std::vector<std::uint32_t> disturbed_;  // seeds that may be in another region
  std::vector<std::uint32_t> touched_;    // components; ascending from label() on
  std::vector<RegionLabel> labels_;       // what these are now
  std::vector<std::uint32_t> arrived_;    // triangles that were not in them before
  std::uint32_t arrived_mark_ = 0;        // theirs, once they are marked
  RegionsDifference difference_;
};

template <int D>
auto RegionsOf<D>::update(const RegionsChange& change) -> RegionsDifference {
  keep();
  try {
    return Update(*this).run(change);
  } catch (...) {
    roll_back();
    throw;
  }
}

template RegionsDifferenceOf<2> RegionsOf<2>::update(const RegionsChangeOf<2>&);
#ifndef MESHER_PLANE_ONLY
template RegionsDifferenceOf<3> RegionsOf<3>::update(const RegionsChangeOf<3>&);
#endif

}  // namespace mesher::detail
