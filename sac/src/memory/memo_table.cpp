// Moving entries of the memo table.
#include "sac/internal/memo_table.hpp"

#include <algorithm>
#include <utility>

#include "sac/check.hpp"

namespace sac {

void MemoTable::put_among(Entry entry) {
  if (!crowds_.empty() && belongs_in_crowd(at(entry.call))) [[unlikely]] {
    if (const auto it = crowds_.find(entry.hash); it != crowds_.end()) {
      return it->second.insert(entry.call, order());
    }
  }
  put_in_array(entry);
}

// Pushes larger hashes one place on. The last entry stays free, to end every search.
void MemoTable::put_in_array(Entry entry) {
  std::size_t i = place(entry.hash);
  std::size_t equal = 0;
  for (; entries_[i].call != nullptr && entries_[i].hash <= entry.hash; ++i) {
    equal += entries_[i].hash == entry.hash;
  }
  if (equal >= kCrowd && !crowds_.contains(entry.hash)) [[unlikely]] {
    make_crowd(entry.hash);
    if (crowds_.contains(entry.hash)) return put(entry);
  }
  std::size_t free = i;
  while (entries_[free].call != nullptr) ++free;
  if (free + 1 >= entries_.size()) {
    entries_.resize(entries_.size() + entries_.size() / 2);  // many equal hashes, near the end
  }
  std::move_backward(entries_.begin() + static_cast<std::ptrdiff_t>(i),
                     entries_.begin() + static_cast<std::ptrdiff_t>(free),
                     entries_.begin() + static_cast<std::ptrdiff_t>(free + 1));
  entries_[i] = entry;
}

// The entries of this hash that have a place leave the array.
void MemoTable::make_crowd(std::uint32_t hash) {
  Crowd crowd;
  const auto for_each = [&](auto&& visit) {
    for (std::size_t i = place(hash); entries_[i].call != nullptr && entries_[i].hash <= hash;) {
      const bool leaves = entries_[i].hash == hash && belongs_in_crowd(at(entries_[i].call));
      if (!leaves || visit(i)) ++i;
    }
  };
  for_each([&](std::size_t i) {
    crowd.insert(entries_[i].call, order());
    return true;
  });
  if (crowd.empty()) return;
  crowds_.emplace(hash, std::move(crowd));
  for_each([&](std::size_t i) {
    take_out(i);
    return false;
  });
}

void MemoTable::placed(Ref<Call> call, std::uint32_t hash) {
  const auto crowd = crowds_.find(hash);
  if (crowd == crowds_.end()) return;
  const std::size_t i = index_of(call, hash);
  if (i == kNowhere) return;
  crowd->second.insert(call, order());
  take_out(i);
}

void MemoTable::leaves(Ref<Call> call, std::uint32_t hash) noexcept {
  const auto crowd = crowds_.find(hash);
  if (crowd == crowds_.end() || !holds(crowd->second, call)) return;
  crowd->second.erase(call, order());
  --size_;
  if (crowd->second.empty()) crowds_.erase(crowd);
}

// In the order in which they came: of calls with equal labels the first is found first.
void MemoTable::settle() {
  if (5 * size_ > 4 * places_) resize(std::max(2 * size_, places_ + places_ / 2));
  std::size_t done = 0;
  try {
    for (; done < waiting_count_; ++done) {
      if (done + kAhead < waiting_count_) fetch(waiting_[done + kAhead]);
      put(waiting_[done]);
    }
  } catch (...) {
    waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(done));
    waiting_count_ -= done;
    throw;
  }
  waiting_count_ = 0;
  if (waiting_.size() > kFirst) Entries().swap(waiting_);
}

void MemoTable::forget_waiting() noexcept {
  size_ -= std::exchange(waiting_count_, 0);
  Entries().swap(waiting_);
}

void MemoTable::erase(Ref<Call> call, std::uint32_t hash) noexcept {
  const std::size_t i = index_of(call, hash);
  if (i == kNowhere) return;
  --size_;
  take_out(i);
}

std::size_t MemoTable::index_of(Ref<Call> call, std::uint32_t hash) const noexcept {
  std::size_t i = place(hash);
  for (; entries_[i].call != call; ++i) {
    if (entries_[i].call == nullptr || entries_[i].hash > hash) return kNowhere;
  }
  return i;
}

bool MemoTable::holds(const Crowd& crowd, Ref<Call> call) const noexcept {
  const Ref<Call>* found = crowd.place_of(call, order()).before;
  return found != nullptr && *found == call;
}

void MemoTable::take_out(std::size_t i) noexcept {
  for (; entries_[i + 1].call != nullptr && place(entries_[i + 1].hash) <= i; ++i) {
    entries_[i] = entries_[i + 1];
  }
  entries_[i] = {};
}

bool MemoTable::contains(Ref<Call> call, std::uint32_t hash) const noexcept {
  for (const Entry& e : waiting()) {
    if (e.call == call) return e.hash == hash;
  }
  if (const std::size_t i = index_of(call, hash); i != kNowhere) return entries_[i].hash == hash;
  const Crowd* crowd = crowd_of(hash);
  return crowd != nullptr && holds(*crowd, call);
}

std::size_t MemoTable::bytes() const noexcept {
  std::size_t total = (entries_.capacity() + waiting_.capacity()) * sizeof(Entry);
  for (const auto& [hash, crowd] : crowds_) total += 64 + crowd.bytes();
  return total;
}

// Entries come in the order of their hashes, and are put down in it.
void MemoTable::resize(std::size_t places) {
  Entries fresh(places + places / 16 + 64);
  const auto place_in_fresh = [&](std::uint32_t hash) {
    return static_cast<std::size_t>(std::uint64_t{hash} * places >> 32);
  };
  std::size_t next = 0;
  for (const Entry& e : entries_) {
    if (e.call == nullptr) continue;
    next = std::max(next, place_in_fresh(e.hash));
    if (next + 1 >= fresh.size()) fresh.resize(fresh.size() + fresh.size() / 2);
    fresh[next++] = e;
  }
  entries_.swap(fresh);
  places_ = places;
}

void MemoTable::shrink() {
  const std::size_t needed = std::max(kFirst, size_ + size_ / 2);
  if (needed < places_) resize(needed);
}

void MemoTable::check_invariants() const {
  std::size_t count = waiting_count_;
  std::uint32_t last = 0;
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const Entry& e = entries_[i];
    if (e.call == nullptr) continue;
    SAC_INVARIANT(place(e.hash) <= i && last <= e.hash);
    SAC_INVARIANT(place(e.hash) == i || entries_[i - 1].call != nullptr);
    last = e.hash;
    ++count;
  }
  for (const auto& [hash, crowd] : crowds_) {
    SAC_INVARIANT(!crowd.empty());
    Ref<Call> previous;
    crowd.for_each([&](Ref<Call> h) {
      SAC_INVARIANT(previous == nullptr || order()(previous, h));
      previous = h;
      ++count;
    });
  }
  SAC_INVARIANT(count == size_ && entries_.back().call == nullptr);
}

}  // namespace sac
