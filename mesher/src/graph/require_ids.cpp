// Repeated ids, and ends of lines that are no points.
#include "graph/require_ids.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "graph/distinct_ids.hpp"

namespace mesher {
namespace {

std::string id_text(FeatureId id) { return std::to_string(static_cast<std::int64_t>(id)); }

void require_distinct_ids(const PslgFile& f) {
  require_distinct_parts(f.pslg, f);
  Named lines =
      named(FeatureKind::line, f.pslg.segments, [&](auto i) { return f.location_of_segment(i); });
  const Named more =
      named(FeatureKind::line, f.pslg.polylines, [&](auto i) { return f.location_of_polyline(i); });
  lines.features.insert(lines.features.end(), more.features.begin(), more.features.end());
  lines.locations.insert(lines.locations.end(), more.locations.begin(), more.locations.end());
  require_distinct(lines);
}

// Throws: Error(unknown_id) for a line along a point that is none of `sorted`.
void require_known(const char* what, FeatureId line, const std::vector<FeatureId>& points,
                   const std::vector<FeatureId>& sorted, const PslgFile& f,
                   const FileLocation& place) {
  const bool alone = sorted.empty() && f.point_file == f.file;
  for (const FeatureId id : points) {
    if (std::binary_search(sorted.begin(), sorted.end(), id)) continue;
    throw Error(ErrorCode::unknown_id,
                std::string(what) + " " + id_text(line) + " ends at point " + id_text(id) +
                    ", which is not there; there are " + std::to_string(sorted.size()) +
                    " points in " + f.point_file + (alone ? ", and no .node file beside it" : ""),
                place, {line_named(line), point_named(id)});
  }
}

// Throws: Error(unknown_id) for the first line along what is no point, Error(bad_syntax) for one of
// fewer than two.
void require_known_ends(const PslgFile& f) {
  std::vector<FeatureId> ids;
  for (const auto& point : f.pslg.points) ids.push_back(point.id);
  std::sort(ids.begin(), ids.end());
  for (std::size_t i = 0; i < f.pslg.segments.size(); ++i) {
    const Pslg::Segment& s = f.pslg.segments[i];
    require_known("segment", s.id, {s.from, s.to}, ids, f, f.location_of_segment(i));
  }
  for (std::size_t i = 0; i < f.pslg.polylines.size(); ++i) {
    const Pslg::Polyline& line = f.pslg.polylines[i];
    require_known("polyline", line.id, line.points, ids, f, f.location_of_polyline(i));
    if (line.points.size() >= 2) continue;
    throw Error(ErrorCode::bad_syntax,
                "polyline " + id_text(line.id) + " has fewer than two points",
                f.location_of_polyline(i), {line_named(line.id)});
  }
}

}  // namespace

void detail::require_ids(const PslgFile& file) {
  require_distinct_ids(file);
  require_known_ends(file);
}

}  // namespace mesher
