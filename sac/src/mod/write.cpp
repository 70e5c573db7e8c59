// Versions that come, change and go.
#include "sac/internal/mod_structure.hpp"

namespace sac {

using detail::History;
using detail::WriteEdge;

void ModStructure::require_unwritten(Handle head) const {
  const Version& version = *at(head);
  if (is_untouched(version)) return;
  throw UsageError("set: " + engine_.describe_mod(head) + " is written by the program, in " +
                   Engine::describe(writer(last(head))));
}

void ModStructure::unmake_input(Handle head) noexcept {
  Version& version = *at(head);
  types_[version.type].destroy(version);
  version.written = version.outside = false;
  if (version.watched) engine_.touched(head);
}

// --- Writing ---------------------------------------------------------------------------------

// The running call's own version at its place: last time's, repeated; null if it has none.
detail::Version* ModStructure::own_version(Scope& scope, Handle head) {
  const Handle place = scope.place();
  const Call& call = scope.self();
  Version* own = at(head);
  if (own->outside) {
    throw UsageError(Engine::describe(call) + " writes " + engine_.describe_mod(head) +
                     ", which is an input");
  }
  own = versions_around(place, head).before;
  if (own == nullptr || own->place != place) return nullptr;
  if (own->round == call.round) return own;
  repeat(scope, head, handle_of(*own));
  own->round = call.round;
  return own;
}

// The edge of last time, or, if it is not found among so many, a new one: the version is that one's
// from now on, and the old edge goes with the others (has_passed_on).
void ModStructure::repeat(Scope& scope, Handle head, Handle version) {
  const auto same = [&](const WriteEdge& edge) { return edge.version == version; };
  if (scope.recall<WriteEdge>(id_, kWrite, same, kMostRecalled) != nullptr) return;
  auto& edge = scope.effect<WriteEdge>(id_, kWrite);
  edge.head = head;
  edge.version = version;
}

// Whether the version is another edge's: that of this execution. Requires: there is a version.
bool ModStructure::has_passed_on(const WriteEdge& edge) const noexcept {
  return at(edge.version)->round != edge.round;
}

// A version for the running call, without a value yet: to be given one at once. The edge comes
// first: if anything fails behind it, it has no version to take back.
detail::Version& ModStructure::new_version(Scope& scope, Handle head,
                                           const detail::ValueType& type) {
  const std::uint16_t type_number = number(type);
  const Call& self = scope.self();
  auto& edge = scope.effect<WriteEdge>(id_, kWrite);
  edge.head = head;
  edge.version = 0;
  Version& first = *at(head);
  const bool is_only = is_untouched(first);
  Version& fresh = first.written ? new_apart(head, type) : first;
  fresh.place = scope.place();
  fresh.type = type_number;
  fresh.round = self.round;
  if (!is_only) enter_history(head, fresh, type);
  edge.version = handle_of(fresh);
  return fresh;
}

// Memory for a version that lies apart.
detail::Version& ModStructure::new_apart(Handle head, const detail::ValueType& type) {
  auto& apart = *::new (engine_.arena().at<void>(engine_.arena().allocate(type.bytes))) Version();
  apart.apart = true;
  apart.modifiable = head;
  return apart;
}

// If that fails, a version that lies apart is freed.
void ModStructure::enter_history(Handle head, Version& version, const detail::ValueType& type) {
  Version& first = *at(head);
  try {
    if (first.history == 0) first.history = new_history(head);
    history(first.history).versions.insert(handle_of(version), order());
  } catch (...) {
    if (version.apart) engine_.arena().release(handle_of(version), type.bytes);
    if (first.history != 0) drop_history(head);
    throw;
  }
}

std::uint32_t ModStructure::new_history(Handle head) {
  if (histories_.empty()) histories_.emplace_back();
  if (free_histories_.empty()) {
    if (free_histories_.capacity() <= histories_.size()) {  // so that drop_history cannot fail
      free_histories_.reserve(2 * histories_.size() + 8);
    }
    histories_.emplace_back();
    free_histories_.push_back(static_cast<std::uint32_t>(histories_.size() - 1));
  }
  const std::uint32_t number = free_histories_.back();
  History& fresh = history(number);
  if (at(head)->written) fresh.versions.insert(head, order());  // in place: it cannot fail
  fresh.head = head;
  free_histories_.pop_back();
  return number;
}

// A version in place needs no order; nor does none.
void ModStructure::drop_history(Handle head) noexcept {
  const std::uint32_t number = at(head)->history;
  const auto& versions = history(number).versions;
  if (versions.size() > 1 || (versions.size() == 1 && versions.first() != head)) return;
  at(head)->history = 0;
  histories_[number] = History();
  free_histories_.push_back(number);
}

detail::Version* ModStructure::predecessor(Handle head, const Version& version) const noexcept {
  const std::uint32_t h = at(head)->history;
  if (h == 0) return nullptr;
  const Handle* found = history(h).versions.predecessor(handle_of(version), order());
  return found != nullptr ? at(*found) : nullptr;
}

// Takes the value of `version` out, to be given another at once; its readers are in doubt, but for
// those at the place `except`, where it is replaced.
void ModStructure::replace(Handle head, Version& version, Handle except) noexcept {
  version.outside ? tell(Event::Kind::edited, nullptr, head)
                  : tell(Event::Kind::changed, &writer(version), head);
  leave_past(head, version, except);
}

// A new version has its value: takes over the readers of `previous` that are behind it if its value
// is the same; else they are in doubt, and stay with what they have seen.
void ModStructure::appeared(Handle head, Version& version, Version& previous, bool same) noexcept {
  for_each_reader_behind(previous, version.place, [&](ReadEdge& edge) {
    same ? move_reader(edge, version) : engine_.doubt(edge.place, head);
  });
}

// --- Taking back -----------------------------------------------------------------------------

// Takes the value out of `version`. Those who have seen it are in doubt, and keep it until it is
// their turn; if there is no memory for that, they run again in any case.
void ModStructure::leave_past(Handle head, Version& version, Handle except) noexcept {
  const detail::ValueType& type = types_[version.type];
  if (type.keep != nullptr && engine_.originals() != nullptr && !version.outside) {
    type.keep(*engine_.originals(), writer(version), head, version);
  }
  Version* past = nullptr;
  forget_order(version);
  for (Handle r = version.readers; r != 0;) {
    ReadEdge& edge = *reader(r);
    r = edge.next_reader;
    if (edge.place == except) continue;
    if (past == nullptr) {
      try {
        past = &new_apart(head, type);
        past->past = true;
        past->type = version.type;
      } catch (...) {
        orphan(edge);
        continue;
      }
    }
    move_reader(edge, *past);
    engine_.doubt(edge.place, head);
  }
  if (past != nullptr) {
    type.move(version, *past);
    past->written = true;
  } else {
    type.destroy(version);
  }
  version.written = false;
}

void ModStructure::free_past(Version& version) noexcept {
  const detail::ValueType& type = types_[version.type];
  if (version.written) type.destroy(version);
  engine_.arena().release(handle_of(version), type.bytes);
}

void ModStructure::forget_version(Handle head, Version& version) noexcept {
  if (const std::uint32_t h = at(head)->history; h != 0) {
    history(h).versions.erase(handle_of(version), order());
    drop_history(head);
  }
  version.place = 0;
  if (handle_of(version) == head) return;
  engine_.arena().release(handle_of(version), types_[version.type].bytes);
}

void ModStructure::retract(Call& call, Edge& edge) noexcept {
  if (edge.kind == kRead) return unlink_reader(static_cast<ReadEdge&>(edge));
  const auto& write = static_cast<const WriteEdge&>(edge);
  if (write.version == 0 || has_passed_on(write)) return;
  Version& version = *at(write.version);
  Version* previous = predecessor(write.head, version);
  bool same = false;
  if (previous != nullptr) {
    try {
      same = types_[version.type].same(*previous, version);
    } catch (...) {  // client code that fails here makes the readers run again
    }
  }
  if (!same) tell(Event::Kind::reverted, &call, write.head);
  if (same) {
    forget_order(version);
    while (version.readers != 0) move_reader(*reader(version.readers), *previous);
  }
  leave_past(write.head, version, 0);
  forget_version(write.head, version);
}

}  // namespace sac
