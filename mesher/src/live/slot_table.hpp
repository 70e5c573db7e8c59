// Records in slots, and the slot of each record.
//
// An update is planned, and then kept or dropped. All operations that may fail are in the plan, and
// nothing of it is visible before keep(). New records take the lowest free slots, ascending; the
// slot of a removed record is free from the next plan on.
//
// Slots are found by hashing, linear probing, in a table of slots alone: 6 to 12 bytes a record.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "mesher/live_mesh.hpp"
#include "sac/check.hpp"

namespace mesher::detail {

/// Room for `size` items, so that it doubles where it grows. Throws: std::bad_alloc.
template <class T>
void make_room(std::vector<T>& items, std::size_t size) {
  if (size > items.capacity()) items.reserve(std::max(size, items.capacity() * 2));
}

/// Hash{}(record): of equal records the same.
template <class Record, class Hash>
class SlotTable {
 public:
  /// By slot; a free slot has its last record.
  [[nodiscard]] std::span<const Record> records() const noexcept { return records_; }
  [[nodiscard]] const Record& operator[](Slot s) const noexcept { return records_[s]; }
  [[nodiscard]] bool is_live(Slot s) const noexcept { return s < live_.size() && live_[s] != 0; }
  /// How many there are, without free slots.
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  /// kNoSlot: there is none.
  [[nodiscard]] Slot find(const Record& record) const noexcept {
    if (buckets_.empty()) return kNoSlot;
    std::size_t i = home(record);
    while (buckets_[i] != kNoSlot && !(records_[buckets_[i]] == record)) i = next(i);
    return buckets_[i];
  }

  /// Plans that records come and slots are left. Requires: no plan; the records are not there, or
  /// leave; `leave`: live, each once. Throws: std::bad_alloc, and then drop() is due.
  void plan(std::vector<Record> come, std::vector<Slot> leave) {
    SAC_EXPECTS(come_.empty() && leave_.empty());
    come_ = std::move(come);
    leave_ = std::move(leave);
    free_left();
    choose_slots();
    make_room(records_, records_.size() + come_.size());
    make_room(live_, records_.size() + come_.size());
    make_buckets(size_ + come_.size());
  }
  /// Of the records that come, in their order; until keep().
  [[nodiscard]] const std::vector<Slot>& chosen() const noexcept { return chosen_; }
  /// How many slots there are when the plan is kept.
  [[nodiscard]] std::size_t planned_slots() const noexcept {
    return chosen_.empty() ? records_.size()
                           : std::max(records_.size(), std::size_t{chosen_.back()} + 1);
  }

  void keep() noexcept {
    const std::size_t slots = planned_slots();
    for (const Slot s : leave_) {
      erase(s);
      live_[s] = 0;
    }
    records_.resize(slots);
    live_.resize(slots, 0);
    for (std::size_t i = 0; i < come_.size(); ++i) {
      records_[chosen_[i]] = come_[i];
      live_[chosen_[i]] = 1;
      insert(chosen_[i]);
    }
    size_ = size_ + come_.size() - leave_.size();
    if (!leave_.empty()) left_.swap(leave_);  // which is empty since plan()
    forget();
  }
  /// Also of a plan that failed.
  void drop() noexcept {
    for (const Slot s : chosen_) {
      if (s < records_.size()) push_free(s);  // there is room: it was there
    }
    leave_.clear();
    forget();
  }

