// Who has read a version.
#include <algorithm>
#include <new>

#include "sac/internal/mod_structure.hpp"

namespace sac {

void ModStructure::link_reader(ReadEdge& edge, Version& version) noexcept {
  const Handle self = engine_.arena().handle_of(&edge);
  edge.version = handle_of(version);
  edge.prev = 0;
  edge.next_reader = version.readers;
  if (version.readers != 0) reader(version.readers)->prev = self;
  version.readers = self;
  if (version.ordered) [[unlikely]]
    put_in_order(edge, version);
}

void ModStructure::put_in_order(const ReadEdge& edge, Version& version) noexcept {
  try {
    auto& readers = reader_orders_.find(edge.version)->second;
    readers.insert(engine_.arena().handle_of(&edge), reader_order());
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

void ModStructure::order_readers(const Version& version) noexcept {
  try {
    std::vector<Handle> readers;
    for (Handle r = version.readers; r != 0; r = reader(r)->next_reader) readers.push_back(r);
    std::sort(readers.begin(), readers.end(), reader_order());
    SortedIndex<Handle> order;
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

void ModStructure::orphan(ReadEdge& edge) noexcept {
  unlink_reader(edge);
  edge.version = 0;
  engine_.invalidate(edge.place);
}

}  // namespace sac
