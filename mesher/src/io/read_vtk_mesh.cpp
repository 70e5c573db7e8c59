// The meshes of VTK's grids.
#include <algorithm>
#include <optional>

#include "io/read_mesh.hpp"
#include "io/vtk_grid.hpp"

namespace mesher {
namespace {

class GridMesh {
 public:
  explicit GridMesh(VtkGrid grid) : grid_(std::move(grid)), mesh_(grid_.file) {}

  AnyMesh read() {
    read_points();
    find_cell_data();
    for (std::size_t i = 0; i < grid_.cell_count(); ++i) read_cell(i);
    note_unused(grid_.point_data, {kinds_, origins_, markers_}, grid_.notes);
    note_unused(grid_.cell_data,
                {regions_, cell_markers_, lines_, has_line_, polygons_, has_polygon_}, grid_.notes);
    mesh_.notes = std::move(grid_.notes);
    mesh_.is_in_space = grid_.is_in_space;
    return mesh_.finish();
  }

 private:
  void read_points() {
    const auto& values = grid_.points.reals;
    for (std::size_t i = 0; i < values.size(); i += 3) {
      mesh_.add_vertex({values[i], values[i + 1], values[i + 2]},
                       [&] { return grid_.points.place; });
    }
    kinds_ = VtkGrid::find_integers(grid_.point_data, "kind");
    if (kinds_ != nullptr) {
      for (const auto kind : kinds_->integers) mesh_.kinds.push_back(kind_of(kind));
    }
    origins_ = VtkGrid::find_integers(grid_.point_data, "origin");
    if (origins_ != nullptr) {
      for (const auto id : origins_->integers) mesh_.origins.emplace_back(FeatureKind::none, id);
    }
    markers_ = VtkGrid::find_integers(grid_.point_data, "marker");
    if (markers_ != nullptr) mesh_.markers = markers_->integers;
  }

  [[nodiscard]] VertexKind kind_of(std::int64_t value) const {
    if (value >= 0 && value <= static_cast<int>(VertexKind::segment)) {
      return static_cast<VertexKind>(value);
    }
    throw Error(ErrorCode::bad_mesh, "no kind of vertex is " + std::to_string(value),
                kinds_->place);
  }

  void find_cell_data() {
    regions_ = VtkGrid::find(grid_.cell_data, "region");
    cell_markers_ = VtkGrid::find_integers(grid_.cell_data, "marker");
    lines_ = VtkGrid::find_integers(grid_.cell_data, "line");
    has_line_ = VtkGrid::find_integers(grid_.cell_data, "has_line");
    polygons_ = VtkGrid::find_integers(grid_.cell_data, "polygon");
    has_polygon_ = VtkGrid::find_integers(grid_.cell_data, "has_polygon");
  }

  void read_cell(std::size_t i) {
    const auto vertices = grid_.cell(i);
    switch (grid_.type(i)) {
      case VtkCell::triangle:
        return add_simplex<2>(i, vertices);
      case VtkCell::tetrahedron:
        return add_simplex<3>(i, vertices);
      case VtkCell::quadratic_triangle:
        return add_simplex<2>(i, corners_of_second_order(vertices, 3, 6));
      case VtkCell::quadratic_tetrahedron:
        return add_simplex<3>(i, corners_of_second_order(vertices, 4, 10));
      case VtkCell::quadratic_line:
        return add_line(i, corners_of_second_order(vertices, 2, 3));
      case VtkCell::line:
      case VtkCell::poly_line:
        return add_line(i, vertices);
      case VtkCell::vertex:
      case VtkCell::poly_vertex:
        return grid_.notes.add("cells that are vertices are not used", grid_.types.place);
      case VtkCell::polygon:
      case VtkCell::quad:
        break;
    }
    throw Error(ErrorCode::unsupported,
                "cell " + std::to_string(i) + " has the type " +
                    std::to_string(grid_.types.integers[i]) +
                    ": triangles (5, 22) and lines (3, 4, 21), or tetrahedra (10, 24), make a mesh",
                grid_.types.place);
  }

  // The first of a cell's nodes; none if they are too few or too many, which no cell has.
  std::vector<std::uint32_t> corners_of_second_order(std::vector<std::uint32_t> nodes,
                                                     std::size_t corners, std::size_t all) {
    if (nodes.size() != all) return {};
    grid_.notes.add("the nodes between corners of cells of second order are not used",
                    grid_.types.place);
    for (std::size_t i = corners; i < all; ++i) mesh_.add_midpoint(nodes[i]);
    nodes.resize(corners);
    return nodes;
  }

  template <int D>
  void add_simplex(std::size_t i, const std::vector<std::uint32_t>& v) {
    typename Mesh<D>::Simplex corners{};  // the same unless there are as many
    if (v.size() == corners.size()) std::copy(v.begin(), v.end(), corners.begin());
    if (!are_different(corners)) {
      throw Error(ErrorCode::bad_mesh,
                  "cell " + std::to_string(i) + " is a " + kSimplexName<D> + " without " +
                      (D == 2 ? "three" : "four") + " different corners",
                  grid_.connectivity.place);
    }
    if constexpr (D == 2) {
      mesh_.add_triangle(corners, region(i), marker(i), id<PolygonId>(polygons_, has_polygon_, i));
    } else {
      mesh_.add<D>(corners, region(i));
    }
  }

  [[nodiscard]] double region(std::size_t cell) const {
    if (regions_ == nullptr) return 0;
    return regions_->is_integral ? static_cast<double>(regions_->integers[cell])
                                 : regions_->reals[cell];
  }

  [[nodiscard]] std::int64_t marker(std::size_t cell) const {
    return cell_markers_ == nullptr ? 0 : cell_markers_->integers[cell];
  }
  // Of `ids`, if there are any and `has_id` does not say that this cell has none.
  template <class Id>
  static std::optional<Id> id(const VtkArray* ids, const VtkArray* has_id, std::size_t cell) {
    const bool has_one = has_id == nullptr || has_id->integers[cell] != 0;
    if (ids == nullptr || !has_one) return std::nullopt;
    return Id{ids->integers[cell]};
  }

  void add_line(std::size_t i, const std::vector<std::uint32_t>& v) {
    if (v.size() < 2) {
      throw Error(ErrorCode::bad_mesh, "cell " + std::to_string(i) + " is a line of one point",
                  grid_.connectivity.place);
    }
    for (std::size_t k = 1; k < v.size(); ++k) {
      MeshEdge edge = edge_of(v[k - 1], v[k], [&] { return grid_.connectivity.place; });
      edge.marker = marker(i);
      edge.line = id<LineId>(lines_, has_line_, i);
      mesh_.edges.push_back(edge);
    }
  }

  VtkGrid grid_;
  MeshParts mesh_;
  const VtkArray *kinds_ = nullptr, *origins_ = nullptr, *markers_ = nullptr;
  const VtkArray *regions_ = nullptr, *cell_markers_ = nullptr, *lines_ = nullptr,
                 *has_line_ = nullptr, *polygons_ = nullptr, *has_polygon_ = nullptr;
};

}  // namespace

AnyMesh read_vtu_mesh(const std::string& path) { return GridMesh(read_vtu(path)).read(); }

AnyMesh read_vtk_mesh(const std::string& path) { return GridMesh(read_vtk(path)).read(); }

}  // namespace mesher
