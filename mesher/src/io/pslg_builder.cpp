// Graphs of formats without ids.
#include <utility>

#include "io/names_read.hpp"
#include "io/read_pslg.hpp"

namespace mesher {

PointId PslgBuilder::add_point(const Point<2>& at, std::int64_t marker, FilePosition position) {
  const PointId id{static_cast<std::int64_t>(out_.graph.points.size()) + 1};
  out_.graph.points.push_back({id, at, marker});
  out_.points.push_back(position);
  return id;
}

PointId PslgBuilder::point_at(const Point<2>& at, std::int64_t marker, FilePosition position) {
  const auto [found, is_new] = at_.try_emplace(at, out_.graph.points.size());
  if (is_new) return add_point(at, marker, position);
  GraphPoint<2>& point = out_.graph.points[found->second];
  if (point.marker == 0) point.marker = marker;
  return point.id;
}

LineId PslgBuilder::add_line(std::vector<PointId> points, std::int64_t marker,
                             FilePosition position) {
  const LineId id{++lines_};
  if (points.size() == 2) {
    out_.graph.segments.push_back({id, points[0], points[1], marker});
    out_.segments.push_back(position);
  } else {
    out_.graph.polylines.push_back({id, std::move(points), marker});
    out_.polylines.push_back(position);
  }
  return id;
}

void PslgBuilder::add_hole(const Point<2>& at, FilePosition position) {
  out_.graph.seeds.push_back(hole_seed<2>(++holes_, at));
  out_.seeds.push_back(position);
}

void PslgBuilder::add_region(const Point<2>& at, double attribute, std::optional<double> max_area,
                             FilePosition position) {
  out_.graph.seeds.push_back(region_seed<2>(++regions_, at, attribute, max_area));
  out_.seeds.push_back(position);
}

void PslgBuilder::name_marker(std::int64_t marker, const NameInFile& name) {
  GroupNames& names = out_.graph.names;
  add_name(names, names.facets, marker, name.text, name.place, notes_);
}
void PslgBuilder::name_region(double attribute, const NameInFile& name) {
  GroupNames& names = out_.graph.names;
  add_name(names, names.regions, attribute + 0.0, name.text, name.place, notes_);
}

GraphFile<2> PslgBuilder::finish() {
  out_.notes = notes_.notes();
  return std::move(out_);
}

}  // namespace mesher
