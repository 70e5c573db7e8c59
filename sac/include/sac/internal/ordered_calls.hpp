// The posted calls of one (bucket, phase, colour), in order: a two-level sorted array.
//
// Leaves of up to 32 entries under a directory of leaves; 12 bytes an entry at full leaves, and
// leaves that two edits leave half empty are merged, so that memory follows the number of calls.
// Built in bulk by a first run, then searched and edited in O(log) comparisons of plain numbers; a
// call itself is looked at only where orders tie. If comparing calls throws, nothing has changed.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "sac/internal/arena.hpp"

namespace sac {

class OrderedCalls {
 public:
  struct Entry {
    std::uint64_t order = 0;
    Handle call = 0;
  };

  [[nodiscard]] bool empty() const noexcept { return leaves_.empty(); }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  /// Requires: not empty.
  [[nodiscard]] Handle first() const noexcept { return leaves_.front()->calls[0]; }
  [[nodiscard]] Entry first_entry() const noexcept { return first(*leaves_.front()); }
  [[nodiscard]] Handle last() const noexcept {
    return leaves_.back()->calls[leaves_.back()->count - 1];
  }

  /// Adds an entry behind all others. Requires: it belongs there.
  void append(Entry entry) {
    if (leaves_.empty() || leaves_.back()->count >= kFill)
      leaves_.push_back(std::make_unique<Leaf>());
    Leaf& leaf = *leaves_.back();
    put(leaf, leaf.count, entry);
    ++size_;
  }

  /// Inserts in order; `before(a, b)` decides between calls of equal order.
  template <class Before>
  void insert(Entry entry, Before&& before) {
    if (leaves_.empty()) return append(entry);
    std::size_t l = leaf_for(entry, before);
    if (leaves_[l]->count == kCapacity) {
      split(l);
      if (!less(entry, first(*leaves_[l + 1]), before)) ++l;
    }
    Leaf& leaf = *leaves_[l];
    put(leaf, position(leaf, entry, before), entry);
    ++size_;
  }

  /// Takes out the entry of `entry.call`. Requires: it is there.
  template <class Before>
  void erase(Entry entry, Before&& before) {
    const std::size_t l = leaf_for(entry, before);
    erase_at(l, position(*leaves_[l], entry, before) - 1);
  }

  /// Takes out `call`, looking at every entry: for when `before` fails. Requires: it is there.
  void erase_without_order(Handle call) noexcept {
    for (std::size_t l = 0;; ++l) {
      const Leaf& leaf = *leaves_[l];
      for (std::size_t i = 0; i < leaf.count; ++i) {
        if (leaf.calls[i] == call) return erase_at(l, i);
      }
    }
  }

  /// Takes out the first entry. Requires: not empty.
  Entry pop_first() noexcept {
    const Entry entry = first(*leaves_.front());
    erase_at(0, 0);
    return entry;
  }

  /// The last call that comes before `entry`, which may be there or not; 0 if there is none.
  template <class Before>
  [[nodiscard]] Handle predecessor(Entry entry, Before&& before) const {
    if (leaves_.empty()) return 0;
    std::size_t l = leaf_for(entry, before);
    std::size_t i = position(*leaves_[l], entry, before);
    if (i > 0 && !less({leaves_[l]->orders[i - 1], leaves_[l]->calls[i - 1]}, entry, before)) --i;
    if (i > 0) return leaves_[l]->calls[i - 1];
    return l > 0 ? leaves_[l - 1]->calls[leaves_[l - 1]->count - 1] : 0;
  }
  /// The last call that does not come behind `entry`; 0 if there is none.
  template <class Before>
  [[nodiscard]] Handle last_not_behind(Entry entry, Before&& before) const {
    if (leaves_.empty()) return 0;
    const Leaf& leaf = *leaves_[leaf_for(entry, before)];
    const std::size_t i = position(leaf, entry, before);
    return i == 0 ? 0 : leaf.calls[i - 1];
  }

  /// The first call that comes behind `entry`; 0 if there is none.
  template <class Before>
  [[nodiscard]] Handle successor(Entry entry, Before&& before) const {
    if (leaves_.empty()) return 0;
    const std::size_t l = leaf_for(entry, before);
    const std::size_t i = position(*leaves_[l], entry, before);
    if (i < leaves_[l]->count) return leaves_[l]->calls[i];
    return l + 1 < leaves_.size() ? leaves_[l + 1]->calls[0] : 0;
  }

