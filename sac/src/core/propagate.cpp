// The queue: which call runs next, and whether it must.
#include "sac/engine.hpp"
#include "sac/internal/core.hpp"

namespace sac {

void Core::ask_again(Call& call, Place place, Validity validity, const Edge* seen,
                     ModRef source) noexcept {
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
void Core::enqueue(Call& call, Place place) noexcept {
  if (call.queue != 0) {
    const Place known = queue_.place_of(call);
    if (known == place || precedes(at(known), at(place))) return;
    queue_.erase(call);
  }
  queue_.push({arena_.ref(call), place});
}

// Runs what is invalid in `call`'s interval; null: everywhere.
void Core::propagate_within(Ref<Call> call) {
  if (call == nullptr) queue_.sort();
  while (!queue_.empty() && (call == nullptr || next_is_within(call))) run_from_queue(queue_.pop());
}

// Whether the earliest place in the queue lies in `call`'s interval. Who depends on the call's
// result waits at its last stamp, and lies outside.
bool Core::next_is_within(Ref<Call> call) const noexcept {
  const PropagationQueue::Entry first = queue_.front();
  if (first.place == call) return first.call == call;
  return precedes(at(call), at(first.place)) && precedes(at(first.place), at(end_of(call)));
}

void Core::run_from_queue(PropagationQueue::Entry entry) {
  Call& c = at(entry.call);
  if (unposted(c)) {
    note(Event::Kind::dying, &c);
    return discard_subtree(entry.call);
  }
  now_ = entry.call;
  if (!c.invalid() && confirmed(c, entry.place)) return;
  execute(entry.call, c.end != nullptr ? c.end : c.next);
}

// Whether a call in doubt has seen, from `place` on, what it would see now. A later segment may lie
// behind others that wait: then the call waits at that one.
bool Core::confirmed(Call& call, Place place) {
  const Ref<Call> self = arena_.ref(call);
  Place here = self;
  for (Ref<Edge> e = call.edges; e != nullptr; e = at(e).next) {
    Edge& edge = at(e);
    if (edge.begins_segment) {
      here = arena_.ref(Segment::of(edge));
      if (!queue_.empty() && precedes(at(place), at(here)) &&
          precedes(at(queue_.front().place), at(here))) {
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
    const Ref<Call> self = arena_.ref(call);
    if (current_ != nullptr) current_->failed_child = self;
    invalidate(self, nullptr);
    throw;
  }
}

// Runs what is invalid in a child that was reused, or in what the child reused: whatever precedes
// the running call is settled.
void Core::settle_child(Ref<Call> child) {
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
