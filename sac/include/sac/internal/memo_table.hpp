// label -> live call: finds the call to reuse.
//
// One array of (hash, call), in the order of the hashes: an entry lies at or behind the place that
// its hash has in proportion to all hashes, and a search ends at a larger hash. So the calls
// themselves are touched only where a hash matches, and the table grows by one pass from front to
// back. 10 to 17 bytes a call.
//
// A first run does not search: insert_soon() only lists the entry. All listed entries are put into
// the table together, while the next ones are prefetched into the cache.
//
// Calls discarded in the current propagation stay in the table until it ends, so that the audit can
// report a program that requests them again (not monotone).
//
// Where many calls have one hash (a program that is not concise), those that have a place leave the
// array for a crowd, which is kept in trace order: the one to reuse is the first that lies ahead.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "sac/huge_pages.hpp"
#include "sac/internal/sorted_index.hpp"
#include "sac/internal/timeline.hpp"
#include "sac/trace.hpp"

namespace sac {

class MemoTable {
 public:
  MemoTable(Arena& arena, const Timeline& timeline)
      : arena_(arena), timeline_(timeline), entries_(kFirst + kFirst / 2), places_(kFirst) {}

  /// Throws: std::bad_alloc, and then changes nothing. Cost: O(1) expected.
  void insert(Ref<Call> call, std::uint32_t hash) {
    make_room();
    put({hash, call});
    ++size_;
  }
  /// A call of the table has got its place; is about to lose it. Needed only if has_crowds(), and
  /// not for posted calls. placed() throws std::bad_alloc, and then changes nothing.
  void placed(Ref<Call> call, std::uint32_t hash);
  void leaves(Ref<Call> call, std::uint32_t hash) noexcept;
  [[nodiscard]] bool has_crowds() const noexcept { return !crowds_.empty(); }

  /// As insert(), but into the table by settle() or the next search. Throws: std::bad_alloc, and
  /// then changes nothing.
  void insert_soon(Ref<Call> call, std::uint32_t hash) {
    if (waiting_count_ == waiting_.size()) [[unlikely]]
      make_room_to_wait();
    waiting_[waiting_count_++] = {hash, call};
    ++size_;
  }
  /// Puts what waits into the table. Throws: std::bad_alloc, and then it waits on.
  void settle();
  void forget_waiting() noexcept;

  /// Does nothing if the call is not there, under this hash. Requires: it does not wait.
  void erase(Ref<Call> call, std::uint32_t hash) noexcept;

  /// A call of this hash that `fits(call)`; null if there is none. Of a crowd only the first is
  /// asked.
  template <class Fits>
  [[nodiscard]] Ref<Call> find(std::uint32_t hash, Fits&& fits) {
    if (waiting_count_ != 0) settle();
    for (std::size_t i = place(hash);; ++i) {
      const Entry& e = entries_[i];
      if (e.call == nullptr || e.hash > hash) break;
      if (e.hash == hash && fits(at(e.call))) return e.call;
    }
    if (const Crowd* crowd = crowd_of(hash); crowd != nullptr && fits(at(crowd->first()))) {
      return crowd->first();
    }
    return nullptr;
  }
  /// One that `fits(call)` and lies between the time stamps `from` and `to`; null: the end.
  template <class Fits>
  [[nodiscard]] Ref<Call> find_between(std::uint32_t hash, Place from, Place to, Fits&& fits) {
    const auto lies_before = [&](const Call& c) {
      return to == nullptr || timeline_.precedes(c, arena_[to]);
    };
    const Ref<Call> found = find(hash, [&](const Call& c) {
      return fits(c) && timeline_.precedes(arena_[from], c) && lies_before(c);
    });
    if (found != nullptr) return found;
    const Crowd* crowd = crowd_of(hash);
    while (crowd != nullptr) {
      const Ref<Call>* ahead = crowd
                                   ->place_of(from,
                                              [&](Place place, Ref<Call> c) {
                                                return timeline_.precedes(arena_[place], at(c));
                                              })
                                   .behind;
      if (ahead == nullptr || !lies_before(at(*ahead))) break;
      if (fits(at(*ahead))) return *ahead;
      from = *ahead;
    }
    return nullptr;
  }

