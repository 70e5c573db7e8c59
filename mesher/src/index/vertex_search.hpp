// Searches for vertices: the queries of the index, without a history.
//
// A cell is searched near its centre first, in the leaves that a gap ball can still enter
// [L 4.3.3]. It need not start from nothing:
//   repair   from what the same question was answered last time, and the vertices that have come
//            since: only where a neighbour went are there gap balls to be searched;
//   seeds    from vertices that are likely to be neighbours: a small cell from the start.
// Either way the cell is that of the set of vertices that are seen, and of nothing else.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "cells/cell_of.hpp"
#include "index/cell_pool.hpp"
#include "index/live_triangulation.hpp"
#include "index/quadtree.hpp"
#include "records/roles.hpp"
#include "records/vertex.hpp"

namespace mesher::detail {

template <int D = 2>
class VertexSearch {
 protected:
  using Cell = CellOf<D>;

 public:
  explicit VertexSearch(const MeshBox<D>& box) : box_(box), tree_(box, pool_) {}
  VertexSearch(const VertexSearch&) = delete;
  VertexSearch& operator=(const VertexSearch&) = delete;

  [[nodiscard]] VertexPool<D>& pool() noexcept { return pool_; }
  [[nodiscard]] const VertexPool<D>& pool() const noexcept { return pool_; }
  [[nodiscard]] Quadtree<D>& tree() noexcept { return tree_; }
  [[nodiscard]] const Quadtree<D>& tree() const noexcept { return tree_; }
  [[nodiscard]] const MeshBox<D>& box() const noexcept { return box_; }
  /// Lengths are kept as floats in units of the box's side, a power of two. `x` must be >= 0.
  [[nodiscard]] float packed(double x) const noexcept;
  [[nodiscard]] double unpacked(float x) const noexcept { return double{x} * box_.side; }

  /// Who refuses a vertex where there is one: throws.
  using RefuseCoincident = std::function<void(const Point<D>&)>;
  void set_refusal(RefuseCoincident refuse) { refuse_ = std::move(refuse); }

  /// The place on a segment that v stands for, if it does.
  [[nodiscard]] Role role(const Vertex<D>& v) const noexcept {
    return v.on_segment ? roles_[v.self] : Role();
  }
  [[nodiscard]] const Roles& roles() const noexcept { return roles_; }

  /// Calls visit(vertex) for the records of vertices in the ball with diameter ab, and for others
  /// nearby; visit must not throw.
  template <class Visit>
  requires(D == 2) void for_each_in_ball(const Point<D>& a, const Point<D>& b,
                                         Visit&& visit) const noexcept {
    const Point<D> middle{a[0] + (b[0] - a[0]) / 2, a[1] + (b[1] - a[1]) / 2};
    const double r = std::hypot(b[0] - a[0], b[1] - a[1]) / 2 + tree_.margin();
    const auto enters = [](const Point<D>&, double) { return true; };
    typename Quadtree<D>::Looked looked;
    tree_.visit_box(middle, {{-r, -r}, {r, r}}, looked, enters,
                    [&](const auto& handles, const auto& places, std::uint32_t count) {
                      for (std::uint32_t i = 0; i < count; ++i) {
                        if (squared_distance(places[i], middle) > r * r * (1 + 0x1p-40)) continue;
                        visit(pool_[handles[i]]);
                      }
                    });
  }

  /// Features that matter to v are within this of it: those that its star may meet, or that points
  /// in the balls of its corners yield to. A point x in the ball of a corner q, and a feature in
  /// the ball around x that is empty, are within 2.75 |q| of v (program/space_lines.hpp), and q's
  /// ball extends from v farther than 1.577 |q| along some axis.
  [[nodiscard]] double beside(const CellOf<D>& cell) const noexcept {
    return beside(concern(cell));
  }

  /// Where a vertex that comes may cut the cell, or one may be that bounds it: around its gap
  /// balls. A corner of the cell of a vertex v on a side of the box, beyond that side, is never
  /// cut. Proof: the grid is there from the start, so the corner's projection q on the side is at
  /// most half an edge from v; a vertex nearer to the corner than v, being in the box, is nearer to
  /// q, too, hence in the diametral ball of an edge of the grid. No vertex ever is [L 4.4.1].
  [[nodiscard]] Reach<D> concern(const Cell& cell) const noexcept;
  /// Whether the clip hides nothing of the cell: no virtual neighbour bounds it within the box.
  [[nodiscard]] bool is_whole(const Cell& cell) const noexcept;

