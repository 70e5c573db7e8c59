// A plane straight-line graph: the points, lines, holes, regions and sizes that a file asks for.
//
// Example:
//   const mesher::PslgFile lake = mesher::read_pslg("lake.poly");
//   for (const auto& segment : lake.pslg.segments) ... segment.from, segment.to ...
//   mesher::write_pslg(lake.pslg, "lake.obj");
//
// Guarantees of `read_pslg`:
//   (1) ids are those of the file, be they counted from 0, from 1 or not at all; in formats without
//       ids, points are numbered 1..n and lines 1..m, each in the order of the file;
//   (2) ids are distinct: of points, of lines (segments and polylines share one numbering), of
//       holes, of regions; each end of a line is a point;
//   (3) what is not exactly as described is an Error with file, line, column and ids, and nothing
//       half-read is returned; no memory is set aside on the word of a header;
//   (4) what a file holds beyond this is an Error or a Note, never left out silently.
//
// Geometry is not judged here: points may coincide, lines may cross, overlap, or have no length.
// Numbers, comments and line ends are as in io.hpp; so are coordinates: 0, or of magnitude 2^-100
// to 2^100.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mesher/error.hpp"
#include "mesher/input_file.hpp"
#include "mesher/mesh.hpp"
#include "mesher/output_files.hpp"

namespace mesher {

/// The size that a background asks for at a place. h: an edge's length, input units, > 0.
/// D is 2 or 3.
template <int D>
struct SizeSampleOf {
  Point<D> at{};
  double h = 0;
  friend bool operator==(const SizeSampleOf&, const SizeSampleOf&) = default;
};
using SizeSample = SizeSampleOf<2>;

/// Plain data, in the order of the file.
struct Pslg {
  using Vertex = MarkedPoint<2>;
  using Segment = MarkedSegment;
  /// Segments from point to point under one id; closed if the last point is the first.
  struct Polyline {
    FeatureId id{};
    std::vector<FeatureId> points;  ///< two or more
    std::int64_t marker = 0;
    friend bool operator==(const Polyline&, const Polyline&) = default;
  };
  using Hole = HoleSeed<2>;  ///< of what the lines enclose
  /// What the lines enclose around `seed` has this attribute and limit.
  struct Region {
    FeatureId id{};
    Point<2> seed{};
    double attribute = 0;            ///< finite
    std::optional<double> max_area;  ///< of a triangle, input units squared, > 0
    friend bool operator==(const Region&, const Region&) = default;
  };

  std::vector<Vertex> points;
  std::size_t attributes_per_point = 0;
  std::vector<double> attributes;  ///< points.size() * attributes_per_point, finite, point by point
  std::vector<Segment> segments;
  std::vector<Polyline> polylines;
  std::vector<Hole> holes;
  std::vector<Region> regions;
  std::vector<SizeSample> sizes;  ///< from read_sizes; no reader of a Pslg fills it
  friend bool operator==(const Pslg&, const Pslg&) = default;
};

/// A graph with where its parts stood.
struct PslgFile : FileParts {
  Pslg pslg;
  std::vector<FilePosition> polylines;

  [[nodiscard]] FileLocation location_of_polyline(std::size_t i) const {
    return at(file, polylines[i]);
  }
};

/// Where a feature of the graph stands in its file; without a line if it does not. Cost: O(n).
[[nodiscard]] FileLocation location_of(const Feature& feature, const PslgFile& file);

/// The error with the locations of its features in the file: located() of these.
[[nodiscard]] Error located(const Error& error, const PslgFile& file);

/// Reads a graph, by the extension of `path`:
///
/// - `.poly` (Triangle): points as in `.node`, or none (`0 2 0 0`) and a `.node` file beside it;
///   then `count [markers]` and `id from to [marker]` for each segment, `count` and `id x y` for
///   each hole, and, if the file goes on, `count` and `id x y attribute [max_area]` for each
///   region. max_area <= 0 is no limit. A region with one value has that as its attribute (Triangle
///   also takes it as a limit, if limits are asked for: a Note says so).
/// - `.geojson`, `.json`: any geometry of RFC 7946, single, in a Feature or in a collection.
///   Positions with equal coordinates are one point. A line of two positions is a segment, a longer
///   one a polyline. Each ring of a polygon is a closed polyline; the polygon is a region, whose
///   attribute is its number in the file from 1, and each inner ring makes a hole. Their seeds are
///   places just inside the ring that no line of the file cuts off from it. A closed line is only a
///   line. Polygons may share borders: a piece that a ring before has is of that one, a Note says
///   so, and what is left of the ring is a line for each run of pieces; an inner ring that shares a
///   piece with the outer one of another polygon is filled by that and makes no hole; what several
///   polygons enclose together is kept, without a region. A feature's properties `marker` (of its
///   points and lines), `attribute` and `max_area` (of its regions) are used. Altitudes and other
///   members are noted.
/// - `.obj` (Wavefront): `v x y [z]`, `l i j ...` (1 is the first point, -1 the last so far), `p`.
///   z must be the same everywhere. Names, groups and materials are noted; faces are refused.
/// - `.vtu` (VTK): vertices, lines and polylines of an unstructured grid in one piece: ASCII,
///   base64 or raw data, inline or appended, plain or by zlib. z must be the same everywhere.
///   Integer arrays `marker` are used, others noted; other cells are refused.
/// - `.node`, `.xyz`, `.csv`: points alone, of `.node` with their markers.
///
/// Throws: Error (cannot_read, unknown_format, bad_header, bad_dimension, bad_number, not_finite,
/// magnitude, wrong_count, truncated, repeated_id, unknown_id, bad_syntax, unsupported).
/// Cost: O(n log n).
[[nodiscard]] PslgFile read_pslg(const std::string& path);

/// A background of sizes: a `.node` file whose one attribute is the size, or a `.csv` file with
/// columns `x,y,h` (or `lon,lat,h`), by name or three numbers a line; in space `x,y,z,h`, or four.
template <int D>
struct SizeFileOf {
  std::string file;
  std::vector<SizeSampleOf<D>> samples;
  std::vector<FilePosition> positions;  ///< one for each sample
};
using SizeFile = SizeFileOf<2>;

/// Places are distinct. D is 2 or 3. Throws: Error as read_points, and bad_number for a size that
/// is not > 0. Cost: O(n log n).
template <int D = 2>
[[nodiscard]] SizeFileOf<D> read_sizes(const std::string& path);

/// Writes a graph so that read_pslg gives it back:
///
/// - `.poly`: all but `sizes`; each piece of a polyline becomes a segment of its own with the
///   polyline's marker, numbered after the last segment.
/// - `.obj`: points and lines, without ids, markers, holes and regions.
///
/// Coordinates read back bit for bit. Throws: Error (unknown_format, cannot_write).
void write_pslg(const Pslg& pslg, const std::string& path);
void write_poly(const Pslg& pslg, TextFile& file);
void write_obj(const Pslg& pslg, TextFile& file);

/// The graph with each polyline taken apart into segments, numbered after the last line.
[[nodiscard]] Pslg without_polylines(Pslg pslg);

}  // namespace mesher
