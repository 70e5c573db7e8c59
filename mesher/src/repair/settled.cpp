// Polygons that are no polygons yet.
#include <algorithm>
#include <set>
#include <string>

#include "geometry/input_point.hpp"
#include "repair/cutting.hpp"
#include "sets/make_set.hpp"

namespace mesher::detail {

namespace {

// Without corners that follow themselves, and edges without length.
void tidy(PolygonParts& parts) {
  for (Loop& loop : parts.loops) {
    loop.erase(std::unique(loop.begin(), loop.end()), loop.end());
    while (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
  }
  for (Ends& e : parts.edges) e = in_order(e.first, e.second);
  make_set(parts.edges);
  std::erase_if(parts.edges, [](const Ends& e) { return e.first == e.second; });
  make_set(parts.points);
}

// Whether no loop passes a point twice, nor two of them, if that is asked for, nor an edge.
bool is_simple(const PolygonParts& parts, bool apart) {
  std::vector<VertexHandle> all;
  std::vector<Ends> edges;
  for (const Loop& loop : parts.loops) {
    if (loop.size() < 3) return false;
    std::vector<VertexHandle> corners = loop;
    make_set(corners);
    if (corners.size() < loop.size()) return false;
    all.insert(all.end(), loop.begin(), loop.end());
    for (std::size_t i = 0; i < loop.size(); ++i) {
      edges.push_back(in_order(loop[i], loop[(i + 1) % loop.size()]));
    }
  }
  const auto has_twice = [](auto items) {
    std::sort(items.begin(), items.end());
    return std::adjacent_find(items.begin(), items.end()) != items.end();
  };
  return !parts.loops.empty() && !has_twice(edges) && !(apart && has_twice(all));
}

bool are_loops_inside(const Polygon& f) {
  for (std::size_t loop = 1; loop < f.loop_end.size(); ++loop) {
    const std::uint32_t i = f.loop_begin(loop);
    const Point<3> middle = scaled(0.5, plus(f.places[i], f.places[f.next(i)]));
    if (!loop_contains(f, 0, f.plane.in_frame(middle))) return false;
  }
  return true;
}

// Drops what a polygon declares to lie in it, which does not.
void drop_outside(PolygonParts& parts, const Polygon& f, const FeatureStore& store) {
  std::vector<VertexHandle> corners = f.corners;
  make_set(corners);
  const auto place = [&](VertexHandle v) { return store.points()[v].p; };
  std::erase_if(parts.points, [&](VertexHandle v) {
    return !std::binary_search(corners.begin(), corners.end(), v) && !contains(f, place(v));
  });
  std::set<Ends> outline;
  for (std::uint32_t i = 0; i < f.corners.size(); ++i) {
    outline.insert(in_order(f.corners[i], f.corners[f.next(i)]));
  }
  std::erase_if(parts.edges, [&](const Ends& e) {
    const Point<3> middle = scaled(0.5, plus(place(e.first), place(e.second)));
    return outline.count(e) == 0 && !contains(f, middle);
  });
}

}  // namespace

std::optional<PolygonParts> polygon_of(PolygonParts parts, FeatureStore& store) {
  const Polygon& f = store.record(parts);
  if (!has_area(f) || !are_loops_inside(f)) return std::nullopt;
  drop_outside(parts, f, store);
  return is_flat(store.record(parts)) ? std::optional(parts) : std::nullopt;
}

std::vector<PolygonParts> settled(const Sheet& sheet, PolygonId polygon, double tolerance,
                                  FeatureStore& store, const Drawing<3>::AddInside& add_inside) {
  PolygonParts parts = sheet.parts;
  tidy(parts);
  if (!sheet.is_cut_up && is_simple(parts, sheet.is_redrawn)) {
    if (const auto as_it_is = polygon_of(parts, store)) return {*as_it_is};
  }
  add_inside(parts);
  auto pieces = cut(parts, sheet.is_cut_up, tolerance, store);
  if (pieces) return std::move(*pieces);
  const Point<3>& at = store.points()[parts.loops[0][0]].p;
  const std::string id = std::to_string(static_cast<std::int64_t>(polygon));
  throw Error(
      ErrorCode::not_flat,
      "polygon " + id + ", which begins at " + place_text(at) +
          ", is too bent to be cut into triangles: its edges cross wherever it is seen from, "
          "and it has holes or many corners",
      {}, {mesher::Feature(polygon)}, {position_of(at)});
}

}  // namespace mesher::detail