  /// Clip radius at which no corner of a star is hidden: circumcentres lie in the box.
  [[nodiscard]] double whole() const noexcept { return 2 * box_.side; }

  /// The record of an input point, not alive yet. `first`: no vertex but the boundary's and inputs
  /// at other places is there. Throws: std::bad_alloc, and then changes nothing.
  Vertex<D>& add_input(const Point<D>& p, bool first) {
    Vertex<D>* v = first ? nullptr : tree_.find(p);
    if (v == nullptr) v = &add(p);
    v->input = true;
    return *v;
  }

  /// A vertex of the boundary grid: there from the start, for good.
  VertexRef<D> add_boundary(const Point<D>& p) {
    Vertex<D>& v = add(p);
    mark_boundary(v);
    return {&v};
  }

 protected:
  using Tree = Quadtree<D>;
  using Codes = std::span<const typename Cell::Code>;

  Vertex<D>& add(const Point<D>& p) {
    Vertex<D>& v = pool_.create(p);
    try {
      tree_.insert(v);
    } catch (...) {
      pool_.release(v);
      throw;
    }
    return v;
  }

  static void mark_boundary(Vertex<D>& v) noexcept {
    v.alive = v.boundary = v.committed = true;
    v.committed_kind = VertexKind::boundary;
  }

  /// The cell of v among all vertices u for which seen(u); u is a handle.
  template <class Seen>
  CellLoan<D> cut_around(const Vertex<D>& v, double radius, Seen&& seen) const {
    CellLoan<D> cell = cells_.borrow();
    cell->reset(v, radius);
    finish(*cell, seen);
    return cell;
  }

  /// A cell, to be made that of a vertex v among all vertices u for which seen(u): it begins with
  /// some, candidates are tried, and a search finishes it. There are no candidates yet.
  [[nodiscard]] CellLoan<D> borrow_cell() const {
    met_count_ = 0;
    return cells_.borrow();
  }
  /// Begins with vertices that may be seen: v's neighbours at another time, `ring`, as they were
  /// written down, with whatever clip.
  template <class Seen>
  void begin_with_ring(Cell& cell, const Vertex<D>& v, double radius, Codes ring, Seen& seen) {
    const auto left = [&](typename Cell::Code u) { return u < Cell::kVirtual && seen(u); };
    cell.restore(pool_, v, radius, ring, left, false);
  }
  /// Begins with the cell for another set of vertices, written down as `last`, with the same clip.
  /// for_each_arrival(visit) calls visit(u) for all vertices that are new in the set and cut that
  /// cell, and perhaps for others.
  template <class ForEachArrival, class Seen>
  void begin_repair(Cell& cell, const Vertex<D>& v, double radius, Codes last,
                    ForEachArrival&& for_each_arrival, Seen& seen) {
    const auto left = [&](typename Cell::Code u) { return u >= Cell::kVirtual || seen(u); };
    cell.restore(pool_, v, radius, last, left, true);
    for_each_arrival([&](VertexHandle u) {
      if (cell.cuts(pool_[u].p) && seen(u)) cell.cut(u);
    });
  }
  /// Notes u, who may cut an open corner, for cut_by_candidates().
  void add_candidate(const Cell& cell, VertexHandle u) const {
    const Point<D>& p = pool_[u].p;
    const double d2 = squared_distance(p, cell.center().p);
    ++visited_;
    if (!cell.in_reach(d2) || u == cell.center().self) return;
    if (met_.size() < met_count_ + Tree::kSlots) met_.resize(2 * met_.size() + Tree::kSlots);
    met_[met_count_++] = {d2, u, p};
  }
  /// Cuts the cell by the candidates that are seen and nearer to an open corner, the nearest first,
  /// and forgets them.
  template <class Seen>
  void cut_by_candidates(Cell& cell, Seen& seen) const {
    const auto first = met_.begin(), last = first + static_cast<std::ptrdiff_t>(met_count_);
    std::sort(first, last, [](const Met& a, const Met& b) { return a.distance2 < b.distance2; });
    for (auto met = first; met != last && cell.in_reach(met->distance2); ++met) {
      cut_by(cell, *met, seen);
    }
    met_count_ = 0;
  }
  /// Cuts the cell by what is seen in the gap balls of its open corners. Where it is not known how
  /// large the cell will be, near vertices come first, the nearest of them first. Where a box holds
  /// very many, as next to far finer parts of the mesh, most are behind the first few of them.
  template <class Seen>
  requires(D == 2) void finish(Cell& cell, Seen& seen) const {
    const Point<D>& center = cell.center().p;
    typename Tree::Looked looked;
    for (double within = 0; cell.open2() > 0; within *= 2) {
      const Box<D> gaps = cell.open_extent();
      const bool all = cell.is_compact();
      if (!all && within == 0) within = tree_.side_at(center) / 2;
      const bool has_met_all = meet(cell, all ? gaps : clipped(gaps, within), looked);
      all&& has_met_all ? cut_by_met(cell, seen) : cut_nearest_first(cell, seen);
      if (!has_met_all) return finish_outward(cell, looked, seen);
      if (all || clipped(gaps, within) == gaps) return;
    }
  }
  /// The same for a cell that is known but for little.
  template <class Seen>
  void finish_known(Cell& cell, Seen& seen) const {
    if constexpr (D == 2) {
      if (!cell.is_compact()) return finish_outward(cell, {}, seen);
    }
    finish(cell, seen);
  }
  /// In space too, where the cell is not much larger than it will be and few are in the box. Else
  /// strictly nearest first: shells meet far fine regions with a thousand temporary neighbours
  /// [rules B3].
  template <class Seen>
  requires(D > 2) void finish(Cell& cell, Seen& seen) const {
    if (cell.open2() == 0) return;
    typename Tree::Looked looked;
    if (cell.is_compact() && meet(cell, cell.open_extent(), looked)) {
      return cut_by_candidates(cell, seen);
    }
    const Vertex<D>& v = cell.center();
    tree_.visit_nearest_first(
        v.p, queue_, [&] { return 4 * cell.open2(); }, entered(cell),
        [&](VertexHandle u, const Point<D>& place, double d2) {
          ++visited_;
          if (u != v.self) cut_by(cell, {d2, u, place}, seen);
        });
  }

