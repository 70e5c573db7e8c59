// Errors about bad data, with the features, positions and file location they concern.
//
// Bad data is found once, at the boundary (a reader, Mesher::insert, the command line), and thrown
// as the one type `mesher::Error`. Its parts are typed, so programs never need to parse its
// message. Programming mistakes fail contract checks instead.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "mesher/ids.hpp"

namespace mesher {

/// The kind of mistake; `code_name` gives the word printed in `error[...]`.
enum class ErrorCode : std::uint8_t {
  duplicate_point,       ///< two input points with equal coordinates
  outside_domain,        ///< a point outside the meshing domain
  not_finite,            ///< NaN or infinity
  magnitude,             ///< a coordinate that is neither 0 nor within 2^-100 .. 2^100
  unknown_id,            ///< an id that no point or line has
  repeated_id,           ///< an id given twice
  wrong_count,           ///< a header that disagrees with what follows
  truncated,             ///< the file ends too early
  bad_number,            ///< not a number, or trailing junk
  bad_header,            ///< a header that cannot be read
  bad_edit,              ///< an edit that cannot be parsed
  unbalanced_commit,     ///< begin without commit, or the reverse
  bad_dimension,         ///< the dimension is not the requested one
  bad_syntax,            ///< text that the format does not allow
  unsupported,           ///< data that the format allows and this library does not read
  bad_mesh,              ///< a mesh file that is not a mesh (index out of range, ...)
  bad_quality,           ///< `check`: a mesh without a property that it must have
  unknown_format,        ///< an extension that no reader or writer knows
  cannot_read,           ///< the file cannot be opened or read
  cannot_write,          ///< the file cannot be written
  bad_option,            ///< an option with an invalid value
  too_close,             ///< features nearer than the domain's resolution
  crossing_segments,     ///< two segments that meet at a point which is not an end of both
  point_on_segment,      ///< an input point in the interior of a segment
  overlapping_segments,  ///< two segments that share more than a point
  zero_length,           ///< a segment from a point to itself
  repeated_segment,      ///< two segments between the same points
  point_in_use,          ///< removal of a point that is an end of a segment
  too_many,              ///< more vertices or memory than a run can hold
  cancelled,             ///< stopped by the user
  bad_seed,              ///< a hole's or region's seed without a region of its own
  bad_polygon,  ///< loops that enclose no area, repeat a corner, or are not inside the first loop
  not_flat,     ///< a polygon whose corners are not in one plane
  repeated_polygon,         ///< two polygons with the same loops
  point_on_polygon,         ///< an input point in a polygon that does not declare it
  segment_on_polygon,       ///< an edge in a polygon that does not declare it
  segment_through_polygon,  ///< a segment and a polygon that meet at a position which is no input
                            ///< point
  crossing_polygons,        ///< two polygons that meet at a position which is on no common edge
  overlapping_polygons,     ///< two polygons in one plane that share an area
};

/// The exit code of a process.
enum class ExitCode : int {
  ok = 0,
  geometry = 1,
  usage = 2,
  format = 3,
  limit = 4,
  cancelled = 5,
  bug = 70
};

[[nodiscard]] std::string_view code_name(ErrorCode code) noexcept;
[[nodiscard]] ExitCode exit_code(ErrorCode code) noexcept;

/// A location in a file; line and column count from 1, and 0 means "not known".
struct FileLocation {
  std::string file;
  long line = 0;
  long column = 0;
  friend bool operator==(const FileLocation&, const FileLocation&) = default;
};

/// FILE:LINE, or FILE where the line is not known.
[[nodiscard]] std::string text_of(const FileLocation& location);

/// Line and column in a file, from 1; 0 means "not known".
struct FilePosition {
  long line = 0;
  long column = 0;
};

/// Data in a file that was understood but is not used.
struct Note {
  std::string text;
  FileLocation location;  ///< of the first such datum
};

/// Coordinates; in the plane z = 0.
using Position = std::array<double, 3>;

template <std::size_t N>
[[nodiscard]] constexpr Position position_of(const std::array<double, N>& p) {
  Position at{};
  for (std::size_t i = 0; i < N && i < at.size(); ++i) at[i] = p[i];
  return at;
}

/// Bad data. `what()` reads `FILE:LINE:COL: error[code]: message` (the location only where known).
class Error : public std::runtime_error {
 public:
  Error(ErrorCode code, std::string message, FileLocation location = {},
        std::vector<Feature> features = {}, std::vector<Position> places = {});

  [[nodiscard]] ErrorCode code() const noexcept { return code_; }
  [[nodiscard]] const std::string& message() const noexcept { return message_; }
  /// The location in a file.
  [[nodiscard]] const FileLocation& location() const noexcept { return location_; }
  /// The features concerned, where known; the one at fault first.
  [[nodiscard]] const std::vector<Feature>& features() const noexcept { return features_; }
  /// The positions concerned, where known.
  [[nodiscard]] const std::vector<Position>& places() const noexcept { return places_; }
  /// The location of features()[i] in a file, without a line if the file does not contain it; empty
  /// unless with_locations() or located() set it.
  [[nodiscard]] const std::vector<FileLocation>& locations() const noexcept { return locations_; }

  /// The same error with another file location.
  [[nodiscard]] Error at(FileLocation location) const {
    return changed(message_, std::move(location));
  }
  /// The same error with these locations().
  [[nodiscard]] Error with_locations(std::vector<FileLocation> locations) const;
  /// The same error with another message.
  [[nodiscard]] Error with_message(std::string message) const {
    return changed(std::move(message), location_);
  }

 private:
  [[nodiscard]] Error changed(std::string message, FileLocation location) const;

  ErrorCode code_;
  std::string message_;
  FileLocation location_;
  std::vector<Feature> features_;
  std::vector<Position> places_;
  std::vector<FileLocation> locations_;
};

/// The error with locations() filled in by `location_of`, which returns a location without a line
/// for a feature that is in no file. location() becomes that of the first feature, unless it
/// already has a line; the message names the locations of the other features.
[[nodiscard]] Error located(const Error& error,
                            const std::function<FileLocation(const Feature&)>& location_of);

}  // namespace mesher
