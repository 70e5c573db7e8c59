// The queue that a gamma-bucketed one approximates: least key first, of equals the last that came.
#pragma once

#include <cstddef>
#include <cstdint>
#include <queue>
#include <vector>

#include "sac/check.hpp"

namespace mesher::detail {

template <class Item>
class StrictQueue {
 public:
  [[nodiscard]] bool empty() const noexcept { return heap_.empty(); }
  [[nodiscard]] std::size_t size() const noexcept { return heap_.size(); }

  /// Strong guarantee. Cost: O(log n).
  void insert(double key, const Item& item) { heap_.push({key, came_++, item}); }
  /// Requires: !empty(). Cost: O(log n).
  [[nodiscard]] Item delete_min() {
    SAC_EXPECTS(!empty());
    const Item item = heap_.top().item;
    heap_.pop();
    return item;
  }

 private:
  struct Entry {
    double key;
    std::uint64_t came;
    Item item;
    bool operator<(const Entry& other) const noexcept {  // it is out later
      return key != other.key ? key > other.key : came < other.came;
    }
  };

  std::priority_queue<Entry> heap_;
  std::uint64_t came_ = 0;
};

}  // namespace mesher::detail
