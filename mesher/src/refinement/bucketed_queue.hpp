// The gamma-bucketed priority queue [Fig 1.5, Def 1.5.1]: the next item is one whose key is less
// than gamma times the smallest, in time that does not depend on how many there are.
//
// An item is in the bucket [l, gamma l) of its key; out comes the last that went into the first
// bucket. Two ways to find a bucket:
//   ComputedBuckets  by the key's bits: its exponent and the highest bits of its fraction. Buckets
//                    lie in an array, with a bit for each whether there is anything in it.
//   WalkedBuckets    in a sorted list, from the smallest on. Bounds of buckets are made by
//                    multiplying and dividing by gamma, so any gamma will do, and only as many
//                    buckets are kept as are in use. Who inserts near what came out last walks
//                    O(1).
// (Rounding may make neighbours overlap by a last bit. What is in the first bucket is in order all
// the same: nothing is below its lower bound.)
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

#include "delaunay/simplex_store.hpp"
#include "sac/check.hpp"

namespace mesher::detail {

/// Stacks of items in one array; a stack is called by its first place, or kNone.
template <class Item>
requires std::is_trivially_copyable_v<Item>
class ItemStacks {
 public:
  /// The next push finds room. Strong guarantee.
  void make_room() {
    if (free_ != kNone) return;
    SAC_EXPECTS(all_.size() < kNone);
    all_.push_back({Item{}, kNone});
    free_ = static_cast<std::uint32_t>(all_.size() - 1);
  }
  /// Requires: make_room() was called for it.
  void push(std::uint32_t& first, const Item& item) noexcept {
    const std::uint32_t at = free_;
    free_ = all_[at].next;
    all_[at] = {item, first};
    first = at;
  }
  /// Requires: first != kNone.
  [[nodiscard]] Item pop(std::uint32_t& first) noexcept {
    const std::uint32_t at = first;
    first = all_[at].next;
    all_[at].next = free_;
    free_ = at;
    return all_[at].item;
  }

 private:
  struct Place {
    Item item;
    std::uint32_t next;
  };
  std::vector<Place> all_;
  std::uint32_t free_ = kNone;
};

/// Keys of all queues here are normal and positive.
[[nodiscard]] inline bool is_key(double key) noexcept {
  return key >= std::numeric_limits<double>::min() && key <= std::numeric_limits<double>::max();
}

/// gamma = 1 + 2^-kFractionBits, or less.
template <class Item, int kFractionBits = 0>
requires(kFractionBits >= 0 && kFractionBits <= 8) class ComputedBuckets {
 public:
  static constexpr double kGamma = 1 + 1.0 / (1 << kFractionBits);

  ComputedBuckets() : first_(kBuckets, kNone) {}

  [[nodiscard]] bool empty() const noexcept { return size_ == 0; }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }

  /// Requires: is_key(key). Strong guarantee. Cost: O(1) amortized.
  void insert(double key, const Item& item) {
    SAC_EXPECTS(is_key(key));
    items_.make_room();
    const std::size_t bucket = std::bit_cast<std::uint64_t>(key) >> (52 - kFractionBits);
    items_.push(first_[bucket], item);
    used_[bucket / 64] |= std::uint64_t{1} << bucket % 64;
    first_word_ = std::min(first_word_, bucket / 64);
    ++size_;
  }
  /// Requires: !empty(). Cost: O(1), and a step for each 64 buckets that are empty below the first.
  [[nodiscard]] Item delete_min() {
    SAC_EXPECTS(!empty());
    while (used_[first_word_] == 0) ++first_word_;
    std::uint64_t& word = used_[first_word_];
    std::uint32_t& first = first_[first_word_ * 64 + static_cast<unsigned>(std::countr_zero(word))];
    const Item item = items_.pop(first);
    if (first == kNone) word &= word - 1;
    --size_;
    return item;
  }

 private:
  static constexpr std::size_t kBuckets = std::size_t{2048} << kFractionBits;

  ItemStacks<Item> items_;
  std::vector<std::uint32_t> first_;            // by bucket
  std::uint64_t used_[kBuckets / 64] = {};      // a bit for each bucket that is not empty
  std::size_t first_word_ = kBuckets / 64 - 1;  // all before it are 0
  std::size_t size_ = 0;
};

template <class Item>
class WalkedBuckets {
 public:
  /// Requires: 1 + 2^-20 <= gamma <= 2^20.
  explicit WalkedBuckets(double gamma = 2) : gamma_(gamma) {
    SAC_EXPECTS(gamma >= 1 + 0x1p-20 && gamma <= 0x1p20);
  }

  [[nodiscard]] bool empty() const noexcept { return head_ == kNone; }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }

  /// Requires: is_key(key). Strong guarantee.
  /// Cost: O(1 + |log_gamma(key / l)|) amortized, l the smallest key or the last that came out.
  void insert(double key, const Item& item) {
    SAC_EXPECTS(is_key(key));
    items_.make_room();
    std::uint32_t before = kNone, at = head_;
    while (at != kNone && key >= buckets_[at].range.end) before = at, at = buckets_[at].next;
    if (at == kNone || key < buckets_[at].range.begin) at = add_bucket(key, before, at);
    items_.push(buckets_[at].first, item);
    ++size_;
  }
  /// Requires: !empty(). Cost: O(1).
  [[nodiscard]] Item delete_min() {
    SAC_EXPECTS(!empty());
    Bucket& bucket = buckets_[head_];
    last_ = bucket.range;
    const Item item = items_.pop(bucket.first);
    if (bucket.first == kNone) {
      const std::uint32_t emptied = head_;
      head_ = bucket.next;
      bucket.next = free_;
      free_ = emptied;
    }
    --size_;
    return item;
  }

 private:
  struct Range {
    double begin, end;
  };
  struct Bucket {
    Range range;
    std::uint32_t first, next;
  };

  /// Between two that are next to each other, or kNone.
  std::uint32_t add_bucket(double key, std::uint32_t before, std::uint32_t after) {
    const Range range = range_for(key, before, after);
    if (free_ == kNone) {
      SAC_EXPECTS(buckets_.size() < kNone);
      buckets_.push_back({range, kNone, kNone});
      free_ = static_cast<std::uint32_t>(buckets_.size() - 1);
    }
    const std::uint32_t at = free_;
    free_ = buckets_[at].next;
    if (head_ == kNone) last_ = range;
    buckets_[at] = {range, kNone, after};
    (before == kNone ? head_ : buckets_[before].next) = at;
    return at;
  }
  [[nodiscard]] Range range_for(double key, std::uint32_t before, std::uint32_t after) const {
    if (head_ == kNone) return {key, key * gamma_};
    Range range = near(before, after);
    while (key >= range.end) range = {range.end, range.end * gamma_};
    while (key < range.begin) range = {range.begin / gamma_, range.begin};
    return range;
  }
  /// A range to walk from: below all the one that came out last, or the first that there is.
  [[nodiscard]] const Range& near(std::uint32_t before, std::uint32_t after) const noexcept {
    if (before != kNone) return buckets_[before].range;
    const Range& next = buckets_[after].range;
    return last_.begin < next.begin ? last_ : next;
  }

  double gamma_;
  ItemStacks<Item> items_;
  std::vector<Bucket> buckets_;
  std::uint32_t head_ = kNone, free_ = kNone;
  std::size_t size_ = 0;
  Range last_{};  // of the item that came out last, or of the first in the empty queue
};

}  // namespace mesher::detail
