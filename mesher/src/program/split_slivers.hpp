// SplitSlivers: tetrahedra in space with a small dihedral angle get vertices, as part of
// ChooseSteiners [Li, Teng 2001; rules E].
//
// A sliver has four corners about on a circle, so its radius-edge ratio is good. Who ends Complete
// with one in its star posts split_slivers(v, b): v is the corner with the least place, b no bucket
// before that of the shortest edge. It runs when the bucket's Completes have.
//
// The new vertex goes where no tetrahedron around it has a small angle, or where the smallest is
// larger than the sliver's: of the places of a lattice in the sliver's ball the first such one,
// those that take most slivers of v first, of these those farthest from vertices. What its star
// would be at a place is observed as a cell is, though nothing is born there.
//
// It ends: in bucket b a vertex is at least kRoom of the bucket's shortest length from all others,
// and each look at its star is in a later bucket. (The alternative, that vertices inherit their
// lengths as floors [rules E5], needs these in the records of all vertices, so that a change of one
// concerns all that see it; measured, both leave the same slivers: paper_map (x).)
//
// Among edges and polygons a place is good only if none is close to it or crosses its star: all are
// unions of edges and faces, as before.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "program/faults.hpp"
#include "program/for_another.hpp"
#include "program/world.hpp"
#include "rules/sliver_rule.hpp"
#include "space/star_crossings.hpp"
#include "space/yielding.hpp"

namespace mesher::detail {

/// A vertex that splits slivers in bucket b is at least this times the bucket's shortest length
/// from all others.
inline constexpr double kRoomForSlivers = 1.0 / 4;

struct SplitSlivers {
  static constexpr std::string_view kName = "split_slivers";
  template <class S>
  void operator()(S& s, VertexRef<3> v, int b) const;
};
inline constexpr SplitSlivers split_slivers{};

/// When split_slivers(v, b) runs, v at `f`. The stars of places are twice as far from v as v's.
[[nodiscard]] inline sac::Key split_slivers_key(const Buckets<3>& buckets, const Fixed<3>& f,
                                                int b) {
  return {.bucket = b, .phase = 2, .colour = buckets.colour(f, b + 1), .order = morton<3>(f)};
}

struct SliverInStar {
  int corner;        // of the cell
  double shortest2;  // edge
  double score;
  std::array<const Point<3>*, 3> others;  // the corners besides v, by places
};

/// Calls visit(sliver, owner) for the slivers of v's star, the centre of the cell: those that v
/// sees. Those of the box's corners alone stay.
template <class S, class Visit>
void for_each_sliver(const World<S, 3>& w, const VoronoiCell3& cell, Visit&& visit) {
  const Vertex<3>& v = cell.center();
  for (int t = 0; t < cell.corners(); ++t) {
    const auto& ends = cell.ends(t);
    if (!cell.real(ends[0]) || !cell.real(ends[1]) || !cell.real(ends[2])) continue;
    if (w.slivers.is_surely_good(cell.neighbour(ends[0]), cell.neighbour(ends[1]),
                                 cell.neighbour(ends[2]))) {
      continue;
    }
    const std::array<const Point<3>*, 4> at{&v.p, &cell.place(ends[0]), &cell.place(ends[1]),
                                            &cell.place(ends[2])};
    const double score = SliverRule::score(at);
    if (score <= w.slivers.worst()) continue;
    double shortest2 = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t k = 0; k < i; ++k) {
        shortest2 = std::min(shortest2, squared_distance(*at[i], *at[k]));
      }
    }
    if (w.rule->exceeds(cell.corner2(t), shortest2)) continue;
    const Vertex<3>* owner = v.boundary ? nullptr : &v;
    for (const int i : ends) {
      const Vertex<3>& u = w.vertices.pool()[cell.handle(i)];
      if (!u.boundary && (owner == nullptr || u.p < owner->p)) owner = &u;
    }
    if (owner == nullptr) continue;
    SliverInStar sliver{t, shortest2, score, {at[1], at[2], at[3]}};
    std::sort(sliver.others.begin(), sliver.others.end(), [](auto* p, auto* q) { return *p < *q; });
    visit(sliver, *owner);
  }
}