  using Nearest = typename LiveTriangulation<D>::Nearest;
  template <class Seen>
  Nearest nearest_around(const Vertex<D>& v, Seen&& seen) const {
    Nearest best{0, 4 * box_.side * box_.side};
    const auto enters = [&](const Point<D>&, double) { return ++visited_, true; };
    const auto look = [&](VertexHandle u, const Point<D>& p) {
      const double d2 = squared_distance(p, v.p);
      if (u == v.self || d2 > best.distance2 || !seen(u)) return;
      if (d2 == best.distance2 && best.handle != 0 && pool_[best.handle].p < p) return;
      best = {u, d2};
    };
    const auto visit = [&](const typename Tree::Handles& handles,
                           const typename Tree::Places& places, std::uint32_t count) {
      visited_ += count;
      for (std::uint32_t i = 0; i < count; ++i) look(handles[i], places[i]);
    };
    typename Tree::Looked looked;
    for (double within = tree_.side_at(v.p) / 2;; within *= 2) {
      const double r = std::min(within, std::sqrt(best.distance2));
      tree_.visit_box(v.p, cube(r), looked, enters, visit);
      if (best.distance2 <= within * within || r < within) return best;
    }
  }

  static constexpr double kBeside = 1.75;
  [[nodiscard]] double beside(const Reach<D>& reach) const noexcept {
    return kBeside * reach.farthest() * box_.side;
  }

  /// Cells and vertices that searches have looked at since this was asked last, each as often.
  [[nodiscard]] std::uint64_t take_visited() noexcept { return std::exchange(visited_, 0); }

  /// Where a side of the box that v is on leads outward: -1 or 1 along its axis, else 0.
  [[nodiscard]] Point<D> outward(const Vertex<D>& v) const noexcept;

  // Requires: roles_.reserve(v.self), unless the role is none.
  void set_role(Vertex<D>& v, const Role& role) noexcept {
    v.on_segment = role.on != 0;
    if (v.on_segment) roles_.set(v.self, role);
  }

  [[noreturn]] void fail_coincident(const Point<D>& p) const;

  const MeshBox<D>& box_;
  VertexPool<D> pool_;
  Quadtree<D> tree_;
  Roles roles_;
  RefuseCoincident refuse_;

