// Files that are written: meshes, graphs, pictures.
//
// Example:
//   mesher::write_mesh(mesh, "lake.vtu");
//
// Guarantees:
//   (1) what is written is a function of the mesh alone, byte for byte;
//   (2) coordinates read back bit for bit, from all formats but .svg;
//   (3) an output file appears whole, at the end, or not at all. Each is written under a temporary
//       name in its own directory. `commit` closes all of them, looks at every error a disk can
//       report, and only then renames them to their targets, each of which is kept under another
//       name until the last has its own. Whatever fails before that removes the temporaries and
//       leaves the targets as they were.
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

/// A text file being written. Throws Error(cannot_write) where the system refuses.
class TextFile {
 public:
  /// Opens `path` for writing and empties it. Errors speak of `shown_as`.
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
  /// What `write` puts where it is told: it returns the end of that, at most `most` characters on,
  /// which are 1024 at the most. For rows of many numbers.
  template <class Write>
  void add_up_to(std::size_t most, Write&& write) {
    if (buffer_.size() - used_ < most) flush();
    used_ = static_cast<std::size_t>(write(buffer_.data() + used_) - buffer_.data());
  }

  /// Writes what is left and closes.
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
  /// Removes what has not been committed.
  ~OutputFiles();

  /// A new file that `commit` will name `target`; the reference stays valid until then.
  /// Throws: Error(cannot_write) if that could not work, Error(bad_option) if `target` is taken
  /// by another output or protected.
  TextFile& open(const std::string& target);

  /// Refuses `path` as a target: it is an input.
  void protect(const std::string& path) { protected_.push_back(path); }

  /// Closes all files and renames them to their targets.
  /// Throws: Error(cannot_write), and then the targets are as before.
  void commit();

  /// Where the files are until they are committed.
  [[nodiscard]] std::vector<std::string> temporaries() const;
  /// What they will be called, in the order of opening.
  [[nodiscard]] std::vector<std::string> targets() const;

