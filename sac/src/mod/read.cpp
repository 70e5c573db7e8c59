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
  const Call& call = scope.self();
  Version* version = at(head);
  if (!version->outside) [[likely]] {
    version = seen_by(call, head);
    if (version == nullptr) fail_unwritten(call, head);
  }
  const Handle seen = handle_of(*version);
  const auto of_this = [&](const ReadEdge& edge) {  // of this version, or another of the modifiable
    return edge.version == seen || (edge.version != 0 && head_of(*at(edge.version)) == head);
  };
  // Not found among so many, it is made anew: the old one goes with the others.
  ReadEdge* edge = scope.recall<ReadEdge>(id_, kRead, of_this, kMostRecalled);
  if (edge != nullptr && edge->version == seen) {
    if (edge->behind) version->read_behind = true;
    return *version;
  }
  if (edge == nullptr) {
    edge = &scope.observe<ReadEdge>(id_, kRead);
    edge->call = engine_.handle_of(call);
    link_reader(*edge, *version);
    rerun_writer_around(*edge, *version);
  } else {
    move_reader(*edge, *version);
  }
  return *version;
}

// seen_by(), also where there are several versions, or what is there is hidden.
detail::Version* ModStructure::seen_among(const Call& call, Handle head) const {
  const Around around = versions_around(call, head);
  if (around.behind != nullptr) require_ahead(call, head, *around.behind);
  return shown(head, around.before);
}

// `version`, or, if that is hidden, the last one before it that is not; null if there is none.
detail::Version* ModStructure::shown(Handle head, Version* version) const noexcept {
  while (version != nullptr && hidden(*version)) {
    const auto skip = skips_.find(handle_of(*version));
    if (skip == skips_.end()) {
      version = predecessor(head, *version);
    } else {
      version = skip->second != 0 ? at(skip->second) : nullptr;
    }
  }
  return version;
}

// `version` is hidden, and so is the one before: calls inside of calls have each written the
// modifiable. What is shown instead of it is the same until it is repeated or taken back, for
// nothing happens before the running call.
void ModStructure::keep_skip(Handle head, const Version& version) noexcept {
  Version* const previous = predecessor(head, version);
  if (previous == nullptr || !hidden(*previous)) return;
  try {
    const Version* const instead = shown(head, previous);
    skips_.insert_or_assign(handle_of(version), instead != nullptr ? handle_of(*instead) : 0);
  } catch (const std::bad_alloc&) {  // then it is looked for each time
  }
}

// The effects of own children lie later in time than their parent: it cannot read them. `next` is
// the first version behind it.
void ModStructure::require_ahead(const Call& reader, Handle head, const Version& next) const {
  const Call& other = writer(next);
  if (engine_.lies_ahead(other)) return;
  throw UsageError(Engine::describe(reader) + " reads " + engine_.describe_mod(head) +
                   " after its own child " + Engine::describe(other) + " has written it");
}

void ModStructure::fail_unwritten(const Call& reader, Handle head) const {
  std::string text = Engine::describe(reader) + " reads " + engine_.describe_mod(head);
  const Around around = versions_around(reader, head);
  if (around.before != nullptr || around.behind == nullptr) {
    throw UsageError(text + ", which nobody has written");
  }
  throw UsageError(text + ", which is written only by the later call " +
                   Engine::describe(writer(*around.behind)));
}

detail::Version& ModStructure::last(Handle head) const {
  if (const std::uint32_t h = at(head)->history; h != 0 && !history(h).versions.empty()) {
    return *at(history(h).versions.last());
  }
  if (!at(head)->written) {
    throw UsageError(engine_.describe_mod(head) + " has no value: nobody has written it");
  }
  return *at(head);
}

// What `call` would read where it has read `seen`. Its own version it would see only where it has
// written it before; what it has read of others it has read before it wrote.
detail::Version* ModStructure::visible_to(const Call& call, const Version& seen) const {
  if (!seen.past && !seen.outside && &writer(seen) == &call) return at(handle_of(seen));
  const Handle head = head_of(seen);
  if (at(head)->outside) return at(head);
  Version* now = seen_by(call, head);
  if (now != nullptr && &writer(*now) == &call) now = predecessor(head, *now);
  return shown(head, now);
}

// The reader goes with the version that it would see now.
bool ModStructure::unchanged(Call& call, Edge& edge) {
  if (edge.kind != kRead) return true;
  auto& read = static_cast<ReadEdge&>(edge);
  if (read.version == 0) return false;
  const Version& seen = *at(read.version);
  Version* now = visible_to(call, seen);
  if (now == &seen) return true;
  if (now == nullptr || (types_[seen.type].keep != nullptr && engine_.undoing())) return false;
  if (!types_[seen.type].same(seen, *now)) return false;
  move_reader(read, *now);
  return true;
}

}  // namespace sac
