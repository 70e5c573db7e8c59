// Invalidated calls in trace order; pops the earliest.
//
// A binary heap of handles ordered by the timeline. A queued call knows its position, so it can
// leave when it is discarded.
#pragma once

#include <vector>

#include "sac/timeline.hpp"
#include "sac/trace.hpp"

namespace sac {

class PropagationQueue {
 public:
  PropagationQueue(Arena& arena, const Timeline& timeline) : arena_(arena), timeline_(timeline) {}

  [[nodiscard]] bool empty() const noexcept { return heap_.empty(); }
  [[nodiscard]] std::size_t size() const noexcept { return heap_.size(); }

  /// Room for `count` calls in all, so that so many pushes cannot fail.
  void reserve(std::size_t count) {
    if (count > heap_.capacity()) heap_.reserve(count + count / 2);
  }

  /// Gives memory back that `count` calls do not need. Throws: std::bad_alloc.
  void shrink(std::size_t count);
  /// What the calls that waited at one time took at most; room for more has not been touched.
  [[nodiscard]] std::size_t bytes() const noexcept { return most_ * sizeof(Handle); }

  /// Requires: the call is not queued and has a place in the timeline. Cost: O(log size).
  void push(Handle call);
  /// The earliest call. Requires: not empty.
  [[nodiscard]] Handle front() const noexcept { return heap_.front(); }
  [[nodiscard]] Handle pop();
  void erase(Call& call) noexcept;

  void check_invariants() const;

 private:
  [[nodiscard]] Call* at(Handle h) const noexcept { return arena_.at<Call>(h); }
  [[nodiscard]] bool before(Handle a, Handle b) const noexcept {
    return timeline_.precedes(*at(a), *at(b));
  }
  void put(std::size_t position, Handle call) noexcept {
    heap_[position] = call;
    at(call)->queue = static_cast<std::uint32_t>(position + 1);
  }
  void sift_up(std::size_t position) noexcept;
  void sift_down(std::size_t position) noexcept;

  Arena& arena_;
  const Timeline& timeline_;
  std::vector<Handle> heap_;
  std::size_t most_ = 0;  // calls that have waited at one time since the last shrink()
};

}  // namespace sac
