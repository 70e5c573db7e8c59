// Facets in a tree of boxes.
#include "sizes/facet_sizes.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace mesher::detail {

namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

void take(SizeRange& all, const SizeRange& r) {
  all.least = std::min(all.least, r.least);
  all.most = std::max(all.most, r.most);
}

}  // namespace

template <int D>
FacetSizes<D>::FacetSizes(std::vector<Facet<D>> facets) : facets_(std::move(facets)) {
  nodes_.reserve(2 * facets_.size());
  if (!facets_.empty()) build(0, facets_.size());
}

template <int D>
void FacetSizes<D>::build(std::size_t begin, std::size_t end) {
  constexpr std::size_t kLeaf = 4;
  const std::size_t me = nodes_.size();
  Node node{facets_[begin].extent(), {kInfinite, 0}, begin, end};
  for (std::size_t i = begin; i < end; ++i) {
    for (const Point<D>& p : facets_[i].corners()) grow(node.box, p);
    take(node.range, {facets_[i].least(), facets_[i].most()});
  }
  nodes_.push_back(node);
  if (end - begin <= kLeaf) return;
  std::size_t axis = 0;
  const auto side = [&](std::size_t i) { return node.box.hi[i] - node.box.lo[i]; };
  for (std::size_t i = 1; i < D; ++i) axis = side(axis) < side(i) ? i : axis;
  const std::size_t middle = begin + (end - begin) / 2;
  const auto at = [&](std::size_t i) { return facets_.begin() + static_cast<std::ptrdiff_t>(i); };
  const auto amid = [axis](const Facet<D>& f) {
    const Box<D> extent = f.extent();
    return extent.lo[axis] + extent.hi[axis];
  };
  std::nth_element(at(begin), at(middle), at(end),
                   [&](const Facet<D>& a, const Facet<D>& b) { return amid(a) < amid(b); });
  build(begin, middle);
  nodes_[me].right = nodes_.size();
  build(middle, end);
}

// Halving keeps the tree's depth below the number of bits of a size.
template <int D>
template <class Enter, class Visit>
void FacetSizes<D>::visit(Enter&& enter, Visit&& visit_facet) const {
  std::array<std::size_t, 65> stack;
  std::size_t top = 0;
  if (!nodes_.empty()) stack[top++] = 0;
  while (top > 0) {
    const std::size_t me = stack[--top];
    const Node& n = nodes_[me];
    if (!enter(n)) continue;
    if (n.right == 0) {
      for (std::size_t i = n.begin; i < n.end; ++i) visit_facet(facets_[i]);
    } else {
      stack[top++] = n.right;
      stack[top++] = me + 1;
    }
  }
}

template <int D>
double FacetSizes<D>::at(const Point<D>& p) const {
  double least = kInfinite;
  visit([&](const Node& n) { return n.range.least < least && contains(n.box, p); },
        [&](const Facet<D>& f) {
          if (f.least() < least && f.contains(p)) least = std::min(least, f.at(p));
        });
  return least;
}

template <int D>
SizeRange FacetSizes<D>::range(const Box<D>& box) const {
  SizeRange all{kInfinite, 0};
  visit(
      [&](const Node& n) {
        const bool known = n.range.least >= all.least && n.range.most <= all.most;
        if (known || is_empty(common(n.box, box))) return false;
        if (contains(box, n.box)) return take(all, n.range), false;
        return true;
      },
      [&](const Facet<D>& f) {
        if (f.touches(box)) take(all, f.range(box));
      });
  return {all.least, std::max(all.least, all.most)};
}

template class FacetSizes<2>;
#ifndef MESHER_PLANE_ONLY
template class FacetSizes<3>;
#endif

}  // namespace mesher::detail
