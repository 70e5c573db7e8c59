// Reads graphs, meshes and sizes from files.
//
// Example:
//   const mesher::GraphFile<2> lake = mesher::read<2>("lake.poly");
//   for (const auto& segment : lake.graph.segments) ... segment.from, segment.to ...
//
// Guarantees:
//   (1) a file that deviates from this description causes an Error with file, line, column and ids,
//       and nothing half-read is returned;
//   (2) no memory is allocated by a count in a header alone;
//   (3) data in a file beyond this description causes an Error or a Note; none is silently ignored;
//   (4) ids of points are those of the file, whether they count from 0, from 1 or not at all; in
//       formats without ids they are 1..n, in the order of the file. Ids are distinct, and lines
//       and polygons name existing points.
//
// Readers do not judge geometry: lines may cross, polygons may be bent.
//
// Text is ASCII or UTF-8; lines end in LF or CRLF, and the last line may have no end; '#' starts a
// comment. A number has the syntax of std::from_chars, with an optional leading '+': no locale, no
// NaN or infinity, no trailing characters.
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

/// The dimension, 2 or 3, of the input in a file:
///
/// - `.node`, `.poly`: that of its header;
/// - `.xyz`, and `.csv` with columns named x, y and z: 2 if z is missing or 0 everywhere, else 3;
///   `.csv` without names: the number of its columns;
/// - `.obj`, `.vtu`: 2 if z is the same everywhere, else 3;
/// - `.off`, `.stl`, `.ply`, `.vtk`, `.smesh`: 3;
/// - all others: 2.
///
/// A file that no reader accepts gets some dimension, too. Throws: Error(cannot_read), and for
/// `.vtu` the errors of its reader. Cost: O(file).
[[nodiscard]] int dimension_of(const std::string& path);

/// Whether a file of points alone with two equal points is refused, or both are kept for a repair
/// (repair.hpp).
enum class CoincidingPoints : std::uint8_t { refused, kept };

/// Options of read().
struct ReadOptions {
  CoincidingPoints coinciding = CoincidingPoints::refused;
  bool points_alone = false;  ///< reads only the vertices of surface and VTK files
};

/// Reads a graph; the extension of `path` gives the format. D is 2 or 3. Formats of points alone:
///
/// - `.node` (Triangle, TetGen): a line `count [dimension [attributes [markers]]]` (defaults 2 0 0;
///   markers 0 or 1), then a line `id x y [z] attributes... [marker]` for each point. Ids are any
///   distinct integers. Markers are kept, attributes checked.
/// - `.xyz`: a line `x y` or `x y z` for each point; in the plane z must be 0. Ids are 1..n.
/// - `.csv`: fields separated by commas, semicolons or tabs (the first of these, in this order,
///   that the first line contains); a field may be in double quotes. The first line may name the
///   columns: `x,y[,z]`, or `lon,lat` or `longitude,latitude` in the plane, in any case and order,
///   among other columns. Without names a line holds exactly D numbers. A comment fills its line.
///   Ids are 1..n.
///
/// Formats in the plane; lines have ids 1..m in the order of the file if the format has no ids:
///
/// - `.poly` (Triangle): points as in `.node`, or none (`0 2 0 0`) and a `.node` file beside it;
///   then `count [markers]` and `id from to [marker]` for each segment, `count` and `id x y` for
///   each hole, and, if the file goes on, `count` and `id x y attribute [max_area]` for each
///   region. max_area <= 0 is no limit. A region with one value has it as its attribute (Triangle
///   also uses it as a limit, if limits are requested: a Note says so).
/// - `.geojson`, `.json`: any geometry of RFC 7946, alone, in a Feature or in a collection.
///   Positions with equal coordinates are one point. A line of two positions is a segment, a longer
///   one a polyline. Each ring of a polygon is a closed polyline; the polygon is a region, whose
///   attribute is its number in the file from 1, and each inner ring makes a hole. Their seeds are
///   just inside the ring, where no line of the file separates them from it. A closed line is only
///   a line. Polygons may share borders: a piece that an earlier ring has belongs to that ring, a
///   Note says so, and the rest of the later ring is one line for each run of pieces. An inner ring
///   that shares a piece with the outer ring of another polygon is filled by that polygon and makes
///   no hole. An area that several polygons enclose together is kept, without a region. A feature's
///   properties `marker` (of its points and lines), `attribute` and `max_area` (of its regions) are
///   used, and `name`: of the region of a polygon, of the marker of a line. Altitudes and other
///   members are noted.
/// - `.obj` (Wavefront): `v x y [z]`, `l i j ...` (1 is the first point, -1 the last so far), `p`.
///   z must be the same everywhere. Names, groups and materials are noted; faces are refused.
/// - `.vtu` (VTK): vertices, lines and polylines of an unstructured grid in one piece: ASCII,
///   base64 or raw data, inline or appended, plain or compressed by zlib. z must be the same
///   everywhere. Integer arrays `marker` are used, others noted; other cells are refused.
///
/// Formats in space; polygons and segments have ids from 1 in the order of the file:
///
/// - `.poly` (TetGen): points as in `.node`, or none (`0 3 0 0`) and a `.node` file beside it; then
///   `count [markers]` and for each facet `polygons [holes [marker]]`, for each of its polygons
///   `count corner...` (which may continue on further lines), and `id x y z` for each of its holes;
///   then `count` and `id x y z` for each hole, and, if the file goes on, `count` and `id x y z
///   attribute [max_volume]` for each region. max_volume <= 0 is no limit. In a facet, a polygon of
///   one corner is a point inside, and one of two corners an edge inside. A polygon of more corners
///   is a loop if the facet is filled directly inside it and not around it, or the reverse (a hole
///   empties the area around it); otherwise its edges lie inside. A facet without loops is
///   segments; separate parts of a facet are polygons of their own, numbered after all facets.
/// - `.smesh` (TetGen): the same, but a facet is one line `count corner... [marker]`.
/// - `.off` (Geomview), with or without colours or normals; `.obj` (Wavefront); `.ply` (Stanford),
///   ASCII or binary, of either byte order; `.stl`, ASCII or binary, where corners with equal
///   coordinates are one point: the vertices, and each face as a polygon. If an ASCII `.stl` has
///   several solids, or an `.obj` faces in several groups (`g` or `o`), their faces have the
///   markers 1, 2, ... in their order, with these names;
/// - `.vtu` and `.vtk` (VTK), as read_mesh reads them: the vertices, and each triangle,
///   quadrilateral or polygon as a polygon.
///
/// Names that a group cannot have (names.hpp) get '_' for blanks and quotes, or are left out, with
/// a Note.
///
/// Throws: Error (cannot_read, unknown_format, bad_header, bad_dimension, bad_number, not_finite,
/// magnitude, wrong_count, truncated, repeated_id, unknown_id, duplicate_point, bad_syntax,
/// bad_mesh, unsupported).
/// Cost: O(n log n); O(polygons^2 corners) for a facet.
template <int D>
[[nodiscard]] GraphFile<D> read(const std::string& path, const ReadOptions& options = {});

