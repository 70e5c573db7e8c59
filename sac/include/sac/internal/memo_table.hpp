// label -> live call: finds the call to reuse.
//
// One array of (hash, call), in the order of the hashes: an entry lies at or behind the place that
// its hash has in proportion to all hashes, and a search ends at a larger hash. So the calls
// themselves are touched only where a hash matches, and the table grows by one pass from front to
// back. 10 to 17 bytes a call.
//
// In a first run nobody searches: insert_soon() only notes the entry. All that wait are put into the
// table together, while the places of the next are fetched into the cache.
//
// Calls discarded in the propagation under way stay findable until it ends, so that a program which
// asks for them again (not monotone) can be told.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sac/internal/huge_pages.hpp"
#include "sac/trace.hpp"

namespace sac {

class MemoTable {
 public:
  explicit MemoTable(Arena& arena)
      : arena_(arena), entries_(kFirst + kFirst / 2), places_(kFirst) {}

  /// Throws: std::bad_alloc, and then changes nothing. Cost: O(1) expected.
  void insert(Handle call, std::uint32_t hash) {
    make_room();
    put({hash, call});
    ++size_;
  }

  /// As insert(), but into the table by settle() or the next search. Throws: std::bad_alloc, and
  /// then changes nothing.
  void insert_soon(Handle call, std::uint32_t hash) {
    waiting_.push_back({hash, call});
    if (waiting_.size() <= kAhead) fetch(waiting_.back());
    ++size_;
  }
  /// Puts what waits into the table. Throws: std::bad_alloc, and then it waits on.
  void settle();
  void forget_waiting() noexcept;

  /// Does nothing if the call is not there, under this hash. Requires: it does not wait.
  void erase(Handle call, std::uint32_t hash) noexcept;

  /// Calls `visit(handle, call)` for every call of this hash until it returns true; the handle it
  /// stopped at, or 0.
  template <class Visit>
  [[nodiscard]] Handle find(std::uint32_t hash, Visit&& visit) {
    if (!waiting_.empty()) settle();
    for (std::size_t i = place(hash);; ++i) {
      const Entry& e = entries_[i];
      if (e.call == 0 || e.hash > hash) return 0;
      if (e.hash == hash && visit(e.call, *arena_.at<Call>(e.call))) return e.call;
    }
  }

  /// Whether the call is there, under this hash.
  [[nodiscard]] bool contains(Handle call, std::uint32_t hash) const noexcept;

  /// Calls `visit(call)` for every call of the table.
  template <class Visit>
  void for_each(Visit&& visit) const {
    for (const Entry& e : waiting_) visit(*arena_.at<Call>(e.call));
    for (const Entry& e : entries_) {
      if (e.call != 0) visit(*arena_.at<Call>(e.call));
    }
  }

  /// Gives memory back that fewer calls do not need. Throws: std::bad_alloc, and then changes
  /// nothing.
  void shrink();

  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  [[nodiscard]] std::size_t bytes() const noexcept {
    return (entries_.capacity() + waiting_.capacity()) * sizeof(Entry);
  }

  void check_invariants() const;

 private:
  struct Entry {
    std::uint32_t hash = 0;
    Handle call = 0;
  };
  static constexpr std::size_t kFirst = 512;
  static constexpr std::size_t kAhead = 16;  // more misses at once than a core can have

  [[nodiscard]] std::size_t place(std::uint32_t hash) const noexcept {
    return static_cast<std::size_t>(std::uint64_t{hash} * places_ >> 32);
  }
  // At most 4 calls to 5 places.
  void make_room() {
    if (5 * (size_ + 1) > 4 * places_) resize(places_ + places_ / 2);
  }
  void fetch(const Entry& entry) const noexcept {
    __builtin_prefetch(&entries_[place(entry.hash)], 1);
  }
  void put(Entry entry);
  void resize(std::size_t places);

  Arena& arena_;
  using Entries = std::vector<Entry, HugePages<Entry>>;
  Entries entries_;  // the places, and room for those pushed behind the last
  Entries waiting_;
  std::size_t places_;
  std::size_t size_ = 0;  // with those that wait
};

}  // namespace sac
