// Births, observations, and which observations a vertex concerns.
#include "index/vertex_index.hpp"

#include <algorithm>
#include <limits>

#include "input.hpp"

namespace mesher::detail {

using Index = VertexIndex<sac::Scope>;

// The least float that is not below x: a bound stays a bound.
float VertexSearch::packed(double x) const noexcept {
  x /= box_.side;
  const auto f = static_cast<float>(x);
  return double{f} >= x ? f : std::nextafter(f, std::numeric_limits<float>::infinity());
}

void VertexSearch::fail_coincident(const Point<2>& p) {
  throw Error(ErrorCode::too_close, "input points are too close for double precision near " +
                                        place_text(p) +
                                        ": a new vertex would coincide with another");
}

// --- Time ------------------------------------------------------------------------------------

bool Index::born_before(const Vertex<2>& u, const sac::Call& call) const {
  if (!u.alive) return false;
  if (u.birth == 0 || engine_.appending()) return true;
  const sac::Call& birth = engine_.call(u.birth);
  return &birth != &call && engine_.precedes(birth, call);
}

// --- Births ----------------------------------------------------------------------------------

VertexRef<2> Index::insert(sac::Scope& s, const Point<2>& p) {
  const auto same = [&](const BirthEdge& edge) { return pool_[edge.vertex].p == p; };
  if (const auto* edge = s.recall<BirthEdge>(id_, kBirth, same)) return {&pool_[edge->vertex]};
  Vertex<2>* v = tree_.find(p);
  if (v != nullptr && born_before(*v, s.self())) fail_coincident(p);
  if (v == nullptr) {
    v = &pool_.create(p);
    tree_.insert(*v);
    log_.touched.push_back(v->self);
    v->touched = true;
  }
  produce(s, *v);
  return {v};
}

void Index::insert(sac::Scope& s, VertexRef<2> v) {
  const auto same = [&](const BirthEdge& edge) { return edge.vertex == v->self; };
  if (s.recall<BirthEdge>(id_, kBirth, same) == nullptr) produce(s, *v);
}

void Index::touch(Vertex<2>& v) {
  if (v.touched) return;
  log_.touched.push_back(v.self);
  v.touched = true;
}

void Index::produce(sac::Scope& s, Vertex<2>& v) {
  touch(v);
  auto& edge = s.effect<BirthEdge>(id_, kBirth);
  edge.vertex = v.self;
  edge.call = engine_.handle_of(s.self());
  edge.next_producer = v.producers;
  v.producers = engine_.arena().handle_of(&edge);
  const bool was_alive = v.alive;
  const sac::Handle old_birth = v.birth;
  choose_birth(v);
  if (engine_.appending()) return;  // no observation is later
  if (!was_alive) return appeared(v, nullptr);
  if (v.birth != old_birth) appeared(v, &engine_.call(old_birth));
}

void Index::choose_birth(Vertex<2>& v) {
  v.alive = v.producers != 0;
  v.birth = 0;
  for (sac::Handle h = v.producers; h != 0; h = producer(h).next_producer) {
    const sac::Handle call = producer(h).call;
    if (v.birth == 0 || engine_.precedes(engine_.call(call), engine_.call(v.birth))) v.birth = call;
  }
}

// Observations later than v's birth (and not later than `before`, who could see v already) that
// have a gap ball around v.
double Index::concern(const VoronoiCell& cell) const {
  const Vertex<2>& v = cell.center();
  if (!v.boundary) return 2 * std::sqrt(cell.reach2());
  Point<2> outward;
  for (int i = 0; i < 2; ++i) {
    outward[i] = v.p[i] == box_.lo[i] ? -1 : v.p[i] == box_.hi(i) ? 1 : 0;
  }
  return 2 * std::sqrt(cell.reach2_inside(outward));
}

template <class Seen>
VoronoiCell& Index::cell_around(sac::Scope& s, std::uint8_t kind, const Vertex<2>& v, double radius,
                                Seen&& seen) {
  const sac::Handle self = engine_.handle_of(s.self());
  for (sac::Handle h = v.queries; h != 0; h = query(h).next_query) {
    const QueryEdge& q = query(h);
    if (q.kind != kind || q.call != self || q.radius != packed(radius)) continue;
    if (!cell_.restore(pool_, v, radius, q.codes(), static_cast<int>(q.count), seen)) break;
    for (std::uint32_t n = q.news; n != 0; n = news_[n].next) {
      const VertexHandle w = news_[n].vertex;
      if (seen(w) && cell_.cuts(pool_[w].p)) cell_.cut(w);
    }
    return cell_.open2() > 0 ? fill_open(v, seen) : cell_;
  }
  return cut_around(v, radius, seen);
}

void Index::appeared(const Vertex<2>& v, const sac::Call* before) {
  const sac::Call& birth = engine_.call(v.birth);
  tree_.visit_reaching(v.p, [&](Vertex<2>& center) {
    if (center.self == v.self) return;
    const double d2 = distance2(center.p, v.p);
    for (sac::Handle h = center.queries; h != 0; h = query(h).next_query) {
      QueryEdge& q = query(h);
      const double reach = unpacked(q.reach);
      if (d2 > reach * reach) continue;
      sac::Call& call = engine_.call(q.call);
      if (!engine_.precedes(birth, call)) continue;
      if (before != nullptr && engine_.precedes(*before, call)) continue;
      if (call.has(sac::Call::kInvalid) || q.kind == kNearest ||
          VoronoiCell::may_cut(pool_, center, unpacked(q.radius), q.codes(),
                               static_cast<int>(q.count), v.p)) {
        news_.push_back({v.self, q.news});
        q.news = static_cast<std::uint32_t>(news_.size() - 1);
        if (!call.has(sac::Call::kInvalid)) engine_.invalidate(call, &q);
      }
    }
  });
}

// Observations later than `from` (and not later than `before`, who see v still) bounded by v.
void Index::vanished(const Vertex<2>& v, const sac::Call& from, const sac::Call* before) {
  tree_.visit_reaching(v.p, [&](Vertex<2>& center) {
    const double d2 = distance2(center.p, v.p);
    for (sac::Handle h = center.queries; h != 0; h = query(h).next_query) {
      const QueryEdge& q = query(h);
      const double reach = unpacked(q.reach);
      if (d2 > reach * reach) continue;
      const std::uint32_t* end = q.codes() + q.count;
        if (std::find(q.codes(), end, v.self) == end) continue;
      sac::Call& call = engine_.call(q.call);
      if (!engine_.precedes(from, call)) continue;
      if (before != nullptr && engine_.precedes(*before, call)) continue;
      engine_.invalidate(call, &q);
    }
  });
}

// --- Observations ----------------------------------------------------------------------------

VoronoiCell& Index::voronoi_cell(sac::Scope& s, VertexRef<2> v, double radius) {
  const sac::Call& self = s.self();
  VoronoiCell& cell = cell_around(
      s, kCell, *v, radius, [&](VertexHandle u) { return born_before(pool_[u], self); });
  codes_.clear();
  for (int i = 0; i < cell.size(); ++i) codes_.push_back(cell.code(i));
  record(s, kCell, *v, packed(concern(cell)), packed(radius));
  return cell;
}

double Index::nearest2(sac::Scope& s, VertexRef<2> v) {
  const sac::Call& self = s.self();
  const Nearest n = nearest_around(*v, [&](VertexHandle u) { return born_before(pool_[u], self); });
  codes_.assign(1, n.handle);
  record(s, kNearest, *v, packed(std::sqrt(n.distance2) * (1 + 0x1p-40)), 0);
  return n.distance2;
}

VoronoiCell& Index::star(sac::Scope& s, VertexRef<2> v) {
  VoronoiCell& cell = cell_around(s, kStar, *v, whole(), [&](VertexHandle u) { return pool_[u].alive; });
  codes_.clear();
  for (int i = 0; i < cell.size(); ++i) codes_.push_back(cell.code(i));
  record(s, kStar, *v, packed(concern(cell)), packed(whole()));
  return cell;
}

// Records the observation `codes_`; one that says the same as last time is kept as it is.
void Index::record(sac::Scope& s, std::uint8_t kind, Vertex<2>& v, float reach, float radius) {
  const auto count = static_cast<std::uint32_t>(codes_.size());
  // The same ring may start elsewhere: the order in which vertices were met decides that.
  if (kind != kNearest) {
    std::rotate(codes_.begin(), std::min_element(codes_.begin(), codes_.end()), codes_.end());
  }
  const auto same = [&](const QueryEdge& q) {
    return q.center == v.self && q.reach == reach && q.radius == radius && q.count == count &&
           std::equal(codes_.begin(), codes_.end(), q.codes());
  };
  if (auto* q = s.recall<QueryEdge>(id_, kind, same)) {
    q->news = 0;
    return;
  }
  auto& q = s.observe<QueryEdge>(id_, kind, count * sizeof(std::uint32_t));
  q.center = v.self;
  q.news = 0;
  q.call = engine_.handle_of(s.self());
  q.reach = reach;
  q.radius = radius;
  q.count = count;
  std::copy(codes_.begin(), codes_.end(), q.codes());
  q.next_query = v.queries;
  v.queries = engine_.arena().handle_of(&q);
  if (reach > v.reach) {
    v.reach = reach;
    tree_.raise_reach(v);
  }
  if (kind == kStar && logging_) log_.stars_come.push_back(star_record(q));
}

Index::StarRecord Index::star_record(const QueryEdge& q) const {
  return {q.center, {q.codes(), q.codes() + q.count}};
}

void Index::unlink(QueryEdge& q) {
  Vertex<2>& v = pool_[q.center];
  const sac::Handle self = engine_.arena().handle_of(&q);
  sac::Handle* link = &v.queries;
  while (*link != self) link = &query(*link).next_query;
  *link = q.next_query;
  if (q.reach < v.reach) return;
  v.reach = 0;
  for (sac::Handle h = v.queries; h != 0; h = query(h).next_query) {
    v.reach = std::max(v.reach, query(h).reach);
  }
}

void Index::split(sac::Scope& s, const Cell<2>& cell) {
  if (s.recall<SplitEdge>(id_, kSplit, [](const SplitEdge&) { return true; }) != nullptr) return;
  auto& edge = s.effect<SplitEdge>(id_, kSplit);
  edge.node = tree_.mark(cell);
}

// --- Taking back -----------------------------------------------------------------------------

void Index::retract(sac::Call& call, sac::Edge& edge) noexcept {
  (void)call;
  switch (edge.kind) {
    case kBirth: return retract_birth(static_cast<BirthEdge&>(edge));
    case kSplit: return tree_.unmark(static_cast<SplitEdge&>(edge).node);
    case kStar:
      if (logging_) log_.stars_gone.push_back(star_record(static_cast<QueryEdge&>(edge)));
      [[fallthrough]];
    default: return unlink(static_cast<QueryEdge&>(edge));
  }
}

void Index::retract_birth(BirthEdge& birth) {
  Vertex<2>& v = pool_[birth.vertex];
  touch(v);
  const sac::Handle self = engine_.arena().handle_of(&birth);
  sac::Handle* link = &v.producers;
  while (*link != self) link = &producer(*link).next_producer;
  *link = birth.next_producer;
  const sac::Handle old_birth = v.birth;
  choose_birth(v);
  if (v.birth == old_birth) return;
  vanished(v, engine_.call(old_birth), v.alive ? &engine_.call(v.birth) : nullptr);
}

// --- For people and for traces ---------------------------------------------------------------

// The neighbours from the smallest on: virtual ones by number, the others by place. In which order
// vertices were made does not matter then.
std::vector<std::uint32_t> Index::canonical_codes(const QueryEdge& q) const {
  std::vector<std::uint32_t> codes(q.codes(), q.codes() + q.count);
  const auto before = [&](std::uint32_t a, std::uint32_t b) {
    if (a >= VoronoiCell::kVirtual || b >= VoronoiCell::kVirtual) return a < b;
    return pool_[a].p < pool_[b].p;
  };
  std::rotate(codes.begin(), std::min_element(codes.begin(), codes.end(), before), codes.end());
  return codes;
}

void Index::label(const sac::Call&, const sac::Edge& edge, sac::LabelSink& sink) const {
  if (edge.kind == kBirth || edge.kind == kSplit) return;
  const auto codes = canonical_codes(static_cast<const QueryEdge&>(edge));
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
  if (edge.kind == kBirth) {
    out << "inserts " << VertexRef<2>{&pool_[static_cast<const BirthEdge&>(edge).vertex]};
  } else if (edge.kind != kSplit) {
    out << (edge.kind == kNearest ? "nearest" : "neighbours");
    for (const std::uint32_t code : canonical_codes(static_cast<const QueryEdge&>(edge))) {
      if (code != 0 && code < VoronoiCell::kVirtual) out << ' ' << VertexRef<2>{&pool_[code]};
    }
  }
}

// --- Between updates -------------------------------------------------------------------------

Index::Ring Index::ring(const Vertex<2>& v) const {
  for (sac::Handle h = v.queries; h != 0; h = query(h).next_query) {
    const QueryEdge& q = query(h);
    if (q.kind == kStar) return {q.codes(), static_cast<int>(q.count)};
  }
  return {};
}

void Index::commit() {
  for (const VertexHandle h : log_.touched) {
    Vertex<2>& v = pool_[h];
    v.touched = false;
    v.committed = v.alive;
    if (v.alive || v.input) continue;
    tree_.erase(v);
    pool_.release(v);
  }
  log_ = {};
  news_.resize(1);
}

void Index::check_invariants() const {
  pool_.for_each([&](const Vertex<2>& v) {
    SAC_INVARIANT(tree_.find(v.p) == &v);
    SAC_INVARIANT(v.alive == (v.boundary || v.producers != 0));
    SAC_INVARIANT(v.alive && v.committed == !v.boundary);
    float reach = 0;
    int stars = 0;
    for (sac::Handle h = v.queries; h != 0; h = query(h).next_query) {
      SAC_INVARIANT(query(h).center == v.self);
      SAC_INVARIANT(!engine_.call(query(h).call).has(sac::Call::kDead));
      reach = std::max(reach, query(h).reach);
      stars += query(h).kind == kStar;
    }
    SAC_INVARIANT(v.reach == reach && stars == 1);
  });
  tree_.check_reach();
}

}  // namespace mesher::detail
