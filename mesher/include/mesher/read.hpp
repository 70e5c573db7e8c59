// Files that are read: graphs, meshes, sizes.
//
// Example:
//   const mesher::GraphFile<2> lake = mesher::read<2>("lake.poly");
//   for (const auto& segment : lake.graph.segments) ... segment.from, segment.to ...
//
// Guarantees:
//   (1) what is not exactly as described here is an Error with file, line, column and ids, and
//       nothing half-read is returned;
//   (2) no memory is set aside on the word of a header;
//   (3) what a file holds beyond this is an Error or a Note, never left out silently;
//   (4) ids of points are those of the file, be they counted from 0, from 1 or not at all; in
//       formats without ids they are 1..n, in the order of the file. Ids are distinct, and what a
//       line or a polygon names is a point.
//
// Geometry is not judged here: lines may cross, polygons may be bent.
//
// Text is ASCII or UTF-8; lines end in LF or CRLF and the last may lack its end; '#' starts a
// comment. A number is what std::from_chars takes, with '+' allowed in front: no locale, no NaN or
// infinity, nothing behind it. An input coordinate is 0 or of magnitude 2^-100 to 2^100.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "mesher/error.hpp"
#include "mesher/graph.hpp"
#include "mesher/mesh.hpp"
#include "mesher/sizes.hpp"

namespace mesher {

/// The dimension, 2 or 3, of the input that a file is:
///
/// - `.node`, `.poly`: that of its header;
/// - `.xyz`, and `.csv` with columns named x, y and z: 2 if z is missing or 0 everywhere, else 3;
///   `.csv` without names: the number of its columns;
/// - `.obj`, `.vtu`: 2 if z is the same everywhere, else 3;
/// - `.off`, `.stl`, `.ply`, `.vtk`, `.smesh`: 3;
/// - all others: 2.
///
/// What no reader would take has some dimension, too. Throws: Error(cannot_read), and of `.vtu` as
/// its reader. Cost: O(file).
[[nodiscard]] int dimension_of(const std::string& path);

/// What files of points alone may hold: points in one place are refused, or kept for a repair
/// (repair.hpp).
enum class CoincidingPoints : std::uint8_t { refused, kept };

struct ReadOptions {
  CoincidingPoints coinciding = CoincidingPoints::refused;
  bool points_alone = false;  ///< of files of surfaces and of VTK the vertices alone
};

/// Reads a graph, by the extension of `path`. D is 2 or 3. Points alone are in:
///
/// - `.node` (Triangle, TetGen): a line `count [dimension [attributes [markers]]]` (defaults 2 0 0;
///   markers 0 or 1), then a line `id x y [z] attributes... [marker]` for each point. Ids are any
///   distinct integers. Markers are kept, attributes checked.
/// - `.xyz`: a line `x y` or `x y z` for each point; in the plane z must be 0. Ids are 1..n.
/// - `.csv`: fields between commas, semicolons or tabs (whichever the first line holds, in this
///   order); a field may stand in double quotes. The first line may name the columns: `x,y[,z]`, or
///   `lon,lat` or `longitude,latitude` in the plane, in any case and order, among other columns.
///   Without names a line holds exactly D numbers. A comment fills its line. Ids are 1..n.
///
/// In the plane; lines have ids 1..m in the order of the file where a format has none:
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
///
/// In space; polygons and segments have ids from 1 in the order of the file:
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
/// - `.off` (Geomview), with colours or normals or without; `.obj` (Wavefront); `.ply` (Stanford),
///   ASCII or binary, of either byte order; `.stl`, ASCII or binary, where corners in one place are
///   one point: vertices, and each face is a polygon;
/// - `.vtu` and `.vtk` (VTK), as read_mesh reads them: vertices, and each triangle, quadrilateral
/// or
///   polygon is a polygon.
///
/// Throws: Error (cannot_read, unknown_format, bad_header, bad_dimension, bad_number, not_finite,
/// magnitude, wrong_count, truncated, repeated_id, unknown_id, duplicate_point, bad_syntax,
/// bad_mesh, unsupported).
/// Cost: O(n log n); O(polygons^2 corners) for a facet.
template <int D>
[[nodiscard]] GraphFile<D> read(const std::string& path, const ReadOptions& options = {});

/// A graph of a file that may be of either dimension.
using AnyGraph = std::variant<GraphFile<2>, GraphFile<3>>;
/// Reads a graph of the dimension that dimension_of finds. Throws, Cost: as both.
[[nodiscard]] AnyGraph read_any(const std::string& path, const ReadOptions& options = {});

/// A background of sizes: a `.node` file whose one attribute is the size, or a `.csv` file with
/// columns `x,y,h` (or `lon,lat,h`), by name or three numbers a line; in space `x,y,z,h`, or four.
template <int D>
struct SizeFile {
  std::string file;
  std::vector<SizeSample<D>> samples;
  std::vector<FilePosition> positions;  ///< one for each sample
};

/// Places are distinct. D is 2 or 3. Throws: Error as read, and bad_number for a size that is not
/// > 0. Cost: O(n log n).
template <int D = 2>
[[nodiscard]] SizeFile<D> read_sizes(const std::string& path);

/// Reads a mesh of triangles or of tetrahedra with what its format knows of features, by the
/// extension of `path`. It is of tetrahedra if there are any; the triangles of such a file are its
/// faces:
///
/// - `.node` or `.ele` (Triangle, TetGen), the other beside it; the dimension is .node's. If they
///   are there also `.edge` (its edges with a marker or line), in the plane `.poly` without points
///   of its own (its segments) and `.neigh` (which must agree with the triangles), and in space
///   `.face` (its faces with a marker or polygon);
/// - `.vtu` (VTK) as above, and `.vtk` (legacy, ASCII or binary): the cells are triangles and
///   lines, or tetrahedra with these;
/// - `.msh` (Gmsh, version 4.1, ASCII or binary): physical groups are regions and markers;
/// - `.mesh` (Medit, ASCII): references are markers and regions;
/// - `.off` (Geomview) and `.obj` (Wavefront): triangles; of .obj also lines.
///
/// Vertices and simplices keep the order of the file; a simplex keeps its corners' order. An array
/// of MeshFeatures whose values are all 0 is empty. In the plane, where the third coordinate is not
/// 0 it must be the same everywhere (.off: 0). Kinds and origins are known from files that
/// `write_mesh` wrote as .node, .vtu or .vtk, else all vertices are steiner. What is not used is in
/// `notes`.
///
/// Throws: Error as read, and bad_mesh for a simplex whose corners are not
/// different vertices of the file, and for an edge or a face given twice; coordinates are any
/// finite doubles, duplicate points are not looked for. Cost: O(m log m).
[[nodiscard]] AnyMesh read_any_mesh(const std::string& path);

/// Throws: also Error(bad_dimension) for the other kind. D is 2 or 3.
template <int D = 2>
[[nodiscard]] MeshData<D> read_mesh(const std::string& path);

}  // namespace mesher
