// What segments are called, by their handles, and what an update brings of that until it is done.
//
// In space some edges are of polygons alone: they have no name.
#pragma once

#include <algorithm>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "facade/make_room.hpp"
#include "mesher/ids.hpp"
#include "records/segment.hpp"

namespace mesher::detail {

class SegmentNames {
 public:
  using Name = std::optional<LineId>;

  /// As the last update left it.
  [[nodiscard]] Name was(SegmentHandle s) const {
    return s < names_.size() ? names_[s] : std::nullopt;
  }
  /// As it is when the update is done.
  [[nodiscard]] Name find(SegmentHandle s) const {
    const auto it = come_.find(s);
    if (it != come_.end()) return it->second;
    return taken_.contains(s) ? std::nullopt : was(s);
  }
  /// The same, but of a segment that has gone what it was called.
  [[nodiscard]] Name latest(SegmentHandle s) const {
    const auto it = come_.find(s);
    return it == come_.end() ? was(s) : it->second;
  }

  /// What an update does. Throws: std::bad_alloc.
  void take(SegmentHandle s) { taken_.insert(s); }
  void add(SegmentHandle s, LineId line) {
    come_[s] = line;
    added_.push_back(s);
  }
  /// In the order in which they came.
  [[nodiscard]] const std::vector<SegmentHandle>& added() const noexcept { return added_; }
  /// Some have come again.
  [[nodiscard]] const std::unordered_set<SegmentHandle>& taken() const noexcept { return taken_; }

  /// So that commit() needs no memory.
  void prepare() {
    const auto last = std::max_element(added_.begin(), added_.end());
    make_place(names_, last == added_.end() ? 0 : *last);
  }
  /// Requires: prepare(), and no change since.
  void commit() noexcept {
    for (const SegmentHandle s : taken_) names_[s].reset();
    for (const auto& [s, line] : come_) names_[s] = line;
    discard();
  }
  /// Tables that were large once are given back: to clear them again takes time in their size.
  void discard() noexcept {
    come_ = decltype(come_)();  // not {}, an empty list, for which a table keeps its size
    taken_ = decltype(taken_)();
    added_.clear();
  }
  /// How many buckets the tables have: what it takes to clear them.
  [[nodiscard]] std::size_t buckets() const noexcept {
    return come_.bucket_count() + taken_.bucket_count();
  }

 private:
  std::vector<Name> names_;  // by handle
  std::unordered_map<SegmentHandle, LineId> come_;
  std::unordered_set<SegmentHandle> taken_;
  std::vector<SegmentHandle> added_;
};

}  // namespace mesher::detail
