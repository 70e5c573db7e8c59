// Inputs in space: complexes, or points alone.
#include <algorithm>
#include <string_view>

#include "input.hpp"

namespace tool {
namespace {

using mesher::Error;
using mesher::ErrorCode;
using mesher::FeatureId;
using mesher::FileLocation;
using mesher::Plc;
using mesher::PlcFile;

bool is_one_of(std::string_view format, std::initializer_list<std::string_view> formats) {
  return std::find(formats.begin(), formats.end(), format) != formats.end();
}
bool is_of_complexes(const std::string& path) {
  return is_one_of(mesher::format_of(path), {".poly", ".smesh"});
}
bool is_of_surfaces(const std::string& path) {
  return is_one_of(mesher::format_of(path), {".off", ".obj", ".ply", ".stl"});
}
// Which may have faces.
bool is_of_grids(const std::string& path) {
  return is_one_of(mesher::format_of(path), {".vtu", ".vtk"});
}

PlcFile points_alone(mesher::PointFile<3> points) {
  PlcFile file;
  file.file = file.point_file = points.file;
  for (std::size_t i = 0; i < points.ids.size(); ++i) {
    file.plc.points.push_back({points.ids[i], points.points[i], 0});
    const FileLocation place = points.location(i);
    file.points.push_back({place.line, place.column});
  }
  file.notes = std::move(points.notes);
  return file;
}

PlcFile read(const std::string& path, Faces faces) {
  if (faces == Faces::unless_points && !is_of_complexes(path)) {
    return points_alone(mesher::read_points<3>(path));
  }
  if (!is_of_complexes(path) && !is_of_surfaces(path) && !is_of_grids(path)) {
    throw Error(
        ErrorCode::bad_option,
        "--surface is for .off, .obj, .ply, .stl, .vtu and .vtk: this format has no polygons",
        {path});
  }
  return mesher::read_plc(path);
}

}  // namespace

SpaceInput::SpaceInput(const std::string& path, Faces faces)
    : Standing(path),
      file_(read(path, faces)),
      is_complex_(faces != Faces::unless_points || is_of_complexes(path)) {
  if (faces != Faces::merged) return;
  // Facets that are left keep their places, by their ids.
  const PlcFile all = file_;
  file_.plc = mesher::with_merged_facets(all.plc);
  std::map<FeatureId, mesher::FilePosition> places;
  for (std::size_t i = 0; i < all.facets.size(); ++i) {
    places.emplace(all.plc.facets[i].polygon.id, all.facets[i]);
  }
  file_.facets.clear();
  for (const auto& f : file_.plc.facets) file_.facets.push_back(places.at(f.polygon.id));
}

bool SpaceInput::leaves_faces() const noexcept { return !is_complex_ && is_of_surfaces(path()); }

std::vector<mesher::InputPoint<3>> SpaceInput::points() const {
  std::vector<mesher::InputPoint<3>> points;
  for (const auto& p : file_.plc.points) points.push_back({p.id, p.at});
  return points;
}

void SpaceInput::repair(const std::optional<mesher::Box<3>>& domain) {
  mesher::RepairedPlc repaired = mesher::repair(file_, domain);
  file_ = std::move(repaired.file);
  repairs_ = std::move(repaired.notes);
}

bool SpaceInput::has_region_limits() const {
  const auto& regions = file_.plc.regions;
  return edits_limits() || std::any_of(regions.begin(), regions.end(), [](const auto& region) {
           return region.max_volume.has_value();
         });
}

std::string SpaceInput::warning(const mesher::SeedFaultOf<3>& fault) const {
  return warning_text(fault.seed, describe(fault));
}

mesher::PointFile<3> points_of(const PlcFile& file) {
  mesher::PointFile<3> points{file.point_file, {}, {}, {}, {}};
  for (std::size_t i = 0; i < file.plc.points.size(); ++i) {
    points.ids.push_back(file.plc.points[i].id);
    points.points.push_back(file.plc.points[i].at);
    points.lines.push_back(file.points[i].line);
  }
  return points;
}

}  // namespace tool
