// Merges points, makes the drawing fit together, and draws segments and polygons anew.
#include <algorithm>
#include <numeric>
#include <unordered_map>

#include "graph/distinct_ids.hpp"
#include "graph/require_ids.hpp"
#include "mesher/mesher.hpp"
#include "mesher/repair.hpp"
#include "program/space_input.hpp"
#include "repair/merging.hpp"
#include "repair/space_arrange.hpp"
#include "repair/space_redraw.hpp"

namespace mesher {

namespace {

using detail::Drawn;
using detail::PolygonParts;
using detail::SpaceDrawing;
using detail::VertexHandle;

// A gap has to be as wide as a few of the shortest pieces (program/split_segments.hpp), and a
// triangle as high as its area needs that has its corners in a box of a quarter of the side
// (space/polygon_shape.cpp: 2^-40 of the reach's square).
constexpr double kSpaceShare = 0x1p-42;
constexpr double kSpaceUnits = 64;

void require_ids(const GraphFile<3>& file) {
  const Graph<3>& plc = file.graph;
  detail::require_distinct_ids(plc, &file);
  std::unordered_map<PointId, bool> points;
  for (const auto& p : plc.points) points.emplace(p.id, true);
  const auto require = [&](PointId id, const char* what, const mesher::Feature& user,
                           const FileLocation& place) {
    if (points.count(id) > 0) return;
    try {
      detail::fail_unknown_point(id, what, user);
    } catch (const Error& error) {
      throw error.at(place);
    }
  };
  for (std::size_t i = 0; i < plc.segments.size(); ++i) {
    for (const PointId end : {plc.segments[i].from, plc.segments[i].to}) {
      require(end, "an end of", mesher::Feature(plc.segments[i].id), file.location_of_segment(i));
    }
  }
  for (std::size_t i = 0; i < plc.polygons.size(); ++i) {
    const mesher::Polygon& f = plc.polygons[i];
    const FileLocation place = file.location_of_polygon(i);
    for (const auto& loop : f.loops) {
      for (const PointId id : loop) require(id, "a corner of", mesher::Feature(f.id), place);
    }
    for (const auto& [a, b] : f.edges) {
      for (const PointId id : {a, b}) require(id, "in", mesher::Feature(f.id), place);
    }
    for (const PointId id : f.points) require(id, "in", mesher::Feature(f.id), place);
  }
}

template <class Parts, class IdOf>
std::vector<std::size_t> ranked(const Parts& parts, IdOf&& id_of) {
  std::vector<std::size_t> order(parts.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t i, std::size_t j) { return id_of(parts[i]) < id_of(parts[j]); });
  return order;
}

Drawn draw(const Graph<3>& plc, SpaceDrawing& drawing) {
  Drawn drawn;
  drawn.points.resize(plc.points.size());
  std::unordered_map<PointId, VertexHandle> handles;
  for (const std::size_t i : detail::merging_order(plc.points)) {
    const auto near = drawing.points_near(plc.points[i].at);
    drawn.points[i] = near.empty() ? drawing.add_point(plc.points[i].at) : near[0];
    if (near.empty()) drawn.keepers.push_back(i);
    handles.emplace(plc.points[i].id, drawn.points[i]);
  }
  drawn.segments = ranked(plc.segments, [](const auto& s) { return s.id; });
  for (const std::size_t i : drawn.segments) {
    drawing.add_path({handles.at(plc.segments[i].from), handles.at(plc.segments[i].to)});
  }
  drawn.facets = ranked(plc.polygons, [](const auto& f) { return f.id; });
  const auto is_moved = [&](PointId id) {
    return plc.points[drawn.keepers[handles.at(id) - std::size_t{1}]].id != id;
  };
  for (std::size_t rank = 0; rank < drawn.facets.size(); ++rank) {
    const mesher::Polygon& f = plc.polygons[drawn.facets[rank]];
    const bool is_redrawn = std::any_of(f.loops.begin(), f.loops.end(), [&](const auto& loop) {
      return std::any_of(loop.begin(), loop.end(), is_moved);
    });
    drawing.add_sheet(rank, detail::drawn_parts(f, handles), is_redrawn);
  }
  return drawn;
}

// What a Mesher says of it.
void require_sound(const Graph<3>& plc, const Options<3>& options) {
  try {
    detail::require_complex(places_of(plc), plc.segments, plc.polygons, options,
                            detail::ids_of(plc.points));
  } catch (const Error& error) {
    throw Error(
        ErrorCode::too_close,
        "what is there is too close to each other to be repaired: after it, " + error.message());
  }
}

// Their pieces stand where they do.
void take_polylines_apart(GraphFile<3>& file) {
  for (std::size_t i = 0; i < file.graph.polylines.size(); ++i) {
    const std::size_t points = file.graph.polylines[i].points.size();
    file.segments.insert(file.segments.end(), points > 0 ? points - 1 : 0, file.polylines[i]);
  }
  file.polylines.clear();
  file.graph = without_polylines(std::move(file.graph));
}

Repaired<3> repair_placed(const GraphFile<3>& file, const std::optional<Box<3>>& given) {
  require_ids(file);
  detail::require_attributes(file.graph);
  const Graph<3>& plc = file.graph;
  if (plc.points.empty()) return {file, {}, 0, 0};
  const detail::MeshBox<3> box = detail::box_of_points(file, given);
  SpaceDrawing drawing(box, detail::tolerance_in(box, kSpaceShare, kSpaceUnits));
  const Drawn drawn = draw(plc, drawing);
  std::vector<PolygonId> names;
  for (const std::size_t i : drawn.facets) names.push_back(plc.polygons[i].id);
  detail::arrange(drawing, names);
  Repaired<3> repaired = detail::redraw(file, drawing, drawn);
  const Box<3> domain = given ? *given : snapped_domain<3>(places_of(plc));
  require_sound(repaired.file.graph, {.domain = domain});
  return repaired;
}

}  // namespace

Repaired<3> repair(const GraphFile<3>& file, const std::optional<Box<3>>& domain) {
  GraphFile<3> placed = file;
  detail::add_positions(placed);
  take_polylines_apart(placed);
  return repair_placed(placed, domain);
}

Repaired<3> repair(const Graph<3>& plc, const std::optional<Box<3>>& domain) {
  GraphFile<3> file;
  file.graph = plc;
  return repair(file, domain);
}

}  // namespace mesher
