// Which polygon of the input a record is, and which polygons lie at its edges and points; and what
// an update brings of that until it is done.
#pragma once

#include <unordered_map>
#include <vector>

#include "facade/make_room.hpp"
#include "mesher/ids.hpp"
#include "space/polygons_at.hpp"

namespace mesher::detail {

class PolygonNames {
 public:
  /// As the last update left it. Requires: it is there.
  [[nodiscard]] PolygonHandle record(PolygonId id) const { return records_.at(id); }
  [[nodiscard]] PolygonId was(PolygonHandle f) const { return ids_.at(f); }
  /// As it is when the update is done. Requires: it was there, or is.
  [[nodiscard]] PolygonId find(PolygonHandle f) const {
    const auto it = come_.find(f);
    return it == come_.end() ? was(f) : it->second;
  }
  /// Together they have all that are there when the update is done, and those that have gone.
  [[nodiscard]] std::vector<const PolygonsAt*> all_at() const { return {&at_, &at_come_}; }
  /// As the last update left them.
  [[nodiscard]] const PolygonsAt& at() const noexcept { return at_; }

  /// What an update does. Throws: std::bad_alloc.
  void take(PolygonHandle f) { taken_.push_back(f); }
  void add(const Polygon& f, PolygonId id) {
    come_[f.self] = id;
    added_.push_back(f.self);
    at_come_.add(f);
    records_come_.insert_or_assign(id, f.self);
  }
  /// In the order in which they came.
  [[nodiscard]] const std::vector<PolygonHandle>& added() const noexcept { return added_; }
  /// Some have come again.
  [[nodiscard]] const std::vector<PolygonHandle>& taken() const noexcept { return taken_; }

  /// So that commit() needs no memory.
  void prepare() {
    make_room_for(records_, records_come_);
    make_room_for(ids_, come_);
  }
  /// Requires: prepare(), and no change since. `polygons`: with the records of those that went.
  void commit(const PolygonPool& polygons) noexcept {
    for (const PolygonHandle f : taken_) {
      const auto it = ids_.find(f);
      records_.erase(it->second);
      ids_.erase(it);
      at_.erase(polygons[f]);
    }
    records_.merge(records_come_);
    ids_.merge(come_);
    at_.merge(at_come_);
    discard();
  }
  /// Tables that were large once are given back: to clear them again takes time in their size.
  void discard() noexcept {
    come_ = decltype(come_)();  // not {}, an empty list, for which a table keeps its size
    records_come_ = decltype(records_come_)();
    added_.clear();
    taken_.clear();
    at_come_ = PolygonsAt();
  }

 private:
  std::unordered_map<PolygonId, PolygonHandle> records_, records_come_;
  std::unordered_map<PolygonHandle, PolygonId> ids_, come_;
  PolygonsAt at_, at_come_;
  std::vector<PolygonHandle> added_, taken_;
};

}  // namespace mesher::detail
