// Inputs, and the places of their features, for errors.
#include "geometry/input_point.hpp"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <string_view>
#include <utility>

#include "pipe.hpp"

namespace tool {
namespace {

using mesher::Error;
using mesher::ErrorCode;
using mesher::Featured;
using mesher::FeatureId;
using mesher::Place;

template <class Part>
std::size_t find(const std::vector<Part>& parts, FeatureId id) {
  std::size_t i = 0;
  while (i < parts.size() && parts[i].id != id) ++i;
  return i;
}

// Of features that the message names in the order of the ids.
std::vector<Featured> kinds_named(const Error& error) {
  std::vector<Featured> kinds;
  std::size_t at = 0;
  const std::string message = error.message() + ' ';
  for (const FeatureId id : error.ids()) {
    const std::string number = ' ' + std::to_string(static_cast<std::int64_t>(id));
    const auto after = [&](const std::string& word) {
      std::size_t found = message.find(word + number, at);
      while (found != std::string::npos &&
             std::isdigit(static_cast<unsigned char>(message[found + word.size() + number.size()])))
        found = message.find(word + number, found + 1);
      return found;
    };
    const std::pair<std::size_t, Featured> first = std::min(
        {std::pair(after("segment"), Featured::line), std::pair(after("point"), Featured::point),
         std::pair(after("polygon"), Featured::polygon)});
    kinds.push_back(first.first == std::string::npos ? Featured::line : first.second);
    at = std::min(first.first, message.size() - 1) + 1;
  }
  return kinds;
}

// What the ids of an error are of.
std::vector<Featured> kinds_of(const Error& error) {
  const Featured p = Featured::point, l = Featured::line;
  switch (error.code()) {
    case ErrorCode::repeated_segment:
      return {l, l};
    case ErrorCode::unknown_id:  // of a line's end, or of something that has a place
      return error.ids().size() == 2 ? kinds_named(error) : std::vector<Featured>();
    case ErrorCode::bad_option:
      return {l};
    case ErrorCode::duplicate_point:
    case ErrorCode::outside_domain:
      return {p, p};
    case ErrorCode::bad_polygon:
      return {Featured::polygon, p};
    case ErrorCode::not_flat:
    case ErrorCode::repeated_polygon:
      return {Featured::polygon, Featured::polygon};
    case ErrorCode::zero_length:
    case ErrorCode::crossing_segments:
    case ErrorCode::overlapping_segments:
    case ErrorCode::point_on_segment:
    case ErrorCode::point_in_use:
    case ErrorCode::point_on_polygon:
    case ErrorCode::segment_on_polygon:
    case ErrorCode::segment_through_polygon:
    case ErrorCode::crossing_polygons:
    case ErrorCode::overlapping_polygons:
    case ErrorCode::too_close:
    case ErrorCode::too_many:
      return kinds_named(error);
    default:
      return {};
  }
}

std::string words(Featured kind, FeatureId id) {
  const char* const what = kind == Featured::point     ? "point "
                           : kind == Featured::polygon ? "polygon "
                                                       : "segment ";
  return what + std::to_string(static_cast<std::int64_t>(id));
}

// What a repair does about the error, "" if nothing: lines that meet at tiny angles it leaves.
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
      if (error.message().find(" angles ") != std::string::npos) return "";
      return "; --repair may mend this: it joins what is closer than " + reach +
             " of the box's side";
    default:
      return "";
  }
}

bool same_line(const Place& a, const Place& b) { return a.file == b.file && a.line == b.line; }

}  // namespace

std::string text_of(const Place& place) {
  const std::string file = with_own_paths(place.file);
  return place.line > 0 ? file + ":" + std::to_string(place.line) : file;
}

Place Standing::place(Featured kind, FeatureId id) const {
  const auto edited = edited_.find({kind, id});
  return edited != edited_.end() ? edited->second : place_in_file(kind, id);
}

Error Standing::located(const Error& error) const {
  if (error.code() == ErrorCode::cancelled) return error;
  const std::vector<Featured> kinds = kinds_of(error);
  Place blamed = error.place();
  std::string others;
  bool mends = offers_repair_;
  for (std::size_t i = 0; i < std::min(kinds.size(), error.ids().size()); ++i) {
    const Place stands = place(kinds[i], error.ids()[i]);
    mends = mends && !edited_.contains({kinds[i], error.ids()[i]});
    if (stands.line == 0 || same_line(stands, blamed)) continue;
    if (blamed.line == 0) {
      blamed = stands;
    } else {
      others +=
          (others.empty() ? " (" : ", ") + words(kinds[i], error.ids()[i]) + ": " + text_of(stands);
    }
  }
  if (blamed.file.empty()) blamed.file = path_;
  if (!others.empty()) others += ")";
  if (mends) others += repair_hint(error, repair_reach());
  return Error(error.code(), error.message() + others, blamed, error.ids());
}

std::string Standing::warning_text(const mesher::SeedName& seed, const std::string& what) const {
  const bool hole = seed.kind == mesher::SeedKind::hole;
  return text_of(place(hole ? Featured::hole : Featured::region, seed.id)) + ": warning: " + what;
}

// --- In the plane ----------------------------------------------------------------------------

Input::Input(const std::string& path, mesher::CoincidingPoints coinciding)
    : Standing(path), file_(mesher::read_pslg(path, coinciding)) {}

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

bool Input::has_region_limits() const {
  const auto& regions = file_.pslg.regions;
  return edits_limits() || std::any_of(regions.begin(), regions.end(), [](const auto& region) {
           return region.max_area.has_value();
         });
}

Place Input::place_in_file(Featured kind, FeatureId id) const {
  const auto& graph = file_.pslg;
  const auto at = [&](const auto& parts, auto place_of) {
    const std::size_t i = find(parts, id);
    return i < parts.size() ? (file_.*place_of)(i) : Place{file_.file};
  };
  switch (kind) {
    case Featured::point:
      return at(graph.points, &mesher::PslgFile::place_of_point);
    case Featured::hole:
      return at(graph.holes, &mesher::PslgFile::place_of_hole);
    case Featured::region:
      return at(graph.regions, &mesher::PslgFile::place_of_region);
    case Featured::line:
    case Featured::polygon:
    case Featured::nothing:
      break;
  }
  const Place segment = at(graph.segments, &mesher::PslgFile::place_of_segment);
  return segment.line > 0 ? segment : at(graph.polylines, &mesher::PslgFile::place_of_polyline);
}

std::string Input::warning(const mesher::SeedFault& fault) const {
  return warning_text(fault.seed, describe(fault));
}

}  // namespace tool
