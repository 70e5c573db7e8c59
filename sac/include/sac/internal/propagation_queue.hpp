// Invalidated calls in trace order; pops the earliest.
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
    return (most_in_heap_ + most_in_run_) * sizeof(Handle);
  }

  /// Requires: the call is not queued and has a place in the timeline. Cost: O(1) behind the last
  /// of the run, else O(log size).
  void push(Handle call);
  /// The earliest call. Requires: not empty.
  [[nodiscard]] Handle front() const noexcept {
    if (heap_.empty()) return run_[run_begin_];
    return run_.empty() || before(heap_.front(), run_[run_begin_]) ? heap_.front()
                                                                   : run_[run_begin_];
  }
  [[nodiscard]] Handle pop();
  void erase(Call& call) noexcept;

  /// Makes one run of all, if the heap holds many and memory allows. Cost: O(size log size), with
  /// comparisons of numbers.
  void sort() noexcept;

  void check_invariants() const;

 private:
  // A position in the run; others are in the heap.
  static constexpr std::uint32_t kInRun = std::uint32_t{1} << 31;

  [[nodiscard]] Call* at(Handle h) const noexcept { return arena_.at<Call>(h); }
  [[nodiscard]] bool before(Handle a, Handle b) const noexcept {
    return timeline_.precedes(*at(a), *at(b));
  }
  void put(std::size_t position, Handle call) noexcept {
    heap_[position] = call;
    at(call)->queue = static_cast<std::uint32_t>(position + 1);
  }
  void append_to_run(Handle call) noexcept {
    run_.push_back(call);
    at(call)->queue = kInRun | static_cast<std::uint32_t>(run_.size());
    most_in_run_ = std::max(most_in_run_, run_.size());
  }
  void erase_from_run(std::size_t position) noexcept;
  void erase_from_heap(std::size_t position) noexcept;
  void sift_up(std::size_t position) noexcept;
  void sift_down(std::size_t position) noexcept;

  Arena& arena_;
  const Timeline& timeline_;
  std::vector<Handle> heap_;
  std::vector<Handle> run_;    // in order from run_begin_ on; 0: has left; the last is there
  std::size_t run_begin_ = 0;  // is there, unless the run is empty
  std::size_t size_ = 0;
  std::size_t most_in_heap_ = 0;  // since the last shrink()
  std::size_t most_in_run_ = 0;
};

}  // namespace sac
