// Births, observations, and which observations a vertex concerns.
#include "index/vertex_index.hpp"

#include <algorithm>

namespace mesher::detail {

using Index = VertexIndex<sac::Scope, 2>;

// --- Births ----------------------------------------------------------------------------------

VertexRef<2> Index::insert(sac::Scope& s, const Point<2>& p) {
  const auto same = [&](const BirthEdge& edge) { return pool_[edge.vertex].p == p; };
  if (const auto* edge = s.recall<BirthEdge>(id_, kBirth, same)) return {&pool_[edge->vertex]};
  Vertex<2>& v = record_at(s, p);
  produce(s, v);
  return {&v};
}

VertexRef<2> Index::insert(sac::Scope& s, const Point<2>& p, const Role& role) {
  if (const auto* edge = recall_on_segment(s, p, role)) return {&pool_[edge->vertex]};
  Vertex<2>& v = record_at(s, p);
  produce_on_segment(s, v, role);
  return {&v};
}

VertexRef<2> Index::insert_early(sac::Scope& s, const Point<2>& p, const Role& role) {
  if (!engine_.appending()) return insert(s, p, role);
  Vertex<2>& v = add(p);
  produce_on_segment(s, v, role);
  return {&v};
}

VertexRef<2> Index::insert_early(sac::Scope& s, const Point<2>& p) {
  if (!engine_.appending()) return insert(s, p);
  Vertex<2>& v = add(p);
  produce(s, v);
  return {&v};
}

const Index::BirthOnSegmentEdge* Index::recall_on_segment(sac::Scope& s, const Point<2>& p,
                                                          const Role& role) {
  const auto same = [&](const BirthOnSegmentEdge& edge) {
    return edge.role == role && pool_[edge.vertex].p == p;
  };
  return s.recall<BirthOnSegmentEdge>(id_, kBirthOnSegment, same);
}

void Index::produce_on_segment(sac::Scope& s, Vertex<2>& v, const Role& role) {
  touch(v);
  roles_.reserve(v.self);
  observers_.expect_arrivals();
  auto& edge = s.effect<BirthOnSegmentEdge>(id_, kBirthOnSegment);
  edge.role = role;
  produced(s, v, edge, role);
}

// Throws: Error if a vertex is at p already.
Vertex<2>& Index::record_at(sac::Scope& s, const Point<2>& p) {
  Vertex<2>* v = tree_.find(p);
  if (v != nullptr && born_before(*v, s.self())) fail_coincident(p);
  return v == nullptr ? add(p) : *v;
}

void Index::insert(sac::Scope& s, VertexRef<2> v) {
  if (v->on_segment && presences_.seen_by(v->presence, s.self())) return;
  const auto same = [&](const BirthEdge& edge) { return edge.vertex == v->self; };
  if (s.recall<BirthEdge>(id_, kBirth, same) == nullptr) produce(s, *v);
}

// A record that fails to be produced is in the log, and freed at the end of the update.
void Index::produce(sac::Scope& s, Vertex<2>& v) {
  touch(v);
  observers_.expect_arrivals();
  produced(s, v, s.effect<BirthEdge>(id_, kBirth), Role());
}

void Index::produced(sac::Scope& s, Vertex<2>& v, BirthEdge& edge, const Role& role) noexcept {
  edge.vertex = v.self;
  const bool was_there = v.presence.there();
  const auto window = presences_.produced(v.presence, edge, s.self());
  v.alive = true;
  if (!was_there) {
    set_role(v, role);  // nobody has seen it
  } else if (v.presence.birth() == engine_.handle_of(s.self())) {
    take_role(v, role, s.self());
  }
  if (window.has_value()) appeared(v, *window);
}

// What `producer`, of v, says that v is.
Role Index::role_from(const sac::Call& producer, const Vertex<2>& v) const noexcept {
  Role role;
  engine_.for_each_edge(producer, [&](const sac::Edge& edge) {
    if (edge.structure != id_ || edge.kind != kBirthOnSegment) return;
    const auto& birth = static_cast<const BirthOnSegmentEdge&>(edge);
    if (birth.vertex == v.self) role = birth.role;
  });
  return role;
}

void Index::run_again(sac::Handle h, const sac::Window& window, const sac::Edge* seen) noexcept {
  sac::Call& call = engine_.call(h);
  if (window.contains(engine_, call)) engine_.invalidate(call, seen);
}

// v's earliest producer gives it a role. Those later that took it for what it was run again; who
// has come to see v by this producer does so in any case.
void Index::take_role(Vertex<2>& v, const Role& now, const sac::Call& producer) noexcept {
  if (!v.on_segment && now.on == 0) return;
  if (role(v) == now) return;
  set_role(v, now);
  if (engine_.appending()) return;
  const sac::Window later{&producer, nullptr};
  if (v.locator != 0) run_again(v.locator, later, nullptr);
  for_each_cell_with(v, [&](const Observation& o) { run_again(o.call, later, &o); });
}

void Index::legs_changed(const Vertex<2>& v) noexcept {
  if (!v.alive) return;  // nobody has seen it
  for_each_cell_with(v,
                     [&](const Observation& o) { engine_.invalidate(engine_.call(o.call), &o); });
}

void Index::retract_birth(BirthEdge& birth) noexcept {
  Vertex<2>& v = pool_[birth.vertex];
  touch(v);
  const sac::Handle earliest = v.presence.birth();
  const auto window = presences_.retracted(v.presence, birth);
  v.alive = v.presence.there();
  if (v.alive && v.presence.birth() != earliest) {
    const sac::Call& next = engine_.call(v.presence.birth());
    take_role(v, role_from(next, v), next);
  }
  if (!window.has_value()) return;
  if (birth.kind == kBirthOnSegment && v.locator != 0) run_again(v.locator, *window, nullptr);
  vanished(v, *window);
}

// Observations in the window that have a gap ball around v, or are nearer to it than to others. Few
// have: times, which lie elsewhere in memory, are looked at last.
void Index::appeared(const Vertex<2>& v, const sac::Window& window) noexcept {
  observers_.for_each_reaching(v.p, box_.side, [&](const Vertex<2>& center, Observation& o) {
    if (center.self == v.self) return;
    if (o.kind != kNearest) {
      const double radius =
          o.kind == kStar ? whole() : unpacked(static_cast<const CellSeen&>(o).radius);
      if (!VoronoiCell::may_cut(pool_, center, radius, observers_.seen(o), v.p)) return;
    }
    sac::Call& call = engine_.call(o.call);
    if (!window.contains(engine_, call)) return;
    if (o.kind != kNearest) observers_.note_arrival(o, v.self);
    engine_.invalidate(call, &o);
  });
}

// Observations in the window that v bounds.
void Index::vanished(const Vertex<2>& v, const sac::Window& window) noexcept {
  observers_.for_each_reaching(v.p, box_.side, [&](const Vertex<2>&, const Observation& o) {
    const auto seen = observers_.seen(o);
    if (std::find(seen.begin(), seen.end(), v.self) == seen.end()) return;
    sac::Call& call = engine_.call(o.call);
    if (window.contains(engine_, call)) engine_.invalidate(call, &o);
  });
}

// --- Observations ----------------------------------------------------------------------------

// `last`: what the running call saw last time, if it asked the same.
template <class Seen>
CellLoan<2> Index::look(const Vertex<2>& v, double radius, const Observation* last, Seen&& seen) {
  if (last != nullptr && observers_.knows_arrivals(*last)) {
    const auto arrivals = [&](auto&& visit) { observers_.for_each_arrival(*last, visit); };
    return repaired_cell(v, radius, observers_.seen(*last), arrivals, seen);
  }
  const auto surrounds = [](const Observation& o) { return o.kind != kNearest; };
  if (const Observation* other = observers_.find_at(v, surrounds)) {
    return cell_from_ring(v, radius, observers_.seen(*other), seen);
  }
  return cut_around(v, radius, seen);
}

CellLoan<2> Index::voronoi_cell(sac::Scope& s, VertexRef<2> v, double radius) {
  const sac::Call& self = s.self();
  const sac::Handle caller = engine_.handle_of(self);
  const float clip = packed(radius);
  SAC_EXPECTS(unpacked(clip) == radius);
  const Observation* last = observers_.find_at(*v, [&](const Observation& o) {
    return o.kind == kCell && o.call == caller && static_cast<const CellSeen&>(o).radius == clip;
  });
  CellLoan<2> cell =
      look(*v, radius, last, [&](VertexHandle u) { return born_before(pool_[u], self); });
  s.weigh(take_visited());
  take_codes(*cell);
  record_cell(s, *v, packed(concern(*cell)), clip);
  return cell;
}

double Index::nearest2(sac::Scope& s, VertexRef<2> v) {
  const sac::Call& self = s.self();
  const Nearest n = nearest_around(*v, [&](VertexHandle u) { return born_before(pool_[u], self); });
  s.weigh(take_visited());
  record_nearest(s, *v, packed(std::sqrt(n.distance2) * (1 + 0x1p-40)), n.handle);
  return n.distance2;
}

CellLoan<2> Index::star(sac::Scope& s, VertexRef<2> v) {
  const sac::Handle caller = engine_.handle_of(s.self());
  const Observation* last = observers_.find_at(
      *v, [&](const Observation& o) { return o.kind == kStar && o.call == caller; });
  CellLoan<2> cell = look(*v, whole(), last, [&](VertexHandle u) { return pool_[u].alive; });
  s.weigh(take_visited());
  take_codes(*cell);
  record_star(s, *v, packed(concern(*cell)));
  return cell;
}

// The same ring may start elsewhere: the order in which vertices were met decides that.
void Index::take_codes(const VoronoiCell& cell) {
  codes_.clear();
  for (int i = 0; i < cell.size(); ++i) codes_.push_back(cell.code(i));
  std::rotate(codes_.begin(), std::min_element(codes_.begin(), codes_.end()), codes_.end());
}

// --- Records ---------------------------------------------------------------------------------
//
// An observation that says the same as last time is kept as it is.

void Index::fill(sac::Scope& s, Observation& o, Vertex<2>& v, float reach) noexcept {
  o.center = v.self;
  o.call = engine_.handle_of(s.self());
  o.reach = reach;
  observers_.link(o);
}

void Index::record_cell(sac::Scope& s, Vertex<2>& v, float reach, float radius) {
  const auto same = [&](const CellSeen& o) {
    return o.center == v.self && o.reach == reach && o.radius == radius &&
           std::equal(codes_.begin(), codes_.end(), o.codes(), o.codes() + o.count);
  };
  if (auto* o = s.recall<CellSeen>(id_, kCell, same)) {
    o->arrivals = 0;
    return;
  }
  auto& o = s.observe<CellSeen>(id_, kCell, codes_.size() * sizeof(std::uint32_t));
  o.radius = radius;
  o.count = static_cast<std::uint32_t>(codes_.size());
  std::copy(codes_.begin(), codes_.end(), o.codes());
  fill(s, o, v, reach);
}

void Index::record_nearest(sac::Scope& s, Vertex<2>& v, float reach, VertexHandle nearest) {
  const auto same = [&](const NearestSeen& o) {
    return o.center == v.self && o.reach == reach && o.nearest == nearest;
  };
  if (s.recall<NearestSeen>(id_, kNearest, same) != nullptr) return;
  auto& o = s.observe<NearestSeen>(id_, kNearest);
  o.nearest = nearest;
  fill(s, o, v, reach);
}

void Index::record_star(sac::Scope& s, Vertex<2>& v, float reach) {
  const auto same = [&](const StarSeen& o) {
    const auto seen = observers_.seen(o);
    return o.center == v.self && o.reach == reach &&
           std::equal(codes_.begin(), codes_.end(), seen.begin(), seen.end());
  };
  if (auto* o = s.recall<StarSeen>(id_, kStar, same)) {
    o->arrivals = 0;
    return;
  }
  const sac::Handle ring = new_ring(v.self);
  try {
    auto& o = s.observe<StarSeen>(id_, kStar);
    o.ring = ring;
    fill(s, o, v, reach);
  } catch (...) {
    engine_.arena().release(ring, Ring::bytes(codes_.size()));
    throw;
  }
  log_.star_came(v, ring);
}

sac::Handle Index::new_ring(VertexHandle center) {
  const sac::Handle handle = engine_.arena().allocate(Ring::bytes(codes_.size()));
  Ring& ring = *engine_.arena().at<Ring>(handle);
  ring = {center, 0, static_cast<std::uint32_t>(codes_.size()), true};
  std::copy(codes_.begin(), codes_.end(), ring.codes());
  return handle;
}

void Index::forget(Observation& o) noexcept {
  observers_.unlink(o);
  if (o.kind == kStar) log_.star_went(pool_[o.center], static_cast<StarSeen&>(o).ring);
}

// --- Taking back -----------------------------------------------------------------------------

void Index::retract(sac::Call&, sac::Edge& edge) noexcept {
  if (is_birth(edge)) return retract_birth(static_cast<BirthEdge&>(edge));
  forget(static_cast<Observation&>(edge));
}

// --- For people and for traces ---------------------------------------------------------------

// The neighbours from the smallest on: virtual ones by number, the others by place. In which order
// vertices were made does not matter then.
std::vector<std::uint32_t> Index::canonical_codes(const Observation& o) const {
  const auto seen = observers_.seen(o);
  std::vector<std::uint32_t> codes(seen.begin(), seen.end());
  const auto before = [&](std::uint32_t a, std::uint32_t b) {
    if (a >= VoronoiCell::kVirtual || b >= VoronoiCell::kVirtual) return a < b;
    return pool_[a].p < pool_[b].p;
  };
  std::rotate(codes.begin(), std::min_element(codes.begin(), codes.end(), before), codes.end());
  return codes;
}

void Index::label(const sac::Call&, const sac::Edge& edge, sac::LabelSink& sink) const {
  if (is_birth(edge)) return;
  const auto codes = canonical_codes(static_cast<const Observation&>(edge));
  sink.number(codes.size());
  for (const std::uint32_t code : codes) {
    if (code == 0 || code >= VoronoiCell::kVirtual) {
      sink.number(code);
    } else {
      label_bytes(sink, VertexRef<2>{&pool_[code]});
    }
  }
}

void Index::print(const sac::Call&, const sac::Edge& edge, std::ostream& out) const {
  if (is_birth(edge)) {
    out << "inserts " << VertexRef<2>{&pool_[static_cast<const BirthEdge&>(edge).vertex]};
  } else {
    out << (edge.kind == kNearest ? "nearest" : "neighbours");
    for (const std::uint32_t code : canonical_codes(static_cast<const Observation&>(edge))) {
      if (code != 0 && code < VoronoiCell::kVirtual) out << ' ' << VertexRef<2>{&pool_[code]};
    }
  }
}

// --- Between updates -------------------------------------------------------------------------

Ring* Index::find_ring(const Vertex<2>& v) const noexcept {
  const auto* star = static_cast<const StarSeen*>(
      observers_.find_at(v, [](const Observation& o) { return o.kind == kStar; }));
  return star == nullptr ? nullptr : engine_.arena().at<Ring>(star->ring);
}

std::span<const std::uint32_t> Index::ring(const Vertex<2>& v) const {
  const Ring* ring = find_ring(v);
  return ring == nullptr ? std::span<const std::uint32_t>() : ring->span();
}

Index::Log Index::log() const {
  Log log{log_.touched(), log_.stars_gone(), {}};
  for (const VertexHandle h : log.touched) {
    const Ring* now = pool_[h].star_changed ? find_ring(pool_[h]) : nullptr;
    if (now != nullptr && now->fresh) log.stars_come.push_back({h, now->span()});
  }
  return log;
}

void Index::commit() noexcept {
  log_.clear([&](Vertex<2>& v) {
    v.committed = v.alive;
    v.committed_kind = v.kind();
    if (Ring* ring = find_ring(v)) ring->fresh = false;
    if (v.alive || v.input) return;
    tree_.erase(v);
    pool_.release(v);
  });
  observers_.forget_arrivals();
}

void Index::give_up() noexcept {
  log_.clear([&](Vertex<2>& v) {
    if (!v.alive) touch(v);
  });
}

void Index::check_invariants() const {
  pool_.check_invariants();
  tree_.check_invariants();
  SAC_INVARIANT(log_.stars_gone().empty());
  for (const VertexHandle h : log_.touched()) SAC_INVARIANT(!pool_[h].alive);
  pool_.for_each([&](const Vertex<2>& v) { check_vertex(v); });
}

// What is not alive is listed to be freed.
void Index::check_vertex(const Vertex<2>& v) const {
  SAC_INVARIANT(tree_.find(v.p) == &v);
  SAC_INVARIANT(v.alive == v.committed && v.alive != v.changed && (v.alive || !v.input));
  SAC_INVARIANT(v.alive == (v.boundary || v.presence.there()));
  presences_.check_invariants(v.presence);
  if (v.presence.there()) {
    SAC_INVARIANT(role(v) == role_from(engine_.call(v.presence.birth()), v));
  }
  observers_.check_invariants(v);
  int stars = 0;
  observers_.find_at(v, [&](const Observation& o) {
    stars += o.kind == kStar && !find_ring(v)->fresh;
    check_observation(v, o);
    return false;
  });
  SAC_INVARIANT(stars == (v.alive ? 1 : 0));
}

// It is what a search from nothing finds.
void Index::check_observation(const Vertex<2>& v, const Observation& o) const {
  const sac::Call& call = engine_.call(o.call);
  const auto seen = [&](VertexHandle u) {
    return o.kind == kStar ? pool_[u].alive : born_before(pool_[u], call);
  };
  if (o.kind == kNearest) {
    SAC_INVARIANT(nearest_around(v, seen).handle == observers_.seen(o)[0]);
    return;
  }
  const double radius =
      o.kind == kStar ? whole() : unpacked(static_cast<const CellSeen&>(o).radius);
  const CellLoan<2> cell = cut_around(v, radius, seen);
  cell->check_invariants();
  const auto codes = observers_.seen(o);
  SAC_INVARIANT(codes.size() == static_cast<std::size_t>(cell->size()));
  int first = 0;
  while (first < cell->size() && cell->code(first) != codes[0]) ++first;
  for (int i = 0; i < cell->size(); ++i) {
    SAC_INVARIANT(cell->code((first + i) % cell->size()) == codes[static_cast<std::size_t>(i)]);
  }
  SAC_INVARIANT(o.reach == packed(concern(*cell)));
}

}  // namespace mesher::detail
