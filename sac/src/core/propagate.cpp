// The queue: which call runs next, and whether it must.
#include <algorithm>
#include <new>

#include "sac/engine.hpp"
#include "sac/internal/core.hpp"

namespace sac {

void Core::ask_again(Call& call, Validity validity, const Edge* seen, Handle source) noexcept {
  if (call.validity < validity) call.validity = validity;
  if (call.life != Life::placed) return;
  if (observer_ != nullptr) [[unlikely]] {
    observer_->on({.kind = Event::Kind::invalidated,
                   .call = &call,
                   .source = source,
                   .seen = seen,
                   .by = running_call()});
  }
  enqueue(call);
}

void Core::result_changed(Handle caller) noexcept {
  Call& c = *at<Call>(caller);
  if (!c.running()) note(Event::Kind::returned, &c);
  invalidate(c, nullptr);
}

// Runs what is invalid in `call`'s interval; 0: everywhere.
void Core::propagate_within(Handle call) {
  if (call == 0) queue_.sort();
  while (true) {
    take_deferred(call);
    if (queue_.empty() || (call != 0 && !next_is_up_to(call, end_of(call)))) return;
    run_from_queue(queue_.pop(), call);
  }
}

// The queue is used by the running call for what lies in its interval: what is before must not
// stand in its way.
void Core::defer(Call& call) noexcept {
  if (!call.invalid()) deferred_.push_back(arena_.handle_of(&call));
  call.validity = Validity::invalid;
}

// Puts into the queue what waits and lies in `call`'s interval; 0: everywhere.
void Core::take_deferred(Handle call) noexcept {
  if (deferred_.empty()) [[likely]]
    return;
  std::erase_if(deferred_, [&](Handle h) {
    Call& c = *at<Call>(h);
    if (c.life == Life::placed && call != 0 && h != call &&
        !lies_between(*at<TimeNode>(call), c, end_of(call))) {
      return false;
    }
    if (c.life == Life::placed) enqueue(c);
    return true;
  });
}

// Whether the earliest call that waits is `call` or behind it, up to `end`.
bool Core::next_is_up_to(Handle call, Handle end) const noexcept {
  const Call& first = *at<Call>(queue_.front());
  return queue_.front() == call ||
         (precedes(*at<Call>(call), first) && !precedes(*at<TimeNode>(end), first));
}

// What fails may have been asked for too early: a call around it, which has acted behind some of
// its children, waits to run again, and refuses what it did behind this one. So it is excused, but
// not for ever: a call around it may wait again by what it does.
void Core::run_from_queue(Handle call, Handle within) {
  constexpr std::uint8_t kMost = 16;
  try {
    run_from_queue(*at<Call>(call));
  } catch (const std::bad_alloc&) {
    throw;
  } catch (...) {
    if (stopped_ || excused_ == kMost || !around_waits(call, within)) throw;
    ++excused_;
  }
}

// Whether a call around `call`, in the interval of `within`, waits to run again; 0: anywhere.
bool Core::around_waits(Handle call, Handle within) const noexcept {
  return std::any_of(deferred_.begin(), deferred_.end(), [&](Handle h) {
    const Call& outer = *at<Call>(h);
    return outer.life == Life::placed && encloses(outer, *at<Call>(call)) &&
           (within == 0 || h == within ||
            lies_between(*at<TimeNode>(within), outer, end_of(within)));
  });
}

void Core::run_from_queue(Call& c) {
  const Handle call = arena_.handle_of(&c);
  if (unposted(c)) {
    note(Event::Kind::dying, &c);
    return discard_subtree(call);
  }
  now_ = call;
  if (!c.invalid() && unchanged(c)) {
    note(Event::Kind::confirmed, &c);
    ++counts_.confirmed;
    c.validity = Validity::valid;
    return;
  }
  execute(call, c.end != 0 ? c.end : c.next);
}

// Client code compares, and may fail.
bool Core::unchanged(Call& call) {
  try {
    for (Handle e = call.edges; e != 0; e = at<Edge>(e)->next) {
      Edge& edge = *at<Edge>(e);
      if (!structures_[edge.structure]->unchanged(call, edge)) return false;
    }
    return true;
  } catch (...) {
    note_failure(Event::Kind::failed, &call);
    if (current_ != nullptr) current_->failed_child = arena_.handle_of(&call);
    invalidate(call, nullptr);
    throw;
  }
}

// Runs what is invalid in a child that was reused, or in what the child reused: whatever precedes
// the running call is settled.
void Core::settle_child(Handle child) {
  if (queue_.empty() && deferred_.empty()) return;
  try {
    propagate_within(child);
  } catch (...) {
    now_ = end_of(child);
    throw;
  }
  now_ = end_of(child);
}

}  // namespace sac
