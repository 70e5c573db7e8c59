// Writes meshes, graphs and pictures to files.
//
// Example:
//   mesher::write_mesh(mesh, "lake.vtu");
//
// Guarantees:
//   (1) the content of a file is a function of the mesh alone, byte for byte;
//   (2) coordinates read back bit for bit, from all formats except .svg and .inp;
//   (3) an output file appears whole, at the end, or not at all. Each file is written under a
//       temporary name in its own directory. `commit` closes all of them, checks every error that a
//       disk can report, and only then renames them to their targets. An existing target is kept
//       under another name until the last file has its target's name. Any failure before that
//       removes the temporary files and leaves the targets as they were.
#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "mesher/error.hpp"
#include "mesher/graph.hpp"
#include "mesher/mesh.hpp"

namespace mesher {

/// A text file being written. Its functions throw Error(cannot_write) if the system reports an
/// error.
class TextFile {
 public:
  /// Opens `path` for writing and empties it. Errors name it `shown_as`.
  TextFile(const std::string& path, std::string shown_as);
  TextFile(const TextFile&) = delete;
  TextFile& operator=(const TextFile&) = delete;
  ~TextFile();

  TextFile& operator<<(std::string_view text);
  TextFile& operator<<(char c) {
    if (used_ == buffer_.size()) flush();
    buffer_[used_++] = c;
    return *this;
  }
  /// The shortest decimal that reads back bit for bit.
  TextFile& operator<<(double value);
  TextFile& operator<<(std::integral auto value) { return add_integer(value); }
  /// Appends the characters that `write` puts at the pointer it is given; it returns their end.
  /// Requires: at most `most` characters, and most <= 1024. For rows of many numbers.
  template <class Write>
  void add_up_to(std::size_t most, Write&& write) {
    if (buffer_.size() - used_ < most) flush();
    used_ = static_cast<std::size_t>(write(buffer_.data() + used_) - buffer_.data());
  }

  /// Writes the rest of the buffer and closes the file.
  void close();

 private:
  TextFile& add_integer(long long value);
  void flush();
  [[noreturn]] void fail();

  std::string shown_as_;
  std::string buffer_;  // of a fixed size
  std::size_t used_ = 0;
  std::FILE* file_;
};

/// The output files of one command.
class OutputFiles {
 public:
  OutputFiles() = default;
  OutputFiles(const OutputFiles&) = delete;
  OutputFiles& operator=(const OutputFiles&) = delete;
  /// Removes files that have not been committed.
  ~OutputFiles();

  /// Opens a new file, which `commit` will rename to `target`; the reference stays valid until
  /// then. Throws: Error(cannot_write) if `target` cannot be written, Error(bad_option) if `target`
  /// is protected or the target of another output.
  TextFile& open(const std::string& target);

  /// Refuses `path` as a target, since it is an input.
  void protect(const std::string& path) { protected_.push_back(path); }

  /// Closes all files and renames them to their targets.
  /// Throws: Error(cannot_write); the targets are then as before.
  void commit();

  /// The temporary paths of the files that are not committed.
  [[nodiscard]] std::vector<std::string> temporaries() const;
  /// The targets, in the order of opening.
  [[nodiscard]] std::vector<std::string> targets() const;

 private:
  struct Entry {
    std::string target;     // as given
    std::string resolved;   // after following symbolic links
    std::string temporary;  // in the directory of `resolved`
    std::string kept;       // in the same directory: the former target, if there was one
    std::unique_ptr<TextFile> file;
  };
  static void keep(Entry& entry);
  static void replace(Entry& entry);
  static void restore(Entry& entry) noexcept;
  void require_free(const Entry& entry) const;

  std::vector<Entry> entries_;
  std::vector<std::string> protected_;
};

/// Writes a mesh into files that are already open. D is 2 or 3.
template <int D>
class MeshWriter {
 public:
  using Write = std::function<void(const Mesh<D>&, const MeshFeatures&)>;
  explicit MeshWriter(Write write) : write_(std::move(write)) {}
  /// Throws: Error(cannot_write).
  void operator()(const Mesh<D>& mesh, const MeshFeatures& features = {}) const {
    write_(mesh, features);
  }

