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
// Requires: the agenda is drained.
Place Agenda::stamp_before(const Call& call) const {
  const Entry* neighbour = calls_.predecessor(entry_of(call), order());
  return neighbour != nullptr ? core_.end_of(neighbour->call) : Place(drain_call_);
}

// Puts a call posted during propagation between its neighbours. All that a neighbour which still
// runs has done so far lies before now; what it will do comes between now and the new call.
void Agenda::place(Ref<Call> call) {
  Call& c = core_.at(call);
  const Place after = stamp_before(c);
  put(entry_of(c));
  unchain(c);
  try {
    core_.place(call, after);
  } catch (...) {
    chain_unposted(c);
    take_from_index(c);
    throw;
  }
  --waiting_calls_;
}

void Agenda::put(const Entry& entry) {
  calls_.insert(entry, order());
  ahead_ = {};
}

void Agenda::take_from_index(const Call& call) noexcept {
  ahead_ = {};
  try {
    calls_.erase(entry_of(call), order());
  } catch (...) {  // client code failed
    calls_.erase_if([&](const Entry& entry) { return entry.call == engine_.handle_of(call); });
  }
}

// A call whose drain is gone waits for another one, if it is still posted.
void Agenda::left(Call& call, bool asked_for) noexcept {
  if (!asked_for) return take_from_index(call);
  core_.set_waiting(call);
  ++waiting_calls_;
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
  if (state_ == State::draining && running_ != nullptr) {
    text += "; of the first drain " + Engine::describe(core_.at(running_)) + " is running";
  }
  throw UsageError(text);
}

// What an earlier drain ran waits again: that drain failed, if only at its end; or it is gone and
// left its calls ahead; or it lies ahead, and is refused if it is still asked for.
void Agenda::begin_drain(Scope& s) {
  const Ref<Call> self = engine_.handle_of(s.self());
  if (drain_call_ != nullptr && drain_call_ != self) {
    Call& other = core_.at(drain_call_);
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
  running_ = nullptr;
  ahead_ = {};
  core_.need_end();
  discard_placed();
  if (!engine_.appending()) set_later_posts_aside(s.self());
}

void Agenda::discard_placed() {
  std::vector<Ref<Call>> placed;
  calls_.for_each([&](const Entry& entry) {
    if (!core_.at(entry.call).waiting()) placed.push_back(entry.call);
  });
  for (const Ref<Call> call : placed) core_.discard_subtree(call);
}

template <class Visit>
void Agenda::for_each_waiting(Visit&& visit) const {
  const auto visit_waiting = [&](const Entry& entry) {
    const Call& call = core_.at(entry.call);
    if (call.waiting()) visit(call);
  };
  calls_.for_each(visit_waiting);
  for (const auto& [rank, entries] : classes_) {
    std::for_each(entries.begin(), entries.end(), visit_waiting);
  }
}

// A post counts for a drain if it comes before. Who posts later, in a trace of last time, will be
// discarded, or must be refused: it runs again.
void Agenda::set_later_posts_aside(const Call& drain) {
  for_each_waiting([&](const Call& call) {
    Posts::for_each(core_.arena(), Slot::of(call).posts, [&](PostEdge& post) {
      if (post.place == nullptr || !engine_.precedes(drain, engine_.time(post.place))) return;
      engine_.invalidate(post.place);
      drop_post(post);
    });
  });
}

void Agenda::run_waiting(Scope& s) {
  begin_drain(s);
  state_ = State::draining;
  try {
    while (find_next()) run_next();
  } catch (...) {  // what has not run waits for the drain to run again
    state_ = State::open;
    throw;
  }
  state_ = State::drained;
}

// Finds out which call runs next: the first of ahead_. Returns false if none is left.
bool Agenda::find_next() {
  while (true) {
    if (ahead_.empty()) ahead_ = entries_ahead();
    if (classes_.empty()) return !ahead_.empty();
    if (!ahead_.empty() && ahead_.front().rank < classes_.begin()->first) return true;
    sort_first_class();
  }
}

std::span<const Agenda::Entry> Agenda::entries_ahead() const {
  if (calls_.empty() || calls_.last().call == running_) return {};
  return running_ != nullptr ? calls_.behind(entry_of(core_.at(running_)), order())
                             : calls_.front();
}

// Puts the calls of the first class into calls_, or, if that fails, none.
void Agenda::sort_first_class() {
  std::vector<Entry> sorted = classes_.begin()->second;  // sorting may fail half way
  if (!std::is_sorted(sorted.begin(), sorted.end(), order())) {
    std::sort(sorted.begin(), sorted.end(), order());
  }
  const bool at_end = ahead_.empty();
  std::size_t done = 0;
  try {
    for (; done < sorted.size(); ++done) at_end ? calls_.append(sorted[done]) : put(sorted[done]);
  } catch (...) {
    while (done > 0) take_from_index(core_.at(sorted[--done].call));
    throw;
  }
  classes_.erase(classes_.begin());
  if (at_end && !sorted.empty()) ahead_ = calls_.back(sorted.size());
}

void Agenda::run_next() {
  const Ref<Call> next = ahead_.front().call;
  Call& call = core_.at(next);
  if (Slot::of(call).posts == nullptr) {  // posted, then taken back
    take_from_index(call);
    return drop_waiting(next);
  }
  core_.place_now(next);
  ahead_ = ahead_.subspan(1);
  --waiting_calls_;
  running_ = next;
  core_.run_placed(next);
}

// --- Bookkeeping -----------------------------------------------------------------------------

std::size_t Agenda::bytes() const noexcept {
  std::size_t total = calls_.bytes();
  for (const auto& [rank, entries] : classes_) total += entries.capacity() * sizeof(Entry) + 64;
  return total;
}

void Agenda::check_invariants() const {
  const Call* previous = nullptr;
  calls_.for_each([&](const Entry& entry) {
    const Call& c = core_.at(entry.call);
    SAC_INVARIANT(Slot::of(c).rank == entry.rank && Slot::of(c).order == entry.order);
    SAC_INVARIANT(previous == nullptr || before(*previous, c));
    if (!c.waiting()) {
      SAC_INVARIANT(c.life == Life::placed);
      SAC_INVARIANT(Slot::of(c).posts != nullptr || c.queue != 0);  // or it is dying
      SAC_INVARIANT(previous == nullptr || engine_.precedes(*previous, c));
    }
    previous = &c;
  });
  std::uint64_t waiting = 0, unposted = 0, chained = 0;
  for_each_waiting([&](const Call& c) {
    ++waiting;
    if (Slot::of(c).posts == nullptr) ++unposted;
  });
  for (Place p = unposted_; p != nullptr; p = core_.at(p).next) ++chained;
  SAC_INVARIANT(waiting == waiting_calls_ && unposted == chained);
  SAC_INVARIANT(waiting == 0 || state_ != State::drained);
}

}  // namespace sac
