// The faces of `.vtu` and `.vtk` files in space, as polygons. Other cells are not used.
#include <set>

#include "io/read_points.hpp"
#include "io/vtk_grid.hpp"

namespace mesher {
namespace {

bool is_face(VtkCell type) {
  return type == VtkCell::triangle || type == VtkCell::quad || type == VtkCell::polygon;
}

// The corners of the i-th cell. Throws: Error(bad_mesh) unless they are as many as its type has.
std::vector<std::uint32_t> corners_of(const VtkGrid& grid, std::size_t i) {
  std::vector<std::uint32_t> corners = grid.cell(i);
  const std::size_t n = corners.size();
  const VtkCell type = grid.type(i);
  const bool fits = type == VtkCell::triangle ? n == 3 : type == VtkCell::quad ? n == 4 : n >= 3;
  if (fits) return corners;
  throw Error(ErrorCode::bad_mesh,
              "cell " + std::to_string(i) + " is a face of " + std::to_string(n) + " points",
              grid.connectivity.place);
}

// The ids of the faces, if each has its own.
const VtkArray* ids_of(const VtkGrid& grid, const std::vector<std::size_t>& faces) {
  const VtkArray* const ids = VtkGrid::find_integers(grid.cell_data, "polygon");
  const VtkArray* const has = VtkGrid::find_integers(grid.cell_data, "has_polygon");
  if (ids == nullptr) return nullptr;
  std::set<std::int64_t> distinct;
  for (const std::size_t i : faces) {
    if (has != nullptr && has->integers[i] == 0) return nullptr;
    if (!distinct.insert(ids->integers[i]).second) return nullptr;
  }
  return ids;
}

Surface surface_of(VtkGrid grid) {
  Surface surface;
  surface.rows.file = grid.file;
  for (std::size_t i = 0; i < grid.point_count(); ++i) {
    const double* const p = &grid.points.reals[3 * i];
    add_vertex(surface.rows, {p[0], p[1], p[2]}, grid.points.place);
  }
  std::vector<std::size_t> faces;
  for (std::size_t i = 0; i < grid.cell_count(); ++i) {
    if (is_face(grid.type(i))) faces.push_back(i);
  }
  const VtkArray* const markers = VtkGrid::find_integers(grid.cell_data, "marker");
  const VtkArray* const ids = ids_of(grid, faces);
  for (const std::size_t i : faces) {
    const FileLocation& place = grid.connectivity.place;
    Surface::Face& face = surface.faces.emplace_back();
    face.corners = corners_of(grid, i);
    face.position = {place.line, place.column};
    if (markers != nullptr) face.marker = markers->integers[i];
    if (ids != nullptr) face.id = PolygonId{ids->integers[i]};
  }
  note_unused(grid.point_data, {}, grid.notes);
  note_unused(grid.cell_data, {markers, ids, VtkGrid::find(grid.cell_data, "has_polygon")},
              grid.notes);
  if (faces.size() < grid.cell_count()) {
    grid.notes.add("cells other than faces are not used", grid.types.place);
  }
  surface.rows.add(grid.notes.notes());
  return surface;
}

}  // namespace

Surface read_vtu_surface(const std::string& path) { return surface_of(read_vtu(path)); }

Surface read_vtk_surface(const std::string& path) { return surface_of(read_vtk(path)); }

}  // namespace mesher