 private:
  Write write_;
};

/// The version of a `.msh` output.
enum class MshVersion : std::uint8_t {
  v4_1,  ///< of Gmsh 4
  v2_2,  ///< which more programs read, among them GetDP, FreeFEM and gmshToFoam of OpenFOAM
};

/// How a mesh is written.
struct WriteOptions {
  /// 1, or 2: with nodes at the midpoints of edges (second_order.hpp). Of second order are `.msh`,
  /// `.vtu`, `.vtk`, `.inp` and `.node`; `.svg` shows the same either way; other formats refuse.
  int order = 1;
  MshVersion msh = MshVersion::v4_1;
};

/// The files of a `.node` output.
enum class MeshFiles : std::uint8_t {
  plain,     ///< .node and .ele
  features,  ///< also .edge, .poly and .neigh; in space .edge
};

/// Opens the files of one mesh output among `files`; the extension of `path` gives the format. For
/// triangles:
///
/// - `.node`, with `.ele` beside it (Triangle): numbered from 1. Vertices without origins and
///   markers have one attribute (1 for an input point, else 0) and one marker (1 on the boundary
///   grid, else 0); other vertices have two attributes, kind and origin, and their marker. The
///   attribute of a triangle is its region. With MeshFiles::features also `.edge` (all edges; after
///   the marker the id of the line, if known), `.poly` (no points; the edges of MeshFeatures as
///   segments) and `.neigh` (-1 if there is no neighbour);
/// - `.vtu` and `.vtk` (VTK, ParaView): ASCII, z = 0; cells are the triangles, then the edges of
///   MeshFeatures as lines; point data kind, origin, marker; cell data region, marker, line, and
///   has_line (1 if the line is known);
/// - `.msh` (Gmsh, WriteOptions::msh): ASCII, z = 0; each region and each marker of edges is a
///   physical group with its name (names.hpp). The number of a group is that value if all values
///   are integers from 1 to 2^31 - 2, else groups are numbered from 1; the value 0 is numbered
///   last, and is no group if it is the only value and has no name;
/// - `.inp` (Abaqus, CalculiX): z = 0; elements CPS3, in second order CPS6. Each region is a set of
///   elements (*ELSET), each marker of edges a set of nodes (*NSET) and a surface (*SURFACE) of
///   sides of elements, of the element with the lowest number for an edge between two; `Nall` and
///   `Eall` are all. Numbers have at most 20 characters, as these programs demand, and so may be
///   rounded. In names, what is no letter, digit, '_', '-' or '.' becomes '_', and a number is
///   added to a name that is taken, in whatever case of letters;
/// - `.su2` (SU2): dimension 2; each marker of edges on the boundary is a marker; names as in
///   `.inp`. Edges between two triangles, and regions, are left out;
/// - `.mesh` (Medit): dimension 3, z = 0; references are regions, and markers of vertices and of
///   edges, numbered in the same way; 0 stays 0;
/// - `.off` (Geomview): z = 0, triangles alone; `.obj` (Wavefront): z = 0, and the edges as lines;
/// - `.svg`: a picture, see write_svg; its coordinates are rounded.
///
/// For tetrahedra:
///
/// - `.node`, with `.ele` and `.face` beside it (TetGen): numbered from 1. Vertices without origins
///   and markers have one attribute (1 for an input point, else 0) and one marker (1 on the
///   boundary grid, else 0); other vertices have two attributes, kind and origin, and their marker.
///   The attribute of a tetrahedron is its region. Without features the faces are those of the
///   boundary, with marker 1; else those of MeshFeatures (after the marker the id of the polygon,
///   if known). With MeshFiles::features also `.edge`: the edges of MeshFeatures (after the marker
///   the id of the line, if known);
/// - `.vtu` and `.vtk` (VTK, ParaView): cells are the tetrahedra, then the faces and the edges of
///   MeshFeatures; point data kind, origin, marker; cell data region, marker, polygon and line,
///   with has_polygon and has_line (1 if known);
/// - `.msh` (Gmsh): each region, and each marker of faces and of edges, is a physical group, named
///   and numbered as in the plane;
/// - `.inp` (Abaqus, CalculiX): elements C3D4, in second order C3D10; sets of elements for regions,
///   sets of nodes and surfaces for markers of faces as for edges in the plane, and sets of nodes
///   for markers of edges;
/// - `.su2` (SU2): dimension 3; markers for those of faces on the boundary;
/// - `.mesh` (Medit): references are regions, and markers of vertices, faces and edges, as in the
///   plane;
/// - `.off` (Geomview), `.obj` (Wavefront) and `.stl`: only the boundary, as triangles that are
///   counterclockwise seen from outside, with the vertices on it. If a marker of faces has a name
///   (names.hpp), each marker on the boundary is a group (g) of `.obj`, a solid of `.stl`;
/// - `.svg`: a cutaway picture, see write_svg; its coordinates are rounded.
///
/// All formats are text. `files` must outlive the writer. D is 2 or 3.
/// Throws: Error (unknown_format, cannot_write; bad_option, also for an order that the format does
/// not have). The writer throws Error(bad_option) for names as require_names does.
template <int D>
[[nodiscard]] MeshWriter<D> open_mesh(OutputFiles& files, const std::string& path,
                                      MeshFiles content = MeshFiles::plain,
                                      const WriteOptions& options = {});

/// The extension of a path in lower case, such as ".vtu", which gives the format.
[[nodiscard]] std::string format_of(const std::string& path);

/// Writes a mesh to `path` (and beside it) as open_mesh describes, whole or not at all. A `.node`
/// output has MeshFiles::features if the mesh has features.
/// Throws: Error (unknown_format, cannot_write, bad_option).
void write_mesh(const Mesh<2>& mesh, const std::string& path, const WriteOptions& options = {});
void write_mesh(const Mesh<3>& mesh, const std::string& path, const WriteOptions& options = {});
void write_mesh(const MeshData<2>& mesh, const std::string& path, const WriteOptions& options = {});
void write_mesh(const MeshData<3>& mesh, const std::string& path, const WriteOptions& options = {});

/// Writes points as a `.node` file, numbered from 1, without attributes or markers.
/// `points`: n x D. Throws: Error(cannot_write).
template <int D>
void write_points(const std::vector<Point<D>>& points, TextFile& file);

/// Writes a graph that read() reads back.
///
/// In the plane `.poly` (each piece of a polyline becomes a segment of its own with the marker of
/// the polyline, numbered after the last segment) or `.obj` (points and lines, without ids,
/// markers, holes and regions). In space `.poly`, or `.smesh` if no polygon has more than one loop;
/// polygons and segments get ids by their order.
/// Coordinates read back bit for bit. Throws: Error (unknown_format, cannot_write, unsupported).
void write_graph(const Graph<2>& graph, const std::string& path);
void write_graph(const Graph<3>& graph, const std::string& path);
void write_poly(const Graph<2>& graph, TextFile& file);
void write_poly(const Graph<3>& graph, TextFile& file);
void write_obj(const Graph<2>& graph, TextFile& file);
/// Requires: require_single_loops(graph) has not thrown.
void write_smesh(const Graph<3>& graph, TextFile& file);
/// Throws: Error(unsupported) if a polygon has more than one loop, which .smesh cannot represent.
void require_single_loops(const Graph<3>& graph);

/// The content of a picture. D is 2 or 3.
template <int D>
struct SvgView {
  Box<D> window;  ///< in the mesh's coordinates
  /// Simplices to show in another colour, as in Change, for example those that an update added.
  std::vector<std::array<Point<D>, D + 1>> coloured;
};

/// A view of the input points of a mesh, with a border of an eighth of their longest side; of the
/// whole mesh if it has fewer than two input points. Cost: O(vertices).
template <int D>
[[nodiscard]] SvgView<D> svg_view(const Mesh<D>& mesh);

/// Draws a mesh: thin lines and input points as small dots, both finer where the mesh is fine;
/// regions in light colours, edges on lines of the input thick and dark. The picture has 1000 units
/// on its longer side; y points upward in the mesh and downward in the file. Coordinates are
/// rounded to a thousandth of a unit; parts outside the view are left out. Throws:
/// Error(cannot_write). Cost: O(m log m).
void write_svg(const Mesh<2>& mesh, const SvgView<2>& view, TextFile& file);
void write_svg(const Mesh<2>& mesh, const MeshFeatures& features, const SvgView<2>& view,
               TextFile& file);

/// Draws a cutaway view from the front, above and left: the tetrahedra with their middle in the
/// window and behind the plane that halves it in y. A tetrahedron is the bluer, the worse its
/// radius-edge ratio (pale: 0.61, blue: 2 and more); faces are darker if they turn away from the
/// light, and with depth. Faces in polygons of the input are green, edges on lines and on edges of
/// polygons thick, input points are dots. Tetrahedra are drawn from back to front: the depth of
/// their circumcentres is a correct order in a Delaunay triangulation (Edelsbrunner 1990).
/// Requires: `mesh` is a Delaunay triangulation. Throws: Error(cannot_write). Cost: O(m log m).
void write_svg(const Mesh<3>& mesh, const SvgView<3>& view, TextFile& file);
/// The same with the faces in polygons and edges on lines of `features`, or of the mesh if
/// `features` has none.
void write_svg(const Mesh<3>& mesh, const MeshFeatures& features, const SvgView<3>& view,
               TextFile& file);
}  // namespace mesher
