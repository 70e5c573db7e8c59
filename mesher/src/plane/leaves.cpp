// Beginnings, ends, and whom they concern.
#include "plane/leaves.hpp"

#include <algorithm>

namespace mesher::detail {

namespace {

void sort(std::vector<LeafRef>& leaves) { std::sort(leaves.begin(), leaves.end(), std::less<>()); }

}  // namespace

// --- Without history -------------------------------------------------------------------------

using PlainLeaves = Leaves<sac::PlainScope>;

std::vector<LeafRef> PlainLeaves::around(const Point<2>& x, const Role& role) const {
  std::vector<LeafRef> leaves;
  records_.for_each_with(x, role, [&](Leaf& leaf) { leaves.push_back({&leaf}); });
  sort(leaves);
  return leaves;
}

std::vector<LeafRef> PlainLeaves::around(sac::PlainScope&, const Point<2>& x) {
  return around(x, Role());
}

std::vector<LeafRef> PlainLeaves::around(sac::PlainScope&, VertexRef<2> v) {
  return around(v->p, vertices_.role(*v));
}

// --- Effects ---------------------------------------------------------------------------------

using TracedLeaves = Leaves<sac::Scope>;

void TracedLeaves::touch(Leaf& leaf) noexcept {
  if (leaf.changed) return;
  leaf.changed = true;
  leaf.next_changed = std::exchange(changed_, leaf.self);
}

void TracedLeaves::begin(sac::Scope& s, const Piece& piece) {
  const auto same = [&](const LeafEdge& edge) { return records_[edge.leaf].piece == piece; };
  if (s.recall<LeafEdge>(id_, kBegin, same) == nullptr) produce(s, records_.record(piece), kBegin);
}

void TracedLeaves::end(sac::Scope& s, LeafRef leaf) {
  const auto same = [&](const LeafEdge& edge) { return edge.leaf == leaf->self; };
  if (s.recall<LeafEdge>(id_, kEnd, same) == nullptr) produce(s, *leaf, kEnd);
}

// A record for which there is no memory to be produced is listed, and freed at the end.
void TracedLeaves::produce(sac::Scope& s, Leaf& leaf, std::uint8_t kind) {
  touch(leaf);
  auto& edge = s.effect<LeafEdge>(id_, kind);
  edge.leaf = leaf.self;
  sac::Presence& presence = kind == kBegin ? leaf.begun : leaf.ended;
  const sac::Ref<sac::Call> self = engine_.handle_of(s.self());
  SAC_ENSURES(s.place() == self);  // calls of the program act before they call
  const auto window = presences_.produced(presence, edge, self);
  if (window.has_value()) changed(leaf, kind, *window);
}

void TracedLeaves::retract(sac::Call&, sac::Edge& edge) noexcept {
  if (edge.kind == kAsk) {
    auto& ask = static_cast<AskEdge&>(edge);
    if (ask.listed) asks_.erase(ask.x, engine_.arena().handle_of(&edge));
    return;
  }
  auto& produced = static_cast<LeafEdge&>(edge);
  Leaf& leaf = records_[produced.leaf];
  touch(leaf);
  const auto window = presences_.retracted(edge.kind == kBegin ? leaf.begun : leaf.ended, produced);
  if (window.has_value()) changed(leaf, edge.kind, *window);
}

// Calls in the window see another beginning or end; it is another answer for those that see the
// beginning and not the end.
void TracedLeaves::changed(const Leaf& leaf, std::uint8_t kind,
                           const sac::Window& window) noexcept {
  const auto concerned = [&](const sac::Call& call) {
    if (!window.contains(engine_, call)) return false;
    return kind == kBegin ? !presences_.seen_by(leaf.ended, call)
                          : presences_.seen_by(leaf.begun, call);
  };
  tell_vertices(leaf, concerned);
  tell_asks(leaf, concerned);
}

// A free vertex's birth is an ask about its place, a cell of a vertex on a segment one about that.
template <class Concerned>
void TracedLeaves::tell_vertices(const Leaf& leaf, Concerned&& concerned) noexcept {
  const auto tell = [&](sac::Call& call, const sac::Edge* seen) {
    if (concerned(call)) engine_.invalidate(call, seen);
  };
  vertices_.for_each_in_ball(leaf.lo, leaf.hi, [&](const Vertex<2>& v) {
    if (v.boundary || v.input || !leaf.has_in_ball(v.p)) return;
    if (!v.on_segment) {
      if (v.presence.there()) tell(engine_.call_at(v.presence.birth()), nullptr);
    } else if (records_.has_in_ball(leaf, v.p, vertices_.role(v))) {
      vertices_.for_each_cell_seen(v, [&](sac::Call& c, const sac::Edge& e) { tell(c, &e); });
    }
  });
}

template <class Concerned>
void TracedLeaves::tell_asks(const Leaf& leaf, Concerned&& concerned) noexcept {
  if (asks_.size() == 0) return;
  const Point<2> middle = leaf.middle();
  const double radius =
      std::hypot(leaf.hi[0] - leaf.lo[0], leaf.hi[1] - leaf.lo[1]) * 0.5 * (1 + 0x1p-40);
  const Box<2> box{{middle[0] - radius, middle[1] - radius},
                   {middle[0] + radius, middle[1] + radius}};
  asks_.visit_in(box, [&](sac::Handle h) {
    const auto& ask = *engine_.arena().at<AskEdge>(h);
    if (!leaf.has_in_ball(ask.x)) return;
    sac::Call& call = engine_.call(ask.call);
    if (concerned(call)) engine_.invalidate(call, &ask);
  });
}

// --- Observations ----------------------------------------------------------------------------

std::vector<LeafRef> TracedLeaves::answer(sac::Scope& s, const Point<2>& x,
                                          const Role& role) const {
  const sac::Call& call = s.self();
  const std::uint64_t before = records_.looked_at();
  std::vector<LeafRef> leaves;
  records_.for_each_with(x, role, [&](Leaf& leaf) {
    if (is_leaf_for(leaf, call)) leaves.push_back({&leaf});
  });
  s.weigh(records_.looked_at() - before);
  sort(leaves);
  return leaves;
}

std::vector<LeafRef> TracedLeaves::around(sac::Scope& s, const Point<2>& x) {
  std::vector<LeafRef> leaves = answer(s, x, Role());
  if (!leaves.empty()) record_ask(s, x, leaves.size());
  return leaves;
}

std::vector<LeafRef> TracedLeaves::around(sac::Scope& s, VertexRef<2> v) {
  return answer(s, v->p, vertices_.role(*v));
}

void TracedLeaves::record_ask(sac::Scope& s, const Point<2>& x, std::size_t count) {
  const auto same = [&](const AskEdge& ask) { return ask.x == x && ask.count == count; };
  if (s.recall<AskEdge>(id_, kAsk, same) != nullptr) return;
  auto& ask = s.observe<AskEdge>(id_, kAsk);
  ask.x = x;
  ask.call = engine_.handle_of(s.self());
  ask.count = static_cast<std::uint32_t>(count);
  ask.listed = 0;  // nothing to take back, should listing fail
  asks_.insert(x, 0, engine_.arena().handle_of(&ask));
  ask.listed = 1;
}

// --- For people and for traces ---------------------------------------------------------------

void TracedLeaves::label(const sac::Call&, const sac::Edge& edge, sac::LabelSink& sink) const {
  if (edge.kind != kAsk) return;
  const auto& ask = static_cast<const AskEdge&>(edge);
  for (const double x : ask.x) sink.number(std::bit_cast<std::uint64_t>(x));
  sink.number(ask.count);
}

void TracedLeaves::print(const sac::Call&, const sac::Edge& edge, std::ostream& out) const {
  if (edge.kind == kAsk) {
    const auto& ask = static_cast<const AskEdge&>(edge);
    out << ask.count << " leaves have (" << ask.x[0] << ' ' << ask.x[1] << ')';
    return;
  }
  out << (edge.kind == kBegin ? "begins " : "ends ")
      << LeafRef{&records_[static_cast<const LeafEdge&>(edge).leaf]};
}

// --- Between updates -------------------------------------------------------------------------

void TracedLeaves::commit() noexcept {
  for (LeafHandle h = std::exchange(changed_, 0); h != 0;) {
    Leaf& leaf = records_[h];
    h = std::exchange(leaf.next_changed, 0);
    leaf.changed = false;
    leaf.committed = is_leaf(leaf);
    if (!leaf.begun.there() && !leaf.ended.there()) records_.release(leaf);
  }
}

void TracedLeaves::check_invariants() const {
  records_.check_invariants();
  asks_.check_invariants();
  SAC_INVARIANT(changed_ == 0);
  records_.for_each([&](const Leaf& leaf) {
    presences_.check_invariants(leaf.begun);
    presences_.check_invariants(leaf.ended);
    SAC_INVARIANT(leaf.begun.there() && leaf.committed == is_leaf(leaf));
  });
  check_births();
  asks_.visit_all([&](sac::Handle h) {
    const auto& ask = *engine_.arena().at<AskEdge>(h);
    std::size_t count = 0;
    records_.for_each([&](const Leaf& leaf) {
      count += leaf.has_in_ball(ask.x) && is_leaf_for(leaf, engine_.call(ask.call));
    });
    SAC_INVARIANT(count == ask.count && count > 0);
  });
}

// No free vertex was born in a leaf's ball.
void TracedLeaves::check_births() const {
  vertices_.pool().for_each([&](const Vertex<2>& v) {
    if (v.boundary || v.input || v.on_segment || !v.presence.there()) return;
    const sac::Call& birth = engine_.call_at(v.presence.birth());
    records_.for_each([&](const Leaf& leaf) {
      SAC_INVARIANT(!leaf.has_in_ball(v.p) || !is_leaf_for(leaf, birth));
    });
  });
}

}  // namespace mesher::detail
