// Records whose changes can be undone.
#pragma once

#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

namespace mesher::detail {

/// Plain records by number. What edit() and add() have done since the last keep() is undone by
/// take_back().
template <class T>
requires std::is_trivially_copyable_v<T>
class Journal {
 public:
  [[nodiscard]] const T& operator[](std::uint32_t i) const noexcept { return records_[i]; }
  [[nodiscard]] std::uint32_t size() const noexcept {
    return static_cast<std::uint32_t>(records_.size());
  }
  [[nodiscard]] std::size_t bytes() const noexcept {
    return records_.capacity() * sizeof(T) + log_.capacity() * sizeof(log_[0]);
  }

  /// Room for n records. Throws: std::bad_alloc.
  void reserve(std::size_t n) { records_.reserve(n); }

  /// A record to be changed, until the next add(). Throws: std::bad_alloc, and then nothing is
  /// changed. Cost: O(1) amortised.
  [[nodiscard]] T& edit(std::uint32_t i) {
    if (i < kept_) log_.emplace_back(i, records_[i]);
    return records_[i];
  }
  /// The number of a new record. Throws: std::bad_alloc.
  std::uint32_t add(const T& record) {
    records_.push_back(record);
    return size() - 1;
  }

  /// Makes all changes final. The log's memory is given back if it is much.
  void keep() noexcept {
    kept_ = size();
    log_.clear();
    if (log_.capacity() > kLogKept) std::vector<std::pair<std::uint32_t, T>>().swap(log_);
  }
  void take_back() noexcept {
    while (!log_.empty()) {
      records_[log_.back().first] = log_.back().second;
      log_.pop_back();
    }
    records_.erase(records_.begin() + kept_, records_.end());
  }

 private:
  static constexpr std::size_t kLogKept = 4096;

  std::vector<T> records_;
  std::vector<std::pair<std::uint32_t, T>> log_;  // what was there before
  std::uint32_t kept_ = 0;                        // records there at the last keep()
};

}  // namespace mesher::detail
