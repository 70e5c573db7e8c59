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
  if (a.function_number != b.function_number) {
    const std::strong_ordering order = order_by_name(a.function(), b.function());
    return order != 0 ? order < 0 : a.function_number < b.function_number;
  }
  return a.function().compare(a, b) < 0;
}

// --- Posting ---------------------------------------------------------------------------------

Handle Agenda::find(const Function& function, std::uint32_t hash, const void* args) const {
  const std::uint16_t number = engine_.number_of(function);
  return engine_.memo_.find(hash, [&](Handle, const Call& c) {
    return c.function_number == number && !c.has(Call::kDead) && slot(c).agenda() == id_ &&
           function.equal(c, args);
  });
}

Handle Agenda::create(const Function& function, const Key& key, std::uint32_t hash,
                      const void* args, Construct construct) {
  const std::uint32_t rank = key.rank();
  const Handle h = engine_.new_call(function, hash, args, construct);
  slot(engine_.call(h)) =
      detail::Slot{.order = key.order, .rank = rank, .agenda_and_posts = id_};
  engine_.call(h).set(Call::kPending);
  ++pending_calls_;
  return h;
}

void Agenda::post_call(Scope& s, const Function& function, const Key& key, std::uint32_t hash,
                       const void* args, Construct construct) {
  const std::uint16_t number = engine_.number_of(function);
  const auto repeats = [&](const PostEdge& edge) {
    const Call& c = engine_.call(edge.target);
    return c.function_number == number && function.equal(c, args);
  };
  if (s.recall<PostEdge>(id_, kPost, repeats) != nullptr) return;
  Handle h = find(function, hash, args);
  const bool fresh = h == 0;
  if (fresh) h = create(function, key, hash, args, construct);
  Call& posted = engine_.call(h);
  try {
    require_room(posted);
    require_future(s.self(), posted);
    if (fresh) drained_ ? place(h) : add_pending(h);
  } catch (...) {
    if (fresh) drop_pending(h);
    throw;
  }
  try {
    s.effect<PostEdge>(id_, kPost).target = h;
  } catch (...) {
    unposted_ = true;  // a call that waits and that nobody posts leaves at the end
    throw;
  }
  add_post(posted);
}

// Whether `posted` runs after `poster`. Before the drain everything is in the future; during the
// drain, what comes after the posted call that runs; then, what has its place behind the poster.
bool Agenda::in_future(const Call& poster, const Call& posted) const {
  if (!draining_ && !drained_) return true;
  if (poster.has(Call::kPosted) && slot(poster).agenda() == id_) return before(poster, posted);
  if (draining_) return running_ != 0 && before(engine_.call(running_), posted);
  if (!posted.has(Call::kPending)) return engine_.precedes(poster, posted);
  if (engine_.precedes(poster, engine_.call(drain_call_))) return true;
  const Handle after = predecessor(posted);
  if (after == drain_call_) return false;
  const Handle end = engine_.end_of(after);
  return !engine_.linked(end) || engine_.precedes(poster, engine_.call(end));
}

void Agenda::require_future(const Call& poster, const Call& posted) const {
  if (in_future(poster, posted)) return;
  throw UsageError("posting into the past: " + Engine::describe(poster) + " posts " +
                   Engine::describe(posted) + " on agenda '" + name_ + "'");
}

Key Agenda::key_of(const Call& call) noexcept {
  const std::uint32_t rank = slot(call).rank;
  return {.bucket = static_cast<int>(rank >> 16) - 32768,
          .phase = rank >> 12 & 15,
          .colour = rank & 4095,
          .order = slot(call).order};
}

void Agenda::outside_post(const Function& function, const Key& key, std::uint32_t hash,
                          const void* args, Construct construct) {
  Handle h = find(function, hash, args);
  if (h == 0) {
    h = create(function, key, hash, args, construct);
    try {
      drained_ ? place(h) : add_pending(h);
    } catch (...) {
      drop_pending(h);
      if (engine_.idle()) engine_.purge();
      throw;
    }
  }
  require_room(engine_.call(h));
  add_post(engine_.call(h));
}

void Agenda::require_room(const Call& call) const {
  if (slot(call).posts() < detail::Slot::kMostPosts) return;
  throw UsageError("agenda '" + name_ + "': too many calls post " + Engine::describe(call));
}

Call& Agenda::require_posted(const Function& function, std::uint32_t hash,
                             const void* args) const {
  const Handle h = find(function, hash, args);
  if (h == 0 || slot(engine_.call(h)).posts() == 0) {
    throw UsageError("retract_from_outside: no call " + std::string(function.name) +
                     " with these arguments is posted on agenda '" + name_ + "'");
  }
  return engine_.call(h);
}

void Agenda::add_post(Call& call) noexcept {
  if (engine_.observer_ != nullptr) [[unlikely]] engine_.note(Event::Kind::posted, &call);
  slot(call).agenda_and_posts += detail::Slot::kOnePost;
}

