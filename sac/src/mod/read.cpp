// What a call reads, and whether it would read the same again.
#include "sac/internal/mod_structure.hpp"

namespace sac {

using detail::WriteEdge;

void ModStructure::check_live(Handle head, detail::Stamp stamp, const char* what) const {
  if (stamp.get() == 0) return;  // made of a bare handle
  if (!Arena::is_stamp_of(stamp.get(), &engine_.arena().header())) {
    throw UsageError(engine_.context(what) + ": the modifiable is one of another engine");
  }
  const bool there = engine_.arena().contains(head, sizeof(Version));
  if (there && at(head)->stamp.get() == stamp.get()) return;
  throw UsageError(engine_.context(what) + ": modifiable @" + std::to_string(head) +
                   " is gone: what it lay in has been released or discarded");
}

void ModStructure::fail_null(const char* what) const {
  const Call* call = engine_.running_call();
  throw UsageError(call != nullptr
                       ? Engine::describe(*call) + ' ' + what + "s a modifiable that is null"
                       : std::string(what) + ": the modifiable is null");
}

detail::Version& ModStructure::observe(Scope& scope, Handle head) {
  const Handle place = scope.place();
  Version* version = at(head);
  if (!version->outside) [[likely]] {
    version = seen_at(place, head);
    if (version == nullptr) fail_unwritten(place, head);
  }
  const Handle seen = handle_of(*version);
  const auto of_this = [&](const ReadEdge& edge) {  // of this version, or another of the modifiable
    return edge.version == seen || (edge.version != 0 && head_of(*at(edge.version)) == head);
  };
  // Not found among so many, it is made anew: the old one goes with the others.
  ReadEdge* edge = scope.recall<ReadEdge>(id_, kRead, of_this, kMostRecalled);
  if (edge != nullptr && edge->version == seen) return *version;
  if (edge == nullptr) {
    edge = &scope.observe<ReadEdge>(id_, kRead);
    edge->place = place;
    link_reader(*edge, *version);
  } else {
    move_reader(*edge, *version);
  }
  return *version;
}

// seen_at(), also where there are several versions, or one at this very place.
detail::Version* ModStructure::seen_among(Handle place, Handle head) const {
  Version* const last = versions_around(place, head).before;
  const bool is_old = last != nullptr && last->place == place && last->round != writer(*last).round;
  return is_old ? predecessor(head, *last) : last;
}

void ModStructure::fail_unwritten(Handle place, Handle head) const {
  std::string text =
      Engine::describe(engine_.call_at(place)) + " reads " + engine_.describe_mod(head);
  const Around around = versions_around(place, head);
  if (around.before != nullptr || around.behind == nullptr) {
    throw UsageError(text + ", which nobody has written");
  }
  throw UsageError(text + ", which is written only by the later call " +
                   Engine::describe(writer(*around.behind)));
}

const detail::Version* ModStructure::last_or_null(Handle head) const noexcept {
  if (const std::uint32_t h = at(head)->history; h != 0 && !history(h).versions.empty()) {
    return at(history(h).versions.last());
  }
  return at(head)->written ? at(head) : nullptr;
}

const detail::Version& ModStructure::last(Handle head) const {
  if (const Version* version = last_or_null(head)) return *version;
  throw UsageError(engine_.describe_mod(head) + " has no value: nobody has written it");
}

// What a call would read at `place`, where it has read `seen`. Its own version of this place it
// would see only where it has written it before; what it has read of others it has read before it
// wrote.
detail::Version* ModStructure::visible_at(Handle place, const Version& seen) const {
  if (!seen.past && !seen.outside && seen.place == place) return at(handle_of(seen));
  const Handle head = head_of(seen);
  if (at(head)->outside) return at(head);
  Version* const now = versions_around(place, head).before;
  return now != nullptr && now->place == place ? predecessor(head, *now) : now;
}

// The reader goes with the version that it would see now.
bool ModStructure::unchanged(Call&, Edge& edge) {
  if (edge.kind != kRead) return true;
  auto& read = static_cast<ReadEdge&>(edge);
  if (read.version == 0) return false;
  const Version& seen = *at(read.version);
  Version* now = visible_at(read.place, seen);
  if (now == &seen) return true;
  if (now == nullptr || (types_[seen.type].keep != nullptr && engine_.undoing())) return false;
  if (!types_[seen.type].same(seen, *now)) return false;
  move_reader(read, *now);
  return true;
}

}  // namespace sac
