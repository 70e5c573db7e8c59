// What a repair has done, for people.
#include <string>

#include "input.hpp"
#include "mesher/repair.hpp"

namespace mesher {

namespace {

std::string ids_text(const std::vector<FeatureId>& ids) {
  std::string text;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (i > 0) text += i + 1 == ids.size() ? " and " : ", ";
    text += std::to_string(static_cast<std::int64_t>(ids[i]));
  }
  return text;
}

std::string id_text(FeatureId id) { return ids_text({id}); }

std::string lines_text(const std::vector<FeatureId>& lines) {
  return (lines.size() == 1 ? "line " : "lines ") + ids_text(lines);
}

std::string deed(const RepairNote& n) {
  const std::string at = " at " + detail::place_text(n.at);
  switch (n.kind) {
    case RepairKind::merged_points:
      return "point " + id_text(n.points[0]) + " is point " + id_text(n.points[1]) + at;
    case RepairKind::zero_length:
      return lines_text(n.lines) + ": a piece without length is dropped, at point " +
             id_text(n.points[0]) + ' ' + detail::place_text(n.at);
    case RepairKind::split_at_point:
      return lines_text(n.lines) + " is split at point " + id_text(n.points[0]) + ' ' +
             detail::place_text(n.at);
    case RepairKind::split_at_crossing:
      return lines_text(n.lines) + (n.lines.size() == 1 ? " crosses itself" : " cross") + at +
             ", point " + id_text(n.points[0]) + " now";
    case RepairKind::overlap:
      if (n.lines[0] == n.lines[1]) {
        return lines_text({n.lines[0]}) + " covers itself from " + detail::place_text(n.at) + " on";
      }
      return lines_text({n.lines[0]}) + " leaves to line " + id_text(n.lines[1]) +
             " what both cover, from " + detail::place_text(n.at) + " on";
    case RepairKind::renamed:
      return lines_text({n.lines[0]}) + " has a gap, and goes on as line " + id_text(n.lines[1]) +
             " from " + detail::place_text(n.at) + " on";
    case RepairKind::dropped_line:
      return lines_text(n.lines) + " is dropped: nothing is left of it";
  }
  return {};
}

}  // namespace

std::string RepairNote::text(const std::string& prefix) const {
  std::string text = place.file;
  for (const long part : {place.line, place.column}) {
    if (!text.empty() && part > 0) text += ':' + std::to_string(part);
  }
  return (text.empty() ? text : text + ": ") + prefix + deed(*this);
}

}  // namespace mesher
