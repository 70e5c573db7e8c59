// Versions, readers and writers of modifiables.
#include "sac/mod.hpp"

#include <algorithm>

namespace sac {

using detail::History;
using detail::ReadEdge;
using detail::Version;
using detail::WriteEdge;

// --- Reading ---------------------------------------------------------------------------------

Version& ModStructure::observe(Scope& scope, Handle head) {
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
  ReadEdge* edge = scope.recall<ReadEdge>(id_, kRead, of_this);
  if (edge == nullptr) {
    edge = &scope.observe<ReadEdge>(id_, kRead);
    edge->call = engine_.handle_of(call);
    link_reader(*edge, *version);
  } else if (edge->version != seen) {
    move_reader(*edge, *version);
  }
  return *version;
}

// The last version before `call`, or its own; null if there is none. What a running call wrote last
// time and has not repeated is not there for it, nor for the children that it makes.
Version* ModStructure::seen_by(const Call& call, Handle head) const {
  Version* version = at(head);
  if (version->history == 0) {
    if (!version->written) return nullptr;
    const Call& w = writer(*version);
    if (&w == &call || engine_.precedes(w, call)) return unconfirmed(*version) ? nullptr : version;
    require_ahead(call, head, head);
    return nullptr;
  }
  const TraceOrder& versions = history(version->history).versions;
  const auto place = versions.place_of(0, order(&call));
  if (place.behind != 0) require_ahead(call, head, place.behind);
  Handle seen = place.before;
  while (seen != 0 && unconfirmed(*at(seen))) seen = versions.predecessor(seen, order());
  return seen != 0 ? at(seen) : nullptr;
}

// Whether a running call wrote `version` last time and has not yet repeated it.
bool ModStructure::unconfirmed(const Version& version) const noexcept {
  const Call& w = writer(version);
  if (!w.has(Call::kRunning)) [[likely]] return false;
  const Engine::Activation* a = engine_.current_;
  while (a->call != &w) a = a->outer;
  const Handle target = handle_of(version);
  for (Handle e = a->old_edges; e != 0; e = engine_.at<Edge>(e)->next) {
    const Edge& edge = *engine_.at<Edge>(e);
    if (edge.structure != id_ || edge.kind != kWrite) continue;
    if (static_cast<const WriteEdge&>(edge).version == target) return true;
  }
  return false;
}

// The effects of own children lie later in time than their parent: it cannot read them. `next` is
// the first version behind it.
void ModStructure::require_ahead(const Call& reader, Handle head, Handle next) const {
  const Call& other = writer(*at(next));
  if (engine_.lies_ahead(other)) return;
  throw UsageError(Engine::describe(reader) + " reads " + engine_.describe_mod(head) +
                   " after its own child " + Engine::describe(other) + " has written it");
}

void ModStructure::fail_unwritten(const Call& reader, Handle head) const {
  std::string text = Engine::describe(reader) + " reads " + engine_.describe_mod(head);
  if (head == 0) throw UsageError(text);
  const Version* later = nullptr;
  if (const std::uint32_t h = at(head)->history; h != 0) {
    if (!history(h).versions.empty()) later = at(history(h).versions.first());
  } else if (at(head)->written) {
    later = at(head);
  }
  if (later == nullptr) throw UsageError(text + ", which nobody has written");
  throw UsageError(text + ", which is written only by the later call " +
                   Engine::describe(writer(*later)));
}

Version& ModStructure::last(Handle head) const {
  if (const std::uint32_t h = at(head)->history; h != 0 && !history(h).versions.empty()) {
    return *at(history(h).versions.last());
  }
  if (!at(head)->written) {
    throw UsageError(engine_.describe_mod(head) + " has no value: nobody has written it");
  }
  return *at(head);
}

// --- Writing ---------------------------------------------------------------------------------

Version* ModStructure::find_own(const Call& call, Handle head) const noexcept {
  Version* version = at(head);
  if (version->history == 0) {
    return version->written && &writer(*version) == &call ? version : nullptr;
  }
  const Handle own = history(version->history).versions.place_of(0, order(&call)).before;
  return own != 0 && &writer(*at(own)) == &call ? at(own) : nullptr;
}

Version* ModStructure::own_version(Scope& scope, Handle head) {
  const Call& call = scope.self();
  if (at(head)->outside) {
    throw UsageError(Engine::describe(call) + " writes " + engine_.describe_mod(head) +
                     ", which is an input");
  }
  Version* own = find_own(call, head);
  if (own != nullptr) {
    const Handle version = handle_of(*own);
    const auto same = [&](const WriteEdge& edge) { return edge.version == version; };
    const bool repeated = scope.recall<WriteEdge>(id_, kWrite, same) != nullptr;
    // Children that have run meanwhile did not see it.
    const bool has_children = engine_.now_ != engine_.handle_of(call);
    const Version* before = repeated && has_children ? predecessor(head, *own) : nullptr;
    if (before != nullptr) require_unread(scope, head, *before);
  }
  return own;
}

// The edge comes first: if anything fails behind it, it has no version to take back.
Version& ModStructure::new_version(Scope& scope, Handle head, const detail::ValueType& type) {
  if (head == 0) {
    throw UsageError(Engine::describe(scope.self()) + " writes " + engine_.describe_mod(head));
  }
  const std::uint16_t type_number = number(type);
  const Handle self = engine_.handle_of(scope.self());
  auto& edge = scope.effect<WriteEdge>(id_, kWrite);
  edge.head = head;
  edge.version = 0;
  Version& first = *at(head);
  if (!first.written && first.history == 0) {
    first.writer = self;
    first.type = type_number;
    edge.version = head;
    return first;
  }
  Handle fresh = head;
  if (first.written) {
    fresh = engine_.arena().allocate(type.bytes);
    ::new (static_cast<void*>(at(fresh))) Version();
    at(fresh)->apart = true;
    at(fresh)->history = head;
  }
  at(fresh)->writer = self;
  at(fresh)->type = type_number;
  try {
    if (first.history == 0) first.history = new_history(head);
    history(first.history).versions.insert(fresh, order());
  } catch (...) {
    if (fresh != head) engine_.arena().release(fresh, type.bytes);
    if (first.history != 0) drop_history(head);
    throw;
  }
  edge.version = fresh;
  return *at(fresh);
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
  const TraceOrder& versions = history(number).versions;
  if (versions.size() > 1 || (versions.size() == 1 && versions.first() != head)) return;
  at(head)->history = 0;
  histories_[number] = History();
  free_histories_.push_back(number);
}

Version* ModStructure::before(Scope& scope, Handle head) const {
  const Call& self = scope.self();
  Version* version = at(head);
  if (version->history == 0) {
    return version->written && engine_.precedes(writer(*version), self) ? version : nullptr;
  }
  const Handle last = history(version->history).versions.place_of(0, order(&self)).before;
  return last != 0 ? at(last) : nullptr;
}

Version* ModStructure::predecessor(Handle head, const Version& version) const noexcept {
  const std::uint32_t h = at(head)->history;
  if (h == 0) return nullptr;
  const Handle found = history(h).versions.predecessor(handle_of(version), order());
  return found != 0 ? at(found) : nullptr;
}

void ModStructure::require_unread(Scope& scope, Handle head, const Version& version) {
  const Call& self = scope.self();
  if (engine_.now_ == engine_.handle_of(self)) return;  // it has no children yet
  const Call* child = nullptr;
  for_each_reader_behind(version, self, 0, [&](ReadEdge& edge) {
    const Call& call = engine_.call(edge.call);
    if (!engine_.lies_ahead(call)) child = &call;
    return child == nullptr && !version.ordered;  // in order, the first decides
  });
  if (child == nullptr) return;
  throw UsageError(Engine::describe(self) + " writes " + engine_.describe_mod(head) +
                   " after its own child " + Engine::describe(*child) + " has read it");
}

void ModStructure::replace(Handle head, Version& version) noexcept {
  if (engine_.observer_ != nullptr) [[unlikely]] {
    version.outside ? engine_.note(Event::Kind::edited, nullptr, head)
                    : engine_.note(Event::Kind::changed, &writer(version), head);
  }
  const Engine::Activation* running = engine_.current_;
  leave_past(head, version, running != nullptr ? engine_.handle_of(*running->call) : 0);
}

void ModStructure::appeared(Scope& scope, Handle head, Version& version, Version* previous,
                            bool same) noexcept {
  if (engine_.observer_ != nullptr && !same) [[unlikely]] {
    engine_.note(Event::Kind::changed, &scope.self(), head);
  }
  if (previous == nullptr) return;
  const Call& self = scope.self();
  if (same) {
    for_each_reader_behind(*previous, self, 0, [&](ReadEdge& edge) {
      move_reader(edge, version);
      return true;
    });
  } else {
    doubt_readers(head, *previous, self);
  }
  // Children of a running call read past what that call has not repeated.
  for (Version* v = previous; v != nullptr && unconfirmed(*v);) {
    v = predecessor(head, *v);
    if (v != nullptr) doubt_readers(head, *v, self);
  }
}

// --- Readers ---------------------------------------------------------------------------------

void ModStructure::link_reader(ReadEdge& edge, Version& version) noexcept {
  const Handle self = engine_.arena().handle_of(&edge);
  edge.version = handle_of(version);
  edge.prev = 0;
  edge.next_reader = version.readers;
  if (version.readers != 0) reader(version.readers)->prev = self;
  version.readers = self;
  if (!version.ordered) [[likely]] return;
  try {
    reader_orders_.find(edge.version)->second.insert(self, reader_order());
  } catch (const std::bad_alloc&) {
    forget_order(version);
  }
}

void ModStructure::unlink_reader(ReadEdge& edge) noexcept {
  if (edge.version == 0) return;
  Version& version = *at(edge.version);
  if (version.ordered) [[unlikely]] {
    const Handle self = engine_.arena().handle_of(&edge);
    reader_orders_.find(edge.version)->second.erase(self, reader_order());
  }
  if (edge.next_reader != 0) reader(edge.next_reader)->prev = edge.prev;
  (edge.prev != 0 ? reader(edge.prev)->next_reader : version.readers) = edge.next_reader;
  if (version.past && version.readers == 0) free_past(version);
}

void ModStructure::move_reader(ReadEdge& edge, Version& to) noexcept {
  unlink_reader(edge);
  link_reader(edge, to);
}

template <class Visit>
void ModStructure::for_each_reader_behind(const Version& version, const Call& call, Handle end,
                                          Visit&& visit) {
  const auto is_before_end = [&](const ReadEdge& edge) {
    return end == 0 || engine_.timeline_.precedes(engine_.call(edge.call), *engine_.at<TimeNode>(end));
  };
  if (version.ordered) {
    const TraceOrder& readers = reader_orders_.find(handle_of(version))->second;
    for (Handle r = readers.place_of(0, reader_order(&call)).behind; r != 0;) {
      const Handle next = readers.place_of(r, reader_order()).behind;
      if (!is_before_end(*reader(r)) || !visit(*reader(r))) return;
      r = next;
    }
    return;
  }
  constexpr std::size_t kMany = 64;
  std::size_t passed = 0;
  std::size_t visited = 0;
  for (Handle r = version.readers; r != 0;) {
    ReadEdge& edge = *reader(r);
    r = edge.next_reader;
    if (!engine_.precedes(call, engine_.call(edge.call)) || !is_before_end(edge)) {
      ++passed;
      continue;
    }
    ++visited;
    if (!visit(edge)) return;
  }
  if (passed > kMany && passed / 8 > visited && !engine_.appending()) order_readers(version);
}

void ModStructure::order_readers(const Version& version) noexcept {
  try {
    std::vector<Handle> readers;
    for (Handle r = version.readers; r != 0; r = reader(r)->next_reader) readers.push_back(r);
    std::sort(readers.begin(), readers.end(), reader_order());
    TraceOrder order;
    for (const Handle r : readers) order.append(r);
    reader_orders_[handle_of(version)] = std::move(order);
    at(handle_of(version))->ordered = true;
  } catch (const std::bad_alloc&) {  // then they stay as they are
  }
}

void ModStructure::forget_order(Version& version) noexcept {
  if (!version.ordered) return;
  reader_orders_.erase(handle_of(version));
  version.ordered = false;
}

// They stay with what they have seen.
void ModStructure::doubt_readers(Handle head, const Version& version,
                                 const Call& later_than) noexcept {
  for_each_reader_behind(version, later_than, 0, [&](ReadEdge& edge) {
    engine_.doubt(engine_.call(edge.call), head);
    return true;
  });
}

// Takes the value out of `version`. Those who have seen it are in doubt, and keep it until it is
// their turn; if there is no memory for that, they run again in any case. Call `except` stays: it
// replaces the value itself.
void ModStructure::leave_past(Handle head, Version& version, Handle except) noexcept {
  const detail::ValueType& type = types_[version.type];
  Version* past = nullptr;
  forget_order(version);
  for (Handle r = version.readers; r != 0;) {
    ReadEdge& edge = *reader(r);
    r = edge.next_reader;
    if (edge.call == except) continue;
    if (past == nullptr) {
      try {
        past = at(engine_.arena().allocate(type.bytes));
        ::new (static_cast<void*>(past)) Version();
        past->type = version.type;
        past->apart = past->past = true;
        past->history = head;
      } catch (...) {
        orphan(edge);
        continue;
      }
    }
    move_reader(edge, *past);
    engine_.doubt(engine_.call(edge.call), head);
  }
  if (past != nullptr) {
    type.move(version, *past);
    past->written = true;
  } else {
    type.destroy(version);
  }
  version.written = false;
}

void ModStructure::orphan(ReadEdge& edge) noexcept {
  unlink_reader(edge);
  edge.version = 0;
  engine_.invalidate(engine_.call(edge.call));
}

void ModStructure::free_past(Version& version) noexcept {
  const detail::ValueType& type = types_[version.type];
  if (version.written) type.destroy(version);
  engine_.arena().release(handle_of(version), type.bytes);
}

// What `call` would read where it has read `seen`. Its own version it would see only where it has
// written it before; what it has read of others it has read before it wrote.
Version* ModStructure::visible_to(const Call& call, const Version& seen) const {
  if (!seen.past && !seen.outside && &writer(seen) == &call) return at(handle_of(seen));
  const Handle head = head_of(seen);
  if (at(head)->outside) return at(head);
  Version* now = seen_by(call, head);
  if (now != nullptr && &writer(*now) == &call) now = predecessor(head, *now);
  while (now != nullptr && unconfirmed(*now)) now = predecessor(head, *now);
  return now;
}

bool ModStructure::reads_the_same(Call& call) {
  const auto for_each_read = [&](auto&& visit) {
    for (Handle e = call.edges; e != 0; e = engine_.at<Edge>(e)->next) {
      Edge& edge = *engine_.at<Edge>(e);
      if (edge.structure == id_ && edge.kind == kRead && !visit(static_cast<ReadEdge&>(edge))) {
        return false;
      }
    }
    return true;
  };
  const bool same = for_each_read([&](ReadEdge& edge) {
    if (edge.version == 0) return false;
    const Version& seen = *at(edge.version);
    const Version* now = visible_to(call, seen);
    return now == &seen || (now != nullptr && types_[seen.type].same(seen, *now));
  });
  if (!same) return false;
  for_each_read([&](ReadEdge& edge) {
    Version* now = visible_to(call, *at(edge.version));
    if (handle_of(*now) == edge.version) return true;
    move_reader(edge, *now);
    return true;
  });
  return true;
}

void ModStructure::hide_unconfirmed(const Call& call, Handle end, Handle old_edges) noexcept {
  for (Handle e = old_edges; e != 0; e = engine_.at<Edge>(e)->next) {
    const Edge& edge = *engine_.at<Edge>(e);
    if (edge.structure != id_ || edge.kind != kWrite) continue;
    const Handle version = static_cast<const WriteEdge&>(edge).version;
    if (version == 0) continue;
    for_each_reader_behind(*at(version), call, end, [&](ReadEdge& read) {
      engine_.doubt(engine_.call(read.call));
      return true;
    });
  }
}

// --- Taking back -----------------------------------------------------------------------------

void ModStructure::retract(Call& call, Edge& edge) noexcept {
  if (edge.kind == kRead) return unlink_reader(static_cast<ReadEdge&>(edge));
  const auto& write = static_cast<const WriteEdge&>(edge);
  if (write.version == 0) return;
  Version& version = *at(write.version);
  Version* previous = predecessor(write.head, version);
  bool same = false;
  if (previous != nullptr && !unconfirmed(*previous)) {  // else its readers must ask anew
    try {
      same = types_[version.type].same(*previous, version);
    } catch (...) {  // client code that fails here makes the readers run again
    }
  }
  if (engine_.observer_ != nullptr && !same) [[unlikely]] {
    engine_.note(Event::Kind::reverted, &call, write.head);
  }
  if (same) {
    forget_order(version);
    while (version.readers != 0) move_reader(*reader(version.readers), *previous);
  }
  leave_past(write.head, version, 0);
  forget_version(write.head, version);
}

void ModStructure::forget_version(Handle head, Version& version) noexcept {
  if (const std::uint32_t h = at(head)->history; h != 0) {
    history(h).versions.erase(handle_of(version), order());
    drop_history(head);
  }
  version.writer = 0;
  if (handle_of(version) == head) return;
  engine_.arena().release(handle_of(version), types_[version.type].bytes);
}

void ModStructure::destroy_values(const Call& call) noexcept {
  engine_.for_each_edge(call, [&](const Edge& edge) {
    if (edge.structure != id_) return;
    const bool reads = edge.kind == kRead;
    const Handle v = reads ? static_cast<const ReadEdge&>(edge).version
                           : static_cast<const WriteEdge&>(edge).version;
    if (v == 0 || !at(v)->written || (reads && !at(v)->past)) return;
    types_[at(v)->type].destroy(*at(v));
    at(v)->written = false;
  });
}

// What lies there is not known to the engine: anything aligned may be a modifiable. Whether it is
// one, others know: the read that has seen it, its history, or the call that has written it.
ModStructure::Use ModStructure::use_within(Handle from, std::size_t bytes) const noexcept {
  for (Handle h = from; (h - from) * Arena::kGranule + sizeof(Version) <= bytes; ++h) {
    if (const Use use = use_of(h); use.call != nullptr) return use;
  }
  return {};
}

ModStructure::Use ModStructure::use_of(Handle head) const noexcept {
  const Version& version = *at(head);
  if (const std::uint32_t h = version.history; h != 0) {
    if (h >= histories_.size() || history(h).head != head) return {};
    return {&writer(*at(history(h).versions.first())), head, true};
  }
  const auto has_edge = [&](Handle call, auto&& matches) {
    if (!engine_.is_live_call(call)) return false;
    bool found = false;
    engine_.for_each_edge(engine_.call(call), [&](const Edge& edge) {
      found |= edge.structure == id_ && matches(edge);
    });
    return found;
  };
  if (engine_.arena().contains(version.readers, sizeof(ReadEdge))) {
    const ReadEdge& read = *reader(version.readers);
    const auto is_it = [&](const Edge& edge) {
      return &edge == &read && edge.kind == kRead && read.version == head;
    };
    if (has_edge(read.call, is_it)) return {&engine_.call(read.call), head, false};
  }
  const auto writes_it = [&](const Edge& edge) {
    return edge.kind == kWrite && static_cast<const WriteEdge&>(edge).version == head;
  };
  if (has_edge(version.writer, writes_it)) return {&writer(version), head, true};
  return {};
}

// --- For people and for traces ---------------------------------------------------------------

void ModStructure::label(const Call&, const Edge& edge, LabelSink& sink) const {
  if (edge.kind != kRead) return;
  const auto& read = static_cast<const ReadEdge&>(edge);
  if (read.version != 0) types_[at(read.version)->type].label(*at(read.version), sink);
}

void ModStructure::print(const Call&, const Edge& edge, std::ostream& out) const {
  const bool reads = edge.kind == kRead;
  const Handle v = reads ? static_cast<const ReadEdge&>(edge).version
                         : static_cast<const WriteEdge&>(edge).version;
  out << (reads ? "reads " : "writes ");
  if (!reads) out << engine_.describe_mod(static_cast<const WriteEdge&>(edge).head) << ": ";
  if (v == 0 || !at(v)->written) {
    out << "nothing";
  } else {
    types_[at(v)->type].print(*at(v), out);
  }
}

std::size_t ModStructure::bytes() const noexcept {
  std::size_t total = histories_.capacity() * sizeof(histories_[0]);
  for (const History& h : histories_) total += h.versions.bytes();
  for (const auto& [version, readers] : reader_orders_) total += 64 + readers.bytes();
  return total;
}

void ModStructure::shrink() {
  for (const auto& [version, readers] : reader_orders_) at(version)->ordered = false;
  std::unordered_map<Handle, TraceOrder>().swap(reader_orders_);
  std::sort(free_histories_.begin(), free_histories_.end());
  while (!free_histories_.empty() && free_histories_.back() + 1 == histories_.size()) {
    free_histories_.pop_back();
    histories_.pop_back();
  }
  histories_.shrink_to_fit();
  std::vector<std::uint32_t> free;
  free.reserve(histories_.size());  // so that drop_history cannot fail
  free.assign(free_histories_.begin(), free_histories_.end());
  free_histories_.swap(free);
}

// --- Invariants ------------------------------------------------------------------------------

void ModStructure::check_invariants(Handle head) const {
  Handle previous = 0;
  const auto check = [&](Handle v, Handle next) {
    SAC_INVARIANT(at(v)->written && (previous == 0 || order()(previous, v)));
    Handle last = 0;
    std::size_t count = 0;
    for (Handle r = at(v)->readers; r != 0; last = r, r = reader(r)->next_reader, ++count) {
      SAC_INVARIANT(reader(r)->version == v && reader(r)->prev == last);
      const Call& call = engine_.call(reader(r)->call);
      SAC_INVARIANT(&writer(*at(v)) == &call || engine_.precedes(writer(*at(v)), call));
      SAC_INVARIANT(next == 0 || !engine_.precedes(writer(*at(next)), call));
    }
    if (at(v)->ordered) {
      const TraceOrder& readers = reader_orders_.at(v);
      SAC_INVARIANT(readers.size() == count);
      Handle before = 0;
      readers.for_each([&](Handle r) {
        SAC_INVARIANT(reader(r)->version == v && (before == 0 || reader_order()(before, r)));
        before = r;
      });
    }
    previous = v;
  };
  if (at(head)->history == 0) return check(head, 0);
  const TraceOrder& versions = history(at(head)->history).versions;
  SAC_INVARIANT(versions.size() > 1 || versions.first() != head);
  Handle before = 0;
  versions.for_each([&](Handle v) {
    if (before != 0) check(before, v);
    before = v;
  });
  check(before, 0);
}

void ModStructure::check_writes(const Call& call) const {
  engine_.for_each_edge(call, [&](const Edge& edge) {
    if (edge.structure != id_) return;
    if (edge.kind == kRead) {
      const auto& read = static_cast<const ReadEdge&>(edge);
      SAC_INVARIANT(read.version != 0 && &engine_.call(read.call) == &call);
      SAC_INVARIANT(at(read.version)->written && !at(read.version)->past);
      const Handle self = engine_.arena().handle_of(&edge);
      SAC_INVARIANT((read.prev != 0 ? reader(read.prev)->next_reader
                                    : at(read.version)->readers) == self);
      return;
    }
    const auto& write = static_cast<const WriteEdge&>(edge);
    SAC_INVARIANT(write.version != 0 && &writer(*at(write.version)) == &call);
    const std::uint32_t h = at(write.head)->history;
    if (h == 0 || history(h).versions.first() == write.version) check_invariants(write.head);
  });
}

}  // namespace sac