// `poster`: null for the outside.
void Agenda::drop_post(Call& call, const Call* poster) noexcept {
  if (engine_.observer_ != nullptr) [[unlikely]] {
    engine_.observer_->on({.kind = Event::Kind::unposted, .call = &call, .by = poster});
  }
  slot(call).agenda_and_posts -= detail::Slot::kOnePost;
  if (call.has(Call::kPending)) unposted_ = true;
  if (slot(call).posts() != 0 || call.has(Call::kPending | Call::kDead) || call.queue != 0) return;
  engine_.enqueue(call);
}

void Agenda::retract(Call& call, Edge& edge) noexcept {
  if (edge.kind == kPost) {
    return drop_post(engine_.call(static_cast<PostEdge&>(edge).target), &call);
  }
  drained_ = false;
  drain_call_ = 0;
}

// --- Placing ---------------------------------------------------------------------------------

void Agenda::add_pending(Handle call) {
  const detail::Slot& s = slot(engine_.call(call));
  pending_[s.rank].push_back({s.order, call});
}

// Requires: the call is in no list.
void Agenda::drop_pending(Handle call) noexcept {
  --pending_calls_;
  if (engine_.observer_ != nullptr) [[unlikely]] {
    engine_.note(Event::Kind::dying, &engine_.call(call));
  }
  engine_.drop_call(call);
}

// Pending calls that nobody posts leave.
void Agenda::drop_unposted() noexcept {
  if (!std::exchange(unposted_, false)) return;
  const auto drop = [&](Handle h) {
    const bool unposted = slot(engine_.call(h)).posts() == 0;
    if (unposted) drop_pending(h);
    return unposted;
  };
  for (auto& [rank, entries] : pending_) {
    std::erase_if(entries, [&](const Entry& entry) { return drop(entry.call); });
  }
  for (Handle* link = &detached_; *link != 0;) {
    Call& c = engine_.call(*link);
    if (drop(*link)) {
      *link = std::exchange(c.edges, 0);
    } else {
      link = &c.edges;
    }
  }
}

// A call whose drain is gone waits for another one.
void Agenda::detach(Engine& engine, Call& call) noexcept {
  auto& agenda = static_cast<Agenda&>(*engine.structures_[slot(call).agenda()]);
  call.clear(Call::kRunning);
  call.set(Call::kPending | Call::kInvalid);
  call.end = 0;
  ++agenda.pending_calls_;
  agenda.chain(call);
}

void Agenda::chain(Call& call) noexcept {
  call.edges = std::exchange(detached_, engine_.handle_of(call));
}

