// The data that the thesis's programs share, on a scope S in D dimensions: the quadtree, the map P
// from its cells to points, the work queues, and functions that read them, so that build_qt.hpp and
// choose_steiners.hpp read like their figures.
//
// A cell of the tree is named by its level and coordinates (cells.hpp), and its data is in rows of
// that name (rows.hpp): so a call that splits a cell for another reason does not move it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <queue>
#include <vector>

#include "cells.hpp"
#include "gap_balls.hpp"
#include "rows.hpp"
#include "sac/sac.hpp"

namespace examples::thesis {

struct Settings {
  double L = 1;      ///< the box is [0, L]^D: a power of two
  double rho = 2;    ///< bound on the aspect ratio of Voronoi cells, above 1
  double gamma = 4;  ///< gap balls up to gamma NN(v) are looked for; above rho
};

/// A point in P(c), with the reason why the larger cell that it was in was split [Fig 4.4].
template <int D>
struct Entry {
  Point<D> p;
  Cell<D> tag;

  friend auto operator<=>(const Entry&, const Entry&) = default;
  friend void label_bytes(sac::LabelSink& sink, const Entry& e) {
    sac::label_arguments(sink, std::tie(e.p, e.tag));
  }
  friend std::uint64_t hash_value(const Entry& e) {
    return sac::mix(hash_value(e.p) + hash_value(e.tag));
  }
  friend std::ostream& operator<<(std::ostream& out, const Entry& e) {
    return out << e.p << " by " << e.tag;
  }
};

/// Says that a cell is split.
struct Mark {
  friend auto operator<=>(const Mark&, const Mark&) = default;
  friend void label_bytes(sac::LabelSink&, const Mark&) {}
};

/// Each P(c) has the newest entry first, so its order turns around from level to level; of the
/// cells of a point the deepest comes first.
struct NewestFirst {
  template <int D>
  static bool descends(const Cell<D>& c) {
    return c.level % 2 == 0;
  }
  template <int D>
  static bool descends(const Point<D>&) {
    return true;
  }
};

template <class S, int D>
class Refinement {
 public:
  template <class Host>
  Refinement(Host& host, const Settings& settings);
  Refinement(const Refinement&) = delete;  // it is the environment
  Refinement& operator=(const Refinement&) = delete;

  [[nodiscard]] const Settings& settings() const noexcept { return settings_; }
  /// The cell of a level that holds p.
  [[nodiscard]] Cell<D> cell(const Point<D>& p, int level) const {
    return cell_at(p, level, settings_.L);
  }
  [[nodiscard]] double side(const Cell<D>& c) const { return side_of(c, settings_.L); }

  // --- The quadtree

  [[nodiscard]] bool is_split(S& s, const Cell<D>& c) { return split_.first(s, c).has_value(); }
  void mark_split(S& s, const Cell<D>& c) { split_.put(s, c, Mark{}); }
  /// Calls visit(n) for the neighbours n of c, leaves that touch it, in a canonical order, until
  /// one says true; whether one has. Requires: c is in the tree.
  template <class Visit>
  bool any_neighbour(S& s, const Cell<D>& c, Visit&& visit);
  /// The leaf that holds x; found in O(1) if its level is near to `level`.
  [[nodiscard]] Cell<D> leaf_of(S& s, const Point<D>& x, int level);

  // --- The map P

  Rows<S, Cell<D>, Entry<D>, NewestFirst> P;
  /// The cells that have held an input point, the leaf first.
  Rows<S, Point<D>, Cell<D>, NewestFirst> cells_of;
  /// Whether P(a) and P(b) have two points or more: counted to two. b may be a.
  [[nodiscard]] bool hold_two(S& s, const Cell<D>& a, const Cell<D>& b);

  // --- The work queues

