// Files of points and meshes: what is read, what is written.
//
// Example:
//   auto input = mesher::read_points<2>("cities.csv");
//   ... mesh input.points ...
//   mesher::write_mesh(mesh, "cities.vtu");
//
// Graphs of points and lines are read and written by pslg.hpp.
//
// Guarantees:
//   (1) what is not exactly as described here is an Error with file, line and column, and nothing
//       half-read is returned;
//   (2) no memory is set aside on the word of a header;
//   (3) what is written is a function of the mesh alone, byte for byte;
//   (4) coordinates read back bit for bit, from all formats but .svg;
//   (5) an output file appears whole, at the end, or not at all (output_files.hpp).
//
// Text is ASCII or UTF-8; lines end in LF or CRLF and the last may lack its end; '#' starts a
// comment. A number is what std::from_chars takes, with '+' allowed in front: no locale, no NaN or
// infinity, nothing behind it. An input coordinate is 0 or of magnitude 2^-100 to 2^100.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "mesher/error.hpp"
#include "mesher/mesh.hpp"
#include "mesher/mesh_data.hpp"
#include "mesher/output_files.hpp"

namespace mesher {

/// Input points with their names and where they stood in the file; the three arrays have one
/// length. Ids are distinct, and so are points.
template <int D>
struct PointFile {
  std::string file;
  std::vector<FeatureId> ids;
  std::vector<Point<D>> points;
  std::vector<long> lines;    ///< from 1; 0 where a file has no lines
  std::vector<Note> notes{};  ///< what the file holds that is not used

  [[nodiscard]] FileLocation location(std::size_t i) const {
    return {file, lines[i], lines[i] > 0 ? 1 : 0};
  }
};

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

/// Reads points, by the extension of `path`. D is 2 or 3.
///
/// - `.node` (Triangle, TetGen): a line `count [dimension [attributes [markers]]]` (defaults 2 0 0;
///   markers 0 or 1), then a line `id x y [z] attributes... [marker]` for each point. Ids are any
///   distinct integers. Attributes and markers are checked, not kept (read_pslg keeps markers).
/// - `.xyz`: a line `x y` or `x y z` for each point; in the plane z must be 0. Ids are 1..n.
/// - `.csv`: fields between commas, semicolons or tabs (whichever the first line holds, in this
///   order); a field may stand in double quotes. The first line may name the columns: `x,y[,z]`, or
///   `lon,lat` or `longitude,latitude` in the plane, in any case and order, among other columns.
///   Without names a line holds exactly D numbers. A comment fills its line. Ids are 1..n.
///
/// and in space the vertices of
///
/// - `.off` (Geomview), with colours or normals or without; `.obj` (Wavefront);
/// - `.ply` (Stanford): ASCII or binary, of either byte order;
/// - `.stl`: ASCII or binary; corners in one place are one point;
/// - `.vtu` and `.vtk` (VTK) as read_pslg and read_mesh read them.
///
/// Ids are 1..n. Faces, cells and all else are checked as far as it takes to find the end of the
/// file, and noted: they are not used.
///
/// Throws: Error (cannot_read, unknown_format, bad_header, bad_dimension, bad_number, not_finite,
/// magnitude, wrong_count, truncated, repeated_id, duplicate_point; of files of surfaces and of VTK
/// also bad_syntax, bad_mesh, unsupported). Cost: O(n log n).
template <int D>
[[nodiscard]] PointFile<D> read_points(const std::string& path);

/// Reads a mesh of triangles or of tetrahedra with what its format knows of features, by the
/// extension of `path`. It is of tetrahedra if there are any; the triangles of such a file are its
/// faces:
///
/// - `.node` or `.ele` (Triangle, TetGen), the other beside it; the dimension is .node's. If they
///   are there also `.edge` (its edges with a marker or line), in the plane `.poly` without points
///   of its own (its segments) and `.neigh` (which must agree with the triangles), and in space
///   `.face` (its faces with a marker or polygon);
/// - `.vtu` (VTK) as in pslg.hpp, and `.vtk` (legacy, ASCII or binary): the cells are triangles and
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
/// Throws: Error as read_points and read_pslg, and bad_mesh for a simplex whose corners are not
/// different vertices of the file, and for an edge or a face given twice; coordinates are any
/// finite doubles, duplicate points are not looked for. Cost: O(m log m).
[[nodiscard]] AnyMesh read_any_mesh(const std::string& path);

/// Throws: also Error(bad_dimension) for the other kind. D is 2 or 3.
template <int D = 2>
[[nodiscard]] MeshDataOf<D> read_mesh(const std::string& path);

/// Writes a mesh into files that are already open. D is 2 or 3.
template <int D>
class MeshWriterOf {
 public:
  using Write = std::function<void(const Mesh<D>&, const MeshFeatures&)>;
  explicit MeshWriterOf(Write write) : write_(std::move(write)) {}
  /// Throws: Error(cannot_write).
  void operator()(const Mesh<D>& mesh, const MeshFeatures& features = {}) const {
    write_(mesh, features);
  }

