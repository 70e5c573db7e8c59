// Chains are parted where their middles are, and each chain by its edges' numbers.
#include "space/edge_tree.hpp"

#include <numeric>
#include <span>
#include <tuple>

namespace mesher::detail {
namespace {

// The direction of half of the angle of (c, s), which has length 1.
Point<2> at_half_angle(const Point<2>& v) {
  if (v[0] >= 0) {
    const double x = std::sqrt((1 + v[0]) / 2);
    return {x, v[1] / (2 * x)};
  }
  const double y = std::sqrt((1 - v[0]) / 2);
  return {v[1] / (2 * y), y};
}

Point<2> at_twice_the_angle(const Point<2>& v) {
  return {v[0] * v[0] - v[1] * v[1], 2 * v[0] * v[1]};
}

// The length of what it is shown by its directions, up to right angles: angles times four.
class Directions {
 public:
  void show(const EdgeTree::Ends& e) {
    const Point<2> along{e[1][0] - e[0][0], e[1][1] - e[0][1]};
    const double length = std::sqrt(along[0] * along[0] + along[1] * along[1]);
    if (!(length > 0)) return;
    const Point<2> fourfold =
        at_twice_the_angle(at_twice_the_angle({along[0] / length, along[1] / length}));
    for (std::size_t i = 0; i < 2; ++i) sum_[i] += length * fourfold[i];
  }
  [[nodiscard]] Point<2> mean() const {
    const double length = std::sqrt(sum_[0] * sum_[0] + sum_[1] * sum_[1]);
    if (!(length > 0)) return {1, 0};
    return at_half_angle(at_half_angle({sum_[0] / length, sum_[1] / length}));
  }

 private:
  Point<2> sum_{};
};

}  // namespace

class EdgeTree::Builder {
 public:
  Builder(EdgeTree& tree, const std::vector<Ends>& edges,
          const std::vector<std::uint32_t>& chain_end)
      : tree_(tree), edges_(edges), chain_end_(chain_end) {
    std::vector<std::uint32_t> chains(chain_end.size());
    std::iota(chains.begin(), chains.end(), 0);
    for (const std::uint32_t chain : chains) find_middle(chain);
    part(chains);
  }

 private:
  [[nodiscard]] std::uint32_t begin_of(std::uint32_t chain) const {
    return chain == 0 ? 0 : chain_end_[chain - 1];
  }
  void find_middle(std::uint32_t chain) {
    Box<2> box{edges_[begin_of(chain)][0], edges_[begin_of(chain)][0]};
    for (std::uint32_t i = begin_of(chain); i < chain_end_[chain]; ++i) include(box, edges_[i]);
    middles_.push_back({(box.lo[0] + box.hi[0]) / 2, (box.lo[1] + box.hi[1]) / 2});
  }
  static void include(Box<2>& box, const Ends& e) {
    for (const Point<2>& p : e) {
      for (std::size_t i = 0; i < 2; ++i) {
        box.lo[i] = std::min(box.lo[i], p[i]);
        box.hi[i] = std::max(box.hi[i], p[i]);
      }
    }
  }

  // A node of whole chains.
  std::uint32_t part(std::span<std::uint32_t> chains) {
    if (chains.size() == 1) return part(begin_of(chains[0]), chain_end_[chains[0]]);
    std::uint32_t edges = 0;
    for (const std::uint32_t chain : chains) edges += chain_end_[chain] - begin_of(chain);
    if (edges <= kLeaf) {
      for (const std::uint32_t chain : chains) append(begin_of(chain), chain_end_[chain]);
      return node(edges, false);
    }
    const std::size_t half = chains.size() / 2;
    halve(chains, half);
    return join([&] { part(chains.first(half)); }, [&] { return part(chains.subspan(half)); },
                false);
  }
  // Across the longer side of the box around their middles.
  void halve(std::span<std::uint32_t> chains, std::size_t half) {
    Box<2> box{middles_[chains[0]], middles_[chains[0]]};
    for (const std::uint32_t chain : chains) include(box, {middles_[chain], middles_[chain]});
    const std::size_t k = box.hi[0] - box.lo[0] >= box.hi[1] - box.lo[1] ? 0 : 1;
    const auto key = [&](std::uint32_t chain) { return std::tuple(middles_[chain][k], chain); };
    std::nth_element(chains.begin(), chains.begin() + static_cast<std::ptrdiff_t>(half),
                     chains.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  }
  // A node of edges of one chain.
  std::uint32_t part(std::uint32_t begin, std::uint32_t end) {
    if (end - begin <= kLeaf) {
      append(begin, end);
      return node(end - begin, true);
    }
    const std::uint32_t half = begin + (end - begin) / 2;
    return join([&] { part(begin, half); }, [&] { return part(half, end); }, true);
  }

  void append(std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t i = begin; i < end; ++i) tree_.items_.push_back(i);
  }
  // A node before its two children.
  template <class First, class Second>
  std::uint32_t join(First&& first, Second&& second, bool in_chain) {
    const auto begin = static_cast<std::uint32_t>(tree_.items_.size());
    const auto n = static_cast<std::uint32_t>(tree_.nodes_.size());
    tree_.nodes_.emplace_back();
    first();
    const std::uint32_t other = second();
    tree_.nodes_[n] = boxed(begin, in_chain);
    tree_.nodes_[n].second = other;
    return n;
  }
  // A leaf of the last items.
  std::uint32_t node(std::uint32_t items, bool in_chain) {
    tree_.nodes_.push_back(
        boxed(static_cast<std::uint32_t>(tree_.items_.size()) - items, in_chain));
    return static_cast<std::uint32_t>(tree_.nodes_.size() - 1);
  }
  [[nodiscard]] Node boxed(std::uint32_t begin, bool in_chain) const {
    Node made{.begin = begin,
              .end = static_cast<std::uint32_t>(tree_.items_.size()),
              .in_chain = in_chain};
    const auto items = std::span(tree_.items_).subspan(begin);
    Directions directions;
    for (const std::uint32_t i : items) directions.show(edges_[i]);
    made.axis = directions.mean();
    const Point<2> start = made.local(edges_[items[0]][0]);
    Box<2> box{start, start};
    for (const std::uint32_t i : items) {
      include(box, {made.local(edges_[i][0]), made.local(edges_[i][1])});
    }
    made.lo = box.lo, made.hi = box.hi;
    return made;
  }

  EdgeTree& tree_;
  const std::vector<Ends>& edges_;
  const std::vector<std::uint32_t>& chain_end_;
  std::vector<Point<2>> middles_;  // of chains
};

void EdgeTree::build(const std::vector<Ends>& edges, const std::vector<std::uint32_t>& chain_end) {
  nodes_.clear();
  items_.clear();
  extent_ = 0;
  count_ = static_cast<std::uint32_t>(edges.size());
  for (const Ends& e : edges) {
    for (const Point<2>& p : e) {
      extent_ = std::max({extent_, std::abs(p[0]), std::abs(p[1])});
    }
  }
  if (count_ <= kLeaf) return;
  const Builder builder(*this, edges, chain_end);
  nodes_.shrink_to_fit();
}

}  // namespace mesher::detail
