// The points and lines of a mesher without the engine, and the edits announced of them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <vector>

#include "static_points.hpp"

namespace tool {

template <int D>
class StaticLines : public StaticPoints<D> {
 public:
  using StaticPoints<D>::StaticPoints;

  /// As those of Mesher. Throws: Error (repeated_id, unknown_id, zero_length), and then changes
  /// nothing.
  void insert_segment(mesher::LineId id, mesher::PointId from, mesher::PointId to,
                      std::int64_t marker = 0) {
    insert_polyline(id, {from, to}, marker);
  }
  void insert_polyline(mesher::LineId id, const std::vector<mesher::PointId>& points,
                       std::int64_t marker = 0) {
    if (edited_.contains(id)) {
      throw mesher::Error(mesher::ErrorCode::repeated_id,
                          "there is a line " + this->id_text(id) + " already", {}, {id});
    }
    const auto same = std::adjacent_find(points.begin(), points.end());
    if (same != points.end()) {
      throw mesher::Error(mesher::ErrorCode::zero_length,
                          "segment " + this->id_text(id) + " goes from point " +
                              this->id_text(*same) + " to itself",
                          {}, {id, *same});
    }
    edited_.emplace(id, Line{points, marker});
  }
  void remove_line(mesher::LineId id) {
    if (edited_.erase(id) > 0) return;
    throw mesher::Error(mesher::ErrorCode::unknown_id, "there is no line " + this->id_text(id), {},
                        {id});
  }
  void discard_edits() {
    StaticPoints<D>::discard_edits();
    edited_ = current_;
  }

 protected:
  struct Line {
    std::vector<mesher::PointId> points;
    std::int64_t marker = 0;
  };
  using Lines = std::map<mesher::LineId, Line>;

  /// Those that are announced to be there.
  [[nodiscard]] const Lines& lines() const { return edited_; }
  /// Throws: Error(point_in_use) if a line ends at a point that goes.
  void require_no_ends_go() const {
    for (const auto& [id, line] : edited_) {
      for (const mesher::PointId end : line.points) {
        this->require_stays(end, "an end of", id);
      }
    }
  }
  void keep_edits() {
    StaticPoints<D>::keep_edits();
    current_ = edited_;
  }

 private:
  Lines current_, edited_;
};

}  // namespace tool
