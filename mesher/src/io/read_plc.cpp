// Reads complexes of any known format and refuses repeated ids.
#include "io/read_plc.hpp"

#include "graph/distinct_ids.hpp"
#include "io/read_points.hpp"
#include "text/text.hpp"

namespace mesher {
namespace {

// A surface's faces as polygons; `line`: of a point, 0 where a file has no lines.
PlcFile plc_of(Surface surface) {
  PlcFile out;
  out.file = out.point_file = surface.rows.file;
  out.notes = std::move(surface.rows.notes);
  for (std::size_t i = 0; i < surface.rows.points.size(); ++i) {
    out.plc.points.push_back({surface.rows.ids[i], surface.rows.points[i]});
    out.points.push_back({surface.rows.lines[i], surface.rows.lines[i] > 0 ? 1 : 0});
  }
  for (const Surface::Face& face : surface.faces) {
    const auto next = static_cast<std::int64_t>(out.plc.facets.size()) + 1;
    Polygon polygon{.id = face.id.value_or(FeatureId{next}), .loops = {{}}};
    for (const std::uint32_t corner : face.corners) {
      polygon.loops[0].push_back(out.plc.points[corner].id);
    }
    out.plc.facets.push_back({std::move(polygon), face.marker});
    out.facets.push_back(face.position);
  }
  return out;
}

PlcFile read_any(const std::string& path) {
  const std::string extension = text::extension(path);
  if (extension == ".poly") return read_space_poly(path);
  if (extension == ".smesh") return read_smesh(path);
  if (extension == ".off") return plc_of(read_off_surface(path));
  if (extension == ".obj") return plc_of(read_obj_surface(path));
  if (extension == ".ply") return plc_of(read_ply_surface(path));
  if (extension == ".stl") return plc_of(read_stl_surface(path));
  if (extension == ".vtu") return plc_of(read_vtu_surface(path));
  if (extension == ".vtk") return plc_of(read_vtk_surface(path));
  throw Error(
      ErrorCode::unknown_format,
      "points, segments and polygons in space are read from .poly, .smesh, .off, .obj, .ply, "
      ".stl, .vtu and .vtk, not " +
          text::quoted(extension),
      {path});
}

}  // namespace

PlcFile read_plc(const std::string& path) {
  PlcFile f = read_any(path);
  require_distinct_parts(f.plc, f);
  return f;
}

}  // namespace mesher
