// The calls of one class (bucket, phase, colour) that a plain drain runs: those posted before, in
// order, merged with those that these calls post into the class.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "sac/internal/sorted_index.hpp"

namespace sac {

/// `before(a, b)` as for SortedIndex: if it throws, or memory runs out, nothing has changed.
template <class Entry>
class DueCalls {
 public:
  /// Takes what was posted. Requires: empty().
  template <class Before>
  void begin(std::vector<Entry>& posted, Before&& before) {
    std::vector<Entry> batch = posted;  // sorting may fail half way
    if (!std::is_sorted(batch.begin(), batch.end(), before)) {
      std::sort(batch.begin(), batch.end(), before);
    }
    batch_ = std::move(batch);
    next_ = 0;
    posted.clear();
  }
  template <class Before>
  void add(const Entry& entry, Before&& before) {
    late_.insert(entry, before);
  }

  [[nodiscard]] bool empty() const noexcept { return next_ == batch_.size() && late_.empty(); }
  /// Requires: not empty.
  template <class Before>
  [[nodiscard]] const Entry& first(Before&& before) const {
    const bool is_late =
        next_ == batch_.size() || (!late_.empty() && before(late_.first(), batch_[next_]));
    return is_late ? late_.first() : batch_[next_];
  }
  /// Requires: `first` is what first() gave, and nothing has come since.
  void drop(const Entry& first) noexcept {
    if (next_ < batch_.size() && &first == &batch_[next_]) {
      ++next_;
    } else {
      late_.pop_first();
    }
  }

  template <class Visit>
  void for_each(Visit&& visit) const {
    std::for_each(batch_.begin() + static_cast<std::ptrdiff_t>(next_), batch_.end(), visit);
    late_.for_each(visit);
  }
  void clear() noexcept {
    next_ = batch_.size();
    late_.clear();
  }

 private:
  std::vector<Entry> batch_;
  std::size_t next_ = 0;  // in batch_
  SortedIndex<Entry> late_;
};

}  // namespace sac
