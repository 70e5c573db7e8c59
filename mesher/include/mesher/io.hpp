// Files of points and meshes: what is read, what is written.
//
// Example:
//   auto input = mesher::read_points<2>("cities.csv");
//   ... mesh input.points ...
//   mesher::write_mesh(mesh, "cities.vtu");
//
// Guarantees:
//   (1) what is not exactly as described here is an Error with file, line and column, and nothing
//       half-read is returned;
//   (2) no memory is set aside on the word of a header;
//   (3) what is written is a function of the mesh alone, byte for byte;
//   (4) coordinates in .node, .off and .vtu read back bit for bit;
//   (5) an output file appears whole, at the end, or not at all (output_files.hpp).
//
// Text is ASCII or UTF-8; lines end in LF or CRLF and the last may lack its end; '#' starts a
// comment. A number is what std::from_chars takes, with '+' allowed in front: no locale, no NaN or
// infinity, nothing behind it. An input coordinate is 0 or of magnitude 2^-100 to 2^100.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "mesher/error.hpp"
#include "mesher/mesh.hpp"
#include "mesher/output_files.hpp"

namespace mesher {

/// Input points with their names and where they stood in the file; the three arrays have one
/// length. Ids are distinct, and so are points.
template <int D>
struct PointFile {
  std::string file;
  std::vector<FeatureId> ids;
  std::vector<Point<D>> points;
  std::vector<long> lines;  ///< from 1

  [[nodiscard]] Place place(std::size_t i) const { return {file, lines[i], 1}; }
};

/// Reads points, by the extension of `path`. D is 2 or 3.
///
/// - `.node` (Triangle, TetGen): a line `count [dimension [attributes [markers]]]` (defaults 2 0 0;
///   markers 0 or 1), then a line `id x y [z] attributes... [marker]` for each point. Ids are any
///   distinct integers. Attributes and markers are counted, not read.
/// - `.xyz`: a line `x y` or `x y z` for each point; in the plane z must be 0. Ids are 1..n.
/// - `.csv`: fields between commas, semicolons or tabs (whichever the first line holds, in this
///   order); a field may stand in double quotes. The first line may name the columns: `x,y[,z]`, or
///   `lon,lat` or `longitude,latitude` in the plane, in any case and order, among other columns.
///   Without names a line holds exactly D numbers. A comment fills its line. Ids are 1..n.
///
/// Throws: Error (cannot_read, unknown_format, bad_header, bad_dimension, bad_number, not_finite,
/// magnitude, wrong_count, truncated, repeated_id, duplicate_point). Cost: O(n log n).
template <int D>
[[nodiscard]] PointFile<D> read_points(const std::string& path);

/// Reads a triangulation: a `.node` or `.ele` file (with the other beside it), or `.off`.
/// Vertices and triangles keep the order of the file; a triangle keeps its corners' order. Kinds
/// are known only from a `.node` file as `write_mesh` writes it; else all are steiner.
/// Throws: Error as read_points, and bad_mesh for a triangle whose corners are not three different
/// vertices of the file; duplicate points are not looked for.
[[nodiscard]] Mesh<2> read_mesh(const std::string& path);

/// Writes a mesh into files that are already open.
using MeshWriter = std::function<void(const Mesh<2>&)>;

/// Opens the files of one mesh output among `files`, by the extension of `path`:
///
/// - `.node`, and `.ele` beside it (Triangle): numbered from 1, one attribute (1 for an input
///   point, 0 otherwise), one boundary marker (1 on the boundary grid, 0 otherwise);
/// - `.vtu` (VTK, ParaView): ASCII, z = 0, the vertices' kind as point data;
/// - `.off` (Geomview): z = 0;
/// - `.svg`: a picture, see svg.hpp; its coordinates are rounded.
///
/// `files` must outlive the writer. Throws: Error (unknown_format, cannot_write, bad_option).
[[nodiscard]] MeshWriter open_mesh(OutputFiles& files, const std::string& path);

/// Writes a mesh to `path` (and beside it) as open_mesh describes, whole or not at all.
/// Throws: Error (unknown_format, cannot_write).
void write_mesh(const Mesh<2>& mesh, const std::string& path);

/// Writes points as a `.node` file, numbered from 1, without attributes or markers.
/// `points`: n x D. Throws: Error(cannot_write).
template <int D>
void write_points(const std::vector<Point<D>>& points, TextFile& file);

}  // namespace mesher
