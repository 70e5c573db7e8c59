// Simplices in a tree of shared nodes.
#include "sizes/region_limits.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "facade/graph_runs.hpp"
#include "geometry/box.hpp"
#include "mesher/mesher.hpp"
#include "mesher/meshing.hpp"
#include "rules/mesh_box.hpp"
#include "sac/check.hpp"
#include "sizes/all_limits.hpp"

namespace mesher {

using detail::Cell;

template <int D>
void RegionLimits<D>::take(Range& all, const Limit& limit) {
  all.all = all.all && limit.counts;
  if (!limit.counts) return;
  all.some = true;
  all.least = std::min(all.least, limit.measure);
  all.most = std::max(all.most, limit.measure);
}

template <int D>
void RegionLimits<D>::take(Range& all, const Range& more) {
  all.least = std::min(all.least, more.least);
  all.most = std::max(all.most, more.most);
  all.some = all.some || more.some;
  all.all = all.all && more.all;
}

// --- Writing ---------------------------------------------------------------------------------

// A node that no other value has.
template <int D>
auto RegionLimits<D>::own(Link& link) -> Node& {
  if (link == nullptr) {
    link = std::make_shared<Node>();
  } else if (link.use_count() > 1) {
    link = std::make_shared<Node>(*link);
  }
  return *link;
}

template <int D>
void RegionLimits<D>::summarise(Link& link) {
  const auto is_there = [](const Link& child) { return child != nullptr; };
  Node& node = *link;
  if (node.entries.empty() && std::none_of(node.child.begin(), node.child.end(), is_there)) {
    link.reset();
    return;
  }
  node.range = Range();
  for (const Entry& e : node.entries) take(node.range, e.limit);
  for (const Link& child : node.child) {
    if (child != nullptr) take(node.range, child->range);
  }
}

template <int D>
Cell<D> RegionLimits<D>::cell_of(const Corners& simplex) const {
  const Box<D> box = detail::bounding_box<D>(simplex);
  const double extent = detail::longest_side(box);
  const int level = std::ilogb(box_.side / extent) - 1;  // the side is twice the extent, or more
  return detail::MeshBox<D>::cell(box_.fixed(detail::middle_of(box)),
                                  std::clamp(level, 0, detail::kLevels - 1));
}

template <int D>
template <class Edit>
void RegionLimits<D>::edit_at(Link& link, const Cell<D>& cell, int level, Edit& edit) {
  Node& node = own(link);
  if (level == cell.level) {
    edit(node.entries);
  } else {
    const int c = detail::MeshBox<D>::child_of(cell.corner, level);
    edit_at(node.child[static_cast<std::size_t>(c)], cell, level + 1, edit);
  }
  summarise(link);
}

template <int D>
void RegionLimits<D>::insert(const Corners& simplex, const Limit& limit) {
  const Entry entry{detail::Tile<D>(simplex), limit};
  const auto put = [&](std::vector<Entry>& entries) { entries.push_back(entry); };
  edit_at(root_, cell_of(simplex), 0, put);
}

template <int D>
auto RegionLimits<D>::erase(const Corners& simplex) -> Limit {
  Limit limit;
  const auto take_out = [&](std::vector<Entry>& entries) {
    const auto same = [&](const Entry& e) { return e.tile.corners() == simplex; };
    const auto it = std::find_if(entries.begin(), entries.end(), same);
    SAC_EXPECTS(it != entries.end());
    limit = it->limit;
    entries.erase(it);
  };
  edit_at(root_, cell_of(simplex), 0, take_out);
  return limit;
}

// --- Reading ---------------------------------------------------------------------------------

// enter(box, node): of all that is in a cell; lo, side: of the cell.
template <int D>
template <class Enter, class Visit>
void RegionLimits<D>::visit(const Node& node, const Point<D>& lo, double side, Enter& enter,
                            Visit& visit_entry) const {
  const double around = 0.26 * side;  // with some rounding
  Box<D> box;
  for (std::size_t i = 0; i < D; ++i) {
    box.lo[i] = lo[i] - around;
    box.hi[i] = lo[i] + side + around;
  }
  if (!enter(box, node)) return;
  for (const Entry& e : node.entries) visit_entry(e);
  for (std::size_t c = 0; c < node.child.size(); ++c) {
    if (node.child[c] == nullptr) continue;
    Point<D> inner = lo;
    for (std::size_t i = 0; i < D; ++i) inner[i] += ((c >> i) & 1) != 0 ? side / 2 : 0;
    visit(*node.child[c], inner, side / 2, enter, visit_entry);
  }
}

template <int D>
std::size_t RegionLimits<D>::bytes_below(const Node& node) {
  constexpr std::size_t kCounts = 16;  // what a shared_ptr keeps beside a node
  std::size_t bytes = sizeof(Node) + kCounts + node.entries.capacity() * sizeof(Entry);
  for (const Link& child : node.child) {
    if (child != nullptr) bytes += bytes_below(*child);
  }
  return bytes;
}
template <int D>
std::size_t RegionLimits<D>::bytes() const {
  return root_ == nullptr ? 0 : bytes_below(*root_);
}

template <int D>
auto RegionLimits<D>::at(const Point<D>& p) const -> Limit {
  Limit found;
  const auto enter = [&](const Box<D>& box, const Node& node) {
    return node.range.some && detail::contains(box, p);
  };
  const auto look = [&](const Entry& e) {
    if (!e.limit.counts || !e.tile.contains(p)) return;
    found.counts = true;
    found.measure = std::min(found.measure, e.limit.measure);
  };
  if (root_ != nullptr) visit(*root_, box_.lo, box_.side, enter, look);
  return found;
}

// What lies in the box takes no further look, nor what says nothing new.
template <int D>
auto RegionLimits<D>::range(const Box<D>& box) const -> Range {
  Range all;
  const auto enter = [&](const Box<D>& around, const Node& node) {
    if (detail::is_empty(detail::common(around, box))) return false;
    Range more = all;
    take(more, node.range);
    if (more == all) return false;
    if (!detail::contains(box, around)) return true;
    all = more;
    return false;
  };
  const auto look = [&](const Entry& e) {
    if (e.tile.touches(box)) take(all, e.limit);
  };
  if (root_ != nullptr) visit(*root_, box_.lo, box_.side, enter, look);
  return all;
}

template class RegionLimits<2>;
#ifndef MESHER_PLANE_ONLY
template class RegionLimits<3>;
#endif

// --- From scratch ----------------------------------------------------------------------------

template <int D>
std::shared_ptr<const RegionLimits<D>> region_limits(const Graph<D>& graph,
                                                     const Options<D>& options, Extent extent,
                                                     RegionAreas areas) {
  Options<D> unlimited = options;
  detail::AllLimits<D>().apply_to(unlimited);
  const auto whole = with_features(mesh_statically(graph, unlimited), graph);
  const auto& walls = [&]() -> const std::vector<WallOf<D>>& {
    if constexpr (D == 2) return whole.features.edges;
    if constexpr (D == 3) return whole.features.faces;
  }();
  const auto domain = find_domain(whole, walls, graph.seeds, extent);
  const auto limits = std::make_shared<RegionLimits<D>>(detail::mesh_box(options));
  std::vector<double> all;
  for (const auto& region : graph.regions()) {
    if (areas == RegionAreas::limits && region.max_measure) all.push_back(*region.max_measure);
  }
  for (std::size_t t = 0; t < whole.simplices.size(); ++t) {
    const Region& region = domain.regions[domain.region_of[t]];
    typename RegionLimits<D>::Limit limit{domain.keeps(region), RegionLimits<D>::kNone, {}};
    if (areas == RegionAreas::limits && region.max_measure) limit.measure = *region.max_measure;
    detail::CornersOf<D> corners;
    for (std::size_t i = 0; i <= D; ++i) corners[i] = whole.vertices[whole.simplices[t][i]];
    limits->insert(corners, limit);
  }
  limits->set_measures(std::move(all));
  return limits;
}

template std::shared_ptr<const RegionLimits<2>> region_limits(const Graph<2>&, const Options<2>&,
                                                              Extent, RegionAreas);
#ifndef MESHER_PLANE_ONLY
template std::shared_ptr<const RegionLimits<3>> region_limits(const Graph<3>&, const Options<3>&,
                                                              Extent, RegionAreas);
#endif

}  // namespace mesher
