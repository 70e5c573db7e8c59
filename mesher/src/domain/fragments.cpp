#include "domain/fragments.hpp"

#include <algorithm>
#include <iterator>

namespace mesher::detail {

// --- Clusters --------------------------------------------------------------------------------

template <int D>
Clusters<D>::Clusters(const TilesOf<D>& tiles, const SeamsOf<D>& seams) {
  std::vector<Slot> added = seams.added;
  std::sort(added.begin(), added.end());
  std::merge(added.begin(), added.end(), seams.frontier.begin(), seams.frontier.end(),
             std::back_inserter(nodes_));
  for (std::uint32_t k = 0; k < count(); ++k) cluster_.push_back(k);
  UnionFind sets(nodes_.size());
  for (std::uint32_t k = 0; k < count(); ++k) {
    for (int i = 0; i <= D; ++i) {
      const std::uint32_t n = of(tiles[nodes_[k]].open_neighbour(i));
      if (n != kNone) sets.unite(k, n);
    }
  }
  for (std::uint32_t k = 0; k < count(); ++k) cluster_[k] = sets.find(k);
  for (const Slot s : seams.frontier) members_.push_back({tiles[s].component, of(s), s});
  std::sort(members_.begin(), members_.end());
}

template <int D>
std::uint32_t Clusters<D>::of(Slot s) const {
  const auto it = std::lower_bound(nodes_.begin(), nodes_.end(), s);
  if (it == nodes_.end() || *it != s) return kNone;
  return cluster_[static_cast<std::size_t>(it - nodes_.begin())];
}

template <int D>
std::span<const Member> Clusters<D>::members(std::uint32_t component) const {
  const auto first = std::lower_bound(members_.begin(), members_.end(), Member{component, 0, 0});
  return {first, std::upper_bound(first, members_.end(), Member{component, kNone, kNone})};
}

template <int D>
std::span<const Member> Clusters<D>::members(std::uint32_t component, std::uint32_t cluster) const {
  const Member low{component, cluster, 0}, high{component, cluster, kNone};
  const auto first = std::lower_bound(members_.begin(), members_.end(), low);
  return {first, std::upper_bound(first, members_.end(), high)};
}

// --- Parting a region ------------------------------------------------------------------------

template <int D>
Parting<D>::Parting(const TilesOf<D>& tiles, const Clusters<D>& clusters, Marks& marks,
                    std::uint32_t component, std::span<const std::uint32_t> starts)
    : tiles_(tiles),
      clusters_(clusters),
      marks_(marks),
      component_(component),
      base_(marks.fresh(tiles.slots(), static_cast<std::uint32_t>(starts.size()))),
      groups_(starts.size()),
      met_(starts.size()) {
  for (std::uint32_t g = 0; g < starts.size(); ++g) {
    for (const Member& m : clusters.members(component, starts[g])) mark(m.slot, g);
  }
}

template <int D>
void Parting<D>::mark(Slot s, std::uint32_t group) {
  groups_[group].pending.push_back(s);
  marks_[s] = base_ + group;
}

// Either all or none of a cluster's members are marked.
template <int D>
void Parting<D>::reach(Slot s, std::uint32_t group) {
  if (is_marked(s)) return meet(met_.find(marks_[s] - base_), met_.find(group));
  const std::uint32_t cluster = clusters_.of(s);
  if (cluster == kNone) return mark(s, met_.find(group));
  for (const Member& m : clusters_.members(component_, cluster)) mark(m.slot, met_.find(group));
}

template <int D>
void Parting<D>::meet(std::uint32_t a, std::uint32_t b) {
  if (a == b) return;
  if (groups_[a].size() < groups_[b].size()) std::swap(groups_[a], groups_[b]);
  Group &to = groups_[a], &from = groups_[b];
  to.done.insert(to.done.end(), from.done.begin(), from.done.end());
  to.pending.insert(to.pending.end(), from.pending.begin() + static_cast<std::ptrdiff_t>(from.head),
                    from.pending.end());
  from = {};
  met_.unite(a, b);
  if (met_.find(a) != a) std::swap(groups_[a], groups_[b]);
}

template <int D>
void Parting<D>::step(std::uint32_t group) {
  Group& g = groups_[group];
  const Slot s = g.pending[g.head++];
  g.done.push_back(s);
  ++visited_;
  for (int i = 0; i <= D; ++i) {
    const Slot n = tiles_[s].open_neighbour(i);
    if (n != kNone && tiles_[n].component == component_) reach(n, group);
  }
}

template <int D>
void Parting<D>::run() {
  std::vector<std::uint32_t> active(groups_.size());
  std::iota(active.begin(), active.end(), std::uint32_t{0});
  while (active.size() > 1) {
    for (const std::uint32_t g : active) {
      if (met_.find(g) == g && !groups_[g].exhausted()) step(g);
    }
    std::erase_if(active,
                  [&](std::uint32_t g) { return met_.find(g) != g || groups_[g].exhausted(); });
  }
  for (std::uint32_t g = 0; g < groups_.size(); ++g) {
    if (met_.find(g) == g && groups_[g].exhausted()) finished_.push_back(g);
  }
  if (active.empty()) choose();
}

// All fragments are found: the largest is as good as not listed.
template <int D>
void Parting<D>::choose() {
  const auto largest = std::max_element(
      finished_.begin(), finished_.end(),
      [&](std::uint32_t a, std::uint32_t b) { return groups_[a].size() < groups_[b].size(); });
  finished_.erase(largest);
}

template <int D>
std::vector<Fragment> Parting<D>::listed() {
  std::vector<Fragment> fragments;
  for (const std::uint32_t g : finished_) {
    groups_[g].listed = static_cast<std::uint32_t>(fragments.size());
    const auto size = static_cast<std::uint32_t>(groups_[g].done.size());
    fragments.push_back({component_, size, true, std::move(groups_[g].done)});
  }
  return fragments;
}

template <int D>
std::uint32_t Parting<D>::listed_with(Slot s) {
  return is_marked(s) ? groups_[met_.find(marks_[s] - base_)].listed : kNone;
}

template class Clusters<2>;
template class Parting<2>;
#ifndef MESHER_PLANE_ONLY
template class Clusters<3>;
template class Parting<3>;
#endif

}  // namespace mesher::detail
