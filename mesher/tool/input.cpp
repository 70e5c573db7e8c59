// Inputs, and where their features stand, for errors.
#include "input.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include "mesher/write.hpp"
#include "pipe.hpp"
#include "sac/check.hpp"

namespace tool {
namespace {

using mesher::Error;
using mesher::ErrorCode;
using mesher::Feature;
using mesher::FileLocation;

// What a repair does about the error, "" if nothing.
// `reach`: what it joins is closer.
std::string repair_hint(const Error& error, const std::string& reach) {
  switch (error.code()) {
    case ErrorCode::duplicate_point:
    case ErrorCode::crossing_segments:
    case ErrorCode::point_on_segment:
    case ErrorCode::overlapping_segments:
    case ErrorCode::repeated_segment:
    case ErrorCode::zero_length:
    case ErrorCode::bad_polygon:
    case ErrorCode::not_flat:
    case ErrorCode::repeated_polygon:
    case ErrorCode::point_on_polygon:
    case ErrorCode::segment_on_polygon:
    case ErrorCode::segment_through_polygon:
    case ErrorCode::crossing_polygons:
    case ErrorCode::overlapping_polygons:
      return "; --repair mends this";
    case ErrorCode::too_close:
      return "; --repair may mend this: it joins what is closer than " + reach +
             " of the box's side";
    default:
      return "";
  }
}

bool is_one_of(std::string_view format, std::initializer_list<std::string_view> formats) {
  return std::find(formats.begin(), formats.end(), format) != formats.end();
}
// Which may have faces.
bool is_surface(const std::string& path) {
  return is_one_of(mesher::format_of(path), {".off", ".obj", ".ply", ".stl"});
}

}  // namespace

bool is_complex(const std::string& path) {
  return is_one_of(mesher::format_of(path), {".poly", ".smesh"});
}

FileLocation Standing::location(const Feature& feature) const {
  const auto edited = edited_.find(feature);
  return edited != edited_.end() ? edited->second : location_in_file(feature);
}

Error Standing::located(const Error& error) const {
  if (error.code() == ErrorCode::cancelled) return error;
  const auto& features = error.features();
  bool mends =
      offers_repair_ && std::none_of(features.begin(), features.end(),
                                     [&](const Feature& f) { return edited_.contains(f); });
  // Of what is not there, the edit that names it is all there is to say.
  const bool alone = error.code() == ErrorCode::unknown_id && features.size() == 1;
  Error found = mesher::located(
      error, [&](const Feature& f) { return alone ? FileLocation{} : location(f); });
  if (found.location().file.empty()) found = found.at({path_});
  // Lines that meet at tiny angles a repair leaves.
  mends = mends && !(error.code() == ErrorCode::too_close && meet(features));
  return mends ? found.with_message(found.message() + repair_hint(error, repair_reach())) : found;
}

std::string Standing::warning_text(const mesher::SeedId& seed, const std::string& what) const {
  return text_of(location(seed)) + ": warning: " + what;
}

// --- A dimension's ---------------------------------------------------------------------------

mesher::GraphFile<3> with_merged_polygons(const mesher::GraphFile<3>& all) {
  mesher::GraphFile<3> merged = all;
  merged.graph = mesher::with_merged_polygons(all.graph);
  std::map<mesher::PolygonId, mesher::FilePosition> places;
  for (std::size_t i = 0; i < all.polygons.size(); ++i) {
    places.emplace(all.graph.polygons[i].id, all.polygons[i]);
  }
  merged.polygons.clear();
  for (const auto& f : merged.graph.polygons) merged.polygons.push_back(places.at(f.id));
  return merged;
}

template <>
Input<2>::Input(const std::string& path, Faces faces, mesher::CoincidingPoints coinciding)
    : Standing(path), file_(mesher::read<2>(path, {.coinciding = coinciding})) {
  SAC_EXPECTS(faces == Faces::unless_points);
  has_features_ = !is_one_of(mesher::format_of(path), {".node", ".xyz", ".csv"});
}

template <>
Input<3>::Input(const std::string& path, Faces faces, mesher::CoincidingPoints coinciding)
    : Standing(path) {
  has_features_ = faces != Faces::unless_points || is_complex(path);
  if (has_features_ && !is_complex(path) && !is_surface(path) &&
      !is_one_of(mesher::format_of(path), {".vtu", ".vtk"})) {
    throw Error(
        ErrorCode::bad_option,
        "--surface is for .off, .obj, .ply, .stl, .vtu and .vtk: this format has no polygons",
        {path});
  }
  file_ = mesher::read<3>(path, {.coinciding = coinciding, .points_alone = !has_features_});
  const bool has_lines = !file_.graph.segments.empty() || !file_.graph.polylines.empty();
  if (has_features_ && !is_complex(path) && file_.graph.polygons.empty() && !has_lines) {
    throw Error(ErrorCode::bad_option,
                "--surface: the file has " + std::to_string(file_.graph.points.size()) +
                    " points and no faces; is it complete?",
                {path});
  }
  if (faces == Faces::merged) file_ = with_merged_polygons(file_);
}

template <int D>
bool Input<D>::leaves_faces() const noexcept {
  return D == 3 && !has_features_ && is_surface(path());
}

template <int D>
void Input<D>::repair(const mesher::RepairOptions<D>& options) {
  mesher::Repaired<D> repaired = mesher::repair(file_, options);
  file_ = std::move(repaired.file);
  repairs_ = std::move(repaired.notes);
  deviation_ = repaired.deviation;
}

// Of lines in the plane.
template <int D>
bool Input<D>::meet(const std::vector<Feature>& features) const {
  std::vector<std::vector<mesher::PointId>> lines;
  for (const Feature& f : features) {
    const auto id = f.line();
    if (D == 3 || !id) return false;
    for (const auto& s : file_.graph.segments) {
      if (s.id == *id) lines.push_back({s.from, s.to});
    }
    for (const auto& line : file_.graph.polylines) {
      if (line.id == *id) lines.push_back(line.points);
    }
  }
  if (lines.size() < 2) return !lines.empty();
  return std::find_first_of(lines[0].begin(), lines[0].end(), lines[1].begin(), lines[1].end()) !=
         lines[0].end();
}

template <int D>
bool Input<D>::has_region_limits() const {
  const auto& seeds = file_.graph.seeds;
  return edits_limits() || std::any_of(seeds.begin(), seeds.end(), [](const auto& seed) {
           return seed.max_measure.has_value();
         });
}

template class Input<2>;
template class Input<3>;

}  // namespace tool
