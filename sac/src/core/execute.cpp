// Executing a call: its body, its tail calls, settling, and the end of its interval.
#include <exception>

#include "sac/engine.hpp"
#include "sac/internal/core.hpp"
#include "sac/scope.hpp"

namespace sac {

void Core::execute(Ref<Call> call, Place limit) {
  const Place end = at(call).end;
  Activation a{.limit = limit, .end = end, .end_linked = end != nullptr, .outer = current_};
  current_ = &a;
  try {
    for (Ref<Call> link = call; link != nullptr;) {
      run_body(a, link);
      link = has_new_tail(a) ? next_link(a) : nullptr;
    }
    if (a.end != nullptr) close(a);
    if (a.returned != nullptr) tell_caller(a.returned);
  } catch (...) {
    abandon(a);
    throw;
  }
  current_ = a.outer;
}

void Core::run_body(Activation& a, Ref<Call> call) {
  Call& c = at(call);
  a.call = &c;
  a.place = a.self = call;
  a.old_edges = std::exchange(c.edges, nullptr);
  a.cursor = nullptr;
  a.failed_child = nullptr;
  a.link = &c.edges;
  a.failed = false;
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
  settle(a);
}

// What has failed must run again: nobody may go on as if it had not.
void Core::fail_caught(const Activation& a) const {
  const std::string whose = a.failed_child != nullptr
                                ? "what " + Engine::describe(at(a.failed_child)) + " threw"
                                : "what something that it asked of the engine threw";
  throw UsageError(Engine::describe(*a.call) + " has caught " + whose +
                   ": exceptions of calls must pass");
}

// The running call does something behind a child. If it did so last time behind this one, the
// segment goes on, with what has not been repeated yet.
void Core::begin_segment(Activation& a) {
  guarded([&] { enter_segment(a); });
}

void Core::enter_segment(Activation& a) {
  a.cursor = nullptr;
  Place here = at(now_).next;
  const bool known = a.old_edges != nullptr && here == arena_.ref(Segment::of(at(a.old_edges)));
  if (known) {
    a.old_edges = std::exchange(at(a.old_edges).next, nullptr);
  } else {
    const Ref<Segment> fresh = arena_.make<Segment>();
    at(fresh).set_kind(TimeNode::Kind::segment);
    at(fresh).edge.begins_segment = true;
    at(fresh).call = a.self;
    try {
      timeline_.insert_after(now_, fresh);
    } catch (...) {
      arena_.release(fresh);
      throw;
    }
    here = fresh;
  }
  Edge& edge = at(as<Segment>(here)).edge;
  edge.round = a.call->round;
  append_edge(a, arena_.ref(edge));
  a.place = now_ = here;
}

// The call has said all it has to say: what it did not repeat is taken back. It has not seen that
// in this execution, so it is not invalidated by it.
void Core::settle(Activation& a) noexcept {
  if (a.old_edges != nullptr) retract_all(*a.call, std::exchange(a.old_edges, nullptr));
  a.call->life = Life::placed;
  a.call->validity = Validity::valid;
}

// Who depends on the result runs again at the place where it has it: behind everything in `call`'s
// interval.
void Core::tell_caller(Ref<Call> call) noexcept {
  Call& caller = at(ResultHead::of(at(call)).caller);
  if (!caller.running()) note(Event::Kind::returned, &caller);
  ask_again(caller, end_of(call), Validity::invalid, nullptr, nullptr);
}

// The new tail call that follows the link that has run.
Ref<Call> Core::next_link(Activation& a) {
  const Ref<Call> next = std::exchange(a.tail, nullptr);
  insert_call(next);
  at(next).end = a.end;
  return next;
}

// Ends the interval: a reused tail ends it, what was not reused is discarded.
void Core::close(Activation& a) {
  if (a.tail != nullptr) {
    discard_between(now_, a.tail);
    reuse(std::exchange(a.tail, nullptr));
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
  if (has_new_tail(a)) drop_call(std::exchange(a.tail, nullptr));
  settle(a);
  if (a.end != nullptr && !a.end_linked) {
    // Cannot fail in the middle of a group with room; a failure leaves the call a leaf.
    try {
      link_end(a);
      now_ = a.end;
    } catch (...) {
      broken_ = true;
    }
  }
  if (a.returned != nullptr) tell_caller(a.returned);
  invalidate(a.self, nullptr);
  if (a.outer != nullptr) a.outer->failed_child = a.self;
  current_ = a.outer;
}

Place Core::new_end() {
  const Place end = arena_.make<TimeNode>();
  at(end).set_kind(TimeNode::Kind::end);
  return end;
}

void Core::report_progress() {
  progress_at_ += settings.progress_every;
  if (!settings.progress({.executed = counts_.executed, .queued = queue_.size()}))
    throw Cancelled();
}

void Core::note_failure(Event::Kind kind, const Call* call) noexcept {
  if (settings.observer == nullptr) return;
  Event event{.kind = kind, .call = call, .by = running_call()};
  try {
    throw;
  } catch (const std::exception& error) {
    event.message = error.what();
    settings.observer->on(event);
  } catch (...) {
    settings.observer->on(event);
  }
}

}  // namespace sac
