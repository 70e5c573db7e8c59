// The observations of vertices, found by position and reach.
//
// An observation is centred at a vertex; its reach is a box that contains every vertex that can
// concern it. A vertex keeps a list of the observations centred at it and a box around their
// reaches; the quadtree keeps one around those below each cell. So the observations that a position
// concerns are found from the root down. (This is not a structure of its own in `sac`: the cells
// with their bounds are those in which vertices are looked up, and a second tree of the same cells
// would cost as much memory again.)
//
// An observation that says who v's neighbours were is also where its call starts from when it runs
// again. Then it must know which vertices came since: those are noted with it, its *arrivals*.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "cells/cell_of.hpp"
#include "index/change_log.hpp"
#include "index/quadtree.hpp"
#include "sac/engine.hpp"

namespace mesher::detail {

template <int D>
struct Observation : sac::Edge {
  VertexHandle center;
  sac::Ref<sac::Call> call;
  sac::Handle next;        // centred at the same vertex
  Reach<D> reach;          // no vertex beyond concerns it
  std::uint32_t arrivals;  // a list
};

/// The nearest vertex.
template <int D>
struct NearestSeen : Observation<D> {
  std::uint32_t nearest;  // 0: none
};
/// What a call that sees a cell may have asked of features besides those that meet its star.
template <int D>
struct FeaturesAsked {};
template <>
struct FeaturesAsked<3> {
  float features_within;  // of the cell's vertex, in units of the box's side
};
/// A cell, clipped or a star; as it was written down lies behind it.
template <int D>
struct CellSeen : Observation<D>, FeaturesAsked<D> {
  float radius;  // the clip, in units of the box's side
  std::uint32_t count : 31;
  // In space: when it was made no feature crossed the star, and the roles of its vertices are what
  // they were.
  std::uint32_t is_clear : 1;

  [[nodiscard]] std::uint32_t* codes() noexcept {
    return reinterpret_cast<std::uint32_t*>(this + 1);
  }
  [[nodiscard]] const std::uint32_t* codes() const noexcept {
    return reinterpret_cast<const std::uint32_t*>(this + 1);
  }
};
template <int D>
class Observers {
 public:
  using Observation = detail::Observation<D>;
  using NearestSeen = detail::NearestSeen<D>;
  using CellSeen = detail::CellSeen<D>;

  static constexpr std::uint8_t kNearest = 2;
  static constexpr std::uint8_t kCell = 1;
  static constexpr std::uint8_t kStar = 3;   // the cell among all vertices, without a clip
  static constexpr std::uint8_t kTrial = 5;  // a cell, of what is no vertex
  static constexpr std::uint32_t kUnknown = 0xffffffffu;

  Observers(sac::Engine& engine, VertexPool<D>& pool, Quadtree<D>& tree)
      : engine_(engine), pool_(pool), tree_(tree) {}

  /// Lists an observation whose centre, call and reach are set.
  void link(Observation& o) noexcept;
  void unlink(Observation& o) noexcept;
  /// Whether any is listed.
  [[nodiscard]] bool any() const noexcept { return live_ != 0; }

  /// Calls visit(observation) for those centred at v, the newest first, until one returns true.
  /// Returns that one, or null.
  template <class Visit>
  Observation* find_at(const Vertex<D>& v, Visit&& visit) const {
    for (sac::Handle h = v.queries; h != 0; h = at(h).next) {
      if (visit(static_cast<const Observation&>(at(h)))) return &at(h);
    }
    return nullptr;
  }
  /// Calls visit(centre, observation) for those that a vertex at p may concern: it is in reach.
  /// visit must not throw. Cost: O(depth of the tree) and what it visits.
  template <class Visit>
  void for_each_reaching(const Point<D>& p, Visit&& visit) noexcept {
    // Memory is asked for the observations of several centres before the first is looked at.
    std::array<Met, 32> met;
    std::size_t count = 0;
    const auto look = [&] {
      for (std::size_t i = 0; i < count; ++i) visit_at(met[i], visit);
      count = 0;
    };
    tree_.visit_reaching(p, [&](Vertex<D>& center, const Point<D>& offset) {
      if (count == met.size()) look();
      __builtin_prefetch(engine_.arena().template at<Observation>(center.queries));
      met[count++] = {&center, offset};
    });
    look();
  }

  [[nodiscard]] static bool is_cell(const Observation& o) noexcept {
    return o.kind == kCell || o.kind == kTrial;
  }
  /// What it saw: a cell as it was written down, or the nearest vertex.
  [[nodiscard]] std::span<const std::uint32_t> seen(const Observation& o) const noexcept;
  /// The vertices that it saw, and virtual neighbours.
  [[nodiscard]] std::span<const std::uint32_t> neighbours(const Observation& o) const noexcept {
    return o.kind == kNearest ? seen(o) : CellOf<D>::neighbours(seen(o));
  }

  /// Makes room for arrivals, which are then noted without fail. Throws: std::bad_alloc.
  void expect_arrivals();
  /// w has come since `o` was made. (Without room it is noted that something has.)
  void note_arrival(Observation& o, VertexHandle w) noexcept;
  /// Whether all that came since is noted.
  [[nodiscard]] bool knows_arrivals(const Observation& o) const noexcept {
    return o.arrivals != kUnknown;
  }
  /// Calls visit(handle) for what came. Requires: knows_arrivals(o).
  template <class Visit>
  void for_each_arrival(const Observation& o, Visit&& visit) const {
    for (std::uint32_t i = o.arrivals; i != 0; i = arrivals_[i].next) visit(arrivals_[i].vertex);
  }
  /// At the end of an update, when no observation has arrivals.
  void forget_arrivals() noexcept { arrivals_.resize(1); }

  /// Throws InvariantError unless v's list is in order, between updates.
  void check_invariants(const Vertex<D>& v) const;

 private:
  struct Met {
    Vertex<D>* center;
    Point<D> offset;  // of the place
  };
  template <class Visit>
  void visit_at(const Met& met, Visit& visit) noexcept {
    for (sac::Handle h = met.center->queries; h != 0; h = at(h).next) {
      if (at(h).reach.contains(met.offset)) visit(*met.center, at(h));
    }
  }

  struct Arrival {
    VertexHandle vertex = 0;
    std::uint32_t next = 0;
  };
  static constexpr std::size_t kRoom = 256;

  [[nodiscard]] Observation& at(sac::Handle h) const noexcept {
    return *engine_.arena().template at<Observation>(h);
  }

  sac::Engine& engine_;
  VertexPool<D>& pool_;
  Quadtree<D>& tree_;
  std::size_t live_ = 0;              // observations
  std::vector<Arrival> arrivals_{1};  // the first stands for the end of a list
};

}  // namespace mesher::detail
