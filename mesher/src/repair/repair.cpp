// Merges points, makes the drawing fit together, and draws lines and polygons anew.
#include "mesher/repair.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <unordered_set>

#include "geometry/input_point.hpp"
#include "graph/distinct_ids.hpp"
#include "graph/require_ids.hpp"
#include "mesher/mesher.hpp"
#include "program/space_input.hpp"
#include "repair/arrange.hpp"
#include "repair/redraw.hpp"
#include "rules/mesh_box.hpp"
#include "text/text.hpp"

namespace mesher {

namespace {

using detail::Drawing;
using detail::Drawn;

// In the plane a segment can be 2^-46 of the box's side from a point (program/split_segments.hpp).
// In space a gap has to be as wide as a few of the shortest pieces, and a triangle as high as its
// area needs that has its corners in a box of a quarter of the side (space/polygon_shape.cpp: 2^-40
// of the reach's square).
template <int D>
constexpr double kShare = D == 2 ? 0x1p-44 : 0x1p-42;
template <int D>
constexpr double kUnits = D == 2 ? 16 : 64;

// --- What can be repaired, and where -----------------------------------------------------------

// `file` with a position for each part: an unknown one where it has none, as one that was made by
// hand.
template <int D>
void add_positions(GraphFile<D>& file) {
  const Graph<D>& graph = file.graph;
  file.points.resize(graph.points.size());
  file.segments.resize(graph.segments.size());
  file.polylines.resize(graph.polylines.size());
  if constexpr (D == 3) file.polygons.resize(graph.polygons.size());
  file.seeds.resize(graph.seeds.size());
}

// Throws: Error(wrong_count), if not each point has its attributes.
template <int D>
void require_attributes(const Graph<D>& input) {
  const std::size_t n = input.attributes_per_point, all = input.attributes.size();
  if (n == 0 ? all == 0 : all % n == 0 && all / n == input.points.size()) return;
  throw Error(ErrorCode::wrong_count, std::to_string(all) + " attributes are there, of " +
                                          std::to_string(input.points.size()) + " points with " +
                                          std::to_string(n) + " each");
}

// Throws: Error (not_finite, magnitude, outside_domain).
template <int D>
void require_in(const GraphFile<D>& file, const Box<D>& domain) {
  const auto& points = file.graph.points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    try {
      detail::check_point(points[i].at, domain, points[i].id);
    } catch (const Error& error) {
      throw error.at(file.location_of_point(i));
    }
  }
}

// Where it is repaired. Throws: Error (not_finite, magnitude).
template <int D>
Box<D> domain_of(const GraphFile<D>& file, const std::optional<Box<D>>& given) {
  Box<D> everywhere;
  everywhere.lo.fill(-0x1p101);
  everywhere.hi.fill(0x1p101);
  require_in(file, everywhere);
  return given ? *given : snapped_domain<D>(places_of(file.graph));
}

// A share of the box's side, and some units in the last place of the largest coordinate: places
// near the box's corners are rounded to these.
template <int D>
double least_tolerance(const detail::MeshBox<D>& box) {
  double largest = 0;
  for (int i = 0; i < D; ++i) {
    largest = std::max({largest, std::abs(box.lo[i]), std::abs(box.hi(i))});
  }
  const double unit = std::nextafter(largest, std::numeric_limits<double>::infinity()) - largest;
  return std::max(box.side * kShare<D>, kUnits<D> * unit);
}

// What is as close is made to touch. Throws: Error(bad_option).
template <int D>
double tolerance_in(const detail::MeshBox<D>& box, const std::optional<double>& given) {
  const double least = least_tolerance(box);
  if (!given) return D == 2 ? least : std::max(least, box.side * kDefaultRepairShare);
  const double most = box.side * kLargestRepairShare;
  if (*given >= 0 && *given <= most) return std::max(least, *given);
  throw Error(ErrorCode::bad_option, "the tolerance of a repair is " + text::to_text(*given) +
                                         ", not from 0 to " + text::to_text(most) +
                                         ", a 64th of the side of the meshing box");
}

void require_parts(const GraphFile<2>& file) { detail::require_ids(file.graph, &file); }

void require_parts(const GraphFile<3>& file) {
  const Graph<3>& plc = file.graph;
  detail::require_distinct_ids(plc, &file);
  std::unordered_set<PointId> points;
  for (const auto& p : plc.points) points.insert(p.id);
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

// In space lines are segments. Their pieces stand where they do.
void prepare(GraphFile<2>&) {}
void prepare(GraphFile<3>& file) {
  for (std::size_t i = 0; i < file.graph.polylines.size(); ++i) {
    const std::size_t points = file.graph.polylines[i].points.size();
    file.segments.insert(file.segments.end(), points > 0 ? points - 1 : 0, file.polylines[i]);
  }
  file.polylines.clear();
  file.graph = without_polylines(std::move(file.graph));
}

// --- What is drawn, until it fits together ---------------------------------------------------

// Rods for all pieces of lines, in an order of their own.
void arrange(const Graph<2>& pslg, const Drawn<2>& drawn, Drawing<2>& drawing, double) {
  std::vector<detail::Ends> rods;
  for (const Segment& s : segments_of(pslg)) {
    const detail::Ends ends = detail::in_order(drawn.spot(s.from), drawn.spot(s.to));
    if (ends.first != ends.second) rods.push_back(ends);
  }
  std::sort(rods.begin(), rods.end());
  for (const auto& [s, t] : rods) drawing.rod(s, t);
  detail::arrange(drawing);
}

// Paths and sheets by rank of ids.
void arrange(const Graph<3>& plc, const Drawn<3>& drawn, Drawing<3>& drawing, double least) {
  for (const std::size_t i : detail::ranked(plc.segments)) {
    drawing.add_path({drawn.spot(plc.segments[i].from), drawn.spot(plc.segments[i].to)});
  }
  const auto is_moved = [&](PointId id) { return !drawn.stays(drawn.by_id.at(id)); };
  std::vector<PolygonId> names;
  for (const std::size_t i : detail::ranked(plc.polygons)) {
    const mesher::Polygon& f = plc.polygons[i];
    const bool is_redrawn = std::any_of(f.loops.begin(), f.loops.end(), [&](const auto& loop) {
      return std::any_of(loop.begin(), loop.end(), is_moved);
    });
    drawing.add_sheet(names.size(), detail::drawn_parts(f, drawn), is_redrawn);
    names.push_back(f.id);
  }
  detail::arrange(drawing, names, least);
}

// What a Mesher says of it.
void require_complex(const Graph<3>& plc, const Box<3>& domain) {
  detail::require_complex(places_of(plc), plc.segments, plc.polygons, {.domain = domain},
                          detail::ids_of(plc.points));
}

// Most files are fine: that is found in less time than it takes to draw them.
bool is_sound(const Graph<3>& plc, const Box<3>& domain) {
  try {
    require_complex(plc, domain);
    return true;
  } catch (const Error&) {
    return false;
  }
}

void require_sound(const Graph<3>& plc, const Box<3>& domain) {
  try {
    require_complex(plc, domain);
  } catch (const Error& error) {
    throw Error(
        ErrorCode::too_close,
        "what is there is too close to each other to be repaired: after it, " + error.message());
  }
}

template <int D>
Repaired<D> repair_file(GraphFile<D> file, const RepairOptions<D>& options) {
  add_positions(file);
  prepare(file);
  require_parts(file);
  require_attributes(file.graph);
  if (file.graph.points.empty()) return {file, {}, 0, 0};
  const Box<D> domain = domain_of(file, options.domain);
  const detail::MeshBox<D> box = detail::mesh_box(Options<D>{.domain = domain});
  require_in(file, domain);
  const double tolerance = tolerance_in(box, options.tolerance);
  if constexpr (D == 3) {  // in the plane arrange() leaves nothing to be found
    if (is_sound(file.graph, domain)) return {std::move(file), {}, tolerance, 0};
  }
  Drawing<D> drawing(box, tolerance);
  const Drawn<D> drawn = detail::draw_points(file.graph.points, drawing);
  arrange(file.graph, drawn, drawing, least_tolerance(box));
  Repaired<D> repaired = detail::redraw(file, drawing, drawn);
  repaired.file.graph.names = file.graph.names;
  repaired.tolerance = tolerance;
  if constexpr (D == 3) require_sound(repaired.file.graph, domain);
  return repaired;
}

template <int D>
GraphFile<D> file_of(const Graph<D>& graph) {
  GraphFile<D> file;
  file.graph = graph;
  return file;
}

}  // namespace

Repaired<2> repair(const GraphFile<2>& file, const RepairOptions<2>& options) {
  return repair_file(file, options);
}
Repaired<3> repair(const GraphFile<3>& file, const RepairOptions<3>& options) {
  return repair_file(file, options);
}
Repaired<2> repair(const Graph<2>& pslg, const RepairOptions<2>& options) {
  return repair(file_of(pslg), options);
}
Repaired<3> repair(const Graph<3>& plc, const RepairOptions<3>& options) {
  return repair(file_of(plc), options);
}

}  // namespace mesher