/// A graph read from a file, of either dimension.
using AnyGraph = std::variant<GraphFile<2>, GraphFile<3>>;
/// Reads a graph in the dimension that dimension_of returns. Throws, Cost: as both.
[[nodiscard]] AnyGraph read_any(const std::string& path, const ReadOptions& options = {});

/// A background of sizes: a `.node` file whose one attribute is the size, or a `.csv` file with
/// columns `x,y,h` (or `lon,lat,h`), named or as three numbers per line; in space `x,y,z,h`, or
/// four numbers.
template <int D>
struct SizeFile {
  std::string file;
  std::vector<SizeSample<D>> samples;
  std::vector<FilePosition> positions;  ///< one for each sample
};

/// Reads a background of sizes, at distinct positions. D is 2 or 3. Throws: Error as read, and
/// bad_number for a size that is not > 0. Cost: O(n log n).
template <int D = 2>
[[nodiscard]] SizeFile<D> read_sizes(const std::string& path);

/// Reads a mesh of triangles or of tetrahedra, with the features that its format has; the extension
/// of `path` gives the format. A file with tetrahedra is a mesh of tetrahedra, and its triangles
/// are faces:
///
/// - `.node` or `.ele` (Triangle, TetGen), with the other beside it; the dimension is that of
///   .node. If present, also `.edge` (edges with a marker or line), in the plane `.poly` without
///   points of its own (its segments) and `.neigh` (which must agree with the triangles), and in
///   space `.face` (faces with a marker or polygon);
/// - `.vtu` (VTK) as above, and `.vtk` (legacy, ASCII or binary): the cells are triangles and
///   lines, or tetrahedra, triangles and lines;
/// - `.msh` (Gmsh, versions 4.1 and 2.2, ASCII or binary): physical groups are regions and markers,
///   with their names; a group `marker_N`, `line_N` or `region_N` has the value N, other groups
///   their numbers;
/// - `.mesh` (Medit, ASCII): references are markers and regions;
/// - `.off` (Geomview) and `.obj` (Wavefront): triangles; of .obj also lines.
///
/// Vertices and simplices keep the order of the file; a simplex keeps the order of its corners. An
/// array of MeshFeatures whose values are all 0 is empty. Cells of second order (.msh, .vtu, .vtk,
/// .ele) are read by their corners: the nodes between corners are no vertices, and a Note says so.
/// In the plane a third coordinate must be the same everywhere (.off: 0). Kinds and origins are
/// known only for files that `write_mesh` wrote as .node, .vtu or .vtk; otherwise all vertices are
/// steiner. `notes` lists data that is not used.
///
/// Throws: Error as read, and bad_mesh for a simplex whose corners are not different vertices of
/// the file, and for an edge or a face given twice. Coordinates may be any finite doubles, and
/// duplicate points are not detected. Cost: O(m log m).
[[nodiscard]] AnyMesh read_any_mesh(const std::string& path);

/// Reads a mesh as read_any_mesh. Throws: also Error(bad_dimension) for a mesh of the other
/// dimension. D is 2 or 3.
template <int D = 2>
[[nodiscard]] MeshData<D> read_mesh(const std::string& path);

}  // namespace mesher