  template <class Visit>
  void for_each(Visit&& visit) const {
    for (const auto& leaf : leaves_) {
      for (std::size_t i = 0; i < leaf->count; ++i) visit(Entry{leaf->orders[i], leaf->calls[i]});
    }
  }

  [[nodiscard]] std::size_t bytes() const noexcept {
    return leaves_.capacity() * sizeof(leaves_[0]) + leaves_.size() * sizeof(Leaf);
  }

 private:
  static constexpr std::size_t kCapacity = 32;
  static constexpr std::size_t kFill = 28;   // a first run leaves room for the edits to come
  static constexpr std::size_t kMerge = 20;  // neighbours of so few entries in all become one leaf

  struct Leaf {
    std::uint32_t count = 0;
    std::array<Handle, kCapacity> calls;
    std::array<std::uint64_t, kCapacity> orders;
  };

  template <class Before>
  static bool less(const Entry& a, const Entry& b, Before&& before) {
    if (a.order != b.order) return a.order < b.order;
    return a.call != b.call && before(a.call, b.call);
  }
  static Entry first(const Leaf& leaf) { return {leaf.orders[0], leaf.calls[0]}; }

  // The last leaf that does not begin behind `entry`; the first leaf if all do.
  template <class Before>
  std::size_t leaf_for(const Entry& entry, Before&& before) const {
    std::size_t low = 0;
    std::size_t high = leaves_.size();
    while (high - low > 1) {
      const std::size_t middle = (low + high) / 2;
      (less(entry, first(*leaves_[middle]), before) ? high : low) = middle;
    }
    return low;
  }

  // The number of entries of `leaf` that are not behind `entry`.
  template <class Before>
  static std::size_t position(const Leaf& leaf, const Entry& entry, Before&& before) {
    std::size_t low = 0;
    std::size_t high = leaf.count;
    while (low < high) {
      const std::size_t middle = (low + high) / 2;
      if (less(entry, {leaf.orders[middle], leaf.calls[middle]}, before)) {
        high = middle;
      } else {
        low = middle + 1;
      }
    }
    return low;
  }

  static void put(Leaf& leaf, std::size_t i, const Entry& entry) {
    const auto open_gap = [&](auto* column) {
      std::copy_backward(column + i, column + leaf.count, column + leaf.count + 1);
    };
    open_gap(leaf.orders.data());
    open_gap(leaf.calls.data());
    leaf.orders[i] = entry.order;
    leaf.calls[i] = entry.call;
    ++leaf.count;
  }

  void erase_at(std::size_t l, std::size_t i) noexcept {
    Leaf& leaf = *leaves_[l];
    const auto close_gap = [&](auto* column) {
      std::copy(column + i + 1, column + leaf.count, column + i);
    };
    close_gap(leaf.orders.data());
    close_gap(leaf.calls.data());
    --size_;
    --leaf.count;
    if (leaf.count == 0) {
      drop_leaf(l);
    } else if (l + 1 < leaves_.size() && leaf.count + leaves_[l + 1]->count <= kMerge) {
      merge(l);
    } else if (l > 0 && leaf.count + leaves_[l - 1]->count <= kMerge) {
      merge(l - 1);
    }
  }

  void split(std::size_t l) {
    leaves_.insert(leaves_.begin() + static_cast<std::ptrdiff_t>(l) + 1, std::make_unique<Leaf>());
    Leaf& left = *leaves_[l];
    Leaf& right = *leaves_[l + 1];
    const std::uint32_t half = left.count / 2;
    move_entries(left, half, right);
    left.count = half;
  }

  // Appends what `from` has from `first` on.
  static void move_entries(const Leaf& from, std::uint32_t first, Leaf& to) noexcept {
    const auto copy = [&](const auto& source, auto& target) {
      std::copy(source.data() + first, source.data() + from.count, target.data() + to.count);
    };
    copy(from.orders, to.orders);
    copy(from.calls, to.calls);
    to.count += from.count - first;
  }

  void merge(std::size_t l) noexcept {
    move_entries(*leaves_[l + 1], 0, *leaves_[l]);
    drop_leaf(l + 1);
  }

  void drop_leaf(std::size_t l) noexcept {
    leaves_.erase(leaves_.begin() + static_cast<std::ptrdiff_t>(l));
  }

  std::vector<std::unique_ptr<Leaf>> leaves_;
  std::size_t size_ = 0;
};

}  // namespace sac
