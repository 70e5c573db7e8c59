// What is refused of lines and polygons when they are announced.
#include "facade/announced_features.hpp"

#include <algorithm>
#include <string>

#include "mesher/error.hpp"
#include "plane/planarity.hpp"
#include "program/space_input.hpp"
#include "text/id_text.hpp"

namespace mesher::detail {

namespace {

[[noreturn]] void refuse(ErrorCode code, const std::string& why, const mesher::Feature& feature) {
  throw Error(code, why, {}, {feature});
}

template <class Key, class Value>
void take(Staged<Key, Value>& staged, const std::string& what, const Key& id) {
  if (staged.find(id) == nullptr) {
    refuse(ErrorCode::unknown_id, what + id_text(id) + " is not there", id);
  }
  staged.set(id, std::nullopt);
}

}  // namespace

template <int D>
void AnnouncedFeatures<D>::insert_line(const State& state, LineId id, const LinePoints& points) {
  const auto refuse = [&](ErrorCode code, const std::string& why) {
    detail::refuse(code, why, id);
  };
  if (rule_ != Rule::radius_edge) {
    refuse(ErrorCode::bad_option, "segments need the rule radius-edge");
  }
  if (points.size() < 2) {
    refuse(ErrorCode::bad_option, "line " + id_text(id) + " has fewer than two points");
  }
  if (lines_.find(id) != nullptr) {
    refuse(ErrorCode::repeated_id, "line " + id_text(id) + " is there already");
  }
  const auto same = std::adjacent_find(points.begin(), points.end());
  if (same != points.end()) fail_zero_length(id, *same, places_of(points_.place(state, *same)));
  lines_.set(id, points);
}

template <int D>
void AnnouncedFeatures<D>::remove_line(LineId id) {
  take(lines_, "line ", id);
}

template <int D>
void AnnouncedFeatures<D>::insert_polygon(const State& state, const mesher::Polygon& polygon) {
  const auto refuse = [&](ErrorCode code, const std::string& why) {
    detail::refuse(code, why, polygon.id);
  };
  if (D == 2) refuse(ErrorCode::bad_option, "polygons are for space");
  if (rule_ != Rule::radius_edge) {
    refuse(ErrorCode::bad_option, "polygons need the rule radius-edge");
  }
  if (polygons_.find(polygon.id) != nullptr) {
    refuse(ErrorCode::repeated_id, "polygon " + id_text(polygon.id) + " is there already");
  }
  if constexpr (D == 3) {
    require_loops(polygon, [&](PointId p) { return points_.place(state, p); });
  }
  polygons_.set(polygon.id, polygon);
}

template <int D>
void AnnouncedFeatures<D>::remove_polygon(PolygonId id) {
  take(polygons_, "polygon ", id);
}

template class AnnouncedFeatures<2>;
#ifndef MESHER_PLANE_ONLY
template class AnnouncedFeatures<3>;
#endif

}  // namespace mesher::detail
