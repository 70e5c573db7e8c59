// The points and lines of `.vtu` files.
#include "io/read_pslg.hpp"
#include "io/vtk_grid.hpp"
#include "text/text.hpp"

namespace mesher {
namespace {

Point<2> input_point(const VtkGrid& grid, std::size_t i) {
  Point<2> p{grid.points.reals[3 * i], grid.points.reals[3 * i + 1]};
  for (double& x : p) {
    x += 0.0;  // no negative zero
    if (text::is_coordinate(x)) continue;
    throw Error(ErrorCode::magnitude,
                "vertex " + std::to_string(i) + " at " + text::to_text<2>(p) +
                    ": a coordinate is neither 0 nor of magnitude 2^-100 to 2^100",
                grid.points.place);
  }
  return p;
}

std::int64_t marker_of(const VtkArray* markers, std::size_t i) {
  return markers == nullptr ? 0 : markers->integers[i];
}

void add_cell(const VtkGrid& grid, std::size_t i, std::int64_t marker,
              const std::vector<PointId>& ids, PslgBuilder& build) {
  const FileLocation& place = grid.connectivity.place;
  const VtkCell type = grid.type(i);
  if (type == VtkCell::vertex || type == VtkCell::poly_vertex) return;  // all points are input
  if (type != VtkCell::line && type != VtkCell::poly_line) {
    throw Error(ErrorCode::unsupported,
                "cell " + std::to_string(i) + " has the type " +
                    std::to_string(grid.types.integers[i]) +
                    ": only vertices (1, 2) and lines (3, 4) are input",
                grid.types.place);
  }
  std::vector<PointId> points;
  for (const std::uint32_t v : grid.cell(i)) points.push_back(ids[v]);
  if (points.size() < 2 || (type == VtkCell::line && points.size() > 2)) {
    throw Error(
        ErrorCode::bad_mesh,
        "cell " + std::to_string(i) + " is a line of " + std::to_string(points.size()) + " points",
        place);
  }
  build.add_line(std::move(points), marker, {place.line, place.column});
}

}  // namespace

GraphFile<2> read_vtu_lines(const std::string& path) {
  VtkGrid grid = read_vtu(path);
  require_plane(grid);
  const VtkArray* const point_markers = VtkGrid::find_integers(grid.point_data, "marker");
  const VtkArray* const cell_markers = VtkGrid::find_integers(grid.cell_data, "marker");
  note_unused(grid.point_data, {point_markers}, grid.notes);
  note_unused(grid.cell_data, {cell_markers}, grid.notes);
  PslgBuilder build(path);
  for (const Note& note : grid.notes.notes()) build.note(note.text, note.location);
  const FilePosition position{grid.points.place.line, grid.points.place.column};
  std::vector<PointId> ids;
  for (std::size_t i = 0; i < grid.point_count(); ++i) {
    ids.push_back(build.add_point(input_point(grid, i), marker_of(point_markers, i), position));
  }
  for (std::size_t i = 0; i < grid.cell_count(); ++i) {
    add_cell(grid, i, marker_of(cell_markers, i), ids, build);
  }
  return build.finish();
}

}  // namespace mesher