 private:
  Write write_;
};
using MeshWriter = MeshWriterOf<2>;

/// Which files a `.node` output has.
enum class MeshFiles : std::uint8_t {
  plain,     ///< .node and .ele
  features,  ///< .edge, .poly and .neigh as well; in space .edge
};

/// Opens the files of one mesh output among `files`, by the extension of `path`:
///
/// - `.node`, and `.ele` beside it (Triangle): numbered from 1. Vertices without origins and
///   markers have one attribute (1 for an input point, 0 otherwise) and one marker (1 on the
///   boundary grid, 0 otherwise); else two attributes, kind and origin, and their marker. A
///   triangle's attribute is its region. With MeshFiles::features: `.edge` (all edges; behind the
///   marker the id of the line, where known), `.poly` (no points; the edges of MeshFeatures as
///   segments) and `.neigh` (-1 where there is none);
/// - `.vtu` and `.vtk` (VTK, ParaView): ASCII, z = 0, cells are the triangles, then the edges of
///   MeshFeatures as lines; point data kind, origin, marker; cell data region, marker, line, and
///   has_line (1 where the line is known);
/// - `.msh` (Gmsh 4.1): ASCII, z = 0; each region and each marker of edges is a physical group,
///   named `region V` or `marker M`. Its number is that value if all are integers from 1 to
///   2^31 - 2, else they are numbered upward from 1; 0 is numbered last, and is no group if no
///   other value is there;
/// - `.mesh` (Medit): dimension 3, z = 0; references are regions, and markers of vertices and of
///   edges, as such numbers; 0 stays 0;
/// - `.off` (Geomview): z = 0, triangles alone; `.obj` (Wavefront): z = 0, and the edges as lines;
/// - `.svg`: a picture, see svg.hpp; its coordinates are rounded.
///
/// `files` must outlive the writer. Throws: Error (unknown_format, cannot_write, bad_option).
[[nodiscard]] MeshWriter open_mesh(OutputFiles& files, const std::string& path,
                                   MeshFiles content = MeshFiles::plain);

/// The extension of a path in small letters, ".vtu": what formats go by.
[[nodiscard]] std::string format_of(const std::string& path);

/// Writes a mesh to `path` (and beside it) as open_mesh describes, whole or not at all; the files
/// of a `.node` output are `features` if there are any.
/// Throws: Error (unknown_format, cannot_write).
void write_mesh(const Mesh<2>& mesh, const std::string& path);
void write_mesh(const MeshData& mesh, const std::string& path);

/// Writes points as a `.node` file, numbered from 1, without attributes or markers.
/// `points`: n x D. Throws: Error(cannot_write).
template <int D>
void write_points(const std::vector<Point<D>>& points, TextFile& file);

}  // namespace mesher
