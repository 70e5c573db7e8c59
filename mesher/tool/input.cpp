// Inputs, and where their features stand, for errors.
#include <algorithm>
#include <utility>

#include "input.hpp"

namespace tool {
namespace {

using mesher::Error;
using mesher::ErrorCode;
using mesher::Feature;
using mesher::FileLocation;

// What a repair does about the error, "" if nothing.
// `reach`: what it joins is closer.
std::string repair_hint(const Error& error, const std::string& reach) {
  switch (error.code()) {
    case ErrorCode::duplicate_point:
    case ErrorCode::crossing_segments:
    case ErrorCode::point_on_segment:
    case ErrorCode::overlapping_segments:
    case ErrorCode::repeated_segment:
    case ErrorCode::zero_length:
    case ErrorCode::bad_polygon:
    case ErrorCode::not_flat:
    case ErrorCode::repeated_polygon:
    case ErrorCode::point_on_polygon:
    case ErrorCode::segment_on_polygon:
    case ErrorCode::segment_through_polygon:
    case ErrorCode::crossing_polygons:
    case ErrorCode::overlapping_polygons:
      return "; --repair mends this";
    case ErrorCode::too_close:
      return "; --repair may mend this: it joins what is closer than " + reach +
             " of the box's side";
    default:
      return "";
  }
}

}  // namespace

FileLocation Standing::location(const Feature& feature) const {
  const auto edited = edited_.find(feature);
  return edited != edited_.end() ? edited->second : location_in_file(feature);
}

Error Standing::located(const Error& error) const {
  if (error.code() == ErrorCode::cancelled) return error;
  const auto& features = error.features();
  bool mends =
      offers_repair_ && std::none_of(features.begin(), features.end(),
                                     [&](const Feature& f) { return edited_.contains(f); });
  // Of what is not there, the edit that names it is all there is to say.
  const bool alone = error.code() == ErrorCode::unknown_id && features.size() == 1;
  Error found = mesher::located(
      error, [&](const Feature& f) { return alone ? FileLocation{} : location(f); });
  if (found.location().file.empty()) found = found.at({path_});
  // Lines that meet at tiny angles a repair leaves.
  mends = mends && !(error.code() == ErrorCode::too_close && meet(features));
  return mends ? found.with_message(found.message() + repair_hint(error, repair_reach())) : found;
}

std::string Standing::warning_text(const mesher::SeedName& seed, const std::string& what) const {
  return text_of(location(seed_named(seed))) + ": warning: " + what;
}

// --- In the plane ----------------------------------------------------------------------------

Input::Input(const std::string& path) : Standing(path), file_(mesher::read_pslg(path)) {}

std::vector<mesher::InputPoint<2>> Input::points() const {
  std::vector<mesher::InputPoint<2>> points;
  for (const auto& point : file_.pslg.points) points.push_back({point.id, point.at});
  return points;
}

void Input::repair(const std::optional<mesher::Box<2>>& domain) {
  mesher::Repaired repaired = mesher::repair(file_, domain);
  file_ = std::move(repaired.file);
  repairs_ = std::move(repaired.notes);
}

bool Input::meet(const std::vector<Feature>& features) const {
  std::vector<std::vector<mesher::FeatureId>> lines;
  for (const Feature& f : features) {
    if (f.kind != mesher::FeatureKind::line) return false;
    for (const auto& s : file_.pslg.segments) {
      if (s.id == f.id) lines.push_back({s.from, s.to});
    }
    for (const auto& line : file_.pslg.polylines) {
      if (line.id == f.id) lines.push_back(line.points);
    }
  }
  if (lines.size() < 2) return !lines.empty();
  return std::find_first_of(lines[0].begin(), lines[0].end(), lines[1].begin(), lines[1].end()) !=
         lines[0].end();
}

bool Input::has_region_limits() const {
  const auto& regions = file_.pslg.regions;
  return edits_limits() || std::any_of(regions.begin(), regions.end(), [](const auto& region) {
           return region.max_area.has_value();
         });
}

std::string Input::warning(const mesher::SeedFault& fault) const {
  return warning_text(fault.seed, describe(fault));
}

}  // namespace tool
