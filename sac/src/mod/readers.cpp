// Who has read a version.
#include <algorithm>
#include <new>

#include "sac/internal/mod_structure.hpp"

namespace sac {

void ModStructure::link_reader(ReadEdge& edge, Version& version) noexcept {
  edge.version = Arena::ref(version);
  detail::Readers::push(engine_.arena(), version.readers, edge);
  if (version.ordered) [[unlikely]]
    put_in_order(edge, version);
}

void ModStructure::put_in_order(const ReadEdge& edge, Version& version) noexcept {
  try {
    readers_in_order(version).insert(Arena::ref(edge), order());
  } catch (const std::bad_alloc&) {
    forget_order(version);
  }
}

void ModStructure::unlink_reader(ReadEdge& edge) noexcept {
  if (edge.version == nullptr) return;
  Version& version = at(edge.version);
  if (version.ordered) [[unlikely]] {
    const Ref<ReadEdge> self = Arena::ref(edge);
    readers_in_order(version).erase(self, order());
  }
  detail::Readers::remove(engine_.arena(), version.readers, edge);
  if (version.past && version.readers == nullptr) free_past(version);
}

void ModStructure::move_reader(ReadEdge& edge, Version& to) noexcept {
  unlink_reader(edge);
  link_reader(edge, to);
}

void ModStructure::order_readers(const Version& version) noexcept {
  try {
    std::vector<Ref<ReadEdge>> readers;
    for (Ref<ReadEdge> r = version.readers; r != nullptr; r = at(r).next_reader)
      readers.push_back(r);
    std::sort(readers.begin(), readers.end(), order());
    SortedIndex<Ref<ReadEdge>> sorted;
    for (const Ref<ReadEdge> r : readers) sorted.append(r);
    reader_orders_[Arena::ref(version).handle()] = std::move(sorted);
    at(Arena::ref(version)).ordered = true;
  } catch (const std::bad_alloc&) {  // then they stay as they are
  }
}

void ModStructure::forget_order(Version& version) noexcept {
  if (!version.ordered) return;
  reader_orders_.erase(Arena::ref(version).handle());
  version.ordered = false;
}

void ModStructure::orphan(ReadEdge& edge) noexcept {
  unlink_reader(edge);
  edge.version = nullptr;
  engine_.invalidate(edge.place);
}

}  // namespace sac
