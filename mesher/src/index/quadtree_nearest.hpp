// Searching the quadtree strictly nearest first [rules B3].
//
// A queue holds cells, vertices and what is left of the way up, each by the least distance at which
// it may have something: a cell is opened when its turn comes, a vertex is visited when no cell can
// hold a nearer one, and the cells around the leaf of the center are climbed to as far as the
// search gets.
#pragma once

#include <algorithm>
#include <array>

#include "index/quadtree_class.hpp"

namespace mesher::detail {

/// What a search in order of distance needs memory for; to be kept for the next one.
template <int D>
struct NearestFirst {
  enum class Kind : std::uint8_t { cell, vertex, above };
  struct Item {
    Point<D> at;  // a cell's lower corner relative to the center; a vertex's place
    double side;
    std::uint32_t id;  // node, handle, or step of the way
    Kind kind;
  };
  struct Turn {
    double distance2;
    std::uint32_t item;
    friend bool operator<(const Turn& a, const Turn& b) { return a.distance2 > b.distance2; }
  };

  void clear() noexcept {
    items.clear();
    turns.clear();
  }
  void add(double distance2, const Item& item) {
    turns.push_back({distance2, static_cast<std::uint32_t>(items.size())});
    items.push_back(item);
    std::push_heap(turns.begin(), turns.end());
  }
  [[nodiscard]] Turn next() {
    std::pop_heap(turns.begin(), turns.end());
    const Turn turn = turns.back();
    turns.pop_back();
    return turn;
  }

  std::vector<Item> items;
  std::vector<Turn> turns;  // a heap
  std::vector<Item> way;    // the cells around the center, from the root to its leaf
};

template <int D>
void Quadtree<D>::find_way(const Point<D>& center, NearestFirst<D>& queue) const {
  const Fixed<D> f = box_.fixed(center);
  typename NearestFirst<D>::Item at{{}, box_.side, 0, NearestFirst<D>::Kind::cell};
  for (std::size_t i = 0; i < D; ++i) at.at[i] = box_.lo[i] - center[i];
  queue.way.assign(1, at);
  for (int level = 0; nodes_[at.id].open() != 0; ++level) {
    const int c = MeshBox<D>::child_of(f, level);
    at.side /= 2;
    for (std::size_t i = 0; i < D; ++i) at.at[i] += (c >> i & 1) != 0 ? at.side : 0;
    at.id = nodes_[at.id].open() + static_cast<NodeIndex>(c);
    queue.way.push_back(at);
  }
}

// Squared, how near what is outside of a cell around the center can be.
template <int D>
double Quadtree<D>::beyond2(const Point<D>& rel, double side) const noexcept {
  double nearest = side;
  for (std::size_t i = 0; i < D; ++i) nearest = std::min({nearest, -rel[i], rel[i] + side});
  nearest = std::max(nearest - margin_, 0.0);
  return nearest * nearest;
}

// Squared, how near what is inside of a cell can be.
template <int D>
double Quadtree<D>::within2(const Point<D>& rel, double side) const noexcept {
  double d2 = 0;
  for (std::size_t i = 0; i < D; ++i) {
    const double d = std::max(std::max(rel[i], -(rel[i] + side)) - margin_, 0.0);
    d2 += d * d;
  }
  return d2;
}

template <int D>
template <class Limit, class Enters, class Visit>
void Quadtree<D>::visit_nearest_first(const Point<D>& center, NearestFirst<D>& queue,
                                      Limit&& limit2, Enters&& enters, Visit&& visit) const {
  using Kind = typename NearestFirst<D>::Kind;
  using Item = typename NearestFirst<D>::Item;
  queue.clear();
  find_way(center, queue);
  const auto add_cell = [&](const Item& cell) {
    const double d2 = within2(cell.at, cell.side);
    const bool empty = nodes_[cell.id].open() == 0 && nodes_[cell.id].head == 0;
    if (!empty && d2 <= limit2()) queue.add(d2, cell);
  };
  const auto add_children = [&](const Item& cell, NodeIndex except) {
    const NodeIndex first = nodes_[cell.id].open();
    for (int c = 0; c < kChildren; ++c) {
      Item child{cell.at, cell.side / 2, first + static_cast<NodeIndex>(c), Kind::cell};
      if (child.id == except) continue;
      for (std::size_t i = 0; i < D; ++i) child.at[i] += (c >> i & 1) != 0 ? child.side : 0;
      add_cell(child);
    }
  };
  const auto add_above = [&](std::size_t step) {
    if (step == 0) return;
    Item above = queue.way[step];
    above.id = static_cast<std::uint32_t>(step);
    above.kind = Kind::above;
    queue.add(beyond2(above.at, above.side), above);
  };
  add_cell(queue.way.back());
  add_above(queue.way.size() - 1);
  while (!queue.turns.empty()) {
    const auto turn = queue.next();
    if (turn.distance2 > limit2()) return;
    const Item item = queue.items[turn.item];
    if (item.kind == Kind::vertex) {
      visit(item.id, item.at, turn.distance2);
    } else if (item.kind == Kind::above) {
      add_children(queue.way[item.id - 1], queue.way[item.id].id);
      add_above(item.id - 1);
    } else if (!enters(item.at, item.side)) {
      continue;
    } else if (nodes_[item.id].open() != 0) {
      add_children(item, 0);
    } else {
      visit_leaf(item.id, [&](VertexHandle h, const Point<D>& place) {
        const double d2 = distance2(place, center);
        if (d2 <= limit2()) queue.add(d2, {place, 0, h, Kind::vertex});
      });
    }
  }
}

}  // namespace mesher::detail
