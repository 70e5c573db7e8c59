// The edits of lines and polygons announced since the last update: for each, the points it went
// along and those it shall.
//
// Only the difference is kept, as for points.
#pragma once

#include <algorithm>
#include <map>
#include <vector>

#include "mesher/graph.hpp"

namespace mesher::detail {

using LinePoints = std::vector<PointId>;  // empty: the line is not there

/// What is announced of parts that are a `Value` each; Value() is that of one that is not there.
template <class Id, class Value>
class PendingParts {
 public:
  struct Edit {
    Id id{};
    Value was, to;
  };

  /// The edit of `id`; null if it stays as it was. Valid until the next change.
  [[nodiscard]] const Edit* find(Id id) const {
    const auto it = edits_.find(id);
    return it == edits_.end() ? nullptr : &it->second;
  }
  /// `id`, which the last update left as `was`, shall be `to`. Throws: bad_alloc, and then changes
  /// nothing.
  void set(Id id, const Value& was, Value to) {
    if (was == to) {
      edits_.erase(id);
      return;
    }
    edits_.insert_or_assign(id, Edit{id, was, std::move(to)});
  }
  /// All edits, by id.
  [[nodiscard]] std::vector<Edit> sorted() const {
    std::vector<Edit> all;
    all.reserve(edits_.size());
    for (const auto& [id, edit] : edits_) all.push_back(edit);
    return all;
  }
  void clear() noexcept { edits_.clear(); }

 private:
  std::map<Id, Edit> edits_;
};
using PendingLines = PendingParts<LineId, LinePoints>;
using PendingPolygons = PendingParts<PolygonId, mesher::Polygon>;  // without loops: it is not there

}  // namespace mesher::detail
