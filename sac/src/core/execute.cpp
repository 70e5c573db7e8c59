// Executing a call: its body, its tail calls, settling, and the end of its interval.
#include <exception>

#include "sac/engine.hpp"
#include "sac/internal/core.hpp"
#include "sac/scope.hpp"

namespace sac {

void Core::execute(Handle call, Handle limit) {
  const Handle end = at<Call>(call)->end;
  Activation a{.limit = limit, .end = end, .end_linked = end != 0, .outer = current_};
  current_ = &a;
  try {
    for (Handle link = call; link != 0;) {
      run_body(a, link);
      link = a.tail_state == Tail::fresh ? next_link(a, link) : 0;
    }
    if (a.end != 0) close(a);
  } catch (...) {
    abandon(a);
    throw;
  }
  current_ = a.outer;
}

void Core::run_body(Activation& a, Handle call) {
  Call& c = *at<Call>(call);
  a.call = &c;
  a.self = call;
  a.old_edges = std::exchange(c.edges, 0);
  a.cursor = a.last_edge = a.failed_child = 0;
  a.hidden = a.failed = false;
  c.round ^= 1;
  c.validity = Validity::valid;
  c.life = Life::running;
  if (counts_.executed >= progress_at_) [[unlikely]]
    report_progress();
  ++counts_.executed;
  note(Event::Kind::executed, &c);
  Scope scope(*this);
  c.function().execute(scope, c);
  if (a.failed) [[unlikely]]
    fail_caught(a);
  if (!queue_.empty()) require_children_unmoved(a);
  settle(a);
}

// What has failed must run again: nobody may go on as if it had not.
void Core::fail_caught(const Activation& a) const {
  const std::string whose = a.failed_child != 0
                                ? "what " + Engine::describe(*at<Call>(a.failed_child)) + " threw"
                                : "what something that it asked of the engine threw";
  throw UsageError(Engine::describe(*a.call) + " has caught " + whose +
                   ": exceptions of calls must pass");
}

// What a call does comes before its children. If it is done behind one that has run and should have
// seen it, a run from scratch and an update would differ.
void Core::require_children_unmoved(const Activation& a) {
  while (!queue_.empty() && next_is_up_to(a.self, now_)) {
    Call& child = *at<Call>(queue_.pop());
    SAC_ENSURES(!unposted(child));
    if (child.invalid() || !unchanged(child)) {
      invalidate(child, nullptr);
      throw UsageError(Engine::describe(*a.call) + " has done something behind its own child " +
                       Engine::describe(child) +
                       ", which should have seen it: what a call does comes before its children");
    }
    child.validity = Validity::valid;
  }
}

// The call has said all it has to say: what it did not repeat is taken back. It has not seen that
// in this execution, so it is not invalidated by it.
void Core::settle(Activation& a) noexcept {
  if (a.old_edges != 0) retract_all(*a.call, std::exchange(a.old_edges, 0));
  a.call->life = Life::placed;
  a.call->validity = Validity::valid;
}

// The new tail call that follows `link`, with its place. What `link` took back when it settled, and
// its children may have seen, is brought up to date before. If a result changes by that, it is the
// link itself that runs again.
//
// Then nothing that it could reuse lies behind its end. A link that is new in the trace had nothing
// to take back, and what it has done behind its children was refused, so that it does not run
// again. Else its call came from the queue: its interval goes up to its end, or, if it was a leaf,
// up to the next stamp.
Handle Core::next_link(Activation& a, Handle link) {
  const bool again = !appending() && settle_link(link);
  const Handle next = std::exchange(a.tail, 0);
  a.tail_state = Tail::none;
  if (again) {
    drop_call(next);
    if (!a.end_linked) link_end(a);  // what it does not repeat lies before
    SAC_ENSURES(a.end == a.limit || at<TimeNode>(a.end)->next == a.limit);
    return now_ = link;
  }
  insert_call(next);
  at<Call>(next)->end = a.end;
  return next;
}

// Runs what is invalid from `link`, which has just run, up to now. Returns whether it is the link
// itself that must run.
bool Core::settle_link(Handle link) {
  while (true) {
    const Handle reached = now_;
    take_deferred(link);
    if (queue_.empty() || !next_is_up_to(link, reached)) return false;
    const Handle h = queue_.pop();
    if (h == link) return true;
    const auto go_back = [&] { now_ = h == reached ? end_of(h) : reached; };
    try {
      run_from_queue(h, link);
    } catch (...) {
      go_back();
      throw;
    }
    go_back();
  }
}

// Ends the interval: a reused tail ends it, what was not reused is discarded.
void Core::close(Activation& a) {
  if (a.tail_state == Tail::reused) {
    discard_between(now_, a.tail);
    reuse(std::exchange(a.tail, 0));
  }
  if (now_ == a.end) return;  // a reused tail may share the end
  if (a.end_linked) {
    discard_between(now_, a.end);
  } else {
    link_end(a);
  }
  now_ = a.end;
}

void Core::link_end(Activation& a) {
  timeline_.insert_after(now_, a.end);
  a.end_linked = true;
}

// Client code threw: the call stays, as one that must run again.
void Core::abandon(Activation& a) noexcept {
  note_failure(Event::Kind::failed, a.call);
  if (a.tail_state == Tail::fresh) drop_call(std::exchange(a.tail, 0));
  settle(a);
  if (a.end != 0 && !a.end_linked) {
    // Cannot fail in the middle of a group with room; a failure leaves the call a leaf.
    try {
      link_end(a);
      now_ = a.end;
    } catch (...) {
      broken_ = true;
    }
  }
  invalidate(*a.call, nullptr);
  if (a.outer != nullptr) a.outer->failed_child = a.self;
  current_ = a.outer;
}

// A call gets its end stamp with its first child. It is linked when the call closes, because the
// calls that it may still reuse lie between.
void Core::need_end(Activation& a) {
  if (a.end == 0) {
    a.end = arena_.allocate(sizeof(TimeNode));
    ::new (at<void>(a.end)) TimeNode;
    at<TimeNode>(a.end)->mark();
  }
  a.call->end = a.end;
}

void Core::report_progress() {
  progress_at_ += progress_every_;
  stopped_ = true;  // unless it returns true
  if (!progress_({.executed = counts_.executed, .queued = queue_.size()})) throw Cancelled();
  stopped_ = false;
}

void Core::note_failure(Event::Kind kind, const Call* call) noexcept {
  if (observer_ == nullptr) return;
  Event event{.kind = kind, .call = call, .by = running_call()};
  try {
    throw;
  } catch (const std::exception& error) {
    event.message = error.what();
    observer_->on(event);
  } catch (...) {
    observer_->on(event);
  }
}

}  // namespace sac