  [[nodiscard]] std::size_t bytes() const noexcept {
    return records_.capacity() * sizeof(Record) + live_.capacity() +
           (buckets_.capacity() + free_.capacity() + left_.capacity()) * sizeof(Slot);
  }
  /// Requires: no plan.
  void check_invariants() const {
    SAC_INVARIANT(come_.empty() && leave_.empty() && chosen_.empty());
    SAC_INVARIANT(live_.size() == records_.size());
    SAC_INVARIANT(std::is_heap(free_.begin(), free_.end(), std::greater<>()));
    std::vector<std::uint8_t> seen = live_;
    for (const auto* slots : {&free_, &left_}) {
      for (const Slot s : *slots) SAC_INVARIANT(s < seen.size() && seen[s]++ == 0);
    }
    SAC_INVARIANT(std::count(seen.begin(), seen.end(), 1) ==
                  static_cast<std::ptrdiff_t>(records_.size()));
    SAC_INVARIANT(size_ + free_.size() + left_.size() == records_.size());
    for (Slot s = 0; s < records_.size(); ++s) {
      if (is_live(s)) SAC_INVARIANT(find(records_[s]) == s);
    }
    const auto empty = std::count(buckets_.begin(), buckets_.end(), kNoSlot);
    SAC_INVARIANT(buckets_.size() - static_cast<std::size_t>(empty) == size_);
  }

 private:
  [[nodiscard]] std::size_t home(const Record& record) const noexcept {
    return Hash{}(record) & (buckets_.size() - 1);
  }
  [[nodiscard]] std::size_t next(std::size_t i) const noexcept {
    return (i + 1) & (buckets_.size() - 1);
  }
  [[nodiscard]] std::size_t steps(std::size_t from, std::size_t to) const noexcept {
    return (to - from) & (buckets_.size() - 1);
  }

  // Requires: there is an empty bucket.
  void insert(Slot s) noexcept {
    std::size_t i = home(records_[s]);
    while (buckets_[i] != kNoSlot) i = next(i);
    buckets_[i] = s;
  }
  // What follows moves up, where it may.
  void erase(Slot s) noexcept {
    std::size_t hole = home(records_[s]);
    while (buckets_[hole] != s) hole = next(hole);
    for (std::size_t i = next(hole); buckets_[i] != kNoSlot; i = next(i)) {
      if (steps(home(records_[buckets_[i]]), i) < steps(hole, i)) continue;
      buckets_[hole] = buckets_[i];
      hole = i;
    }
    buckets_[hole] = kNoSlot;
  }
  // For `size` records, of which some leave meanwhile: two thirds full at most.
  void make_buckets(std::size_t size) {
    std::size_t count = std::max<std::size_t>(buckets_.size(), 16);
    while (3 * size > 2 * count) count *= 2;
    if (count == buckets_.size()) return;
    std::vector<Slot> all(count, kNoSlot);
    buckets_.swap(all);
    for (const Slot s : all) {
      if (s != kNoSlot) insert(s);
    }
  }

  void push_free(Slot s) noexcept {
    free_.push_back(s);
    std::push_heap(free_.begin(), free_.end(), std::greater<>());
  }
  void free_left() {
    make_room(free_, free_.size() + left_.size());
    for (const Slot s : left_) push_free(s);
    left_.clear();
  }
  void choose_slots() {
    chosen_.reserve(come_.size());
    while (chosen_.size() < come_.size() && !free_.empty()) {
      std::pop_heap(free_.begin(), free_.end(), std::greater<>());
      chosen_.push_back(free_.back());
      free_.pop_back();
    }
    for (auto s = static_cast<Slot>(records_.size()); chosen_.size() < come_.size(); ++s) {
      chosen_.push_back(s);
    }
  }
  // Memory that was much is given back.
  void forget() noexcept {
    std::vector<Record>().swap(come_);
    chosen_.clear();
    if (chosen_.capacity() > kKept) std::vector<Slot>().swap(chosen_);
    if (leave_.capacity() > kKept) std::vector<Slot>().swap(leave_);
  }

  static constexpr std::size_t kKept = 4096;

  std::vector<Record> records_;
  std::vector<std::uint8_t> live_;
  std::vector<Slot> buckets_;  // a power of two of them, or none; kNoSlot: empty
  std::vector<Slot> free_;     // a heap, the lowest first
  std::vector<Slot> left_;     // in the last update: free from the next on
  std::size_t size_ = 0;
  // The plan.
  std::vector<Record> come_;
  std::vector<Slot> chosen_;  // for these; ascending
  std::vector<Slot> leave_;
};

}  // namespace mesher::detail
