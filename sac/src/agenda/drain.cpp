// Placing posted calls, and draining.
#include <algorithm>
#include <cstring>

#include "sac/agenda.hpp"

namespace sac {

std::strong_ordering order_of_functions(const Function& a, const Function& b) {
  if (a.name != b.name) return a.name <=> b.name;
  const Identity x = a.identity();
  const Identity y = b.identity();
  const int by_type = std::strcmp(x.type, y.type);
  return (by_type != 0 ? by_type : std::strcmp(x.file, y.file)) <=> 0;
}

bool Agenda::before(const Call& a, const Call& b) const {
  const Slot& x = Slot::of(a);
  const Slot& y = Slot::of(b);
  if (x.rank != y.rank) return x.rank < y.rank;
  if (x.order != y.order) return x.order < y.order;
  if (a.function_number != b.function_number) {
    return order_of_functions(a.function(), b.function()) < 0;
  }
  return a.function().compare(a, b) < 0;
}

// --- Placing ---------------------------------------------------------------------------------

// The time stamp behind which a call that waits has its place: the end of the one before it.
Handle Agenda::stamp_before(const Call& call) const {
  const Entry* neighbour = placed_.predecessor(entry_of(call), order());
  return neighbour != nullptr ? core_.end_of(neighbour->call) : drain_call_;
}

// Puts a call posted during propagation between its neighbours. All that a neighbour which still
// runs has done so far lies before now; what it will do comes between now and the new call.
void Agenda::place(Handle call) {
  const Call& c = *core_.at<Call>(call);
  const Handle after = stamp_before(c);
  placed_.insert(entry_of(c), order());
  try {
    core_.place(call, after);
  } catch (...) {
    placed_.erase_if([&](const Entry& entry) { return entry.call == call; });
    throw;
  }
  --waiting_calls_;
}

void Agenda::take_from_index(const Call& call) noexcept {
  try {
    placed_.erase(entry_of(call), order());
  } catch (...) {  // client code failed
    placed_.erase_if([&](const Entry& entry) { return entry.call == engine_.handle_of(call); });
  }
}

// A call whose drain is gone waits for another one.
void Agenda::left(Call& call, bool asked_for) noexcept {
  take_from_index(call);
  if (!asked_for) return;
  core_.set_waiting(call);
  ++waiting_calls_;
  chain(call);
}

void Agenda::chain(Call& call) noexcept {
  call.next_waiting = std::exchange(chained_, engine_.handle_of(call));
}

void Agenda::adopt_chained() {
  while (chained_ != 0) {
    const Handle next = core_.at<Call>(chained_)->next_waiting;
    add_waiting(chained_);
    chained_ = next;
  }
}

// --- Draining --------------------------------------------------------------------------------

struct Agenda::Drain {
  void operator()(Scope& s, Agenda* agenda) const { agenda->run_waiting(s); }
  static constexpr std::string_view kName = "drain";
};

void Agenda::drain(Scope& s) {
  static constexpr Drain kDrain{};
  core_.guarded([&] {
    if (state_ == State::draining) fail_drained_twice(s.self());
    s.call<kDrain>(this);
  });
}

void Agenda::fail_drained_twice(const Call& caller) const {
  std::string text = Engine::describe(caller) + ": agenda '" + name_ + "' is drained twice";
  if (state_ == State::draining && running_ != 0) {
    text += "; of the first drain " + Engine::describe(*core_.at<Call>(running_)) + " is running";
  }
  throw UsageError(text);
}

// What an earlier drain ran waits again: that drain failed, if only at its end; or it is gone and
// left its calls ahead; or it lies ahead, and is refused if it is still asked for.
void Agenda::begin_drain(Scope& s) {
  const Handle self = engine_.handle_of(s.self());
  if (drain_call_ != 0 && drain_call_ != self) {
    Call& other = *core_.at<Call>(drain_call_);
    if (state_ != State::open && !engine_.lies_ahead(other)) {
      fail_drained_twice(core_.parent_of(s.self()));
    }
    engine_.invalidate(drain_call_);
  }
  // The edge comes first: a drain without it would not be taken back.
  if (s.recall<Edge>(id_, kDrain, [](const Edge&) { return true; }) == nullptr) {
    s.effect<Edge>(id_, kDrain);
  }
  state_ = State::open;
  drain_call_ = self;
  running_ = 0;
  core_.need_end();
  while (!placed_.empty()) core_.discard_subtree(placed_.first().call);
  adopt_chained();
  if (!engine_.appending()) set_later_posts_aside(s.self());
}

// A post counts for a drain if it comes before. Who posts later, in a trace of last time, will be
// discarded, or must be refused: it runs again.
void Agenda::set_later_posts_aside(const Call& drain) {
  for (const auto& [rank, entries] : waiting_) {
    for (const Entry& entry : entries) {
      for (Handle h = Slot::of(*core_.at<Call>(entry.call)).posts; h != 0;) {
        PostEdge& post = post_at(h);
        h = post.next_post;
        if (post.place == 0 || !engine_.precedes(drain, engine_.time(post.place))) continue;
        engine_.invalidate(post.place);
        drop_post(post);
      }
    }
  }
}

void Agenda::run_waiting(Scope& s) {
  begin_drain(s);
  state_ = State::draining;
  try {
    while (!waiting_.empty()) {
      due_.begin(waiting_.begin()->second, order());
      due_.for_each([&](const Entry& entry) { core_.at<Call>(entry.call)->edges = 0; });
      waiting_.erase(waiting_.begin());
      while (!due_.empty()) run_first();
    }
  } catch (...) {  // what has not run waits for the drain to run again
    due_.for_each([&](const Entry& entry) { chain(*core_.at<Call>(entry.call)); });
    due_.clear();
    state_ = State::open;
    throw;
  }
  state_ = State::drained;
}

void Agenda::run_first() {
  const Entry& first = due_.first(order());
  const Entry entry = first;
  const bool posted = Slot::of(*core_.at<Call>(entry.call)).posts != 0;
  if (posted) {
    placed_.append(entry);
    try {
      core_.place_now(entry.call);
    } catch (...) {
      placed_.erase_if([&](const Entry& other) { return other.call == entry.call; });
      throw;
    }
  }
  due_.drop(first);
  if (!posted) return drop_waiting(entry.call);  // posted, then taken back
  --waiting_calls_;
  running_ = entry.call;
  core_.run_placed(entry.call);
}

// --- Bookkeeping -----------------------------------------------------------------------------

std::size_t Agenda::bytes() const noexcept {
  std::size_t total = placed_.bytes() + unposted_.capacity() * sizeof(Handle);
  for (const auto& [rank, entries] : waiting_) total += entries.capacity() * sizeof(Entry) + 64;
  return total;
}

void Agenda::check_invariants() const {
  const Call* previous = nullptr;
  placed_.for_each([&](const Entry& entry) {
    const Call& c = *core_.at<Call>(entry.call);
    SAC_INVARIANT(c.life == Life::placed);
    SAC_INVARIANT(Slot::of(c).posts != 0 || c.queue != 0);  // or it is dying
    SAC_INVARIANT(Slot::of(c).rank == entry.rank && Slot::of(c).order == entry.order);
    SAC_INVARIANT(previous == nullptr || (before(*previous, c) && engine_.precedes(*previous, c)));
    previous = &c;
  });
}

}  // namespace sac
