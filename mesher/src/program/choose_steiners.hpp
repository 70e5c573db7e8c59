// ChooseSteiners [Fig 4.7, 4.10, 5.6]: the Steiner points, bucket by bucket.
//
// The work queue is an agenda keyed (length bucket, ComputeNN before Complete before Cut, colour,
// place). InsertionRule decides whether a vertex needs new vertices, and their positions.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "program/faults.hpp"
#include "program/for_another.hpp"
#include "program/lines.hpp"
#include "program/split_slivers.hpp"
#include "program/staying.hpp"
#include "program/world.hpp"

namespace mesher::detail {

struct Complete {
  static constexpr std::string_view kName = "complete";
  template <class S, int D>
  void operator()(S& s, VertexRef<D> v, int b) const;
};
inline constexpr Complete complete{};

struct ComputeNN {
  static constexpr std::string_view kName = "compute_nn";
  template <class S, int D>
  void operator()(S& s, VertexRef<D> v, int b) const;
};
inline constexpr ComputeNN compute_nn{};

/// When an event on a vertex at `f` runs, in bucket b.
template <std::size_t N>
[[nodiscard]] sac::Key nearest_key(const std::array<std::uint64_t, N>& f, int b) {
  return {.bucket = b, .phase = 0, .order = morton<N>(f)};
}
template <int D>
[[nodiscard]] sac::Key complete_key(const Buckets<D>& buckets,
                                    const std::type_identity_t<Fixed<D>>& f, int b) {
  return {.bucket = b, .phase = 1, .colour = buckets.colour(f, b), .order = morton<D>(f)};
}

/// A static run for one tile notes that the call about v with this key has its turn. Whether it is
/// one.
template <class S, int D, class KeyOf>
bool begin_for_tile(World<S, D>& w, VertexRef<D> v, KeyOf&& key_of) {
  if (S::kTraced || w.halo == nullptr) return false;
  const sac::Key key = key_of(w.box.fixed(v->p));
  w.halo->begin({Stage::steiner, kKeyWidths.rank(key), key.order, v->p});
  return true;
}

// if w is a ComputeNN event on v: compute the exact nearest neighbour u to v; add Complete(v) with
// key |uv|
template <class S, int D>
void ComputeNN::operator()(S& s, VertexRef<D> v, int b) const {
  auto& w = s.template environment<World<S, D>>();
  const bool is_for_tile =
      begin_for_tile(w, v, [&](const Fixed<D>& f) { return nearest_key(f, b); });
  const double nearest2 = w.vertices.nearest2(s, v);
  if (is_for_tile) w.halo->looked({v->p, {}, std::sqrt(nearest2) * (1 + 0x1p-30)});
  w.post_complete(s, v, std::max(b, w.buckets().bucket(nearest2)));
}

struct Filled {
  bool inserts = false;  // vertices
  bool waits = false;    // for leaves that are cut
  bool fails = false;    // a gap ball cannot be filled
};

/// No vertex that Complete inserts has another nearer to it than this, in the shortest lengths of
/// its bucket. (It is inserted for a length l that is at most rho times shorter than these, and is
/// rho l or more from all others.)
inline constexpr double kNearest = 1.0 / 3;
/// The same of Complete in this world. (Where slivers are split a vertex comes in bucket b at
/// kRoomForSlivers of its shortest length, and is completed in the next one.)
template <class S, int D>
[[nodiscard]] double nearest_in(const World<S, D>& w) {
  if constexpr (D == 3) return w.slivers.any() ? kNearest * kRoomForSlivers : kNearest;
  return kNearest;
}

/// The vertex at `point`, which fills a gap ball of v. In a tile nothing, if that is not possible:
/// it may be otherwise when other tiles have said what they have: a cell among few vertices has
/// corners far away, or nowhere. Nor if others are too near, as are two versions of one vertex, in
/// two tiles: to refine the mesh down to their distance would take long. (Beside segments others
/// may be as near in the end: leaves that are cut are shorter than these lengths at small angles.
/// When all else is agreed on it is tried again.)
template <class S, int D>
std::optional<VertexRef<D>> fill_at(S& s, World<S, D>& w, CellOf<D>& gaps, const Vertex<D>& v,
                                    int b, const typename InsertionRule<D>::NewPoint& point) {
  const auto fill = [&] {
    const VertexRef<D> x = w.vertices.insert(s, point.p);
    if (!point.farther || !gaps.cuts(x->p)) w.fail_useless(v, *x);
    return x;
  };
  if (!w.is_part()) return fill();
  double nearest = nearest_in(w) * w.buckets().shortest(b);
  if constexpr (S::kTraced) nearest *= w.border->nearness(s);
  const bool is_far = w.box.contains(point.p) && point.nearest2 >= nearest * nearest;
  std::optional<VertexRef<D>> x;
  succeeds(
      s, w,
      [&] {
        if (!is_far) w.fail_useless(v, v);
        x = fill();
      },
      !is_far);
  return x;
}

// While there is a gap ball b = B(x, r) to fill: if x is in the balls of leaves, cut them instead
// [5.2c]; else add x to the vertices; add Complete(x), with key |xv|
template <class S, int D>
Filled fill_gaps(S& s, World<S, D>& w, CellOf<D>& gaps, Staying<S, D>& stays, const Vertex<D>& v,
                 int b) {
  Filled filled;
  while (auto point = w.rule->next_point(gaps, b, stays.filter())) {
    const Outcome outcome = yields(s, w, stays, *point, b);
    if (outcome == Outcome::waits || outcome == Outcome::refused) {
      stays.leave(gaps, point->from, point->to);
      filled.waits = filled.waits || outcome == Outcome::waits;
    }
    filled.inserts = filled.inserts || outcome == Outcome::yielded;
    if (outcome != Outcome::stands) continue;
    if (point->on_lattice && has_room(stays, *point)) point->move();
    const std::optional<VertexRef<D>> x = fill_at(s, w, gaps, v, b, *point);
    if (!x) {
      filled.fails = true;
      return filled;
    }
    w.require_room(s);
    gaps.cut((*x)->self);
    filled.inserts = true;
    const int first = std::max(b + 1, w.buckets().bucket(point->nearest2));
    if (w.halo != nullptr) w.halo->born((*x)->self, first);
    w.post_complete(s, *x, first);
    w.post_star(s, *x);
  }
  return filled;
}

// else if w is a Complete event on v: if v encroaches leaves, cut them [5.2b]; in space, add
// vertices to features that cross v's star. Then fill v's gap balls
template <class S, int D>
void Complete::operator()(S& s, VertexRef<D> v, int b) const {
  auto& w = s.template environment<World<S, D>>();
  if constexpr (S::kTraced && D <= 3) {
    if (!w.owns(v->p)) [[unlikely]]
      return run_for_another(s, w, v);
  }
  const bool is_for_tile =
      begin_for_tile(w, v, [&](const Fixed<D>& f) { return complete_key(w.buckets(), f, b); });
  if (is_settled(s, w, v, b)) return;
  const CellLoan<D> gaps = w.vertices.voronoi_cell(s, v, w.buckets().clip_radius(b));
  if constexpr (D <= 3) {
    if (is_for_tile) w.halo->looked_at_cell(*gaps);
  }
  Staying<S, D> stays(w, *gaps);
  bool cuts = disencroach(s, w, v, b);
  bool fails = false;
  const bool goes_well = succeeds(s, w, [&] {
    conform(s, stays, b);
    for (bool grows = true; grows;) {
      const Filled filled = fill_gaps(s, w, *gaps, stays, *v, b);
      fails = fails || filled.fails;
      cuts = cuts || filled.waits;
      grows = !fails && filled.inserts && conform(s, stays, b);
    }
  });
  if (fails || !goes_well) return;
  const std::optional<int> later = cuts ? b + 1 : w.rule->next_bucket(*gaps, b, stays.filter());
  s.weigh(stays.looked_at());
  post_slivers(s, w, *gaps, b);
  later ? w.post_complete(s, v, *later) : w.post_border_star(s, v, *gaps);
}

}  // namespace mesher::detail
