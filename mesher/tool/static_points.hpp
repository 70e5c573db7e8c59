// The points of a mesher without the engine, and the edits announced of them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>

#include "mesher/error.hpp"
#include "mesher/mesh.hpp"

namespace tool {

template <int D>
class StaticPoints {
 public:
  explicit StaticPoints(const mesher::Box<D>& domain) : domain_(domain) {}

  /// As those of Mesher, but that points that are too close are left to update().
  /// Throws: Error (repeated_id, unknown_id, duplicate_point, outside_domain), and then changes
  /// nothing.
  void insert(mesher::PointId id, const mesher::Point<D>& point, std::int64_t marker = 0) {
    if (is_there(id)) {
      throw mesher::Error(mesher::ErrorCode::repeated_id,
                          "there is a point " + id_text(id) + " already", {}, {id});
    }
    require_inside(id, point);
    if (!was_there(id)) require_free(id, point);
    put(id, {point, marker});
  }
  void remove(mesher::PointId id) {
    require_known(id);
    const auto row = edited_.points.find(id);
    const auto [first, last] = edited_.ids.equal_range(row->second.at);
    edited_.ids.erase(std::find_if(first, last, [&](const auto& e) { return e.second == id; }));
    edited_.points.erase(row);
  }
  void move(mesher::PointId id, const mesher::Point<D>& point) {
    require_known(id);
    require_inside(id, point);
    const std::int64_t marker = edited_.points.at(id).marker;
    remove(id);
    put(id, {point, marker});
  }
  void discard_edits() { edited_ = current_; }

 protected:
  struct Vertex {
    mesher::Point<D> at{};
    std::int64_t marker = 0;
  };
  using Points = std::map<mesher::PointId, Vertex>;

  /// Those that are announced to be there.
  [[nodiscard]] const Points& points() const { return edited_.points; }
  /// Throws: Error(point_in_use) if the point, which is `what` of `user`, goes.
  void require_stays(mesher::PointId id, const char* what, const mesher::Feature& user) const {
    if (is_there(id) || !was_there(id)) return;
    throw mesher::Error(mesher::ErrorCode::point_in_use,
                        "point " + id_text(id) + " cannot go: it is " + what + " " + text_of(user),
                        {}, {id, user});
  }
  void keep_edits() { current_ = edited_; }
  static std::string id_text(const mesher::Feature& id) { return std::to_string(id.number); }

 private:
  // ids has (points.at(id).at, id) for every id, and nothing else.
  struct Placed {
    Points points;
    std::multimap<mesher::Point<D>, mesher::PointId> ids;
  };

  [[nodiscard]] bool is_there(mesher::PointId id) const { return edited_.points.contains(id); }
  // At the last keep_edits().
  [[nodiscard]] bool was_there(mesher::PointId id) const { return current_.points.contains(id); }
  void put(mesher::PointId id, const Vertex& vertex) {
    edited_.points.emplace(id, vertex);
    edited_.ids.emplace(vertex.at, id);
  }
  void require_known(mesher::PointId id) const {
    if (is_there(id)) return;
    throw mesher::Error(mesher::ErrorCode::unknown_id, "there is no point " + id_text(id), {},
                        {id});
  }
  void require_inside(mesher::PointId id, const mesher::Point<D>& p) const {
    for (int i = 0; i < D; ++i) {
      if (p[i] >= domain_.lo[i] && p[i] <= domain_.hi[i]) continue;
      throw mesher::Error(mesher::ErrorCode::outside_domain,
                          "point " + id_text(id) + " is outside the domain", {}, {id},
                          {mesher::position_of(p)});
    }
  }
  void require_free(mesher::PointId id, const mesher::Point<D>& p) const {
    const auto other = edited_.ids.find(p);
    if (other == edited_.ids.end()) return;
    throw mesher::Error(mesher::ErrorCode::duplicate_point,
                        "point " + id_text(id) + " would lie on point " + id_text(other->second),
                        {}, {id, other->second}, {mesher::position_of(p)});
  }

  mesher::Box<D> domain_;
  Placed current_, edited_;
};

}  // namespace tool
