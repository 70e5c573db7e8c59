// label -> live call: finds the call to reuse.
//
// Chained through the calls themselves; four bytes of table per call. Calls discarded in the
// propagation under way stay findable until it ends, so that a program which asks for them again
// (not monotone) can be told.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sac/trace.hpp"

namespace sac {

class MemoTable {
 public:
  explicit MemoTable(Arena& arena) : arena_(arena), buckets_(1024, 0) {}

  /// Throws: std::bad_alloc, and then changes nothing.
  void insert(Handle call) {
    if (size_ >= buckets_.size()) grow();
    Call& c = *at(call);
    Handle& head = buckets_[bucket(c.hash)];
    c.memo_next = head;
    head = call;
    ++size_;
  }

  void erase(Handle call) noexcept;

  /// Calls `visit(handle, call)` for every call of this hash until it returns true; the handle it
  /// stopped at, or 0.
  template <class Visit>
  [[nodiscard]] Handle find(std::uint32_t hash, Visit&& visit) const {
    for (Handle h = buckets_[bucket(hash)]; h != 0; h = at(h)->memo_next) {
      if (at(h)->hash == hash && visit(h, *at(h))) return h;
    }
    return 0;
  }

  /// Calls `visit(call)` for every call of the table.
  template <class Visit>
  void for_each(Visit&& visit) const {
    for (const Handle head : buckets_) {
      for (Handle h = head; h != 0; h = at(h)->memo_next) visit(*at(h));
    }
  }

  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  [[nodiscard]] std::size_t bytes() const noexcept { return buckets_.capacity() * sizeof(Handle); }

 private:
  [[nodiscard]] Call* at(Handle h) const noexcept { return arena_.at<Call>(h); }
  [[nodiscard]] std::size_t bucket(std::uint32_t hash) const noexcept {
    return hash & (buckets_.size() - 1);
  }
  void grow();

  Arena& arena_;
  std::vector<Handle> buckets_;
  std::size_t size_ = 0;
};

}  // namespace sac
