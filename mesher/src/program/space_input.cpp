// What is said of segments and polygons that cannot come.
#include "program/space_input.hpp"

#include <algorithm>

#include "text/id_text.hpp"

namespace mesher::detail {

namespace {

// Of the first of the points whose place is known.
std::vector<Position> first_place(const std::vector<PointId>& points,
                                  const PlaceOfPoint& place_of) {
  for (const PointId p : points) {
    if (const auto at = place_of(p)) return places_of(at);
  }
  return {};
}

}  // namespace

void require_loops(const mesher::Polygon& polygon, const PlaceOfPoint& place_of) {
  const auto fail = [&](const std::string& what, std::vector<mesher::Feature> features,
                        const std::vector<PointId>& where) {
    features.insert(features.begin(), mesher::Feature(polygon.id));
    throw Error(ErrorCode::bad_polygon, "polygon " + id_text(polygon.id) + " " + what, {},
                std::move(features), first_place(where, place_of));
  };
  if (polygon.loops.empty()) fail("has no loop", {}, {});
  for (const auto& loop : polygon.loops) {
    if (loop.size() < 3) fail("has a loop of fewer than three points", {}, loop);
    std::vector<PointId> sorted = loop;
    std::sort(sorted.begin(), sorted.end());
    const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
    if (twice != sorted.end()) {
      fail("has a loop that goes along point " + id_text(*twice) + " twice",
           {mesher::Feature(*twice)}, {*twice});
    }
  }
  for (const auto& [a, b] : polygon.edges) {
    if (a != b) continue;
    throw Error(ErrorCode::zero_length,
                "an edge in polygon " + id_text(polygon.id) + " goes from point " + id_text(a) +
                    " to itself",
                {}, {mesher::Feature(polygon.id), mesher::Feature(a)}, first_place({a}, place_of));
  }
}

void fail_unknown_point(PointId point, const std::string& what, const mesher::Feature& user) {
  throw Error(ErrorCode::unknown_id,
              "point " + id_text(point) + ", " + what + " " + text_of(user) + ", is not there", {},
              {mesher::Feature(point), user});
}

void require_new(const Edge* there, LineId id, const SpaceNames& names) {
  const auto other = there == nullptr ? std::nullopt : names.segment(there->self);
  if (!other) return;
  throw Error(ErrorCode::repeated_segment,
              "segment " + id_text(id) + " is " +
                  (*other == id ? "itself" : "segment " + id_text(*other)) + " again, from " +
                  place_text(there->place_a) + " to " + place_text(there->place_b),
              {}, {mesher::Feature(id), mesher::Feature(*other)},
              {position_of(there->place_a), position_of(there->place_b)});
}

void require_new(const Polygon& record, PolygonId id, const SpaceNames& names) {
  if (!record.alive) return;
  const PolygonId other = names.polygon(record.self);
  throw Error(ErrorCode::repeated_polygon,
              "polygon " + id_text(id) + " is polygon " + id_text(other) +
                  " again; its first corner is at " + place_text(record.places.front()),
              {}, {mesher::Feature(id), mesher::Feature(other)},
              {position_of(record.places.front())});
}

}  // namespace mesher::detail
