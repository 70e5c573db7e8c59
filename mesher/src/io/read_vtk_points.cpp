// Reads the points of `.vtu` and `.vtk` files as points in space. Cells are not used.
#include "io/read_points.hpp"
#include "io/vtk_grid.hpp"

namespace mesher {
namespace {

PointFile<3> points_of(VtkGrid grid) {
  PointFile<3> rows{grid.file, {}, {}, {}};
  for (std::size_t i = 0; i < grid.point_count(); ++i) {
    const double* const p = &grid.points.reals[3 * i];
    add_vertex(rows, {p[0], p[1], p[2]}, grid.points.place);
  }
  note_unused(grid.point_data, {}, grid.notes);
  note_unused(grid.cell_data, {}, grid.notes);
  bool cells = false;
  for (std::size_t i = 0; i < grid.cell_count() && !cells; ++i) {
    cells = grid.type(i) != VtkCell::vertex && grid.type(i) != VtkCell::poly_vertex;
  }
  if (cells) grid.notes.add("cells other than vertices are not used", grid.types.place);
  rows.add(grid.notes.notes());
  return rows;
}

}  // namespace

PointFile<3> read_vtu_points(const std::string& path) { return points_of(read_vtu(path)); }

PointFile<3> read_vtk_points(const std::string& path) { return points_of(read_vtk(path)); }

}  // namespace mesher