  /// Whether the call is there, under this hash.
  [[nodiscard]] bool contains(Ref<Call> call, std::uint32_t hash) const noexcept;

  /// Calls `visit(call)` for every call of the table.
  template <class Visit>
  void for_each(Visit&& visit) const {
    for (const Entry& e : waiting()) visit(at(e.call));
    for (const Entry& e : entries_) {
      if (e.call != nullptr) visit(at(e.call));
    }
    for (const auto& [hash, crowd] : crowds_) crowd.for_each([&](Ref<Call> h) { visit(at(h)); });
  }

  /// Gives memory back that fewer calls do not need. Throws: std::bad_alloc, and then changes
  /// nothing.
  void shrink();

  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  [[nodiscard]] std::size_t bytes() const noexcept;

  void check_invariants() const;

 private:
  struct Entry {
    std::uint32_t hash = 0;
    Ref<Call> call;
  };
  static constexpr std::size_t kFirst = 512;
  static constexpr std::size_t kAhead = 16;  // more misses at once than a core can have
  static constexpr std::size_t kCrowd = 32;  // so many calls of one hash are searched one by one
  using Crowd = SortedIndex<Ref<Call>>;      // never empty

  [[nodiscard]] Call& at(Ref<Call> call) const noexcept { return arena_[call]; }
  struct Order {
    const MemoTable& table;
    bool operator()(Ref<Call> a, Ref<Call> b) const noexcept {
      return table.timeline_.precedes(table.at(a), table.at(b));
    }
  };
  [[nodiscard]] Order order() const noexcept { return {*this}; }
  [[nodiscard]] const Crowd* crowd_of(std::uint32_t hash) const {
    if (crowds_.empty()) [[likely]]
      return nullptr;
    const auto it = crowds_.find(hash);
    return it != crowds_.end() ? &it->second : nullptr;
  }
  [[nodiscard]] bool belongs_in_crowd(const Call& call) const noexcept {
    return !call.posted && (call.life == Life::placed || call.life == Life::running);
  }

  [[nodiscard]] std::size_t place(std::uint32_t hash) const noexcept {
    return static_cast<std::size_t>(std::uint64_t{hash} * places_ >> 32);
  }
  [[nodiscard]] std::span<const Entry> waiting() const noexcept {
    return {waiting_.data(), waiting_count_};
  }
  [[gnu::noinline]] void make_room_to_wait() {
    waiting_.resize(std::max(kFirst, 2 * waiting_.size()));
  }
  // At most 4 calls to 5 places.
  void make_room() {
    if (5 * (size_ + 1) > 4 * places_) resize(places_ + places_ / 2);
  }
  void fetch(const Entry& entry) const noexcept {
    __builtin_prefetch(&entries_[place(entry.hash)], 1);
  }
  static constexpr std::size_t kNowhere = ~std::size_t{0};
  [[nodiscard]] std::size_t index_of(Ref<Call> call, std::uint32_t hash) const noexcept;
  [[nodiscard]] bool holds(const Crowd& crowd, Ref<Call> call) const noexcept;
  void put(Entry entry) {
    Entry& home = entries_[place(entry.hash)];
    if (home.call == nullptr && crowds_.empty()) {
      home = entry;
    } else {
      put_among(entry);
    }
  }
  void put_among(Entry entry);
  void put_in_array(Entry entry);
  void make_crowd(std::uint32_t hash);
  void take_out(std::size_t i) noexcept;
  void resize(std::size_t places);

  Arena& arena_;
  const Timeline& timeline_;
  using Entries = std::vector<Entry, HugePages<Entry>>;
  Entries entries_;                // the places, and room for those pushed behind the last
  Entries waiting_;                // room for those that wait
  std::size_t waiting_count_ = 0;  // so many of it wait
  std::unordered_map<std::uint32_t, Crowd> crowds_;  // by hash
  std::size_t places_;
  std::size_t size_ = 0;  // with those that wait, and the crowds
};

}  // namespace sac
