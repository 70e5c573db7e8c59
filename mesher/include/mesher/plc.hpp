// A piecewise linear complex: the points, segments, polygons, holes and regions in space that a
// file asks for.
//
// Example:
//   const mesher::PlcFile part = mesher::read_plc("part.poly");
//   for (const auto& polygon : part.plc.polygons) ... polygon.loops[0] ...
//   mesher::write_plc(part.plc, "part.smesh");
//
// Guarantees of `read_plc`:
//   (1) ids of points are those of the file; facets are numbered from 1 in the order of the file,
//       and segments likewise;
//   (2) ids are distinct: of points, of polygons, of segments, of holes, of regions; what a polygon
//       or a segment names is a point;
//   (3) what is not exactly as described is an Error with file, line, column and ids, and nothing
//       half-read is returned; no memory is set aside on the word of a header;
//   (4) what a file holds beyond this is an Error or a Note, never left out silently.
//
// Geometry is not judged here: points may coincide, polygons may be bent or cross. Numbers,
// comments and line ends are as in io.hpp; so are coordinates: 0, or of magnitude 2^-100 to 2^100.
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

/// Plain data, in the order of the file.
struct Plc {
  using Vertex = MarkedPoint<3>;
  using Segment = MarkedSegment;
  struct Facet {
    Polygon polygon;
    std::int64_t marker = 0;
    friend bool operator==(const Facet&, const Facet&) = default;
  };
  using Hole = HoleSeed<3>;  ///< of what the polygons enclose
  /// What the polygons enclose around `seed` has this attribute and limit.
  struct Region {
    FeatureId id{};
    Point<3> seed{};
    double attribute = 0;              ///< finite
    std::optional<double> max_volume;  ///< of a tetrahedron, input units cubed, > 0
    friend bool operator==(const Region&, const Region&) = default;
  };

  std::vector<Vertex> points;
  std::size_t attributes_per_point = 0;
  std::vector<double> attributes;  ///< points.size() * attributes_per_point, finite, point by point
  std::vector<Segment> segments;
  std::vector<Facet> facets;
  std::vector<Hole> holes;
  std::vector<Region> regions;
  friend bool operator==(const Plc&, const Plc&) = default;
};

/// A complex with where its parts stood.
struct PlcFile : FileParts {
  Plc plc;
  std::vector<FilePosition> facets;

  [[nodiscard]] FileLocation location_of_facet(std::size_t i) const { return at(file, facets[i]); }
};

/// Where a feature of the complex stands in its file; without a line if it does not. Cost: O(n).
[[nodiscard]] FileLocation location_of(const Feature& feature, const PlcFile& file);

/// The error with the locations of its features in the file: located() of these.
[[nodiscard]] Error located(const Error& error, const PlcFile& file);

/// Reads a complex, by the extension of `path`:
///
/// - `.poly` (TetGen): points as in `.node`, or none (`0 3 0 0`) and a `.node` file beside it; then
///   `count [markers]` and for each facet `polygons [holes [marker]]`, for each of its polygons
///   `count corner...` (which may go on over several lines), and `id x y z` for each of its holes;
///   then `count` and `id x y z` for each hole, and, if the file goes on, `count` and
///   `id x y z attribute [max_volume]` for each region. max_volume <= 0 is no limit.
///   In a facet a polygon of one corner is a point inside, one of two an edge inside; one of more
///   is a loop if what lies directly in it is filled and what is around it is not, or the reverse
///   (a hole empties what it lies in), else its edges lie inside. A facet without loops is
///   segments; parts of one that lie apart are polygons of their own, numbered after all facets.
/// - `.smesh` (TetGen): the same, but a facet is one line `count corner... [marker]`.
/// - `.off` (Geomview), `.obj` (Wavefront), `.ply` (Stanford), `.stl`: vertices and faces as
///   read_points reads them; each face is a polygon.
///
/// Throws: Error (cannot_read, unknown_format, bad_header, bad_dimension, bad_number, not_finite,
/// magnitude, wrong_count, truncated, repeated_id, unknown_id; bad_syntax: a facet's hole that no
/// polygon of it goes around; bad_mesh: a face's corner that is no vertex). Cost: O(n log n);
/// O(polygons^2 corners) for a facet.
[[nodiscard]] PlcFile read_plc(const std::string& path);

/// The complex with facets of one plane that are side by side made one, under the least of their
/// ids, if their markers are the same. An edge goes if nobody else has it, else it lies inside, as
/// points do that are then on no loop. Requires: what facets and segments name is a point.
/// Cost: O(n log n).
[[nodiscard]] Plc with_merged_facets(const Plc& plc);

/// Writes a complex so that read_plc gives it back, but for the numbers of polygons and segments,
/// where they are not those of the order: `.poly`, or `.smesh` if no facet has more than one loop.
/// Coordinates read back bit for bit. Throws: Error (unknown_format, cannot_write, unsupported).
void write_plc(const Plc& plc, const std::string& path);
void write_poly(const Plc& plc, TextFile& file);
/// Requires: require_single_loops(plc) has not thrown.
void write_smesh(const Plc& plc, TextFile& file);
/// Throws: Error(unsupported) if a polygon is more than one loop: .smesh has no place for that.
void require_single_loops(const Plc& plc);

}  // namespace mesher