void Agenda::adopt_detached() {
  while (detached_ != 0) {
    add_pending(detached_);
    detached_ = std::exchange(engine_.call(detached_).edges, 0);
  }
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

// Puts a call posted during propagation between its neighbours. All that a neighbour which still
// runs has done so far lies before now; what it will do comes between now and the new call.
void Agenda::place(Handle call) {
  Call& c = engine_.call(call);
  const detail::Slot& s = slot(c);
  const auto order = [&](Handle a, Handle b) { return before(engine_.call(a), engine_.call(b)); };
  const Handle after = predecessor(c);
  OrderedCalls& calls = classes_[s.rank];
  const Handle end = after == drain_call_ ? after : engine_.end_of(after);
  engine_.timeline_.insert_after(engine_.linked(end) ? end : engine_.now_, call);
  try {
    calls.insert({s.order, call}, order);
  } catch (...) {
    engine_.timeline_.erase(call);
    throw;
  }
  c.clear(Call::kPending);
  --pending_calls_;
  engine_.enqueue(c);  // it is invalid: it has not run, or not since its drain went
}

// A discarded call leaves the order.
void Agenda::forget(Engine& engine, Call& call) noexcept {
  const detail::Slot& s = slot(call);
  auto& agenda = static_cast<Agenda&>(*engine.structures_[s.agenda()]);
  const auto order = [&](Handle a, Handle b) {
    return agenda.before(engine.call(a), engine.call(b));
  };
  const auto it = agenda.classes_.find(s.rank);
  if (it == agenda.classes_.end()) return;
  try {
    it->second.erase({s.order, engine.handle_of(call)}, order);
  } catch (...) {  // client code failed
    it->second.erase_without_order(engine.handle_of(call));
  }
}

// --- Draining --------------------------------------------------------------------------------

struct Agenda::Drain {
  void operator()(Scope& s, Agenda* agenda) const { agenda->run_pending(s); }
  static constexpr std::string_view kName = "drain";
};

void Agenda::drain(Scope& s) {
  if (draining_) fail_drained_twice(s.self());
  // What was posted last time, and is not by now, is in no drain any more.
  engine_.retract_unrepeated(
      [&](const Edge& edge) { return edge.structure == id_ && edge.kind == kPost; });
  static constexpr Drain kDrain{};
  s.call<kDrain>(this);
}

void Agenda::fail_drained_twice(const Call& caller) const {
  std::string text = Engine::describe(caller) + ": agenda '" + name_ + "' is drained twice";
  if (draining_ && running_ != 0) {
    text += "; of the first drain " + Engine::describe(engine_.call(running_)) + " is running";
  }
  throw UsageError(text);
}

// What an earlier drain ran waits again: that drain failed, if only at its end, or it is gone and
// left its calls ahead.
void Agenda::begin_drain(Scope& s) {
  const Handle self = engine_.handle_of(s.self());
  if (draining_ || (drained_ && drain_call_ != self)) {
    const auto* caller = engine_.current_->outer;
    fail_drained_twice(caller != nullptr ? *caller->call : s.self());
  }
  drained_ = false;
  drain_call_ = self;
  running_ = 0;
  if (s.recall<Edge>(id_, kDrain, [](const Edge&) { return true; }) == nullptr) {
    s.effect<Edge>(id_, kDrain);
  }
  engine_.need_end(*engine_.current_);
  for (auto& [rank, calls] : classes_) {
    while (!calls.empty()) engine_.discard_subtree(calls.first());
  }
  adopt_detached();
}

void Agenda::run_pending(Scope& s) {
  begin_drain(s);
  draining_ = true;
  try {
    while (!pending_.empty()) run_class(pending_.begin()->first);
  } catch (...) {
    draining_ = false;
    throw;
  }
  draining_ = false;
  drained_ = true;
}

// Runs one (bucket, phase, colour): what was posted before in order, merged with what its own
// calls post into it. Comparing calls may throw in the middle of sorting, so a copy is sorted.
void Agenda::run_class(std::uint32_t rank) {
  const auto order = [&](Handle a, Handle b) { return before(engine_.call(a), engine_.call(b)); };
  const auto earlier = [&](const Entry& a, const Entry& b) {
    if (a.order != b.order) return a.order < b.order;
    return a.call != b.call && order(a.call, b.call);
  };
  std::vector<Entry> batch = pending_[rank];
  std::sort(batch.begin(), batch.end(), earlier);
  pending_[rank].clear();
  OrderedCalls late;
  std::size_t i = 0;
  std::size_t taken = 0;  // of what the running call posted
  Entry next;
  try {
    OrderedCalls& done = classes_[rank];
    while (i < batch.size() || !late.empty()) {
      const bool from_late =
          i == batch.size() || (!late.empty() && earlier(late.first_entry(), batch[i]));
      next = from_late ? late.pop_first() : batch[i++];
      taken = 0;
      run_one(next, done);
      next = {};
      auto& posted = pending_[rank];
      for (; taken < posted.size(); ++taken) late.insert(posted[taken], order);
      posted.clear();
    }
  } catch (...) {  // what has not run waits for the drain to run again
    auto& posted = pending_[rank];
    posted.erase(posted.begin(), posted.begin() + static_cast<std::ptrdiff_t>(taken));
    if (next.call != 0 && engine_.call(next.call).has(Call::kPending)) {
      chain(engine_.call(next.call));
    }
    for (; i < batch.size(); ++i) chain(engine_.call(batch[i].call));
    late.for_each([&](const Entry& entry) { chain(engine_.call(entry.call)); });
    throw;
  }
  pending_.erase(rank);
}

void Agenda::run_one(const Entry& entry, OrderedCalls& done) {
  Call& c = engine_.call(entry.call);
  if (slot(c).posts() == 0) {  // posted, then taken back before it could run
    c.clear(Call::kPending);
    return drop_pending(entry.call);
  }
  engine_.timeline_.insert_after(engine_.now_, entry.call);
  try {
    done.append(entry);
  } catch (...) {
    engine_.timeline_.erase(entry.call);
    throw;
  }
  --pending_calls_;
  c.clear(Call::kPending);
  engine_.now_ = running_ = entry.call;
  engine_.execute(entry.call, engine_.current_->limit);
  engine_.settle_child(entry.call);
}

// --- Bookkeeping -----------------------------------------------------------------------------

std::size_t Agenda::bytes() const noexcept {
  std::size_t total = 0;
  for (const auto& [rank, calls] : classes_) total += calls.bytes() + 64;
  for (const auto& [rank, entries] : pending_) total += entries.capacity() * sizeof(Entry) + 64;
  return total;
}

void Agenda::shrink() noexcept {
  std::erase_if(classes_, [](const auto& entry) { return entry.second.empty(); });
}

void Agenda::check_invariants() const {
  const Call* previous = nullptr;
  for (const auto& [rank, calls] : classes_) {
    calls.for_each([&, rank = rank](const Entry& entry) {
      const Call& c = engine_.call(entry.call);
      SAC_INVARIANT(!c.has(Call::kDead | Call::kPending));
      SAC_INVARIANT(slot(c).posts() > 0 || c.queue != 0);  // or it is dying
      SAC_INVARIANT(slot(c).rank == rank && slot(c).order == entry.order);
      SAC_INVARIANT(previous == nullptr ||
                    (before(*previous, c) && engine_.precedes(*previous, c)));
      previous = &c;
    });
  }
}

}  // namespace sac