/// Posts for the slivers with which a call on the cell's centre ends, in bucket b.
template <class S>
void post_slivers(S& s, World<S, 3>& w, const VoronoiCell3& cell, int b) {
  if (!w.slivers.any()) return;
  const VertexPool<3>& pool = w.vertices.pool();
  for_each_sliver(w, cell, [&](const SliverInStar& sliver, const Vertex<3>& owner) {
    const int q = std::max(b, w.buckets().bucket(sliver.shortest2));
    if (q < w.buckets().count()) w.post_split_slivers(s, {&pool[owner.self]}, q);
  });
}
template <class S, int D>
void post_slivers(S&, World<S, D>&, const CellOf<D>&, int) {}

/// One call of split_slivers.
template <class S>
class SliverSplitter {
 public:
  SliverSplitter(S& s, World<S, 3>& w, VertexRef<3> v, int b)
      : s_(s),
        w_(w),
        v_(v),
        b_(b),
        cell_(w.vertices.voronoi_cell(s, v, w.buckets().clip_radius(b))) {}

  // What one call inserts it does not see in the stars of further places: they are for a later one.
  void run() {
    bool again = false;
    while (const auto sliver = next()) {
      remember(*sliver);
      if (const auto best = choose(*sliver)) {
        insert(*best);
        again = again || next().has_value();
        break;
      }
      again = again || may_try_again(*sliver);
    }
    if (again && b_ + 1 < w_.buckets().count()) w_.post_split_slivers(s_, v_, b_ + 1);
  }

 private:
  static constexpr double kRoom2 = kRoomForSlivers * kRoomForSlivers;
  // A place yields to features within kYields times this of the nearest vertex's distance.
  static constexpr double kBeside = 0.25;
  static constexpr double kLeast = 0x1p-30;  // that a score is better by

  struct Place {
    int takes;        // slivers of v
    double nearest2;  // to the vertices around
    double off2;      // from the centre
    Point<3> at;
  };
  struct Tried {
    Point<3> at;
    double score, nearest2;
  };
  using Corners = std::array<Point<3>, 3>;

  [[nodiscard]] static Corners corners_of(const SliverInStar& sliver) {
    return {*sliver.others[0], *sliver.others[1], *sliver.others[2]};
  }
  // In two more buckets.
  [[nodiscard]] bool may_try_again(const SliverInStar& sliver) const {
    return b_ < w_.buckets().bucket(sliver.shortest2) + 2;
  }
  void remember(const SliverInStar& sliver) { done_.push_back(corners_of(sliver)); }

  // Of those of v that are due: with the shortest edge, of equals the first by its places.
  [[nodiscard]] std::optional<SliverInStar> next() {
    std::optional<SliverInStar> first;
    all_.clear();
    for_each_sliver(w_, *cell_, [&](const SliverInStar& sliver, const Vertex<3>& owner) {
      all_.push_back(sliver.corner);
      if (owner.self != v_->self || w_.buckets().bucket(sliver.shortest2) > b_) return;
      if (first && sliver.shortest2 > first->shortest2) return;
      const Corners corners = corners_of(sliver);
      if (first && sliver.shortest2 == first->shortest2 && corners_of(*first) < corners) return;
      if (std::find(done_.begin(), done_.end(), corners) == done_.end()) first = sliver;
    });
    return first;
  }

  void find_places(const SliverInStar& sliver) {
    places_.clear();
    const Point<3>& v = v_->p;
    const Point<3> centre = plus(v, cell_->corner(sliver.corner));
    const double radius2 = cell_->corner2(sliver.corner);
    w_.slivers.for_each_place(centre, radius2, [&](const Point<3>& at, double off2) {
      const Point<3> y = minus(at, v);
      const double y2 = squared(y);
      Place place{0, y2, off2, at};
      for (const int t : all_) place.takes += 2 * dot(y, cell_->corner(t)) > y2 ? 1 : 0;
      for (int i = 0; i < cell_->size(); ++i) {
        if (!cell_->used(i) || !cell_->real(i)) continue;
        place.nearest2 = std::min(place.nearest2, squared_distance(at, cell_->place(i)));
      }
      if (has_room(place.nearest2)) places_.push_back(place);
    });
    std::sort(places_.begin(), places_.end(), [](const Place& p, const Place& q) {
      if (p.takes != q.takes) return p.takes > q.takes;
      if (p.nearest2 != q.nearest2) return p.nearest2 > q.nearest2;
      return p.off2 != q.off2 ? p.off2 < q.off2 : p.at < q.at;
    });
    // At last all of them are tried.
    const bool is_last = !may_try_again(sliver);
    if (places_.size() > w_.slivers.most() && !is_last) places_.resize(w_.slivers.most());
  }

