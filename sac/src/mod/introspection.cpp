// Modifiables seen from outside: uses of released ones, labels, prints, memory, invariants.
#include <algorithm>

#include "sac/internal/mod_structure.hpp"

namespace sac {

using detail::History;
using detail::WriteEdge;

void ModStructure::destroy_values(const Call& call) noexcept {
  engine_.for_each_edge(call, [&](const Edge& edge) {
    if (edge.structure != id_) return;
    const bool reads = edge.kind == kRead;
    const Ref<Version> v = reads ? static_cast<const ReadEdge&>(edge).version
                                 : static_cast<const WriteEdge&>(edge).version;
    if (v == nullptr || !at(v).written || (reads && !at(v).past)) return;
    types_[at(v).type].destroy(at(v));
    at(v).written = false;
  });
}

// --- Use of what is released -----------------------------------------------------------------

// What lies there is not known to the engine: anything aligned may be a modifiable. Whether it is
// one, others know: the read that has seen it, its history, or the call that has written it.
ModStructure::Use ModStructure::use_within(Handle from, std::size_t bytes) const noexcept {
  for (Handle h = from; (h - from) * Arena::kGranule + sizeof(Version) <= bytes; ++h) {
    if (const Use use = use_of(ModRef(h)); use.call != nullptr) return use;
  }
  return {};
}

ModStructure::Use ModStructure::use_of(ModRef head) const noexcept {
  const Version& version = at(head);
  if (const std::uint32_t h = version.history; h != 0) {
    if (h >= histories_.size() || history(h).head != head) return {};
    return {&writer(at(history(h).versions.first())), head, true};
  }
  const auto has_edge = [&](Place place, auto&& matches) {
    if (!engine_.is_live_place(place)) return false;
    bool found = false;
    engine_.for_each_edge(engine_.call_at(place), [&](const Edge& edge) {
      found |= edge.structure == id_ && matches(edge);
    });
    return found;
  };
  if (engine_.arena().contains(version.readers)) {
    const ReadEdge& read = at(version.readers);
    const auto is_it = [&](const Edge& edge) {
      return &edge == &read && edge.kind == kRead && read.version == head;
    };
    if (has_edge(read.place, is_it)) return {&engine_.call_at(read.place), head, false};
  }
  const auto writes_it = [&](const Edge& edge) {
    return edge.kind == kWrite && static_cast<const WriteEdge&>(edge).version == head;
  };
  if (has_edge(version.place, writes_it)) return {&writer(version), head, true};
  return {};
}

// --- For people and for traces ---------------------------------------------------------------

void ModStructure::label(const Call&, const Edge& edge, LabelSink& sink) const {
  if (edge.kind != kRead) return;
  const auto& read = static_cast<const ReadEdge&>(edge);
  if (read.version != nullptr) types_[at(read.version).type].label(at(read.version), sink);
}

void ModStructure::print(const Call&, const Edge& edge, std::ostream& out) const {
  const bool reads = edge.kind == kRead;
  const Ref<Version> v = reads ? static_cast<const ReadEdge&>(edge).version
                               : static_cast<const WriteEdge&>(edge).version;
  out << (reads ? "reads " : "writes ");
  if (!reads) out << engine_.describe_mod(static_cast<const WriteEdge&>(edge).head) << ": ";
  if (v == nullptr || !at(v).written) {
    out << "nothing";
  } else {
    types_[at(v).type].print(at(v), out);
  }
}

std::size_t ModStructure::bytes() const noexcept {
  std::size_t total = histories_.capacity() * sizeof(histories_[0]);
  for (const History& h : histories_) total += h.versions.bytes();
  for (const auto& [version, readers] : reader_orders_) total += 64 + readers.bytes();
  return total;
}

void ModStructure::shrink() {
  for (const auto& [version, readers] : reader_orders_) at(Ref<Version>(version)).ordered = false;
  decltype(reader_orders_)().swap(reader_orders_);
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

// `v` lies between two versions; 0: none.
void ModStructure::check_version(Ref<Version> v, Ref<Version> previous, Ref<Version> next) const {
  const Version& version = at(v);
  SAC_INVARIANT(version.written && (previous == nullptr || order()(previous, v)));
  Ref<ReadEdge> last;
  std::size_t count = 0;
  for (Ref<ReadEdge> r = version.readers; r != nullptr; last = r, r = at(r).next_reader, ++count) {
    SAC_INVARIANT(at(r).version == v && at(r).prev == last);
    const Place place = at(r).place;
    SAC_INVARIANT(version.place == place || precedes(version.place, place));
    SAC_INVARIANT(next == nullptr || !precedes(at(next).place, place));
  }
  if (!version.ordered) return;
  const auto& readers = reader_orders_.at(v.handle());
  SAC_INVARIANT(readers.size() == count);
  Ref<ReadEdge> before;
  readers.for_each([&](Ref<ReadEdge> r) {
    SAC_INVARIANT(at(r).version == v && (before == nullptr || order()(before, r)));
    before = r;
  });
}

void ModStructure::check_modifiable(ModRef head) const {
  if (at(head).history == 0) return check_version(head, nullptr, nullptr);
  const auto& versions = history(at(head).history).versions;
  SAC_INVARIANT(versions.size() > 1 || versions.first() != head);
  Ref<Version> before;
  Ref<Version> current;
  versions.for_each([&](Ref<Version> v) {
    if (current != nullptr) check_version(current, before, v);
    before = std::exchange(current, v);
  });
  check_version(current, before, nullptr);
}

void ModStructure::check_invariants() const {
  if (!engine_.settled()) return;
  engine_.walk([&](const Call& call, std::size_t) {
    engine_.for_each_edge(call, [&](const Edge& edge) {
      if (edge.structure != id_) return;
      if (edge.kind == kRead) {
        const auto& read = static_cast<const ReadEdge&>(edge);
        SAC_INVARIANT(read.version != nullptr && &engine_.call_at(read.place) == &call);
        SAC_INVARIANT(at(read.version).written && !at(read.version).past);
        const Ref<ReadEdge> self = Arena::ref(read);
        SAC_INVARIANT(
            (read.prev != nullptr ? at(read.prev).next_reader : at(read.version).readers) == self);
        return;
      }
      const auto& write = static_cast<const WriteEdge&>(edge);
      SAC_INVARIANT(write.version != nullptr && &writer(at(write.version)) == &call);
      SAC_INVARIANT(at(write.version).round == call.round);
      const std::uint32_t h = at(write.head).history;
      if (h == 0 || history(h).versions.first() == write.version) check_modifiable(write.head);
    });
  });
}

}  // namespace sac
