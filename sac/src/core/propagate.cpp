// The queue: which call runs next, and whether it must.
#include "sac/engine.hpp"
#include "sac/internal/core.hpp"

namespace sac {

void Core::ask_again(Call& call, Handle place, Validity validity, const Edge* seen,
                     Handle source) noexcept {
  if (call.validity < validity) call.validity = validity;
  if (call.life != Life::placed) return;
  if (settings.observer != nullptr) [[unlikely]] {
    settings.observer->on({.kind = Event::Kind::invalidated,
                           .call = &call,
                           .source = source,
                           .seen = seen,
                           .by = running_call()});
  }
  enqueue(call, place);
}

// A call waits at the earliest place where it must be asked.
void Core::enqueue(Call& call, Handle place) noexcept {
  if (call.queue != 0) {
    const Handle known = queue_.place_of(call);
    if (known == place || precedes(*at<TimeNode>(known), *at<TimeNode>(place))) return;
    queue_.erase(call);
  }
  queue_.push({arena_.handle_of(&call), place});
}

// Runs what is invalid in `call`'s interval; 0: everywhere.
void Core::propagate_within(Handle call) {
  if (call == 0) queue_.sort();
  while (!queue_.empty() && (call == 0 || next_is_within(call))) run_from_queue(queue_.pop());
}

// Whether the earliest place in the queue lies in `call`'s interval. Who depends on the call's
// result waits at its last stamp, and lies outside.
bool Core::next_is_within(Handle call) const noexcept {
  const PropagationQueue::Entry first = queue_.front();
  if (first.place == call) return first.call == call;
  return precedes(*at<Call>(call), *at<TimeNode>(first.place)) &&
         precedes(*at<TimeNode>(first.place), *at<TimeNode>(end_of(call)));
}

void Core::run_from_queue(PropagationQueue::Entry entry) {
  Call& c = *at<Call>(entry.call);
  if (unposted(c)) {
    note(Event::Kind::dying, &c);
    return discard_subtree(entry.call);
  }
  now_ = entry.call;
  if (!c.invalid() && confirmed(c, entry.place)) return;
  execute(entry.call, c.end != 0 ? c.end : c.next);
}

// Whether a call in doubt has seen, from `place` on, what it would see now. A later segment may lie
// behind others that wait: then the call waits at that one.
bool Core::confirmed(Call& call, Handle place) {
  const Handle self = arena_.handle_of(&call);
  Handle here = self;
  for (Handle e = call.edges; e != 0; e = at<Edge>(e)->next) {
    Edge& edge = *at<Edge>(e);
    if (edge.begins_segment) {
      here = arena_.handle_of(&Segment::of(edge));
      if (!queue_.empty() && precedes(*at<TimeNode>(place), *at<TimeNode>(here)) &&
          precedes(*at<TimeNode>(queue_.front().place), *at<TimeNode>(here))) {
        queue_.push({self, here});
        return true;
      }
    } else if (!unchanged(call, edge)) {
      return false;
    }
  }
  note(Event::Kind::confirmed, &call);
  ++counts_.confirmed;
  call.validity = Validity::valid;
  return true;
}

// Client code compares, and may fail.
bool Core::unchanged(Call& call, Edge& edge) {
  try {
    return structures_[edge.structure]->unchanged(call, edge);
  } catch (...) {
    note_failure(Event::Kind::failed, &call);
    const Handle self = arena_.handle_of(&call);
    if (current_ != nullptr) current_->failed_child = self;
    invalidate(self, nullptr);
    throw;
  }
}

// Runs what is invalid in a child that was reused, or in what the child reused: whatever precedes
// the running call is settled.
void Core::settle_child(Handle child) {
  if (queue_.empty()) return;
  try {
    propagate_within(child);
  } catch (...) {
    now_ = end_of(child);
    throw;
  }
  now_ = end_of(child);
}

}  // namespace sac