  typename S::AgendaType& cells;   ///< Q of BuildQT: cells to split
  typename S::AgendaType& events;  ///< Q of ChooseSteiners: bucketed with factor rho
  /// The bucket of a length: bucket b has those in [start(b), rho start(b)).
  [[nodiscard]] int bucket(double length) const;
  [[nodiscard]] double start(int b) const { return starts_[static_cast<std::size_t>(b)]; }
  /// By the grid of [Fig 4.9, 4.10], whose elements have side 3 gamma rho start(b): the parities of
  /// the coordinates of v's element.
  [[nodiscard]] unsigned colour(const Point<D>& v, int b) const;

  // --- Searches

  /// Visits the vertices within `reach` of v, v itself not, in the order of their distance, ties by
  /// coordinates, until visit(w, |vw|^2) says false; of the cells those that enters(c) says yes to.
  template <class Enters, class Visit>
  void sweep(S& s, const Point<D>& v, double reach, Enters&& enters, Visit&& visit);

  /// For the outside: calls visit(x) for each vertex of the mesh, in no order.
  template <class Visit>
  void for_each_vertex(Visit&& visit) const;
  /// Calls visit(c) for each cell that is split, in no order.
  template <class Visit>
  void for_each_split_cell(Visit&& visit) const {
    split_.for_each([&](const Cell<D>& c, const Mark&) { visit(c); });
  }

 private:
  /// c, or the leaf that it is a part of.
  [[nodiscard]] Cell<D> in_tree(S& s, Cell<D> c) {
    while (c.level > 0 && !is_split(s, parent_of(c))) c = parent_of(c);
    return c;
  }
  template <class Visit>
  bool any_leaf_beside(S& s, const Cell<D>& n, const Cell<D>& c, Visit&& visit);
  [[nodiscard]] std::vector<Cell<D>> cells_around(S& s, const Point<D>& v, double reach);

