// The words and exit codes of errors, and the one line that a person reads.
#include "mesher/error.hpp"

#include <array>

#include "text/printable.hpp"

namespace mesher {
namespace {

struct CodeRow {
  std::string_view name;
  ExitCode exit;
};

// Points that cannot be meshed together exit as geometry; what a file may not contain as format;
// what the command line names wrongly (an unreadable path included) as usage.
CodeRow row(ErrorCode code) noexcept {
  switch (code) {
    case ErrorCode::duplicate_point:
      return {"duplicate_point", ExitCode::geometry};
    case ErrorCode::outside_domain:
      return {"outside_domain", ExitCode::geometry};
    case ErrorCode::too_close:
      return {"too_close", ExitCode::geometry};
    case ErrorCode::crossing_segments:
      return {"crossing_segments", ExitCode::geometry};
    case ErrorCode::point_on_segment:
      return {"point_on_segment", ExitCode::geometry};
    case ErrorCode::overlapping_segments:
      return {"overlapping_segments", ExitCode::geometry};
    case ErrorCode::zero_length:
      return {"zero_length", ExitCode::geometry};
    case ErrorCode::repeated_segment:
      return {"repeated_segment", ExitCode::geometry};
    case ErrorCode::point_in_use:
      return {"point_in_use", ExitCode::geometry};
    case ErrorCode::bad_quality:
      return {"bad_quality", ExitCode::geometry};
    case ErrorCode::not_finite:
      return {"not_finite", ExitCode::format};
    case ErrorCode::magnitude:
      return {"magnitude", ExitCode::format};
    case ErrorCode::unknown_id:
      return {"unknown_id", ExitCode::format};
    case ErrorCode::repeated_id:
      return {"repeated_id", ExitCode::format};
    case ErrorCode::wrong_count:
      return {"wrong_count", ExitCode::format};
    case ErrorCode::truncated:
      return {"truncated", ExitCode::format};
    case ErrorCode::bad_number:
      return {"bad_number", ExitCode::format};
    case ErrorCode::bad_header:
      return {"bad_header", ExitCode::format};
    case ErrorCode::bad_edit:
      return {"bad_edit", ExitCode::format};
    case ErrorCode::unbalanced_commit:
      return {"unbalanced_commit", ExitCode::format};
    case ErrorCode::bad_dimension:
      return {"bad_dimension", ExitCode::format};
    case ErrorCode::bad_syntax:
      return {"bad_syntax", ExitCode::format};
    case ErrorCode::unsupported:
      return {"unsupported", ExitCode::format};
    case ErrorCode::bad_mesh:
      return {"bad_mesh", ExitCode::format};
    case ErrorCode::unknown_format:
      return {"unknown_format", ExitCode::usage};
    case ErrorCode::cannot_read:
      return {"cannot_read", ExitCode::usage};
    case ErrorCode::cannot_write:
      return {"cannot_write", ExitCode::usage};
    case ErrorCode::bad_option:
      return {"bad_option", ExitCode::usage};
    case ErrorCode::too_many:
      return {"too_many", ExitCode::limit};
    case ErrorCode::cancelled:
      return {"cancelled", ExitCode::cancelled};
    case ErrorCode::bad_seed:
      return {"bad_seed", ExitCode::geometry};
    case ErrorCode::bad_polygon:
      return {"bad_polygon", ExitCode::geometry};
    case ErrorCode::not_flat:
      return {"not_flat", ExitCode::geometry};
    case ErrorCode::repeated_polygon:
      return {"repeated_polygon", ExitCode::geometry};
    case ErrorCode::point_on_polygon:
      return {"point_on_polygon", ExitCode::geometry};
    case ErrorCode::segment_on_polygon:
      return {"segment_on_polygon", ExitCode::geometry};
    case ErrorCode::segment_through_polygon:
      return {"segment_through_polygon", ExitCode::geometry};
    case ErrorCode::crossing_polygons:
      return {"crossing_polygons", ExitCode::geometry};
    case ErrorCode::overlapping_polygons:
      return {"overlapping_polygons", ExitCode::geometry};
  }
  return {"unknown", ExitCode::bug};
}

// "FILE:LINE:COL: ", as far as known.
std::string prefix_of(const FileLocation& location) {
  if (location.file.empty()) return {};
  std::string text = text::printable(location.file) + ":";
  if (location.line > 0) text += std::to_string(location.line) + ":";
  if (location.line > 0 && location.column > 0) text += std::to_string(location.column) + ":";
  return text + " ";
}

bool same_line(const FileLocation& a, const FileLocation& b) {
  return a.file == b.file && a.line == b.line;
}

}  // namespace

std::string_view code_name(ErrorCode code) noexcept { return row(code).name; }

ExitCode exit_code(ErrorCode code) noexcept { return row(code).exit; }

std::string text_of(const FileLocation& location) {
  return location.line > 0 ? location.file + ":" + std::to_string(location.line) : location.file;
}

std::string text_of(const Feature& feature) {
  static constexpr std::array<const char*, 6> kNames{"",         "point ", "segment ",
                                                     "polygon ", "hole ",  "region "};
  if (feature.kind == FeatureKind::none) return {};
  return kNames[static_cast<std::size_t>(feature.kind)] + std::to_string(feature.number);
}

Error::Error(ErrorCode code, std::string message, FileLocation location,
             std::vector<Feature> features, std::vector<Position> places)
    : std::runtime_error(prefix_of(location) + "error[" + std::string(code_name(code)) +
                         "]: " + text::printable(message)),
      code_(code),
      message_(text::printable(message)),
      location_(std::move(location)),
      features_(std::move(features)),
      places_(std::move(places)) {}

Error Error::changed(std::string message, FileLocation location) const {
  Error error(code_, std::move(message), std::move(location), features_, places_);
  error.locations_ = locations_;
  return error;
}

Error Error::with_locations(std::vector<FileLocation> locations) const {
  Error error = *this;
  error.locations_ = std::move(locations);
  return error;
}

Error located(const Error& error, const std::function<FileLocation(const Feature&)>& location_of) {
  FileLocation blamed = error.location();
  std::vector<FileLocation> locations;
  std::string others;
  for (const Feature& feature : error.features()) {
    const FileLocation& stands = locations.emplace_back(location_of(feature));
    if (stands.line == 0 || same_line(stands, blamed)) continue;
    if (blamed.line == 0) {
      blamed = stands;
    } else {
      others += (others.empty() ? " (" : ", ") + text_of(feature) + ": " + text_of(stands);
    }
  }
  if (!others.empty()) others += ")";
  return error.with_message(error.message() + others)
      .at(std::move(blamed))
      .with_locations(std::move(locations));
}

}  // namespace mesher
