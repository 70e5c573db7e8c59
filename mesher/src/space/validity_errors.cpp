// What is said of features that do not fit together.
#include <algorithm>
#include <string>

#include "geometry/input_point.hpp"
#include "sets/make_set.hpp"
#include "space/validity.hpp"
#include "text/id_text.hpp"
#include "text/text.hpp"

namespace mesher::detail {

namespace {

struct Words {
  ErrorCode code;
  const char* verb;
  const char* rest;
};
Words words_of(SpaceConflict::Kind kind) {
  using Kind = SpaceConflict::Kind;
  switch (kind) {
    case Kind::point_on_edge:
      return {ErrorCode::point_on_segment, " lies on ", ""};
    case Kind::point_on_polygon:
      return {ErrorCode::point_on_polygon, " lies on ", ", which does not declare it"};
    case Kind::crossing_edges:
      return {ErrorCode::crossing_segments, " crosses ", ""};
    case Kind::edge_on_polygon:
      return {ErrorCode::segment_on_polygon, " lies on ", ", which does not declare it"};
    case Kind::edge_through_polygon:
      return {ErrorCode::segment_through_polygon, " goes through ", ""};
    case Kind::crossing_polygons:
      return {ErrorCode::crossing_polygons, " crosses ", ""};
    case Kind::overlapping_polygons:
      break;
  }
  return {ErrorCode::overlapping_polygons, " overlaps ", ""};
}

[[noreturn]] void fail_polygon(ErrorCode code, PolygonId id, const std::string& what,
                               const Point<3>& at) {
  throw Error(code, "polygon " + id_text(id) + " " + what, {}, {mesher::Feature(id)},
              {position_of(at)});
}

void require_loops_inside(const Polygon& f, PolygonId id) {
  for (std::size_t loop = 1; loop < f.loop_end.size(); ++loop) {
    const std::uint32_t i = f.loop_begin(loop);
    const Point<3> middle = scaled(0.5, plus(f.places[i], f.places[f.next(i)]));
    if (loop_contains(f, 0, f.plane.in_frame(middle))) continue;
    fail_polygon(ErrorCode::bad_polygon, id,
                 "has a loop at " + place_text(f.places[i]) + " that does not lie in its first",
                 f.places[i]);
  }
}

void require_edges_once(const Polygon& f, PolygonId id, const FeatureStore& store) {
  std::vector<EdgeHandle> edges = f.edges;
  std::sort(edges.begin(), edges.end());
  const auto twice = std::adjacent_find(edges.begin(), edges.end());
  if (twice == edges.end()) return;
  const Edge& e = store.edges()[*twice];
  fail_polygon(
      ErrorCode::bad_polygon, id,
      "has the edge from " + place_text(e.place_a) + " to " + place_text(e.place_b) + " twice",
      e.place_a);
}

void require_declared_inside(const Polygon& f, PolygonId id, const FeatureStore& store) {
  const auto require = [&](const Point<3>& x, const std::string& what, const Point<3>& at) {
    if (contains(f, x)) return;
    fail_polygon(ErrorCode::bad_polygon, id,
                 "declares " + what + place_text(at) + " to lie in it, which does not", at);
  };
  std::vector<VertexHandle> corners = f.corners;
  make_set(corners);
  for (const VertexHandle v : f.points) {
    const Point<3>& p = store.points()[v].p;
    if (!std::binary_search(corners.begin(), corners.end(), v)) require(p, "a point at ", p);
  }
  for (const EdgeHandle h : f.all_edges) {
    const Edge& e = store.edges()[h];
    if (f.corner_at(h) != Polygon::kInner) continue;
    require(scaled(0.5, plus(e.place_a, e.place_b)), "an edge from ", e.place_a);
  }
}

}  // namespace

NamedFeature named(const Feature& f, const SpaceNames& names, const FeatureStore& store) {
  if (f.kind() == Feature::Kind::point) {
    const mesher::Feature point = mesher::Feature(names.point(f.handle()));
    return {text_of(point), point};
  }
  if (f.kind() == Feature::Kind::polygon) {
    const mesher::Feature polygon = mesher::Feature(names.polygon(f.handle()));
    return {text_of(polygon), polygon};
  }
  if (const auto id = names.segment(f.handle()))
    return {text_of(mesher::Feature(*id)), mesher::Feature(*id)};
  std::optional<PolygonId> least;
  for (const PolygonHandle g : store.polygons_at(store.edges()[f.handle()])) {
    if (const PolygonId id = names.polygon(g); !least || id < *least) least = id;
  }
  const mesher::Feature polygon = mesher::Feature(least.value_or(PolygonId{}));
  return {"an edge of " + text_of(polygon), polygon};
}

void fail(const SpaceConflict& c, const SpaceNames& names, const FeatureStore& store) {
  NamedFeature one = named(c.one, names, store), other = named(c.other, names, store);
  if (other.text < one.text && c.one.kind() == c.other.kind()) std::swap(one, other);
  const Words words = words_of(c.kind);
  const bool itself = one.text == other.text;
  throw Error(words.code,
              one.text + words.verb + (itself ? "another of it" : other.text) + " at " +
                  place_text(c.at) + words.rest,
              {}, {one.feature, other.feature}, {position_of(c.at)});
}

void require_shape(const Polygon& f, PolygonId id, const FeatureStore& store) {
  if (!has_area(f)) {
    fail_polygon(ErrorCode::bad_polygon, id,
                 "has no area; its first corner is at " + place_text(f.places.front()),
                 f.places.front());
  }
  if (!is_flat(f)) {
    const Deviation most = deviation(f);
    fail_polygon(ErrorCode::not_flat, id,
                 "is not flat: " + place_text(most.at) + " is " + text::to_text(most.height) +
                     " off its plane",
                 most.at);
  }
  require_edges_once(f, id, store);
  require_loops_inside(f, id);
  require_declared_inside(f, id, store);
}

}  // namespace mesher::detail
