// Errors of bad data: what the mesher refuses, with the features, places and location in a file.
//
// Bad data is found once, at the boundary (a reader, Mesher::insert, the command line), and thrown
// as the one type `mesher::Error`, whose parts are typed: nobody needs to read its
// message. Programming mistakes are contract checks instead.
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

/// What is wrong; `code_name` gives the word printed in `error[...]`.
enum class ErrorCode : std::uint8_t {
  duplicate_point,       ///< two input points with equal coordinates
  outside_domain,        ///< a point outside the meshing domain
  not_finite,            ///< NaN or infinity
  magnitude,             ///< a coordinate that is neither 0 nor within 2^-100 .. 2^100
  unknown_id,            ///< an id of a point or line that is not there
  repeated_id,           ///< an id given twice
  wrong_count,           ///< a header that disagrees with what follows
  truncated,             ///< the file ends too early
  bad_number,            ///< not a number, or trailing junk
  bad_header,            ///< a header that cannot be read
  bad_edit,              ///< an edit that cannot be parsed
  unbalanced_commit,     ///< begin without commit, or the reverse
  bad_dimension,         ///< the dimension is not the one asked for
  bad_syntax,            ///< a text that its format does not allow
  unsupported,           ///< what a format allows and we do not read
  bad_mesh,              ///< a mesh file that is not a mesh (index out of range, ...)
  bad_quality,           ///< `check`: a mesh that does not keep its promise
  unknown_format,        ///< an extension that no reader or writer knows
  cannot_read,           ///< the file cannot be opened or read
  cannot_write,          ///< the file cannot be written
  bad_option,            ///< an option whose value makes no sense
  too_close,             ///< features nearer than the domain's resolution
  crossing_segments,     ///< two segments with a point in common that is no end of both
  point_on_segment,      ///< an input point between the ends of a segment
  overlapping_segments,  ///< two segments with more than a point in common
  zero_length,           ///< a segment from a point to itself
  repeated_segment,      ///< two segments between the same points
  point_in_use,          ///< the removal of a point that is an end of a segment
  too_many,              ///< more vertices or memory than a run can hold
  cancelled,             ///< stopped by the user
  bad_seed,              ///< a hole's or region's seed that has no region of its own
  bad_polygon,         ///< loops without an area, that repeat a corner, or do not lie in the first
  not_flat,            ///< a polygon whose corners lie in no plane
  repeated_polygon,    ///< two polygons with the same loops
  point_on_polygon,    ///< an input point in a polygon that does not declare it
  segment_on_polygon,  ///< an edge in a polygon that does not declare it
  segment_through_polygon,  ///< a segment and a polygon with a place in common that is no point
  crossing_polygons,        ///< two polygons with a place in common that is on no common edge
  overlapping_polygons,     ///< two polygons in a plane, with an area in common
};

/// What a process exits with.
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

/// Where something stands in a file; line and column count from 1, and 0 means "not known".
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

/// Something in a file that was understood and is not used.
struct Note {
  std::string text;
  FileLocation location;  ///< of the first such thing
};

/// Coordinates in the geometry; in the plane z = 0.
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
  /// Where in a file it is.
  [[nodiscard]] const FileLocation& location() const noexcept { return location_; }
  /// The features that it is about, where known; the one to blame first.
  [[nodiscard]] const std::vector<Feature>& features() const noexcept { return features_; }
  /// Where in the geometry it is, where known.
  [[nodiscard]] const std::vector<Position>& places() const noexcept { return places_; }
  /// Where features()[i] stands in a file, without a line if it does not; empty before located().
  [[nodiscard]] const std::vector<FileLocation>& locations() const noexcept { return locations_; }

  /// The same error, said of a place in a file.
  [[nodiscard]] Error at(FileLocation location) const {
    return changed(message_, std::move(location));
  }
  /// The same error, with locations().
  [[nodiscard]] Error with_locations(std::vector<FileLocation> locations) const;
  /// The same error, with other words.
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

/// The error with locations(): where its features stand, by `location_of`, which gives one without
/// a line for what stands nowhere. location() becomes that of the first, unless it has a line
/// already; the message names those that stand elsewhere.
[[nodiscard]] Error located(const Error& error,
                            const std::function<FileLocation(const Feature&)>& location_of);

}  // namespace mesher
