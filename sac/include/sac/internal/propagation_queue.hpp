// Invalidated calls in the order of the places where they are invalid; pops the earliest.
//
// A place is a time stamp: of the call itself, of one of its segments, or, if the call depends on
// the result of a child, the last one of that child.
//
// A run of calls that came in order, consumed from its front, and a binary heap of the others. So
// the edits of a large batch, sorted once, and calls that invalidate the one behind them, cost O(1)
// each; the heap holds what comes in between. A queued call knows its position, so it can leave
// when it is discarded.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "sac/internal/timeline.hpp"
#include "sac/trace.hpp"

namespace sac {

class PropagationQueue {
 public:
  struct Entry {
    Ref<Call> call;
    Place place;
  };

  PropagationQueue(Arena& arena, const Timeline& timeline) : arena_(arena), timeline_(timeline) {}

  [[nodiscard]] bool empty() const noexcept { return size_ == 0; }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }

  /// Room for `count` calls in all, so that so many pushes cannot fail: in the heap. What the run
  /// has no room for goes there.
  void reserve(std::size_t count) {
    if (count > heap_.capacity()) heap_.reserve(count + count / 2);
    if (count > run_.capacity()) run_.reserve(count + count / 2);
  }

  /// Gives memory back that `count` calls do not need. Throws: std::bad_alloc, and then changes
  /// nothing.
  void shrink(std::size_t count);
  /// What the calls that waited at one time took at most; room for more has not been touched.
  [[nodiscard]] std::size_t bytes() const noexcept {
    return (most_in_heap_ + most_in_run_) * sizeof(Entry);
  }

  /// Requires: the call is not queued, `place` is in the timeline. Cost: O(1) behind the last of
  /// the run, else O(log size).
  void push(Entry entry);
  /// Where the call waits. Requires: it is queued.
  [[nodiscard]] Place place_of(const Call& call) const noexcept {
    const std::uint32_t position = call.queue;
    return ((position & kInRun) != 0 ? run_[(position & ~kInRun) - 1] : heap_[position - 1]).place;
  }
  /// The earliest one. Requires: not empty.
  [[nodiscard]] Entry front() const noexcept {
    if (heap_.empty()) return run_[run_begin_];
    return run_.empty() || before(heap_.front(), run_[run_begin_]) ? heap_.front()
                                                                   : run_[run_begin_];
  }
  [[nodiscard]] Entry pop();
  void erase(Call& call) noexcept;

  /// Makes one run of all, if the heap holds many and memory allows. Cost: O(size log size), with
  /// comparisons of numbers.
  void sort() noexcept;

  void check_invariants() const;

 private:
  // A position in the run; others are in the heap.
  static constexpr std::uint32_t kInRun = std::uint32_t{1} << 31;

  // At one place the call that has it comes before the one that depends on its result.
  [[nodiscard]] bool before(const Entry& a, const Entry& b) const noexcept {
    return a.place == b.place ? a.call == a.place && b.call != b.place
                              : timeline_.precedes(arena_[a.place], arena_[b.place]);
  }
  void put(std::size_t position, Entry entry) noexcept {
    heap_[position] = entry;
    arena_[entry.call].queue = static_cast<std::uint32_t>(position + 1);
  }
  void append_to_run(Entry entry) noexcept {
    run_.push_back(entry);
    arena_[entry.call].queue = kInRun | static_cast<std::uint32_t>(run_.size());
    most_in_run_ = std::max(most_in_run_, run_.size());
  }
  void erase_from_run(std::size_t position) noexcept;
  void erase_from_heap(std::size_t position) noexcept;
  void sift_up(std::size_t position) noexcept;
  void sift_down(std::size_t position) noexcept;

  Arena& arena_;
  const Timeline& timeline_;
  std::vector<Entry> heap_;
  std::vector<Entry> run_;     // in order from run_begin_ on; null: has left; the last is there
  std::size_t run_begin_ = 0;  // is there, unless the run is empty
  std::size_t size_ = 0;
  std::size_t most_in_heap_ = 0;  // since the last shrink()
  std::size_t most_in_run_ = 0;
};

}  // namespace sac
