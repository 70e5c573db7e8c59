// Reads graphs of any known format.
#include "mesher/read.hpp"

#include <utility>

#include "graph/require_ids.hpp"
#include "io/line_points.hpp"
#include "io/point_file.hpp"
#include "io/read_node.hpp"
#include "io/read_plc.hpp"
#include "io/read_points.hpp"
#include "io/read_pslg.hpp"
#include "text/text.hpp"

namespace mesher {
namespace {

template <int D>
GraphFile<D> read_node_points(const std::string& path, CoincidingPoints coinciding) {
  NodeFile<D> nodes = read_node<D>(text::whole_file(path), CoordinateRule::input);
  require_distinct_ids(nodes.rows);
  if (coinciding == CoincidingPoints::refused) require_distinct_points(nodes.rows);
  return points_alone(std::move(nodes.rows), nodes.markers);
}

#ifndef MESHER_PLANE_ONLY
// A surface's faces as polygons; `line`: of a point, 0 where a file has no lines.
GraphFile<3> plc_of(Surface surface) {
  GraphFile<3> out;
  out.file = out.point_file = surface.rows.file;
  out.graph.names = std::move(surface.names);
  out.notes = std::move(surface.rows.notes);
  for (std::size_t i = 0; i < surface.rows.points.size(); ++i) {
    out.graph.points.push_back({surface.rows.ids[i], surface.rows.points[i]});
    out.points.push_back({surface.rows.lines[i], surface.rows.lines[i] > 0 ? 1 : 0});
  }
  for (const Surface::Face& face : surface.faces) {
    const auto next = static_cast<std::int64_t>(out.graph.polygons.size()) + 1;
    Polygon polygon{.id = face.id.value_or(PolygonId{next}), .loops = {{}}};
    for (const std::uint32_t corner : face.corners) {
      polygon.loops[0].push_back(out.graph.points[corner].id);
    }
    polygon.marker = face.marker;
    out.graph.polygons.push_back(std::move(polygon));
    out.polygons.push_back(face.position);
  }
  return out;
}

#endif

GraphFile<2> read_in_plane(const std::string& path, const ReadOptions& options) {
  const std::string extension = text::extension(path);
  if (extension == ".poly") return read_poly(path, PointsBeside::read);
  if (extension == ".geojson" || extension == ".json") return read_geojson(path);
  if (extension == ".obj") return read_obj_lines(path);
  if (extension == ".vtu") return read_vtu_lines(path);
  if (extension == ".node") return read_node_points<2>(path, options.coinciding);
  if (extension == ".xyz" || extension == ".csv") {
    return points_alone(read_points<2>(path, options.coinciding));
  }
  throw Error(ErrorCode::unknown_format,
              "points and lines are read from .poly, .geojson, .json, .obj, .vtu, .node, .xyz and "
              ".csv, not " +
                  text::quoted(extension),
              {path});
}

#ifndef MESHER_PLANE_ONLY
GraphFile<3> read_in_space(const std::string& path, const ReadOptions& options) {
  const std::string extension = text::extension(path);
  if (extension == ".poly") return read_space_poly(path);
  if (extension == ".smesh") return read_smesh(path);
  if (extension == ".node") return read_node_points<3>(path, options.coinciding);
  if (options.points_alone || extension == ".xyz" || extension == ".csv") {
    return points_alone(read_points<3>(path, options.coinciding));
  }
  if (extension == ".off") return plc_of(read_off_surface(path));
  if (extension == ".obj") return plc_of(read_obj_surface(path));
  if (extension == ".ply") return plc_of(read_ply_surface(path));
  if (extension == ".stl") return plc_of(read_stl_surface(path));
  if (extension == ".vtu") return plc_of(read_vtu_surface(path));
  if (extension == ".vtk") return plc_of(read_vtk_surface(path));
  throw Error(
      ErrorCode::unknown_format,
      "points, segments and polygons in space are read from .poly, .smesh, .off, .obj, .ply, "
      ".stl, .vtu, .vtk, .node, .xyz and .csv, not " +
          text::quoted(extension),
      {path});
}
#endif

}  // namespace

template <>
GraphFile<2> read<2>(const std::string& path, const ReadOptions& options) {
  GraphFile<2> file = read_in_plane(path, options);
  detail::require_ids(file.graph, &file);
  return file;
}

#ifndef MESHER_PLANE_ONLY
template <>
GraphFile<3> read<3>(const std::string& path, const ReadOptions& options) {
  GraphFile<3> file = read_in_space(path, options);
  detail::require_ids(file.graph, &file);
  return file;
}

AnyGraph read_any(const std::string& path, const ReadOptions& options) {
  if (dimension_of(path) == 3) return read<3>(path, options);
  return read<2>(path, options);
}
#endif

}  // namespace mesher
