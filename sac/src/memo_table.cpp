// Growing and erasing of the memo table.
#include "sac/memo_table.hpp"

namespace sac {

void MemoTable::erase(Handle call) noexcept {
  Handle* link = &buckets_[bucket(at(call)->hash)];
  while (*link != call) link = &at(*link)->memo_next;
  *link = at(call)->memo_next;
  --size_;
}

void MemoTable::grow() {
  std::vector<Handle> wider(buckets_.size() * 2, 0);
  const std::size_t mask = wider.size() - 1;
  for (Handle head : buckets_) {
    while (head != 0) {
      Call& c = *at(head);
      const Handle next = c.memo_next;
      c.memo_next = wider[c.hash & mask];
      wider[c.hash & mask] = head;
      head = next;
    }
  }
  buckets_.swap(wider);
}

}  // namespace sac
