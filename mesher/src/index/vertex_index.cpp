// Births, observations, and which observations a vertex concerns.
#include "index/vertex_index.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/box.hpp"
#include "geometry/space_distances.hpp"

namespace mesher::detail {

// --- Births ----------------------------------------------------------------------------------

template <int D>
VertexRef<D> VertexIndex<sac::Scope, D>::insert(sac::Scope& s, const Point<D>& p) {
  const auto same = [&](const BirthEdge& edge) { return pool_[edge.vertex].p == p; };
  if (const auto* edge = s.recall<BirthEdge>(id_, kBirth, same)) return {&pool_[edge->vertex]};
  Vertex<D>& v = record_at(s, p);
  produce(s, v);
  join(v);
  return {&v};
}

template <int D>
VertexRef<D> VertexIndex<sac::Scope, D>::insert(sac::Scope& s, const Point<D>& p,
                                                const Role& role) {
  if (const auto* edge = recall_on_segment(s, p, role)) return {&pool_[edge->vertex]};
  Vertex<D>& v = record_at(s, p);
  produce_on_segment(s, v, role);
  join(v);
  return {&v};
}

template <int D>
VertexRef<D> VertexIndex<sac::Scope, D>::insert_early(sac::Scope& s, const Point<D>& p,
                                                      const Role& role) {
  if (!engine_.appending()) return insert(s, p, role);
  Vertex<D>& v = add(p);
  produce_on_segment(s, v, role);
  return {&v};
}

template <int D>
VertexRef<D> VertexIndex<sac::Scope, D>::insert_early(sac::Scope& s, const Point<D>& p) {
  if (!engine_.appending()) return insert(s, p);
  Vertex<D>& v = add(p);
  produce(s, v);
  return {&v};
}

template <int D>
auto VertexIndex<sac::Scope, D>::recall_on_segment(sac::Scope& s, const Point<D>& p,
                                                   const Role& role) -> const BirthOnSegmentEdge* {
  const auto same = [&](const BirthOnSegmentEdge& edge) {
    return edge.role == role && pool_[edge.vertex].p == p;
  };
  return s.recall<BirthOnSegmentEdge>(id_, kBirthOnSegment, same);
}

template <int D>
void VertexIndex<sac::Scope, D>::produce_on_segment(sac::Scope& s, Vertex<D>& v, const Role& role) {
  touch(v);
  roles_.reserve(v.self);
  observers_.expect_arrivals();
  auto& edge = s.effect<BirthOnSegmentEdge>(id_, kBirthOnSegment);
  edge.role = role;
  produced(s, v, edge, role);
}

// Throws: Error if a vertex is at p already.
template <int D>
Vertex<D>& VertexIndex<sac::Scope, D>::record_at(sac::Scope& s, const Point<D>& p) {
  Vertex<D>* v = tree_.find(p);
  if (v != nullptr && born_before(*v, s.self())) fail_coincident(p);
  return v == nullptr ? add(p) : *v;
}

template <int D>
void VertexIndex<sac::Scope, D>::insert(sac::Scope& s, VertexRef<D> v) {
  if (v->on_segment && presences_.seen_by(v->presence, s.self())) return;
  const auto same = [&](const BirthEdge& edge) { return edge.vertex == v->self; };
  if (s.recall<BirthEdge>(id_, kBirth, same) == nullptr) produce(s, *v);
}

// What tiles say to each other is true at the end: it is not looked whether another is there.
template <int D>
void VertexIndex<sac::Scope, D>::insert(sac::Scope& s, VertexRef<D> v, const Role& role) {
  if (role.on == 0) return insert(s, v);
  if (recall_on_segment(s, v->p, role) == nullptr) produce_on_segment(s, *v, role);
}

// A record that fails to be produced is in the log, and freed at the end of the update.
template <int D>
void VertexIndex<sac::Scope, D>::produce(sac::Scope& s, Vertex<D>& v) {
  touch(v);
  observers_.expect_arrivals();
  produced(s, v, s.effect<BirthEdge>(id_, kBirth), Role());
}

template <int D>
void VertexIndex<sac::Scope, D>::produced(sac::Scope& s, Vertex<D>& v, BirthEdge& edge,
                                          const Role& role) noexcept {
  edge.vertex = v.self;
  const bool was_there = v.presence.there();
  if (!was_there) log_.came(v);
  const sac::Ref<sac::Call> self = engine_.handle_of(s.self());
  SAC_ENSURES(s.place() == self);  // calls of the program act before they call
  const auto window = presences_.produced(v.presence, edge, self);
  v.alive = true;
  set_trial(v, false);
  if (!was_there) {
    set_role(v, role);  // nobody has seen it
  } else if (v.presence.birth() == self) {
    take_role(v, role, s.self());
  }
  if (window.has_value()) appeared(v, *window);
}

// What `producer`, of v, says that v is.
template <int D>
Role VertexIndex<sac::Scope, D>::role_from(const sac::Call& producer,
                                           const Vertex<D>& v) const noexcept {
  Role role;
  engine_.for_each_edge(producer, [&](const sac::Edge& edge) {
    if (edge.structure != id_ || edge.kind != kBirthOnSegment) return;
    const auto& birth = static_cast<const BirthOnSegmentEdge&>(edge);
    if (birth.vertex == v.self) role = birth.role;
  });
  return role;
}

template <int D>
void VertexIndex<sac::Scope, D>::run_again(sac::Ref<sac::Call> h, const sac::Window& window,
                                           const sac::Edge* seen) noexcept {
  sac::Call& call = engine_.call(h);
  if (window.contains(engine_, call)) engine_.invalidate(call, seen);
}

// v's earliest producer gives it a role. Those later that took it for what it was run again; who
// has come to see v by this producer does so in any case.
template <int D>
void VertexIndex<sac::Scope, D>::take_role(Vertex<D>& v, const Role& now,
                                           const sac::Call& producer) noexcept {
  if (!v.on_segment && now.on == 0) return;
  if (role(v) == now) return;
  set_role(v, now);
  if (engine_.appending()) return;
  const sac::Window later{&producer, nullptr};
  if (v.locator != nullptr) run_again(v.locator, later, nullptr);
  for_each_cell_with(v, [&](Observation& o) {
    no_longer_clear(o);
    run_again(o.call, later, &o);
  });
}

template <int D>
void VertexIndex<sac::Scope, D>::legs_changed(const Vertex<D>& v) noexcept {
  if (!v.alive) return;  // nobody has seen it
  for_each_cell_with(v,
                     [&](const Observation& o) { engine_.invalidate(engine_.call(o.call), &o); });
}

template <int D>
void VertexIndex<sac::Scope, D>::limits_changed(const Box<D>& where) noexcept {
  tree_.visit_reaching(where, [&](const Vertex<D>& center) {
    observers_.find_at(center, [&](const Observation& o) {
      if (Observers<D>::is_cell(o)) engine_.invalidate(engine_.call(o.call), &o);
      return false;
    });
  });
}

template <int D>
void VertexIndex<sac::Scope, D>::retract_birth(BirthEdge& birth) noexcept {
  Vertex<D>& v = pool_[birth.vertex];
  touch(v);
  const sac::Place earliest = v.presence.birth();
  const auto window = presences_.retracted(v.presence, birth);
  v.alive = v.presence.there();
  if (v.alive && v.presence.birth() != earliest) {
    const sac::Call& next = engine_.call_at(v.presence.birth());
    take_role(v, role_from(next, v), next);
  }
  if (!window.has_value()) return;
  if (birth.kind == kBirthOnSegment && v.locator != nullptr) run_again(v.locator, *window, nullptr);
  vanished(v, *window);
}

// Whether v is in a gap ball, erring towards yes, or as near as the nearest is.
template <int D>
bool VertexIndex<sac::Scope, D>::concerns(const Vertex<D>& v, const Vertex<D>& center,
                                          const Observation& o) noexcept {
  const auto seen = observers_.seen(o);
  looks_ += seen.size();
  if (o.kind == kNearest) {
    return seen[0] == 0 ||
           squared_distance(v.p, center.p) <= squared_distance(pool_[seen[0]].p, center.p);
  }
  const double radius = unpacked(static_cast<const CellSeen&>(o).radius);
  return Cell::may_cut(pool_, center, radius, seen, v.p);
}

// Observations in the window that have a gap ball around v, or are nearer to it than to others. Few
// have: times, which lie elsewhere in memory, are looked at last, unless gap balls take longer.
template <int D>
void VertexIndex<sac::Scope, D>::appeared(const Vertex<D>& v, const sac::Window& window) noexcept {
  observers_.for_each_reaching(v.p, [&](const Vertex<D>& center, Observation& o) {
    const auto is_later = [&] { return window.contains(engine_, engine_.call(o.call)); };
    if (center.self == v.self) return;
    if (!Cell::kMayCutIsCheap && !is_later()) return;
    if (!concerns(v, center, o)) return;
    if (Cell::kMayCutIsCheap && !is_later()) return;
    if (o.kind != kNearest) observers_.note_arrival(o, v.self);
    engine_.invalidate(engine_.call(o.call), &o);
  });
}

// Observations in the window that v bounds. (v may come again, as something else.)
template <int D>
void VertexIndex<sac::Scope, D>::vanished(const Vertex<D>& v, const sac::Window& window) noexcept {
  observers_.for_each_reaching(v.p, [&](const Vertex<D>& center, Observation& o) {
    if (center.self == v.self) no_longer_clear(o);
    const auto seen = observers_.neighbours(o);
    if (std::find(seen.begin(), seen.end(), v.self) == seen.end()) return;
    no_longer_clear(o);
    sac::Call& call = engine_.call(o.call);
    if (window.contains(engine_, call)) engine_.invalidate(call, &o);
  });
}

// --- Reading, in a first run -----------------------------------------------------------------

template <int D>
void VertexIndex<sac::Scope, D>::begin_questions() {
  live_.reset();
  if (!may_read() || !pool_.is_dense()) return;
  bool all = true;
  pool_.for_each([&](const Vertex<D>& v) { all = all && (v.alive || v.input); });
  if (all) live_ = LiveTriangulation<D>::of(pool_, 0, [] {});
}

template <int D>
void VertexIndex<sac::Scope, D>::keep_reading(const std::vector<VertexHandle>& touched) {
  if (live_ == nullptr) return;
  for (const VertexHandle h : touched) {
    const Vertex<D>& v = pool_[h];
    if (v.alive == live_->has(v)) continue;
    if (!v.alive) {
      live_->remove(v);
    } else if (!live_->insert(v)) {
      fail_coincident(v.p);
    }
  }
}

template <int D>
void VertexIndex<sac::Scope, D>::join(const Vertex<D>& v) {
  if (reads() && !live_->insert(v)) fail_coincident(v.p);
}

// --- Observations ----------------------------------------------------------------------------

// `last`: what the running call saw last time, if it asked the same.
template <int D>
template <class Seen>
CellLoan<D> VertexIndex<sac::Scope, D>::look(const Vertex<D>& v, double radius,
                                             const Observation* last, Seen&& seen) {
  CellLoan<D> cell = borrow_cell();
  if (reads(v)) {
    live_->read(*cell, v, radius);
    return cell;
  }
  const bool repairs = last != nullptr && observers_.knows_arrivals(*last);
  bool known = true;
  if (repairs) {
    const auto arrivals = [&](auto&& visit) { observers_.for_each_arrival(*last, visit); };
    begin_repair(*cell, v, radius, observers_.seen(*last), arrivals, seen);
    if (cell->open2() == 0) return cell;
  } else {
    known = begin(*cell, v, radius, seen);
  }
  const auto came = log_.few_that_came();
  for (const VertexHandle u : came.value_or(std::span<const VertexHandle>())) {
    add_candidate(*cell, u);
  }
  cut_by_candidates(*cell, seen);
  known ? finish_known(*cell, seen) : finish(*cell, seen);
  return cell;
}

// With who is likely to be near: v's neighbours at another time, or those in a triangulation, or,
// in an update, those of the vertex for which v was made. Returns false if nobody is known.
template <int D>
template <class Seen>
bool VertexIndex<sac::Scope, D>::begin(Cell& cell, const Vertex<D>& v, double radius, Seen& seen) {
  const auto surrounds = [](const Observation& o) { return o.kind != kNearest; };
  if (const Observation* other = observers_.find_at(v, surrounds)) {
    begin_with_ring(cell, v, radius, observers_.seen(*other), seen);
    return true;
  }
  cell.reset(v, radius);
  // Of a tile, in whose first run others ask; it may have later ones, too. (In the plane to walk
  // there takes longer than to search from nothing.)
  if (D == 3 && live_ != nullptr) {
    live_->list_near(v, near_);
    for (const VertexHandle u : near_) add_candidate(cell, u);
    return true;
  }
  const CellSeen* made_in = engine_.appending() ? nullptr : cell_of_producer(v);
  if (made_in == nullptr) return false;
  add_neighbours(cell, *made_in);
  return true;
}

template <int D>
void VertexIndex<sac::Scope, D>::add_neighbours(const Cell& cell, const CellSeen& seen) const {
  add_candidate(cell, seen.center);
  for (const std::uint32_t u : observers_.neighbours(seen)) {
    if (u < Cell::kVirtual) add_candidate(cell, u);
  }
}

// The cell in which v was found to be needed.
template <int D>
auto VertexIndex<sac::Scope, D>::cell_of_producer(const Vertex<D>& v) const noexcept
    -> const CellSeen* {
  const CellSeen* cell = nullptr;
  if (!v.presence.there()) return cell;
  engine_.for_each_edge(engine_.call_at(v.presence.birth()), [&](const sac::Edge& edge) {
    if (edge.structure == id_ && edge.kind == kCell) cell = static_cast<const CellSeen*>(&edge);
  });
  return cell;
}

// What has been looked at since the last query.
template <int D>
void VertexIndex<sac::Scope, D>::weigh(sac::Scope& s) {
  const std::uint64_t visited = take_visited();
  s.weigh(visited);
  looks_ += visited;
  if (looks_ > most_looks_) throw TooManyLooks();
}

template <int D>
CellLoan<D> VertexIndex<sac::Scope, D>::voronoi_cell(sac::Scope& s, VertexRef<D> v, double radius) {
  const sac::Call& self = s.self();
  const sac::Ref<sac::Call> caller = engine_.handle_of(self);
  const float clip = packed(radius);
  SAC_EXPECTS(unpacked(clip) == radius);
  const Observation* last = observers_.find_at(*v, [&](const Observation& o) {
    return o.kind == kCell && o.call == caller && static_cast<const CellSeen&>(o).radius == clip;
  });
  CellLoan<D> cell =
      look(*v, radius, last, [&](VertexHandle u) { return born_before(pool_[u], self); });
  weigh(s);
  cell->write(codes_);
  record_cell(s, *v, *cell, clip, kCell);
  return cell;
}

// What is tried is a record without producers; it is freed when nobody observes it.
template <int D>
VertexRef<D> VertexIndex<sac::Scope, D>::trial_record(sac::Scope& s, const Point<D>& p) {
  if (Vertex<D>* v = tree_.find(p); v != nullptr) {
    if (born_before(*v, s.self())) fail_coincident(p);
    return {v};
  }
  Vertex<D>& v = add(p);
  set_trial(v, true);
  touch(v);
  return {&v};
}

template <int D>
CellLoan<D> VertexIndex<sac::Scope, D>::trial(sac::Scope& s, const Point<D>& p, VertexRef<D> near,
                                              double radius) {
  const sac::Call& self = s.self();
  const sac::Ref<sac::Call> caller = engine_.handle_of(self);
  const float clip = packed(radius);
  SAC_EXPECTS(unpacked(clip) == radius);
  const VertexRef<D> v = trial_record(s, p);
  const auto seen = [&](VertexHandle u) { return born_before(pool_[u], self); };
  const Observation* last = observers_.find_at(*v, [&](const Observation& o) {
    return o.kind == kTrial && o.call == caller && static_cast<const CellSeen&>(o).radius == clip;
  });
  const auto look_there = [&]() -> CellLoan<D> {
    if (last != nullptr && !reads(*near)) return look(*v, radius, last, seen);
    CellLoan<D> cell = borrow_cell();
    if (reads(*near)) {
      live_->read_as_if(*cell, *v, near->self, radius);
      return cell;
    }
    cell->reset(*v, radius);
    const Observation* around = observers_.find_at(
        *near, [&](const Observation& o) { return o.kind == kCell && o.call == caller; });
    if (around != nullptr) add_neighbours(*cell, static_cast<const CellSeen&>(*around));
    cut_by_candidates(*cell, seen);
    finish(*cell, seen);
    return cell;
  };
  CellLoan<D> cell = look_there();
  weigh(s);
  cell->write(codes_);
  record_cell(s, *v, *cell, clip, kTrial);
  return cell;
}

template <int D>
void VertexIndex<sac::Scope, D>::look_across(sac::Scope& s, VertexRef<D> v, double radius,
                                             std::vector<VertexHandle>& found) {
  const struct Across {
    bool& flag;
    explicit Across(bool& f) : flag(f) { flag = true; }
    ~Across() { flag = false; }
  } across(looks_across_);
  found.clear();
  const sac::Call& self = s.self();
  const auto seen = [&](VertexHandle u) { return born_before(pool_[u], self); };
  if (radius < 0) {
    const auto n = nearest_around(*v, seen);
    weigh(s);
    const double reach = std::min(std::sqrt(n.distance2) * (1 + 0x1p-40), whole());
    record_nearest(s, *v, Reach<D>::around(reach / box_.side), n.handle);
    if (n.handle != 0) found.push_back(n.handle);
    return;
  }
  const sac::Ref<sac::Call> caller = engine_.handle_of(self);
  const Observation* last = observers_.find_at(
      *v, [&](const Observation& o) { return o.kind == kTrial && o.call == caller; });
  const CellLoan<D> cell = look(*v, radius, last, seen);
  weigh(s);
  cell->write(codes_);
  record_cell(s, *v, *cell, packed(radius), kTrial);
  for (const std::uint32_t u : Cell::neighbours(codes_)) {
    if (u < Cell::kVirtual) found.push_back(u);
  }
}

template <int D>
double VertexIndex<sac::Scope, D>::nearest2(sac::Scope& s, VertexRef<D> v) {
  const sac::Call& self = s.self();
  const auto seen = [&](VertexHandle u) { return born_before(pool_[u], self); };
  const auto n = reads() ? live_->nearest(*v) : nearest_around(*v, seen);
  weigh(s);
  record_nearest(s, *v, Reach<D>::around(std::sqrt(n.distance2) * (1 + 0x1p-40) / box_.side),
                 n.handle);
  return n.distance2;
}

template <int D>
CellLoan<D> VertexIndex<sac::Scope, D>::star(sac::Scope& s, VertexRef<D> v) {
  const sac::Ref<sac::Call> caller = engine_.handle_of(s.self());
  const Observation* last = observers_.find_at(
      *v, [&](const Observation& o) { return o.kind == kStar && o.call == caller; });
  CellLoan<D> cell = look(*v, whole(), last, [&](VertexHandle u) { return pool_[u].alive; });
  weigh(s);
  cell->write(codes_);
  record_cell(s, *v, *cell, packed(whole()), kStar);
  return cell;
}

// --- Records ---------------------------------------------------------------------------------
//
// An observation that says the same as last time is kept as it is.

template <int D>
void VertexIndex<sac::Scope, D>::fill(sac::Scope& s, Observation& o, Vertex<D>& v,
                                      Reach<D> reach) noexcept {
  o.center = v.self;
  o.call = engine_.handle_of(s.self());
  o.reach = reach;
  observers_.link(o);
}

template <int D>
void VertexIndex<sac::Scope, D>::record_cell(sac::Scope& s, Vertex<D>& v, const CellOf<D>& cell,
                                             float radius, std::uint8_t kind) {
  const Reach<D> reach = concern(cell);
  const auto same = [&](const CellSeen& o) {
    return o.center == v.self && o.reach == reach && o.radius == radius &&
           std::equal(codes_.begin(), codes_.end(), o.codes(), o.codes() + o.count);
  };
  // If this run of the call asks less of features than the last one, it is told of more than it
  // must be: an update that fails leaves the observation as it was.
  last_cell_ = s.recall<CellSeen>(id_, kind, same);
  last_is_new_ = last_cell_ == nullptr;
  if (last_cell_ != nullptr) {
    last_cell_->arrivals = 0;
    return;
  }
  last_cell_ = &s.observe<CellSeen>(id_, kind, codes_.size() * sizeof(std::uint32_t));
  last_cell_->radius = radius;
  SAC_EXPECTS(codes_.size() < std::size_t{1} << 31);
  last_cell_->count = static_cast<std::uint32_t>(codes_.size()) & 0x7fffffffu;
  last_cell_->is_clear = 0;
  std::copy(codes_.begin(), codes_.end(), last_cell_->codes());
  if constexpr (D == 3) last_cell_->features_within = 0;
  fill(s, *last_cell_, v, reach);
  tell(v, *last_cell_, unpacked(radius));
}

template <int D>
void VertexIndex<sac::Scope, D>::record_nearest(sac::Scope& s, Vertex<D>& v, Reach<D> reach,
                                                VertexHandle nearest) {
  const auto same = [&](const NearestSeen& o) {
    return o.center == v.self && o.reach == reach && o.nearest == nearest;
  };
  if (s.recall<NearestSeen>(id_, kNearest, same) != nullptr) return;
  auto& o = s.observe<NearestSeen>(id_, kNearest);
  o.nearest = nearest;
  fill(s, o, v, reach);
  tell(v, o, -1);
}

template <int D>
void VertexIndex<sac::Scope, D>::forget(Observation& o) noexcept {
  observers_.unlink(o);
  if (listener_ != nullptr) [[unlikely]]
    listener_->forgot(pool_[o.center], o);
  if (o.kind == kTrial && !pool_[o.center].alive) touch(pool_[o.center]);
}

// --- In doubt --------------------------------------------------------------------------------

/// A call is in doubt where features have changed as near as the corners of a cell that it saw.
template <int D>
bool VertexIndex<sac::Scope, D>::unchanged(sac::Call&, sac::Edge& edge) {
  if constexpr (D == 3) {
    if (changed_ == nullptr || is_birth(edge)) return true;
    const auto& o = static_cast<const Observation&>(edge);
    return !Observers<D>::is_cell(o) || !star_has_changed_feature(static_cast<const CellSeen&>(o));
  }
  return true;
}

/// Whether a feature that has changed meets the box around the vertices of a star, and the ball of
/// a simplex; erring towards yes by more than rounding does there (space/star_crossings.hpp).
template <int D>
bool VertexIndex<sac::Scope, D>::star_has_changed_feature(const CellSeen& cell) {
  if constexpr (D == 3) {
    const Vertex<3>& v = pool_[cell.center];
    const auto seen = observers_.seen(cell);
    Box<3> box{v.p, v.p};
    for (const std::uint32_t code : Cell::neighbours(seen)) {
      if (code >= Cell::kVirtual) break;
      grow(box, pool_[code].p);
    }
    const auto slack = [&](double radius) {
      return radius * (1 + 0x1p-9) + 0x1p9 * resolution(v.p, 0);
    };
    const PlaceBall whole{middle_of(box), slack(reach_of(box))};
    balls_.clear();
    Cell::visit_gap_balls(pool_, v, unpacked(cell.radius), seen,
                          [&](const Point<3>& middle, double radius2) {
                            balls_.push_back({plus(v.p, middle), slack(std::sqrt(radius2))});
                          });
    return changed_->any_meets(whole, balls_);
  }
  return false;
}

// --- Taking back -----------------------------------------------------------------------------

template <int D>
void VertexIndex<sac::Scope, D>::retract(sac::Call&, sac::Edge& edge) noexcept {
  if (is_birth(edge)) return retract_birth(static_cast<BirthEdge&>(edge));
  forget(static_cast<Observation&>(edge));
}

// --- For people and for traces ---------------------------------------------------------------

// The neighbours in a canonical order: virtual ones by number, the others by place. In which order
// vertices were made does not matter then.
template <int D>
std::vector<std::uint32_t> VertexIndex<sac::Scope, D>::canonical_codes(const Observation& o) const {
  const auto seen = observers_.neighbours(o);
  std::vector<std::uint32_t> codes(seen.begin(), seen.end());
  const auto before = [&](std::uint32_t a, std::uint32_t b) {
    if (a >= Cell::kVirtual || b >= Cell::kVirtual) return a < b;
    return pool_[a].p < pool_[b].p;
  };
  if (o.kind != kNearest) Cell::put_in_order(codes, before);
  return codes;
}

template <int D>
void VertexIndex<sac::Scope, D>::label(const sac::Call&, const sac::Edge& edge,
                                       sac::LabelSink& sink) const {
  if (is_birth(edge)) return;
  const auto codes = canonical_codes(static_cast<const Observation&>(edge));
  sink.number(codes.size());
  for (const std::uint32_t code : codes) {
    if (code == 0 || code >= Cell::kVirtual) {
      sink.number(code);
    } else {
      label_bytes(sink, VertexRef<D>{&pool_[code]});
    }
  }
}

template <int D>
void VertexIndex<sac::Scope, D>::print(const sac::Call&, const sac::Edge& edge,
                                       std::ostream& out) const {
  if (is_birth(edge)) {
    out << "inserts " << VertexRef<D>{&pool_[static_cast<const BirthEdge&>(edge).vertex]};
  } else {
    out << (edge.kind == kNearest ? "nearest" : edge.kind == kTrial ? "tries" : "neighbours");
    for (const std::uint32_t code : canonical_codes(static_cast<const Observation&>(edge))) {
      if (code != 0 && code < Cell::kVirtual) out << ' ' << VertexRef<D>{&pool_[code]};
    }
  }
}

// --- Between updates -------------------------------------------------------------------------

template <int D>
std::span<const std::uint32_t> VertexIndex<sac::Scope, D>::ring(const Vertex<D>& v) const {
  const Observation* star =
      observers_.find_at(v, [](const Observation& o) { return o.kind == kStar; });
  return star == nullptr ? std::span<const std::uint32_t>() : observers_.seen(*star);
}

template <int D>
void VertexIndex<sac::Scope, D>::keep_triangulation() {
  if constexpr (D <= 3) {
    kept_ = live_ != nullptr ? std::make_unique<KeptTriangulation<D>>(*live_)
                             : std::make_unique<KeptTriangulation<D>>(pool_, live_vertices());
    keeps_ = true;
    live_.reset();
  }
}

template <int D>
void VertexIndex<sac::Scope, D>::follow(const std::vector<VertexHandle>& touched) {
  if constexpr (D <= 3) {
    if (!keeps_) return;
    if (kept_ == nullptr) {
      kept_ = std::make_unique<KeptTriangulation<D>>(
          pool_, vertices_that([](const Vertex<D>& v) { return v.committed; }));
    }
    std::vector<VertexHandle> come, gone;
    for (const VertexHandle h : touched) {
      const Vertex<D>& v = pool_[h];
      if (v.alive != kept_->has(h)) (v.alive ? come : gone).push_back(h);
    }
    const auto near = [&](VertexHandle v, VertexHandle last) {
      const double few = kFewLeaves * tree_.side_at(pool_[v].p);
      const bool is_beside = last != 0 && squared_distance(pool_[last].p, pool_[v].p) <= few * few;
      if (is_beside) return last;
      return nearest_around(pool_[v], [&](VertexHandle u) { return kept_->has(u); }).handle;
    };
    kept_->change(pool_, come, gone, near);
    static_cast<void>(take_visited());
  }
}

// Its vertices are those of a failed update, perhaps.
template <int D>
void VertexIndex<sac::Scope, D>::put_triangulation_back() noexcept {
  if constexpr (D <= 3) {
    if (kept_ == nullptr) return;
    const auto is_other = [&](const Vertex<D>& v) { return v.alive != kept_->has(v.self); };
    try {
      if (log_.any_touched(is_other)) follow();
      kept_->commit();
    } catch (...) {
      kept_.reset();
    }
  }
}

template <int D>
auto VertexIndex<sac::Scope, D>::log() -> Log {
  Log log{log_.touched(), {}, {}};
  if constexpr (D <= 3) {
    follow(log.touched);
    if (!keeps_) return log;
    auto news = kept_->news();
    log.simplices_gone = std::move(news.gone);
    log.simplices_come = std::move(news.come);
  }
  return log;
}

template <int D>
void VertexIndex<sac::Scope, D>::commit() noexcept {
  put_triangulation_back();
  log_.clear([&](Vertex<D>& v) {
    v.committed = v.alive;
    v.committed_kind = v.kind();
    if (v.alive || v.input) return;
    const bool tried = v.queries != 0;
    set_trial(v, tried);
    if (tried || v.held != 0) return;
    tree_.erase(v);
    pool_.release(v);
  });
  observers_.forget_arrivals();
}

template <int D>
void VertexIndex<sac::Scope, D>::give_up() noexcept {
  log_.clear([&](Vertex<D>& v) {
    if (!v.alive) touch(v);
  });
}

template <int D>
void VertexIndex<sac::Scope, D>::check_invariants() const {
  pool_.check_invariants();
  tree_.check_invariants();
  for (const VertexHandle h : log_.touched()) SAC_INVARIANT(!pool_[h].alive);
  pool_.for_each([&](const Vertex<D>& v) { check_vertex(v); });
  if constexpr (D <= 3) {
    if (kept_ == nullptr) return;
    kept_->check_invariants();
    pool_.for_each([&](const Vertex<D>& v) { SAC_INVARIANT(kept_->has(v.self) == v.alive); });
  }
}

// What is not alive is listed to be freed. (Inputs that no call locates are never alive.)
template <int D>
void VertexIndex<sac::Scope, D>::check_vertex(const Vertex<D>& v) const {
  SAC_INVARIANT(tree_.find(v.p) == &v);
  const bool waits = v.input && v.locator == nullptr;
  SAC_INVARIANT(v.alive == v.committed && (v.alive || !v.input || waits));
  SAC_INVARIANT(v.alive ? !v.changed && !v.trial
                        : v.changed || v.queries != 0 || v.held != 0 || waits);
  const bool is_made = v.boundary || v.presence.there();
  SAC_INVARIANT(v.alive == is_made || (v.alive && is_given_));
  presences_.check_invariants(v.presence);
  if (v.presence.there()) {
    SAC_INVARIANT(role(v) == role_from(engine_.call_at(v.presence.birth()), v));
  }
  observers_.check_invariants(v);
  int stars = 0;
  observers_.find_at(v, [&](const Observation& o) {
    stars += o.kind == kStar;
    check_observation(v, o);
    return false;
  });
  SAC_INVARIANT(stars == (v.alive ? 1 : 0) || (D <= 3 && stars == 0));
}

// It is what a search from nothing finds.
template <int D>
void VertexIndex<sac::Scope, D>::check_observation(const Vertex<D>& v, const Observation& o) const {
  const sac::Call& call = engine_.call(o.call);
  const auto seen = [&](VertexHandle u) {
    return o.kind == kStar ? pool_[u].alive : born_before(pool_[u], call);
  };
  if (o.kind == kNearest) {
    SAC_INVARIANT(nearest_around(v, seen).handle == observers_.seen(o)[0]);
    return;
  }
  const double radius = unpacked(static_cast<const CellSeen&>(o).radius);
  const CellLoan<D> cell = cut_around(v, radius, seen);
  cell->check_invariants();
  std::vector<std::uint32_t> record;
  cell->write(record);
  const auto last = observers_.seen(o);
  SAC_INVARIANT(std::equal(record.begin(), record.end(), last.begin(), last.end()));
  SAC_INVARIANT(o.reach == concern(*cell));
}

template class VertexIndex<sac::Scope, 2>;
#ifndef MESHER_PLANE_ONLY
template class VertexIndex<sac::Scope, 3>;
template class VertexIndex<sac::Scope, 4>;
#endif

}  // namespace mesher::detail
