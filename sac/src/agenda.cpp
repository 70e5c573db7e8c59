// Posting, draining, and keeping posted calls in order.
#include "sac/agenda.hpp"

#include <algorithm>
#include <cmath>

namespace sac {

using detail::PostEdge;

int exponent_bucket(double length) { return std::ilogb(length); }

Agenda::Agenda(Engine& engine, std::string name)
    : engine_(engine), name_(std::move(name)), id_(engine.add_structure(*this)) {}

bool Agenda::before(const Call& a, const Call& b) const {
  const detail::Slot& x = slot(a);
  const detail::Slot& y = slot(b);
  if (x.rank != y.rank) return x.rank < y.rank;
  if (x.order != y.order) return x.order < y.order;
  if (a.function != b.function) return a.function->name < b.function->name;
  return a.function->compare(a, b) < 0;
}

// --- Posting ---------------------------------------------------------------------------------

Handle Agenda::find(const Function& function, std::uint32_t hash, const void* args) const {
  return engine_.memo_.find(hash, [&](Handle, const Call& c) {
    return c.function == &function && !c.has(Call::kDead) && slot(c).agenda == id_ &&
           function.equal(c, args);
  });
}

Handle Agenda::create(const Function& function, const Key& key, std::uint32_t hash,
                      const void* args, Construct construct) {
  const std::uint32_t rank = key.rank();
  const Handle h = engine_.new_call(function, hash, args, construct);
  slot(engine_.call(h)) = detail::Slot{.order = key.order, .rank = rank, .agenda = id_};
  engine_.call(h).set(Call::kPending);
  ++pending_calls_;
  return h;
}

void Agenda::post_call(Scope& s, const Function& function, const Key& key, std::uint32_t hash,
                       const void* args, Construct construct) {
  const auto repeats = [&](const PostEdge& edge) {
    const Call& c = engine_.call(edge.target);
    return c.hash == hash && c.function == &function && function.equal(c, args);
  };
  if (s.recall<PostEdge>(id_, 0, repeats) != nullptr) return;
  Handle h = find(function, hash, args);
  const bool fresh = h == 0;
  if (fresh) h = create(function, key, hash, args, construct);
  Call& posted = engine_.call(h);
  try {
    require_future(s.self(), posted);
    if (fresh) {
      drained_ ? place(h) : add_pending(h);
    }
    s.effect<PostEdge>(id_, 0).target = h;
  } catch (...) {
    if (fresh) {
      if (posted.has(Call::kPending)) {
        posted.set(Call::kDead);
        --pending_calls_;
        --engine_.live_calls_;
        engine_.graveyard_.push_back(h);
      } else {
        engine_.invalidate(posted);  // placed without a post: it is discarded when popped
      }
    }
    throw;
  }
  add_post(posted);
}

void Agenda::require_future(const Call& poster, const Call& posted) const {
  const bool together = poster.function->posted && slot(poster).agenda == id_;
  bool future = true;
  if (together) {
    future = before(poster, posted);
  } else if (drained_ || draining_) {
    future = engine_.precedes(poster, engine_.call(drain_call_));
  }
  if (future) return;
  throw UsageError("posting into the past: " + Engine::describe(poster) + " posts " +
                   Engine::describe(posted) + " on agenda '" + name_ + "'");
}

void Agenda::outside_post(const Function& function, const Key& key, std::uint32_t hash,
                          const void* args, Construct construct) {
  engine_.begin_edit();
  Handle h = find(function, hash, args);
  if (h == 0) {
    h = create(function, key, hash, args, construct);
    drained_ ? place(h) : add_pending(h);
  }
  Call& c = engine_.call(h);
  add_post(c);
  engine_.on_rollback([this, h] { drop_post(engine_.call(h)); });
}

void Agenda::outside_retract(const Function& function, std::uint32_t hash, const void* args) {
  engine_.begin_edit();
  const Handle h = find(function, hash, args);
  if (h == 0 || engine_.call(h).posts() == 0) {
    throw UsageError("agenda '" + name_ + "': nothing to retract");
  }
  // Until the next propagation ends the call is only dying, so the handle stays good.
  engine_.on_rollback([this, h] { add_post(engine_.call(h)); });
  drop_post(engine_.call(h));
}

void Agenda::drop_post(Call& call) noexcept {
  call.state -= Call::kOnePost;
  if (call.posts() != 0 || call.has(Call::kPending | Call::kDead) || call.queue != 0) return;
  engine_.enqueue(call);
}

void Agenda::retract(Call&, Edge& edge) noexcept {
  drop_post(engine_.call(static_cast<PostEdge&>(edge).target));
}

// --- Placing ---------------------------------------------------------------------------------

void Agenda::add_pending(Handle call) {
  const detail::Slot& s = slot(engine_.call(call));
  pending_[s.rank].push_back({s.order, call});
}

Handle Agenda::predecessor(const Call& call) const {
  const detail::Slot& s = slot(call);
  const auto order = [&](Handle a, Handle b) { return before(engine_.call(a), engine_.call(b)); };
  auto it = classes_.lower_bound(s.rank);
  if (it != classes_.end() && it->first == s.rank) {
    const Handle h = it->second.predecessor({s.order, engine_.handle_of(call)}, order);
    if (h != 0) return h;
  }
  while (it != classes_.begin()) {
    --it;
    if (!it->second.empty()) return it->second.last();
  }
  return drain_call_;
}

// Puts a call posted during propagation between its neighbours.
void Agenda::place(Handle call) {
  Call& c = engine_.call(call);
  const detail::Slot& s = slot(c);
  const auto order = [&](Handle a, Handle b) { return before(engine_.call(a), engine_.call(b)); };
  const Handle after = predecessor(c);
  OrderedCalls& calls = classes_[s.rank];
  engine_.timeline_.insert_after(after == drain_call_ ? after : engine_.end_of(after), call);
  try {
    calls.insert({s.order, call}, order);
  } catch (...) {
    engine_.timeline_.erase(call);
    throw;
  }
  c.clear(Call::kPending);
  --pending_calls_;
  engine_.invalidate(c);
}

// A discarded call leaves the order.
void Agenda::forget(Engine& engine, Call& call) noexcept {
  const detail::Slot& s = slot(call);
  auto& agenda = static_cast<Agenda&>(*engine.structures_[s.agenda]);
  const auto order = [&](Handle a, Handle b) {
    return agenda.before(engine.call(a), engine.call(b));
  };
  const auto it = agenda.classes_.find(s.rank);
  if (it != agenda.classes_.end()) it->second.erase({s.order, engine.handle_of(call)}, order);
}

// --- Draining --------------------------------------------------------------------------------

struct Agenda::Drain {
  void operator()(Scope& s, Agenda* agenda) const { agenda->run_pending(s.engine()); }
  static constexpr std::string_view kName = "drain";
};

void Agenda::drain(Scope& s) {
  if (draining_ || drained_) throw UsageError("agenda '" + name_ + "' is drained twice");
  static constexpr Drain kDrain{};
  s.call<kDrain>(this);
}

void Agenda::run_pending(Engine& engine) {
  drain_call_ = engine.handle_of(*engine.current_->call);
  draining_ = true;
  try {
    engine.need_end(*engine.current_);
    while (!pending_.empty()) run_class(pending_.begin()->first);
  } catch (...) {
    draining_ = false;
    throw;
  }
  draining_ = false;
  drained_ = true;
}

// Runs one (bucket, phase, colour): what was posted before in order, merged with what its own
// calls post into it.
void Agenda::run_class(std::uint32_t rank) {
  const auto later = [&](const Entry& a, const Entry& b) {
    if (a.order != b.order) return a.order > b.order;
    return a.call != b.call && before(engine_.call(b.call), engine_.call(a.call));
  };
  std::vector<Entry> batch = std::move(pending_[rank]);
  pending_[rank].clear();
  std::sort(batch.begin(), batch.end(), [&](const Entry& a, const Entry& b) { return later(b, a); });
  OrderedCalls& done = classes_[rank];
  std::vector<Entry> late;  // a heap
  std::size_t i = 0;
  try {
    while (i < batch.size() || !late.empty()) {
      const bool from_late = i == batch.size() || (!late.empty() && later(batch[i], late.front()));
      Handle next;
      if (from_late) {
        std::pop_heap(late.begin(), late.end(), later);
        next = late.back().call;
        late.pop_back();
      } else {
        next = batch[i++].call;
      }
      run_one(next, done);
      auto& posted = pending_[rank];
      for (const Entry& entry : posted) {
        late.push_back(entry);
        std::push_heap(late.begin(), late.end(), later);
      }
      posted.clear();
    }
  } catch (...) {
    batch.insert(batch.end(), late.begin(), late.end());
    return_to_pending(batch, i);
    throw;
  }
  pending_.erase(rank);
}

void Agenda::run_one(Handle call, OrderedCalls& done) {
  Call& c = engine_.call(call);
  --pending_calls_;
  c.clear(Call::kPending);
  if (c.posts() == 0) {  // posted, then taken back before it could run
    c.set(Call::kDead);
    --engine_.live_calls_;
    engine_.graveyard_.push_back(call);
    return;
  }
  done.append({slot(c).order, call});
  engine_.timeline_.insert_after(engine_.now_, call);
  engine_.now_ = call;
  engine_.execute(call, engine_.current_->limit);
}

// After a failure: what has not run is dropped, since the run that posted it is taken back.
void Agenda::return_to_pending(std::vector<Entry>& batch, std::size_t from) noexcept {
  for (std::size_t i = from; i < batch.size(); ++i) {
    Call& c = engine_.call(batch[i].call);
    c.set(Call::kDead);
    c.clear(Call::kPending);
    --pending_calls_;
    --engine_.live_calls_;
    engine_.graveyard_.push_back(batch[i].call);
  }
}

// --- Bookkeeping -----------------------------------------------------------------------------

std::size_t Agenda::bytes() const noexcept {
  std::size_t total = 0;
  for (const auto& [rank, calls] : classes_) total += calls.bytes() + 64;
  for (const auto& [rank, entries] : pending_) total += entries.capacity() * sizeof(Entry) + 64;
  return total;
}

void Agenda::check_invariants() const {
  const Call* previous = nullptr;
  for (const auto& [rank, calls] : classes_) {
    calls.for_each([&, rank = rank](const Entry& entry) {
      const Call& c = engine_.call(entry.call);
      SAC_INVARIANT(!c.has(Call::kDead | Call::kPending) && c.posts() > 0);
      SAC_INVARIANT(slot(c).rank == rank && slot(c).order == entry.order);
      SAC_INVARIANT(previous == nullptr || (before(*previous, c) && engine_.precedes(*previous, c)));
      previous = &c;
    });
  }
}

}  // namespace sac
