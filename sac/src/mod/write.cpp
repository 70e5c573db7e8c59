// Versions that come, change and go.
#include "sac/internal/mod_structure.hpp"

namespace sac {

using detail::History;
using detail::WriteEdge;

void ModStructure::require_unwritten(ModRef head) const {
  const Version& version = at(head);
  if (is_untouched(version)) return;
  throw UsageError("set: " + engine_.describe_mod(head) + " is written by the program, in " +
                   Engine::describe(writer(last(head))));
}

void ModStructure::unmake_input(ModRef head) noexcept {
  Version& version = at(head);
  types_[version.type].destroy(version);
  version.written = version.outside = false;
  if (version.watched) engine_.touched(head);
}

// --- Writing ---------------------------------------------------------------------------------

// The running call's own version at its place: last time's, repeated; null if it has none.
detail::Version* ModStructure::own_version(ModRef head) {
  Core& core = engine_.core();
  const Place place = core.place();
  Version* own = &at(head);
  if (own->outside) [[unlikely]]
    fail_input(head);
  if (own->history != 0) own = versions_around(place, head).before;
  if (own == nullptr || own->place != place) return nullptr;
  const Call& call = core.self();
  if (own->round == call.round) return own;
  repeat(head, Arena::ref(*own));
  own->round = call.round;
  return own;
}

void ModStructure::fail_input(ModRef head) const {
  throw UsageError(Engine::describe(*engine_.running_call()) + " writes " +
                   engine_.describe_mod(head) + ", which is an input");
}

// The edge of last time, or, if it is not found among so many, a new one: the version is that one's
// from now on, and the old edge goes with the others (has_passed_on).
void ModStructure::repeat(ModRef head, Ref<Version> version) {
  Core& core = engine_.core();
  const auto same = [&](const Edge& edge) {
    return edge.structure == id_ && edge.kind == kWrite &&
           static_cast<const WriteEdge&>(edge).version == version;
  };
  if (core.recall(same, Scope::kMostRecalled) != nullptr) return;
  auto& edge = static_cast<WriteEdge&>(core.attach_here(id_, kWrite, sizeof(WriteEdge)));
  edge.head = head;
  edge.version = version;
}

// Whether the version is another edge's: that of this execution. Requires: there is a version.
bool ModStructure::has_passed_on(const WriteEdge& edge) const noexcept {
  return at(edge.version).round != edge.round;
}

// The first version, without a value yet: to be given one at once.
detail::Version& ModStructure::first_version(ModRef head, const detail::ValueType& type) {
  Core& core = engine_.core();
  const std::uint16_t type_number = number(type);
  const Place place = core.place();
  auto& edge = static_cast<WriteEdge&>(core.attach_here(id_, kWrite, sizeof(WriteEdge)));
  edge.version = edge.head = head;
  Version& first = at(head);
  first.place = place;
  first.type = type_number;
  first.round = edge.round;
  return first;
}

// Another version for the running call, without a value yet: to be given one at once. The edge
// comes first: if anything fails behind it, it has no version to take back.
detail::Version& ModStructure::new_version(ModRef head, const detail::ValueType& type) {
  Core& core = engine_.core();
  const std::uint16_t type_number = number(type);
  const Place place = core.place();
  auto& edge = static_cast<WriteEdge&>(core.attach_here(id_, kWrite, sizeof(WriteEdge)));
  edge.head = head;
  edge.version = nullptr;
  Version& first = at(head);
  Version& fresh = first.written ? new_apart(head, type) : first;
  fresh.place = place;
  fresh.type = type_number;
  fresh.round = edge.round;
  enter_history(head, fresh, type);
  edge.version = Arena::ref(fresh);
  return fresh;
}

// Memory for a version that lies apart.
detail::Version& ModStructure::new_apart(ModRef head, const detail::ValueType& type) {
  const Ref<Version> fresh(engine_.arena().allocate(type.bytes));
  Version& apart = *::new (&at(fresh)) Version();
  apart.apart = true;
  apart.modifiable = head.handle();
  return apart;
}

// If that fails, a version that lies apart is freed.
void ModStructure::enter_history(ModRef head, Version& version, const detail::ValueType& type) {
  Version& first = at(head);
  try {
    if (first.history == 0) first.history = new_history(head);
    history(first.history).versions.insert(Arena::ref(version), order());
  } catch (...) {
    if (version.apart) engine_.arena().release(Arena::ref(version), type.bytes);
    if (first.history != 0) drop_history(head);
    throw;
  }
}

std::uint32_t ModStructure::new_history(ModRef head) {
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
  if (at(head).written) fresh.versions.insert(head, order());  // in place: it cannot fail
  fresh.head = head;
  free_histories_.pop_back();
  return number;
}

// A version in place needs no order; nor does none.
void ModStructure::drop_history(ModRef head) noexcept {
  const std::uint32_t number = at(head).history;
  const auto& versions = history(number).versions;
  if (versions.size() > 1 || (versions.size() == 1 && versions.first() != head)) return;
  at(head).history = 0;
  histories_[number] = History();
  free_histories_.push_back(number);
}

detail::Version* ModStructure::predecessor(ModRef head, const Version& version) const noexcept {
  const std::uint32_t h = at(head).history;
  if (h == 0) return nullptr;
  return pointer(history(h).versions.predecessor(Arena::ref(version), order()));
}

// Takes the value of `version` out, to be given another at once; its readers are in doubt, but for
// those at the place `except`, where it is replaced.
void ModStructure::replace(ModRef head, Version& version, Place except) noexcept {
  version.outside ? tell(Event::Kind::edited, nullptr, head)
                  : tell(Event::Kind::changed, &writer(version), head);
  leave_past(head, version, except);
}

// A new version has its value: takes over the readers of `previous` that are behind it if its value
// is the same; else they are in doubt, and stay with what they have seen.
void ModStructure::appeared(ModRef head, Version& version, Version& previous, bool same) noexcept {
  for_each_reader_behind(previous, version.place, [&](ReadEdge& edge) {
    same ? move_reader(edge, version) : engine_.doubt(edge.place, head);
  });
}

// --- Taking back -----------------------------------------------------------------------------

// Takes the value out of `version`. Those who have seen it are in doubt, and keep it until it is
// their turn; if there is no memory for that, they run again in any case.
void ModStructure::leave_past(ModRef head, Version& version, Place except) noexcept {
  const detail::ValueType& type = types_[version.type];
  if (type.keep != nullptr && engine_.originals() != nullptr && !version.outside) {
    type.keep(*engine_.originals(), writer(version), head, version);
  }
  forget_order(version);
  if (Version* past = part_with_readers(head, version, except)) {
    type.move(version, *past);
    past->written = true;
  } else {
    type.destroy(version);
  }
  version.written = false;
}

// A past version, without a value yet, with the readers of `version`, who are in doubt from now on.
// Those at the place `except` stay. Null: there are no others, or no memory.
detail::Version* ModStructure::part_with_readers(ModRef head, Version& version,
                                                 Place except) noexcept {
  Ref<ReadEdge> r = version.readers;
  while (r != nullptr && at(r).place == except) r = at(r).next_reader;
  if (r == nullptr) return nullptr;
  Version* const past = new_past(head, version);
  if (past == nullptr) {
    orphan_readers(version, except);
    return nullptr;
  }
  past->readers = std::exchange(version.readers, nullptr);
  detail::Readers::for_each(engine_.arena(), past->readers, [&](ReadEdge& edge) {
    edge.version = Arena::ref(*past);
    if (edge.place == except) {
      move_reader(edge, version);
    } else {
      engine_.doubt(edge.place, head);
    }
  });
  return past;
}

void ModStructure::orphan_readers(const Version& version, Place except) noexcept {
  detail::Readers::for_each(engine_.arena(), version.readers, [&](ReadEdge& edge) {
    if (edge.place != except) orphan(edge);
  });
}

// Null: there is no memory.
detail::Version* ModStructure::new_past(ModRef head, const Version& version) noexcept {
  try {
    Version& past = new_apart(head, types_[version.type]);
    past.past = true;
    past.type = version.type;
    return &past;
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}

void ModStructure::free_past(Version& version) noexcept {
  const detail::ValueType& type = types_[version.type];
  if (version.written) type.destroy(version);
  engine_.arena().release(Arena::ref(version), type.bytes);
}

void ModStructure::forget_version(ModRef head, Version& version) noexcept {
  if (const std::uint32_t h = at(head).history; h != 0) {
    history(h).versions.erase(Arena::ref(version), order());
    drop_history(head);
  }
  version.place = nullptr;
  if (Arena::ref(version) == head) return;
  engine_.arena().release(Arena::ref(version), types_[version.type].bytes);
}

void ModStructure::retract(Call& call, Edge& edge) noexcept {
  if (edge.kind == kRead) return unlink_reader(static_cast<ReadEdge&>(edge));
  const auto& write = static_cast<const WriteEdge&>(edge);
  if (write.version == nullptr || has_passed_on(write)) return;
  Version& version = at(write.version);
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
    while (version.readers != nullptr) move_reader(at(version.readers), *previous);
  }
  leave_past(write.head, version, nullptr);
  forget_version(write.head, version);
}

}  // namespace sac