  [[nodiscard]] bool has_room(double nearest2) const {
    return w_.buckets().bucket(nearest2 / kRoom2) >= b_;
  }

  [[nodiscard]] std::optional<Tried> choose(const SliverInStar& sliver) {
    find_places(sliver);
    std::optional<Tried> best;
    double bound = sliver.score - kLeast;
    for (const Place& place : places_) {
      const auto tried = try_at(place.at);
      if (!tried || tried->score >= bound) continue;
      best = tried;
      bound = tried->score;
      if (bound <= w_.slivers.worst()) break;
    }
    return best;
  }

  [[nodiscard]] std::optional<Tried> try_at(const Point<3>& at) {
    const CellLoan<3> star = w_.vertices.trial(s_, at, v_, w_.buckets().clip_radius(b_));
    Tried tried{at, -1, std::numeric_limits<double>::infinity()};
    for (int i = 0; i < star->size(); ++i) {
      if (!star->used(i) || !star->real(i)) continue;
      tried.nearest2 = std::min(tried.nearest2, squared(star->neighbour(i)));
    }
    for (int t = 0; t < star->corners(); ++t) {
      const auto& ends = star->ends(t);
      if (!star->real(ends[0]) || !star->real(ends[1]) || !star->real(ends[2])) continue;
      tried.score =
          std::max(tried.score, SliverRule::score({&at, &star->place(ends[0]),
                                                   &star->place(ends[1]), &star->place(ends[2])}));
    }
    if (is_barred(*star, tried.nearest2) || !has_room(tried.nearest2)) return std::nullopt;
    return tried;
  }

  // Of the features a place has asked about those within its star. Where there are none it is not
  // known how far it would ask, and the first feature concerns whoever it might.
  [[nodiscard]] bool is_barred(VoronoiCell3& star, double nearest2) {
    if (!w_.has_features()) {
      w_.vertices.note_asked(std::numeric_limits<double>::infinity());
      return false;
    }
    const FeaturesBeside near(w_.plc.store(), star.center().p, w_.vertices.beside(star));
    const auto role_of = [&](const Vertex<3>& u) { return w_.vertices.role(u); };
    const bool barred = yield(near, star.center().p, kBeside * std::sqrt(nearest2)).has_value() ||
                        StarCrossings(w_.star_room, star, w_.vertices.pool(), near, role_of).any();
    w_.vertices.note_asked(near.asked());
    return barred;
  }

  void insert(const Tried& tried) {
    const VertexRef<3> x = w_.vertices.insert(s_, tried.at);
    if (!cell_->cuts(x->p)) w_.fail_useless(*v_, *x);
    w_.require_room(s_);
    cell_->cut(x->self);
    w_.post_complete(s_, x, std::max(b_ + 1, w_.buckets().bucket(tried.nearest2)));
    w_.post_star(s_, x);
  }

  S& s_;
  World<S, 3>& w_;
  const VertexRef<3> v_;
  const int b_;
  const CellLoan<3> cell_;
  std::vector<Corners> done_;
  std::vector<int> all_;  // corners of the cell that are slivers
  std::vector<Place> places_;
};

template <class S>
void SplitSlivers::operator()(S& s, VertexRef<3> v, int b) const {
  auto& w = s.template environment<World<S, 3>>();
  if constexpr (S::kTraced) {
    if (!w.owns(v->p)) [[unlikely]]
      return run_for_another(s, w, v);
  }
  succeeds(s, w, [&] { SliverSplitter<S>(s, w, v, b).run(); });
}

}  // namespace mesher::detail
