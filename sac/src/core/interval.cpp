// The interval of a running call: which calls it reuses, which it makes, which it discards.
#include "sac/engine.hpp"
#include "sac/internal/core.hpp"

namespace sac {

// --- Asking for calls ------------------------------------------------------------------------

Ref<Call> Core::call_child(const Asked& asked) {
  Activation& caller = running();
  const auto stack = reinterpret_cast<std::uintptr_t>(__builtin_frame_address(0));
  if (caller.failed || caller.tail != nullptr || stack < stack_end_) [[unlikely]] {
    fail_call(caller, asked.function);
  }
  need_end(caller);
  Ref<Call> child = find_reusable(asked, false);
  const bool fresh = child == nullptr;
  if (fresh) {
    child = new_call(asked);
    insert_call(child);
    if (caller.old_edges != nullptr) settle_before(caller, at(child));
  } else {
    if (caller.old_edges != nullptr) settle_before(caller, at(child));
    discard_between(now_, child);
    reuse(child);
  }
  // The last call that asked for it depends on its result.
  if (asked.function.has_result) ResultHead::of(at(child)).caller = caller.self;
  if (fresh) {
    if (asked.function.execute == nullptr) return child;
    execute(child, caller.limit);
  }
  if (!appending()) settle_child(child);
  SAC_ENSURES(at(child).validity == Validity::valid);
  return child;
}

Ref<Call> Core::call_tail(const Asked& asked) {
  Activation& caller = running();
  if (caller.failed || caller.tail != nullptr) [[unlikely]]
    fail_call(caller, asked.function);
  need_end(caller);
  caller.tail = find_reusable(asked, true);
  if (caller.tail == nullptr) caller.tail = new_call(asked);
  return caller.tail;
}

// A call whose end stamp is the limit itself can only be the tail of the call that ends there:
// as anything else it would leave no room before that end. Calls are mostly repeated in order: the
// next one is looked at first, which spares a look into the memo table.
Ref<Call> Core::find_ahead(const Asked& asked, bool tail) {
  const Place limit = current_->limit;
  Place next = at(now_).next;
  if (at(next).kind() == TimeNode::Kind::segment) next = at(next).next;
  if (next == limit) return nullptr;
  const bool may_share_end = tail && current_->end == limit;
  const Function* const* const functions = functions_.data();
  const auto fits = [&](const Call& c) {
    return functions[c.function_number] == &asked.function && c.life == Life::placed && !c.posted &&
           (c.end == nullptr || c.end != limit || may_share_end) &&
           asked.function.equal(c, asked.arguments);
  };
  if (at(next).is_call() && fits(at(as<Call>(next)))) return as<Call>(next);
  return memo_.find_between(asked.hash, now_, limit, fits);
}

void Core::reuse(Ref<Call> child) noexcept {
  now_ = end_of(child);
  ++counts_.reused;
  note(Event::Kind::reused, &at(child));
}

// What a call has not repeated before this child is no more: the child must not see it.
void Core::settle_before(Activation& a, const TimeNode& child) noexcept {
  a.cursor = nullptr;
  a.old_edges = retract(*a.call, a.old_edges, &child);
}

void Core::fail_call(const Activation& caller, const Function& function) const {
  if (caller.failed) fail_caught(caller);
  const std::string calls = Engine::describe(*caller.call) + " calls " + std::string(function.name);
  if (caller.tail != nullptr) {
    throw UsageError(calls + " behind its tail call " + Engine::describe(at(caller.tail)) +
                     ", which must be the last");
  }
  throw UsageError(calls + " too deep: calls inside of calls have taken " +
                   std::to_string(settings.stack_limit) +
                   " bytes of the native stack; use tail calls, or divide");
}

// --- Making calls ----------------------------------------------------------------------------

// Room for so many calls, those that leave included, so that invalidating and discarding cannot
// fail.
void Core::make_room(std::size_t calls) {
  queue_.reserve(calls);
  graveyard_.reserve(calls);
  room_ = calls;
}

// A new call waits for its place.
Ref<Call> Core::new_call(const Asked& asked) {
  const Function& function = asked.function;
  if (const std::size_t calls = live_calls_ + graveyard_.size(); calls >= room_) [[unlikely]] {
    make_room(calls + calls / 2 + 64);
  }
  const std::uint16_t number = number_of(function);
  const Ref<Call> fresh(arena_.allocate(function.frame_bytes));
  Call& c = *::new (&at(fresh)) Call;
  c.function_number = number;
  c.life = Life::waiting;
  c.validity = function.execute != nullptr ? Validity::invalid : Validity::valid;
  c.posted = function.posted;
  try {
    asked.construct(&c, asked.arguments, asked.hash);
  } catch (...) {
    arena_.release(fresh, function.frame_bytes);
    throw;
  }
  try {
    if (settings.audit) suspect(fresh, asked);
    appending() ? memo_.insert_soon(fresh, asked.hash) : memo_.insert(fresh, asked.hash);
  } catch (...) {
    if (function.destroy != nullptr) function.destroy(c);
    arena_.release(fresh, function.frame_bytes);
    throw;
  }
  ++live_calls_;
  ++counts_.created;
  note(Event::Kind::created, &c);
  return fresh;
}

void Core::suspect(Ref<Call> fresh, const Asked& asked) {
  const Call& f = at(fresh);
  const Ref<Call> other = memo_.find(asked.hash, [&](const Call& c) {
    return c.function_number == f.function_number && asked.function.equal(c, asked.arguments);
  });
  if (other != nullptr) suspects_.emplace_back(fresh, other);
}

// Throws: std::bad_alloc, and then changes nothing.
void Core::give_place(Ref<Call> call, Place after) {
  timeline_.insert_after(after, call);
  Call& c = at(call);
  try {
    if (memo_.has_crowds() && !c.posted) memo_.placed(call, c.function().hash(c));
  } catch (...) {
    timeline_.erase(call);
    throw;
  }
  c.life = Life::placed;
}

// A new call of the running one gets its place: now.
void Core::insert_call(Ref<Call> call) {
  try {
    give_place(call, now_);
  } catch (...) {
    drop_call(call);
    throw;
  }
  now_ = call;
}

// --- Posted calls ----------------------------------------------------------------------------

void Core::place(Ref<Call> call, Place after) {
  give_place(call, linked(after) ? after : now_);
  enqueue(at(call));
}

void Core::place_now(Ref<Call> call) {
  give_place(call, now_);
  now_ = call;
}

void Core::run_placed(Ref<Call> call) {
  execute(call, running().limit);
  if (!appending()) settle_child(call);
}

// --- Discarding ------------------------------------------------------------------------------

// A call that got no place, or lost it, leaves for good.
void Core::drop_call(Ref<Call> call) noexcept {
  Call& c = at(call);
  if (!c.dead()) note(Event::Kind::discarded, &c);
  c.life = Life::dead;
  graveyard_.push_back(call);
  --live_calls_;
}

void Core::set_waiting(Call& call) noexcept {
  call.life = Life::waiting;
  call.validity = Validity::invalid;
  call.end = nullptr;
}

void Core::free_call(Ref<Call> call) noexcept {
  Call& c = at(call);
  const Function& function = c.function();
  memo_.erase(call, function.hash(c));
  if (function.destroy != nullptr) function.destroy(c);
  if (function.object_offset != 0 && (settings.watching || !settings.names.empty())) {
    forget_names(call.handle(), function.frame_bytes);
  }
  arena_.release(call, function.frame_bytes);
}

void Core::discard_between(Place from, Place to) noexcept {
  for (Place p; (p = at(from).next) != to;) {
    switch (at(p).kind()) {
      case TimeNode::Kind::call:
        discard(as<Call>(p));
        break;
      case TimeNode::Kind::end:
        timeline_.erase(p);
        arena_.release(p);
        break;
      case TimeNode::Kind::segment:
        pass(at(as<Segment>(p)));
        break;
    }
  }
}

// A call that runs has made a child, and that goes on behind a segment of its caller's last
// execution: time has passed it. (Segments of calls that are discarded go with them.)
void Core::pass(const Segment& segment) noexcept {
  Activation* a = current_;
  while (a->self != segment.call) a = a->outer;
  settle_before(*a, at(segment.next));
}

// A posted call that is still asked for goes back to its queue: only what ran it has left.
void Core::discard(Ref<Call> call) noexcept {
  Call& c = at(call);
  const bool asked_for = c.posted && Slot::of(c).posts != nullptr;
  note(asked_for ? Event::Kind::detached : Event::Kind::discarded, &c);
  c.life = asked_for ? Life::waiting : Life::dead;
  if (c.queue != 0) queue_.erase(c);
  retract_all(c, std::exchange(c.edges, nullptr));
  if (memo_.has_crowds() && !c.posted) memo_.leaves(call, c.function().hash(c));
  timeline_.erase(call);
  if (c.posted) {
    static_cast<WorkQueue&>(*structures_[c.work_queue]).left(c, asked_for);
    if (asked_for) return;
  }
  drop_call(call);
  ++counts_.discarded;
}

void Core::discard_subtree(Ref<Call> call) noexcept {
  Call& c = at(call);
  if (c.end != nullptr) {
    retract_all(
        c, std::exchange(c.edges, nullptr));  // with its segments, which lie between its children
    discard_between(call, c.end);
    timeline_.erase(c.end);
    arena_.release(c.end);
  }
  discard(call);
}

// --- Edges -----------------------------------------------------------------------------------

// Takes back the edges from `edges` on, up to the first segment behind `until`, if there is one;
// returns the edge where it stopped. A segment stays until its edges have gone: they lie at it.
Ref<Edge> Core::retract(Call& call, Ref<Edge> edges, const TimeNode* until) noexcept {
  Ref<Segment> segment;
  const auto end_segment = [&] {
    if (segment == nullptr) return;
    timeline_.erase(segment);
    arena_.release(segment);
  };
  while (edges != nullptr) {
    Edge& edge = at(edges);
    if (edge.begins_segment) {
      Segment& next = Segment::of(edge);
      if (until != nullptr && precedes(*until, next)) break;
      end_segment();
      segment = arena_.ref(next);
      edges = edge.next;
      continue;
    }
    edges = edge.next;
    structures_[edge.structure]->retract(call, edge);
    ++counts_.edges_removed;
    arena_.release(arena_.ref(edge), edge.granules * Arena::kGranule);
  }
  end_segment();
  return edges;
}

}  // namespace sac
