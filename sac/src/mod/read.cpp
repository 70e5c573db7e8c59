// What a call reads, and whether it would read the same again.
#include "sac/internal/mod_structure.hpp"

namespace sac {

using detail::WriteEdge;

void ModStructure::check_live(ModRef head, detail::Stamp stamp, const char* what) const {
  if (stamp.get() == 0) return;  // made of a bare handle
  if (!Arena::is_stamp_of(stamp.get(), &engine_.arena().header())) {
    throw UsageError(engine_.context(what) + ": the modifiable is one of another engine");
  }
  const bool there = engine_.arena().contains(head);
  if (there && at(head).stamp.get() == stamp.get()) return;
  throw UsageError(engine_.context(what) + ": modifiable @" + std::to_string(head.handle()) +
                   " is gone: what it lay in has been released or discarded");
}

void ModStructure::fail_null(const char* what) const {
  const Call* call = engine_.running_call();
  throw UsageError(call != nullptr
                       ? Engine::describe(*call) + ' ' + what + "s a modifiable that is null"
                       : std::string(what) + ": the modifiable is null");
}

detail::Version& ModStructure::observe(ModRef head) {
  Core& core = engine_.core();
  const Place place = core.place();
  Version* version = &at(head);
  if (!version->outside) [[likely]] {
    version = seen_at(place, head);
    if (version == nullptr) fail_unwritten(place, head);
  }
  if (core.may_recall()) {
    if (ReadEdge* edge = recall_read(head, Arena::ref(*version))) {
      if (edge->version != Arena::ref(*version)) move_reader(*edge, *version);
      return *version;
    }
  }
  auto& edge = static_cast<ReadEdge&>(core.attach_here(id_, kRead, sizeof(ReadEdge)));
  edge.place = place;
  link_reader(edge, *version);
  return *version;
}

// The read of last time, of this version or another of the modifiable. Not found among so many, it
// is made anew: the old one goes with the others.
detail::ReadEdge* ModStructure::recall_read(ModRef head, Ref<Version> seen) {
  const auto of_this = [&](const Edge& e) {
    if (e.structure != id_ || e.kind != kRead) return false;
    const auto& edge = static_cast<const ReadEdge&>(e);
    return edge.version == seen || (edge.version != nullptr && head_of(at(edge.version)) == head);
  };
  return static_cast<ReadEdge*>(engine_.core().recall(of_this, Scope::kMostRecalled));
}

detail::Version* ModStructure::newest(ModRef head) const noexcept {
  if (const std::uint32_t h = at(head).history; h != 0) {
    return history(h).versions.empty() ? nullptr : &at(history(h).versions.last());
  }
  return at(head).written ? &at(head) : nullptr;
}

// seen_at(), also where there are several versions, or one at this very place.
detail::Version* ModStructure::seen_among(Place place, ModRef head) const {
  Version* const last = versions_around(place, head).before;
  const bool is_old = last != nullptr && last->place == place && last->round != writer(*last).round;
  return is_old ? predecessor(head, *last) : last;
}

void ModStructure::fail_unwritten(Place place, ModRef head) const {
  std::string text =
      Engine::describe(engine_.call_at(place)) + " reads " + engine_.describe_mod(head);
  const Around around = versions_around(place, head);
  if (around.before != nullptr || around.behind == nullptr) {
    throw UsageError(text + ", which nobody has written");
  }
  throw UsageError(text + ", which is written only by the later call " +
                   Engine::describe(writer(*around.behind)));
}

const detail::Version& ModStructure::last(ModRef head) const {
  if (const Version* version = newest(head)) return *version;
  throw UsageError(engine_.describe_mod(head) + " has no value: nobody has written it");
}

// What a call would read at `place`, where it has read `seen`. Its own version of this place it
// would see only where it has written it before; what it has read of others it has read before it
// wrote.
detail::Version* ModStructure::visible_at(Place place, const Version& seen) const {
  if (!seen.past && !seen.outside && seen.place == place) return &at(Arena::ref(seen));
  const ModRef head = head_of(seen);
  return at(head).outside ? &at(head) : last_before(place, head);
}

// The reader goes with the version that it would see now.
bool ModStructure::unchanged(Call&, Edge& edge) {
  if (edge.kind != kRead) return true;
  auto& read = static_cast<ReadEdge&>(edge);
  if (read.version == nullptr) return false;
  const Version& seen = at(read.version);
  Version* now = visible_at(read.place, seen);
  if (now == &seen) return true;
  if (now == nullptr || (types_[seen.type].keep != nullptr && engine_.undoing())) return false;
  if (!types_[seen.type].same(seen, *now)) return false;
  move_reader(read, *now);
  return true;
}

}  // namespace sac