 private:
  // Cells and vertices in a box. Measured (updates of great_lakes): 64 or 96 is a tenth better than
  // 128; on points that are evenly dense all are equal. In space (updates of uniform points) 400
  // and 1200 take 2% fewer instructions than 200.
  static constexpr std::uint64_t kMostMet = D == 2 ? 64 : 400;
  struct Met {
    double distance2;
    VertexHandle vertex;
    Point<D> place;
  };
  [[nodiscard]] auto entered(const Cell& cell) const {
    return [&, margin = tree_.margin()](const Point<D>& corner, double side) {
      ++visited_;
      return cell.enters(corner, side, margin);
    };
  }
  // What finish() does, leaf by leaf.
  template <class Seen>
  void finish_outward(Cell& cell, const typename Tree::Looked& looked, Seen& seen) const {
    const Vertex<D>& v = cell.center();
    const auto cut_all = [&](const typename Tree::Handles& handles,
                             const typename Tree::Places& places, std::uint32_t used) {
      visited_ += used;
      for (std::uint32_t i = 0; i < used; ++i) {
        const double d2 = squared_distance(places[i], v.p);
        if (cell.in_reach(d2) && handles[i] != v.self)
          cut_by(cell, {d2, handles[i], places[i]}, seen);
      }
    };
    tree_.visit_outward(v.p, cell.open_extent(), looked, entered(cell), cut_all);
  }

  // Notes who is in reach in the leaves that a gap ball enters, and returns true; false if they are
  // too many to be looked at. Whether a vertex is in reach cannot be predicted: all are written
  // down, and those that are not are written over. Slots without a vertex are infinitely far, which
  // the corner between two neighbours that are nearly one may be as well.
  bool meet(const Cell& cell, const Box<D>& box, typename Tree::Looked& looked) const {
    met_count_ = 0;
    std::size_t count = 0;
    const auto note = [&, v = cell.center().self, center = cell.center().p,
                       reach2 = std::min(4 * cell.open2(), std::numeric_limits<double>::max())](
                          const typename Tree::Handles& handles,
                          const typename Tree::Places& places, std::uint32_t used) {
      visited_ += used;
      if (met_.size() < count + Tree::kSlots) met_.resize(2 * met_.size() + Tree::kSlots);
      Met* const met = met_.data();
      for (std::size_t i = 0; i < Tree::kSlots; ++i) {
        const double d2 = squared_distance(places[i], center);
        met[count] = {d2, handles[i], places[i]};
        count += static_cast<std::size_t>((d2 <= reach2) & (handles[i] != v));
      }
    };
    const Point<D>& center = cell.center().p;
    const bool all = tree_.visit_box(center, box, looked, entered(cell), note, kMostMet);
    met_count_ = count;
    return all;
  }
  template <class Seen>
  void cut_by(Cell& cell, const Met& met, Seen& seen) const {
    if (!cell.has(met.vertex) && cell.cuts_open(met.place) && seen(met.vertex)) {
      cell.cut(met.vertex);
    }
  }
  template <class Seen>
  void cut_by_met(Cell& cell, Seen& seen) const {
    for (std::size_t i = 0; i < met_count_; ++i) {
      if (cell.in_reach(met_[i].distance2)) cut_by(cell, met_[i], seen);
    }
  }
  // Who is met is bounded, so that looking for the nearest each time is.
  template <class Seen>
  void cut_nearest_first(Cell& cell, Seen& seen) const {
    for (; met_count_ > 0; --met_count_) {
      visited_ += met_count_;
      std::size_t nearest = 0;
      double d2 = met_[0].distance2;
      for (std::size_t i = 1; i < met_count_; ++i) {
        nearest = met_[i].distance2 < d2 ? i : nearest;
        d2 = std::min(d2, met_[i].distance2);
      }
      if (!cell.in_reach(d2)) return;
      cut_by(cell, met_[nearest], seen);
      met_[nearest] = met_[met_count_ - 1];
    }
  }
  [[nodiscard]] static Box<D> cube(double r) {
    Box<D> box;
    box.lo.fill(-r);
    box.hi.fill(r);
    return box;
  }
  [[nodiscard]] static Box<D> clipped(Box<D> box, double within) {
    for (double& x : box.lo) x = std::max(x, -within);
    for (double& x : box.hi) x = std::min(x, within);
    return box;
  }

  mutable CellPool<D> cells_;
  // Whom a search has met; what lies behind the count is room.
  mutable std::vector<Met> met_;
  mutable std::size_t met_count_ = 0;
  mutable NearestFirst<D> queue_;
  mutable std::uint64_t visited_ = 0;
};

}  // namespace mesher::detail
