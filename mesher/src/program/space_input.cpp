// What is said of segments and polygons that cannot come.
#include "program/space_input.hpp"

#include <algorithm>

namespace mesher::detail {

namespace {

std::string text(FeatureId id) { return std::to_string(static_cast<std::int64_t>(id)); }

}  // namespace

void require_loops(const mesher::Polygon& polygon) {
  const auto fail = [&](const std::string& what, std::vector<mesher::Feature> features) {
    features.insert(features.begin(), polygon_named(polygon.id));
    throw Error(ErrorCode::bad_polygon, "polygon " + text(polygon.id) + " " + what, {},
                std::move(features));
  };
  if (polygon.loops.empty()) fail("has no loop", {});
  for (const auto& loop : polygon.loops) {
    if (loop.size() < 3) fail("has a loop of fewer than three points", {});
    std::vector<FeatureId> sorted = loop;
    std::sort(sorted.begin(), sorted.end());
    const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
    if (twice != sorted.end()) {
      fail("has a loop that goes along point " + text(*twice) + " twice", {point_named(*twice)});
    }
  }
  for (const auto& [a, b] : polygon.edges) {
    if (a != b) continue;
    throw Error(
        ErrorCode::zero_length,
        "an edge in polygon " + text(polygon.id) + " goes from point " + text(a) + " to itself", {},
        {polygon_named(polygon.id), point_named(a)});
  }
}

void fail_unknown_point(FeatureId point, const std::string& what, const mesher::Feature& user) {
  throw Error(ErrorCode::unknown_id,
              "point " + text(point) + ", " + what + " " + text_of(user) + ", is not there", {},
              {point_named(point), user});
}

void require_new(const Edge* there, FeatureId id, const SpaceNames& names) {
  const auto other = there == nullptr ? std::nullopt : names.segment(there->self);
  if (!other) return;
  throw Error(ErrorCode::repeated_segment,
              "segment " + text(id) + " is " +
                  (*other == id ? "itself" : "segment " + text(*other)) + " again, from " +
                  place_text(there->place_a) + " to " + place_text(there->place_b),
              {}, {line_named(id), line_named(*other)},
              {position_of(there->place_a), position_of(there->place_b)});
}

void require_new(const Polygon& record, FeatureId id, const SpaceNames& names) {
  if (!record.alive) return;
  const FeatureId other = names.polygon(record.self);
  throw Error(ErrorCode::repeated_polygon,
              "polygon " + text(id) + " is polygon " + text(other) +
                  " again; its first corner is at " + place_text(record.places.front()),
              {}, {polygon_named(id), polygon_named(other)}, {position_of(record.places.front())});
}

}  // namespace mesher::detail
