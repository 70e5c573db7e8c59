// Triangles in a quadtree of shared nodes.
#include "sizes/region_limits.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/box.hpp"
#include "mesher/domain_mesh.hpp"
#include "program/world.hpp"
#include "sac/check.hpp"
#include "sizes/all_limits.hpp"

namespace mesher {

using detail::Cell;

void RegionLimits::take(Range& all, const Limit& limit) {
  all.all = all.all && limit.counts;
  if (!limit.counts) return;
  all.some = true;
  all.least = std::min(all.least, limit.area);
  all.most = std::max(all.most, limit.area);
}

void RegionLimits::take(Range& all, const Range& more) {
  all.least = std::min(all.least, more.least);
  all.most = std::max(all.most, more.most);
  all.some = all.some || more.some;
  all.all = all.all && more.all;
}

// --- Writing ---------------------------------------------------------------------------------

// A node that no other value has.
RegionLimits::Node& RegionLimits::own(Link& link) {
  if (link == nullptr) {
    link = std::make_shared<Node>();
  } else if (link.use_count() > 1) {
    link = std::make_shared<Node>(*link);
  }
  return *link;
}

void RegionLimits::summarise(Link& link) {
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

Cell<2> RegionLimits::cell_of(const Corners& triangle) const {
  const Box<2> box = detail::bounding_box<2>(triangle);
  const double extent = std::max(box.hi[0] - box.lo[0], box.hi[1] - box.lo[1]);
  const int level = std::ilogb(box_.side / extent) - 1;  // the side is twice the extent, or more
  return detail::MeshBox<2>::cell(box_.fixed(detail::middle_of(box)),
                                  std::clamp(level, 0, detail::kLevels - 1));
}

template <class Edit>
void RegionLimits::edit_at(Link& link, const Cell<2>& cell, int level, Edit& edit) {
  Node& node = own(link);
  if (level == cell.level) {
    edit(node.entries);
  } else {
    const int c = detail::MeshBox<2>::child_of(cell.corner, level);
    edit_at(node.child[static_cast<std::size_t>(c)], cell, level + 1, edit);
  }
  summarise(link);
}

void RegionLimits::insert(const Corners& triangle, const Limit& limit) {
  const Entry entry{detail::Facet(triangle, {}), limit};
  const auto put = [&](std::vector<Entry>& entries) { entries.push_back(entry); };
  edit_at(root_, cell_of(triangle), 0, put);
}

RegionLimits::Limit RegionLimits::erase(const Corners& triangle) {
  Limit limit;
  const auto take_out = [&](std::vector<Entry>& entries) {
    const auto same = [&](const Entry& e) { return e.facet.corners() == triangle; };
    const auto it = std::find_if(entries.begin(), entries.end(), same);
    SAC_EXPECTS(it != entries.end());
    limit = it->limit;
    entries.erase(it);
  };
  edit_at(root_, cell_of(triangle), 0, take_out);
  return limit;
}

// --- Reading ---------------------------------------------------------------------------------

// enter(box, node): of all that is in a cell; lo, side: of the cell.
template <class Enter, class Visit>
void RegionLimits::visit(const Node& node, const Point<2>& lo, double side, Enter& enter,
                         Visit& visit_entry) const {
  const double around = 0.26 * side;  // with some rounding
  const Box<2> box{{lo[0] - around, lo[1] - around},
                   {lo[0] + side + around, lo[1] + side + around}};
  if (!enter(box, node)) return;
  for (const Entry& e : node.entries) visit_entry(e);
  for (std::size_t c = 0; c < 4; ++c) {
    if (node.child[c] == nullptr) continue;
    const Point<2> inner{lo[0] + ((c & 1) != 0 ? side / 2 : 0),
                         lo[1] + ((c & 2) != 0 ? side / 2 : 0)};
    visit(*node.child[c], inner, side / 2, enter, visit_entry);
  }
}

std::size_t RegionLimits::bytes_below(const Node& node) {
  constexpr std::size_t kCounts = 16;  // what a shared_ptr keeps beside a node
  std::size_t bytes = sizeof(Node) + kCounts + node.entries.capacity() * sizeof(Entry);
  for (const Link& child : node.child) {
    if (child != nullptr) bytes += bytes_below(*child);
  }
  return bytes;
}
std::size_t RegionLimits::bytes() const { return root_ == nullptr ? 0 : bytes_below(*root_); }

RegionLimits::Limit RegionLimits::at(const Point<2>& p) const {
  Limit found;
  const auto enter = [&](const Box<2>& box, const Node& node) {
    return node.range.some && detail::contains(box, p);
  };
  const auto look = [&](const Entry& e) {
    if (!e.limit.counts || !e.facet.contains(p)) return;
    found.counts = true;
    found.area = std::min(found.area, e.limit.area);
  };
  if (root_ != nullptr) visit(*root_, box_.lo, box_.side, enter, look);
  return found;
}

// What lies in the box takes no further look, nor what says nothing new.
RegionLimits::Range RegionLimits::range(const Box<2>& box) const {
  Range all;
  const auto enter = [&](const Box<2>& around, const Node& node) {
    if (detail::is_empty(detail::common(around, box))) return false;
    Range more = all;
    take(more, node.range);
    if (more == all) return false;
    if (!detail::contains(box, around)) return true;
    all = more;
    return false;
  };
  const auto look = [&](const Entry& e) {
    if (e.facet.touches(box)) take(all, e.limit);
  };
  if (root_ != nullptr) visit(*root_, box_.lo, box_.side, enter, look);
  return all;
}

// --- From scratch ----------------------------------------------------------------------------

std::shared_ptr<const RegionLimits> region_limits(const Pslg& graph, const Options<2>& options,
                                                  Extent extent, RegionAreas areas) {
  Options<2> unlimited = options;
  detail::AllLimits().apply_to(unlimited);
  const MeshData whole = with_features(mesh_statically(graph, unlimited), graph);
  const Domain domain = find_domain(whole, whole.features.edges, seeds_of(graph), extent);
  const auto limits = std::make_shared<RegionLimits>(detail::mesh_box(options));
  std::vector<double> all;
  for (const auto& region : graph.regions) {
    if (areas == RegionAreas::limits && region.max_area) all.push_back(*region.max_area);
  }
  for (std::size_t t = 0; t < whole.simplices.size(); ++t) {
    const Region& region = domain.regions[domain.region_of[t]];
    RegionLimits::Limit limit{domain.keeps(region), RegionLimits::kNone, {}};
    if (areas == RegionAreas::limits && region.max_area) limit.area = *region.max_area;
    const auto& [a, b, c] = whole.simplices[t];
    limits->insert({whole.vertices[a], whole.vertices[b], whole.vertices[c]}, limit);
  }
  limits->set_areas(std::move(all));
  return limits;
}

}  // namespace mesher