 private:
  struct Entry {
    std::string target;     // as given
    std::string resolved;   // behind symbolic links
    std::string temporary;  // in the directory of `resolved`
    std::string kept;       // there as well: what had the target's name, if anything had
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

/// Which files a `.node` output has.
enum class MeshFiles : std::uint8_t {
  plain,     ///< .node and .ele
  features,  ///< .edge, .poly and .neigh as well; in space .edge
};

/// Opens the files of one mesh output among `files`, by the extension of `path`. Of triangles:
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
/// - `.svg`: a picture, see write_svg; its coordinates are rounded.
///
/// Of tetrahedra:
///
/// - `.node`, and `.ele` and `.face` beside it (TetGen): numbered from 1. Vertices without origins
///   and markers have one attribute (1 for an input point, 0 otherwise) and one marker (1 on the
///   boundary grid, 0 otherwise); else two attributes, kind and origin, and their marker. A
///   tetrahedron's attribute is its region. Without features faces are those of the boundary, with
///   marker 1; else those of MeshFeatures (behind the marker the id of the polygon, where known).
///   With MeshFiles::features `.edge`: the edges of MeshFeatures (behind the marker the id of the
///   line, where known);
/// - `.vtu` and `.vtk` (VTK, ParaView): cells are the tetrahedra, then the faces and the edges of
///   MeshFeatures; point data kind, origin, marker; cell data region, marker, polygon and line with
///   has_polygon and has_line (1 where it is known);
/// - `.msh` (Gmsh 4.1): each region, and each marker of faces and of edges, is a physical group,
///   named and numbered as in the plane;
/// - `.mesh` (Medit): references are regions, and markers of vertices, faces and edges, as there;
/// - `.off` (Geomview), `.obj` (Wavefront) and `.stl`: the boundary alone, as triangles seen from
///   outside counterclockwise, with the vertices on it;
/// - `.svg`: a picture, cut open, see write_svg; its coordinates are rounded.
///
/// All in text. `files` must outlive the writer. D is 2 or 3.
/// Throws: Error (unknown_format, cannot_write, bad_option).
template <int D>
[[nodiscard]] MeshWriter<D> open_mesh(OutputFiles& files, const std::string& path,
                                      MeshFiles content = MeshFiles::plain);

/// The extension of a path in small letters, ".vtu": what formats go by.
[[nodiscard]] std::string format_of(const std::string& path);

/// Writes a mesh to `path` (and beside it) as open_mesh describes, whole or not at all; the files
/// of a `.node` output are `features` if there are any.
/// Throws: Error (unknown_format, cannot_write).
void write_mesh(const Mesh<2>& mesh, const std::string& path);
void write_mesh(const Mesh<3>& mesh, const std::string& path);
void write_mesh(const MeshData<2>& mesh, const std::string& path);
void write_mesh(const MeshData<3>& mesh, const std::string& path);

/// Writes points as a `.node` file, numbered from 1, without attributes or markers.
/// `points`: n x D. Throws: Error(cannot_write).
template <int D>
void write_points(const std::vector<Point<D>>& points, TextFile& file);

/// Writes a graph so that read() gives it back.
///
/// In the plane `.poly` (each piece of a polyline becomes a segment of its own with the polyline's
/// marker, numbered after the last segment), or `.obj`: points and lines, without ids, markers,
/// holes and regions. In space `.poly`, or `.smesh` if no polygon has more than one loop; but for
/// the numbers of polygons and segments, where they are not those of the order.
/// Coordinates read back bit for bit. Throws: Error (unknown_format, cannot_write, unsupported).
void write_graph(const Graph<2>& graph, const std::string& path);
void write_graph(const Graph<3>& graph, const std::string& path);
void write_poly(const Graph<2>& graph, TextFile& file);
void write_poly(const Graph<3>& graph, TextFile& file);
void write_obj(const Graph<2>& graph, TextFile& file);
/// Requires: require_single_loops(graph) has not thrown.
void write_smesh(const Graph<3>& graph, TextFile& file);
/// Throws: Error(unsupported) if a polygon is more than one loop: .smesh has no place for that.
void require_single_loops(const Graph<3>& graph);

/// What a picture shows. D is 2 or 3.
template <int D>
struct SvgView {
  Box<D> window;  ///< in the mesh's coordinates
  /// Simplices to show in another colour, as Change has them: the change of an update.
  std::vector<std::array<Point<D>, D + 1>> coloured;
};

/// The input points of a mesh with an eighth of their longest side around them; all of the mesh if
/// it has fewer than two. Cost: O(vertices).
template <int D>
[[nodiscard]] SvgView<D> svg_view(const Mesh<D>& mesh);

/// A picture: thin lines, input points as small dots, both finer where the mesh is; regions in
/// light colours, edges on lines of the input thick and dark. It is 1000 units on its longer side,
/// y upward in the mesh and downward in the file. Coordinates are rounded to a thousandth of a
/// unit; what lies outside the view is left out. Throws: Error(cannot_write). Cost: O(m log m).
void write_svg(const Mesh<2>& mesh, const SvgView<2>& view, TextFile& file);
void write_svg(const Mesh<2>& mesh, const MeshFeatures& features, const SvgView<2>& view,
               TextFile& file);

/// A picture cut open, seen from the front, above and left: the tetrahedra with their middle in the
/// window and behind the plane that halves it in y. The worse the radius-edge ratio of a
/// tetrahedron, the bluer it is (pale: 0.61, blue: 2 and more); faces are darker where they turn
/// away from the light, and with depth. Faces in polygons of the input are green, edges on lines
/// and on polygons' edges thick, input points are dots. What is behind is drawn first: the depth of
/// circumcentres orders the tetrahedra of a Delaunay triangulation so (Edelsbrunner 1990).
/// Requires: `mesh` is a Delaunay triangulation. Throws: Error(cannot_write). Cost: O(m log m).
void write_svg(const Mesh<3>& mesh, const SvgView<3>& view, TextFile& file);
/// With what `features` tell of faces in polygons and edges on lines; else as the mesh does.
void write_svg(const Mesh<3>& mesh, const MeshFeatures& features, const SvgView<3>& view,
               TextFile& file);
}  // namespace mesher
