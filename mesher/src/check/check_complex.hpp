// What of a mesh of tetrahedra are parts of the segments and polygons of a complex, found from the
// places of vertices and verified; see (b) to (d) of check.hpp.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "check/checked_mesh.hpp"
#include "check/flat_polygon.hpp"

namespace mesher::detail {

class ComplexCheck {
 public:
  /// `options.graph` is given. All must outlive this. Requires: (1) to (4) hold.
  ComplexCheck(const CheckedMesh<3>& mesh, const CheckOptions<3>& options);

  [[nodiscard]] const Verdict& segments() const { return segments_; }
  [[nodiscard]] const Verdict& polygons() const { return polygons_; }
  /// Of the faces that polygons are unions of: by its corners, ascending.
  [[nodiscard]] bool is_in_polygon(const Face& key) const { return tiles_.count(key) != 0; }
  /// Requires: tells_markers(options) (marked.hpp); segments() and polygons() hold.
  [[nodiscard]] Verdict markers() const;
  /// Whether a poor tetrahedron is one of small angles of the complex.
  [[nodiscard]] bool excuses(const Mesh<3>::Simplex& s) const;

 private:
  class Markers;
  // An edge of the complex, called by its segment, or else by the polygon that has it.
  struct Line {
    std::string name;
    std::array<PointId, 2> ends;
    Point<3> from, to;
    std::vector<std::vector<std::uint32_t>>
        runs{};                          // of vertices that edges join; one if it is whole
    std::vector<std::uint32_t> alone{};  // vertices on it, but on no edge of it
  };
  using Ends = std::array<std::uint32_t, 2>;  // low, high
  [[nodiscard]] static Ends ends_of(std::uint32_t a, std::uint32_t b) {
    return {std::min(a, b), std::max(a, b)};
  }
  struct Surface {
    const Polygon* polygon;
    std::vector<std::size_t> lines;
    std::set<Ends> border, inner;   // the edges that loops, and declared edges, are unions of
    std::set<PointId> points;       // all that it names
    std::vector<std::uint32_t> on;  // vertices on it, ascending
    std::map<std::uint32_t, std::vector<std::size_t>> lines_at;  // by vertices on them
    std::vector<Face> tiles;
  };
  struct Featured {  // what a vertex is on
    std::vector<std::size_t> lines, surfaces;
    bool is_point = false;
  };

  void add_lines();
  std::size_t line(PointId a, PointId b, const std::string& name);
  Verdict find_segments();
  void add_edges(Surface& surface, const std::vector<PointId>& ends, std::set<Ends>& edges);
  Verdict find_polygons();
  void add_named_tiles();
  void add_tiles_beside_flat();
  [[nodiscard]] bool cuts_edge(const Surface& surface, const Face& face) const;
  [[nodiscard]] bool has_three_on_line(const Surface& surface,
                                       const Mesh<3>::Simplex& corners) const;
  [[nodiscard]] bool share_line(const Surface& surface,
                                const std::vector<std::uint32_t>& vertices) const;
  [[nodiscard]] bool is_above(const FlatPolygon& f, const Face& face, std::uint32_t t) const;
  [[nodiscard]] std::optional<std::string> trouble_of(const Surface& surface);
  [[nodiscard]] double outline_of(const Surface& surface) const;
  [[nodiscard]] double flatness(const Surface& surface, const FlatPolygon& f) const;
  [[nodiscard]] bool is_open(const Ends& edge, const Point<3>& towards);
  [[nodiscard]] bool is_outside(const Point<3>& p) const;
  void name_vertices();
  [[nodiscard]] bool is_short(std::uint32_t a, std::uint32_t b) const;
  [[nodiscard]] bool is_wide(std::uint32_t a, std::uint32_t b) const;
  [[nodiscard]] bool share_shell(std::uint32_t a, std::uint32_t b) const;
  [[nodiscard]] const Point<3>& at(std::uint32_t v) const { return mesh_.at(v); }

  const CheckedMesh<3>& mesh_;
  const CheckOptions<3>& options_;
  double rounding_;
  std::map<PointId, Point<3>> places_;
  std::vector<Line> lines_;
  std::map<std::array<PointId, 2>, std::size_t> line_of_;  // by ends, ascending
  std::vector<Surface> surfaces_;
  std::set<Face> tiles_;
  std::map<Ends, std::vector<std::uint32_t>> around_;  // tetrahedra, by edges of polygons
  std::map<std::uint32_t, Featured> featured_;
  Verdict segments_, polygons_;
};

}  // namespace mesher::detail