  Settings settings_;
  Rows<S, Cell<D>, Mark, NewestFirst> split_;
  std::vector<double> starts_;
};

/// The environment of a running call.
template <class S, int D>
[[nodiscard]] Refinement<S, D>& environment(S& s) {
  return s.template environment<Refinement<S, D>>();
}

template <class S, int D>
template <class Host>
Refinement<S, D>::Refinement(Host& host, const Settings& settings)
    : P(host),
      cells_of(host),
      cells(host.make_agenda("cells")),
      events(host.make_agenda("events")),
      settings_(settings),
      split_(host) {
  SAC_EXPECTS(settings.rho > 1 && settings.gamma > settings.rho);
  SAC_EXPECTS(settings.L > 0 && std::ldexp(1.0, std::ilogb(settings.L)) == settings.L);
  // No length is below the side of a deepest cell, nor above the box's diagonal.
  const double most = 2 * std::sqrt(double{D}) * settings.L;
  for (double start = std::ldexp(settings.L, -kDeepest - 2); start < most; start *= settings.rho) {
    starts_.push_back(start);
  }
  host.set_environment(this);
}

template <class S, int D>
template <class Visit>
bool Refinement<S, D>::any_neighbour(S& s, const Cell<D>& c, Visit&& visit) {
  std::vector<Cell<D>> larger;  // those met so far: one may lie beside c in several places
  return any_beside(c, [&](const Cell<D>& beside) {
    const Cell<D> n = in_tree(s, beside);
    if (n.level == c.level) return any_leaf_beside(s, n, c, visit);
    if (std::find(larger.begin(), larger.end(), n) != larger.end()) return false;
    larger.push_back(n);
    return static_cast<bool>(visit(n));
  });
}
template <class S, int D>
template <class Visit>
bool Refinement<S, D>::any_leaf_beside(S& s, const Cell<D>& n, const Cell<D>& c, Visit&& visit) {
  if (!is_split(s, n)) return visit(n);
  for (unsigned i = 0; i < 1u << D; ++i) {
    const Cell<D> part = child_of(n, i);
    if (touch(part, c) && any_leaf_beside(s, part, c, visit)) return true;
  }
  return false;
}
template <class S, int D>
Cell<D> Refinement<S, D>::leaf_of(S& s, const Point<D>& x, int level) {
  Cell<D> c = in_tree(s, cell(x, level));
  while (is_split(s, c)) c = cell(x, c.level + 1);
  return c;
}

template <class S, int D>
bool Refinement<S, D>::hold_two(S& s, const Cell<D>& a, const Cell<D>& b) {
  const auto p = P.first(s, a);
  if (p && P.behind(s, a, *p)) return true;
  if (a == b) return false;
  const auto q = P.first(s, b);
  return q && (p || P.behind(s, b, *q));
}

template <class S, int D>
int Refinement<S, D>::bucket(double length) const {
  const auto above = std::upper_bound(starts_.begin() + 1, starts_.end(), length);
  return static_cast<int>(above - starts_.begin()) - 1;
}
template <class S, int D>
unsigned Refinement<S, D>::colour(const Point<D>& v, int b) const {
  const double element = 3 * settings_.gamma * settings_.rho * start(b);
  unsigned colour = 0;
  for (unsigned i = 0; i < D; ++i) {
    colour |= static_cast<unsigned>(static_cast<std::uint64_t>(v[i] / element) & 1) << i;
  }
  return colour;
}

// Cells of the tree that hold all within `reach`: of a size to which the box is O(1) cells, or
// larger leaves.
template <class S, int D>
std::vector<Cell<D>> Refinement<S, D>::cells_around(S& s, const Point<D>& v, double reach) {
  const Cell<D> middle = cell(v, level_of(reach, settings_.L));
  std::vector<Cell<D>> around{in_tree(s, middle)};
  any_beside(middle, [&](const Cell<D>& c) {
    if (squared_distance(v, c, settings_.L) <= reach * reach) around.push_back(in_tree(s, c));
    return false;
  });
  std::sort(around.begin(), around.end());
  around.erase(std::unique(around.begin(), around.end()), around.end());
  return around;
}

// Dijkstra's search of §4.3: what is met next is the nearest cell or vertex that is known.
template <class S, int D>
template <class Enters, class Visit>
void Refinement<S, D>::sweep(S& s, const Point<D>& v, double reach, Enters&& enters,
                             Visit&& visit) {
  struct Met {
    double apart2;
    bool is_vertex;  // a cell as near comes first: it may hold a vertex as near
    Point<D> w;
    Cell<D> c;
    auto operator<=>(const Met&) const = default;
  };
  std::priority_queue<Met, std::vector<Met>, std::greater<>> met;
  const auto meet = [&](const Cell<D>& c) {
    met.push({squared_distance(v, c, settings_.L), false, {}, c});
  };
  for (const Cell<D>& c : cells_around(s, v, reach)) meet(c);
  std::uint64_t steps = 0;
  while (!met.empty() && met.top().apart2 <= reach * reach) {
    const Met next = met.top();
    met.pop();
    ++steps;
    if (next.is_vertex) {
      if (!visit(next.w, next.apart2)) break;
    } else if (!enters(next.c)) {
      continue;
    } else if (is_split(s, next.c)) {
      for (unsigned i = 0; i < 1u << D; ++i) meet(child_of(next.c, i));
    } else {
      for (auto at = P.first(s, next.c); at; at = P.behind(s, next.c, *at)) {
        if (at->p != v) met.push({squared_distance(v, at->p), true, at->p, {}});
      }
    }
  }
  s.weigh(steps);
}

template <class S, int D>
template <class Visit>
void Refinement<S, D>::for_each_vertex(Visit&& visit) const {
  std::vector<Cell<D>> split;
  for_each_split_cell([&](const Cell<D>& c) { split.push_back(c); });
  std::sort(split.begin(), split.end());
  P.for_each([&](const Cell<D>& c, const Entry<D>& entry) {
    if (!std::binary_search(split.begin(), split.end(), c)) visit(entry.p);
  });
}

}  // namespace examples::thesis
