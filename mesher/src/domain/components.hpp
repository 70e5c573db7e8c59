// The regions of a triangulation as records, and marks on triangles for searches.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "domain/journal.hpp"
#include "domain/tiles.hpp"
#include "mesher/domain.hpp"

namespace mesher::detail {

struct Component {
  std::uint32_t size = 0;      // triangles
  std::uint32_t exits = 0;     // edges at the boundary of the triangulation that are no walls
  Slot any = kNone;            // one of the triangles; in a free record: the next free one
  std::uint32_t seed = kNone;  // the first of those in it
  RegionLabel label{};
};

/// Records by number; freed ones are used again.
class Components {
 public:
  Components() { free_.add(kNone); }

  [[nodiscard]] const Component& operator[](std::uint32_t c) const noexcept { return records_[c]; }
  [[nodiscard]] Component& edit(std::uint32_t c) { return records_.edit(c); }
  /// Numbers, free ones included. In a free record `size` is 0.
  [[nodiscard]] std::uint32_t size() const noexcept { return records_.size(); }

  std::uint32_t create() {
    const std::uint32_t c = free_[0];
    if (c == kNone) return records_.add({});
    free_.edit(0) = records_[c].any;
    records_.edit(c) = {};
    return c;
  }
  /// Requires: nothing is in it.
  void release(std::uint32_t c) {
    Component empty;
    empty.any = free_[0];
    records_.edit(c) = empty;
    free_.edit(0) = c;
  }

  void keep() noexcept {
    records_.keep();
    free_.keep();
  }
  void take_back() noexcept {
    records_.take_back();
    free_.take_back();
  }

 private:
  Journal<Component> records_;
  Journal<std::uint32_t> free_;  // one
};

/// A number on each slot, for one search at a time: what earlier ones left does not count.
class Marks {
 public:
  /// Makes `count` numbers ready that no slot has, the first of which is returned.
  std::uint32_t fresh(std::uint32_t slots, std::uint32_t count) {
    if (marks_.size() < slots) marks_.resize(slots);
    if (UINT32_MAX - next_ < count) {
      std::fill(marks_.begin(), marks_.end(), 0);
      next_ = 1;
    }
    next_ += count;
    return next_ - count;
  }
  [[nodiscard]] std::uint32_t& operator[](Slot s) noexcept { return marks_[s]; }
  [[nodiscard]] std::size_t bytes() const noexcept { return marks_.capacity() * sizeof(marks_[0]); }

 private:
  std::vector<std::uint32_t> marks_;
  std::uint32_t next_ = 1;
};

}  // namespace mesher::detail
