// Versions, readers and writers of modifiables.
#include "sac/mod.hpp"

namespace sac {

using detail::ReadEdge;
using detail::Version;
using detail::WriteEdge;

// --- Reading ---------------------------------------------------------------------------------

bool ModStructure::sees(const Call& call, const Version& version) const {
  if (!version.written) return false;
  if (version.outside) return true;
  const Call& writer = *engine_.at<Call>(version.writer);
  if (&writer == &call) return !unconfirmed(version);
  return engine_.precedes(writer, call);
}

// Whether the running call wrote `version` last time and has not yet repeated it.
bool ModStructure::unconfirmed(const Version& version) const noexcept {
  const Handle target = engine_.arena().handle_of(&version);
  for (Handle e = engine_.current_->old_edges; e != 0; e = engine_.at<Edge>(e)->next) {
    const Edge& edge = *engine_.at<Edge>(e);
    if (edge.structure != id_ || edge.kind != kWrite) continue;
    if (static_cast<const WriteEdge&>(edge).version == target) return true;
  }
  return false;
}

Version& ModStructure::observe(Scope& scope, Handle head) {
  Call& call = scope.self();
  Handle seen = 0;
  for (Handle v = head; v != 0; v = at(v)->next) {
    if (sees(call, *at(v))) {
      seen = v;
    } else if (at(v)->written && at(v)->writer != engine_.handle_of(call)) {
      require_ahead(call, *at(v), head);
      break;
    }
  }
  if (seen == 0) fail_unwritten(call, head);
  const auto same = [&](const ReadEdge& edge) { return edge.version == seen; };
  if (scope.recall<ReadEdge>(id_, kRead, same) == nullptr) {
    auto& edge = scope.observe<ReadEdge>(id_, kRead);
    edge.call = engine_.handle_of(call);
    link_reader(edge, *at(seen));
  }
  return *at(seen);
}

// The effects of own children lie later in time than their parent: it cannot read them.
void ModStructure::require_ahead(const Call& reader, const Version& version, Handle head) const {
  const Call& writer = *engine_.at<Call>(version.writer);
  if (engine_.lies_ahead(writer)) return;
  throw UsageError(Engine::describe(reader) + " reads modifiable @" + std::to_string(head) +
                   " after its own child " + Engine::describe(writer) + " has written it");
}

void ModStructure::fail_unwritten(const Call& reader, Handle head) const {
  std::string text = Engine::describe(reader) + " reads modifiable @" + std::to_string(head);
  for (Handle v = head; v != 0; v = at(v)->next) {
    if (!at(v)->written || at(v)->outside) continue;
    throw UsageError(text + ", which is written only by the later call " +
                     Engine::describe(*engine_.at<Call>(at(v)->writer)));
  }
  throw UsageError(text + ", which nobody has written");
}

Version& ModStructure::last(Handle head) const {
  Handle found = 0;
  for (Handle v = head; v != 0; v = at(v)->next) {
    if (at(v)->written) found = v;
  }
  if (found == 0) {
    throw UsageError("modifiable @" + std::to_string(head) +
                     " has no value: nobody has written it");
  }
  return *at(found);
}

// --- Writing ---------------------------------------------------------------------------------

ModStructure::Slot ModStructure::own_version(Scope& scope, Handle head,
                                             const detail::ValueOps& ops) {
  Call& call = scope.self();
  const Handle self = engine_.handle_of(call);
  if (at(head)->outside) {
    throw UsageError(Engine::describe(call) + " writes modifiable @" + std::to_string(head) +
                     ", which is an input");
  }
  for (Handle v = head; v != 0; v = at(v)->next) {
    if (!at(v)->written || at(v)->writer != self) continue;
    const auto same = [&](const WriteEdge& edge) { return edge.version == v; };
    scope.recall<WriteEdge>(id_, kWrite, same);  // null: written already in this execution
    return {at(v), false};
  }
  if (at(head)->written && !engine_.precedes(*engine_.at<Call>(at(head)->writer), call)) {
    vacate(head, ops);
  }
  Handle place = head;  // the last version before the call, or the vacant head
  for (Handle v = at(head)->next; v != 0; v = at(v)->next) {
    if (!engine_.precedes(*engine_.at<Call>(at(v)->writer), call)) break;
    place = v;
  }
  Handle fresh = head;
  if (at(head)->written || place != head) {
    fresh = engine_.arena().allocate(ops.bytes);
    ::new (static_cast<void*>(at(fresh))) Version();
  }
  WriteEdge* edge = nullptr;
  try {
    edge = &scope.effect<WriteEdge>(id_, kWrite);
  } catch (...) {
    if (fresh != head) engine_.arena().release(fresh, ops.bytes);
    throw;
  }
  edge->head = head;
  edge->version = fresh;
  edge->ops = &ops;
  at(fresh)->writer = self;
  if (fresh != head) at(fresh)->next = std::exchange(at(place)->next, fresh);
  return {at(fresh), true};
}

// Moves the version in place to the chain behind it, to make way for an earlier one.
void ModStructure::vacate(Handle head, const detail::ValueOps& ops) {
  const Handle moved = engine_.arena().allocate(ops.bytes);
  ::new (static_cast<void*>(at(moved))) Version();
  Version& from = *at(head);
  Version& to = *at(moved);
  try {
    ops.move(from, to);
  } catch (...) {
    engine_.arena().release(moved, ops.bytes);
    throw;
  }
  to.writer = std::exchange(from.writer, 0);
  to.written = std::exchange(from.written, false);
  to.next = std::exchange(from.next, moved);
  move_readers(from, to, nullptr, false);
  for (Handle e = engine_.at<Call>(to.writer)->edges; e != 0; e = engine_.at<Edge>(e)->next) {
    auto& edge = *engine_.at<Edge>(e);
    if (edge.structure != id_ || edge.kind != kWrite) continue;
    auto& write = static_cast<WriteEdge&>(edge);
    if (write.version == head) write.version = moved;
  }
}

Version* ModStructure::before(Handle head, const Version& version) const noexcept {
  Version* found = nullptr;
  for (Handle v = head; at(v) != &version; v = at(v)->next) {
    if (at(v)->written) found = at(v);
  }
  return found;
}

void ModStructure::changed(Scope& scope, Version& version) {
  require_unread(scope, version);
  invalidate_readers(version);
}

void ModStructure::appeared(Scope& scope, Handle head, Version& version, bool same_as_before) {
  Version* previous = before(head, version);
  if (previous == nullptr) return;
  const Call& self = scope.self();
  for (Handle r = previous->readers; r != 0; r = reader(r)->next_reader) {
    const Call& call = *engine_.at<Call>(reader(r)->call);
    if (&call != &self && engine_.precedes(self, call) && !engine_.lies_ahead(call) &&
        !same_as_before) {
      throw UsageError(Engine::describe(self) + " writes modifiable @" + std::to_string(head) +
                       " after its own child " + Engine::describe(call) + " has read it");
    }
  }
  move_readers(*previous, version, &self, !same_as_before);
}

// A value read by the writer's own children cannot change under them.
void ModStructure::require_unread(Scope& scope, const Version& version) const {
  for (Handle r = version.readers; r != 0; r = reader(r)->next_reader) {
    const Call& call = *engine_.at<Call>(reader(r)->call);
    if (&call == &scope.self() || engine_.lies_ahead(call)) continue;
    throw UsageError(Engine::describe(scope.self()) + " changes what its own child " +
                     Engine::describe(call) + " has read");
  }
}

void ModStructure::invalidate_readers(Version& version) noexcept {
  for (Handle r = version.readers; r != 0; r = reader(r)->next_reader) {
    engine_.invalidate(*engine_.at<Call>(reader(r)->call));
  }
}

void ModStructure::link_reader(ReadEdge& edge, Version& version) noexcept {
  const Handle self = engine_.arena().handle_of(&edge);
  edge.version = engine_.arena().handle_of(&version);
  edge.prev = 0;
  edge.next_reader = version.readers;
  if (version.readers != 0) reader(version.readers)->prev = self;
  version.readers = self;
}

void ModStructure::unlink_reader(ReadEdge& edge) noexcept {
  if (edge.next_reader != 0) reader(edge.next_reader)->prev = edge.prev;
  (edge.prev != 0 ? reader(edge.prev)->next_reader : at(edge.version)->readers) = edge.next_reader;
}

void ModStructure::move_readers(Version& from, Version& to, const Call* later_than,
                                bool invalidate) noexcept {
  for (Handle r = from.readers; r != 0;) {
    ReadEdge& edge = *reader(r);
    r = edge.next_reader;
    Call& call = *engine_.at<Call>(edge.call);
    if (later_than != nullptr && !engine_.precedes(*later_than, call)) continue;
    unlink_reader(edge);
    link_reader(edge, to);
    if (invalidate) engine_.invalidate(call);
  }
}

// --- Taking back -----------------------------------------------------------------------------

void ModStructure::retract(Call&, Edge& edge) noexcept {
  if (edge.kind == kRead) return unlink_reader(static_cast<ReadEdge&>(edge));
  auto& write = static_cast<WriteEdge&>(edge);
  Version& version = *at(write.version);
  Version* previous = before(write.head, version);
  const bool same = previous != nullptr && version.written && write.ops->equal(*previous, version);
  if (version.written) write.ops->destroy(version);
  version.written = false;
  if (previous != nullptr) {
    move_readers(version, *previous, nullptr, !same);
  } else if (write.version != write.head) {
    move_readers(version, *at(write.head), nullptr, true);
  } else {
    invalidate_readers(version);
  }
  version.writer = 0;
  if (write.version == write.head) return;
  Handle* link = &at(write.head)->next;
  while (*link != write.version) link = &at(*link)->next;
  *link = version.next;
  engine_.arena().release(write.version, write.ops->bytes);
}

void ModStructure::check_invariants(Handle head) const {
  const auto writer = [&](Handle v) -> const Call& { return *engine_.at<Call>(at(v)->writer); };
  Handle previous = 0;
  for (Handle v = head; v != 0; v = at(v)->next) {
    SAC_INVARIANT(at(v)->written || v == head);
    if (!at(v)->written) continue;
    if (previous != 0) SAC_INVARIANT(engine_.precedes(writer(previous), writer(v)));
    Handle last = 0;
    for (Handle r = at(v)->readers; r != 0; last = r, r = reader(r)->next_reader) {
      SAC_INVARIANT(reader(r)->version == v && reader(r)->prev == last);
      const Call& call = *engine_.at<Call>(reader(r)->call);
      SAC_INVARIANT(at(v)->outside || &writer(v) == &call || engine_.precedes(writer(v), call));
      const Handle next = at(v)->next;
      SAC_INVARIANT(next == 0 || !engine_.precedes(writer(next), call));
    }
    previous = v;
  }
}

void ModStructure::check_writes(const Call& call) const {
  for (Handle e = call.edges; e != 0; e = engine_.at<Edge>(e)->next) {
    const Edge& edge = *engine_.at<Edge>(e);
    if (edge.structure != id_ || edge.kind != kWrite) continue;
    const auto& write = static_cast<const WriteEdge&>(edge);
    if (write.version == write.head || !at(write.head)->written) check_invariants(write.head);
  }
}

}  // namespace sac
