// Names of the input's features.
//
// The caller gives ids. Those of points, of lines (segments and polylines together), of polygons,
// of holes and of regions are numbered apart: point 3 and segment 3 may both be there. A `Feature`
// says which of these an id is of.
//
// Example:
//   catch (const Error& error) {
//     for (const Feature& f : error.features()) {
//       if (f.kind == FeatureKind::line) mark_line(f.id);
//     }
//   }
#pragma once

#include <compare>
#include <cstdint>
#include <string>

namespace mesher {

/// The caller's name of an input feature.
enum class FeatureId : std::int64_t {};

enum class SeedKind : std::uint8_t { hole, region };

/// Holes and regions are numbered apart.
struct SeedName {
  SeedKind kind = SeedKind::region;
  FeatureId id{};
  friend auto operator<=>(const SeedName&, const SeedName&) = default;
};

/// A line is a segment or a polyline.
enum class FeatureKind : std::uint8_t { none, point, line, polygon, hole, region };

/// The name of a feature of any kind. In order: by kind, then by id.
struct Feature {
  FeatureKind kind = FeatureKind::none;
  FeatureId id{};
  friend auto operator<=>(const Feature&, const Feature&) = default;
};

[[nodiscard]] constexpr Feature point_named(FeatureId id) { return {FeatureKind::point, id}; }
[[nodiscard]] constexpr Feature line_named(FeatureId id) { return {FeatureKind::line, id}; }
[[nodiscard]] constexpr Feature polygon_named(FeatureId id) { return {FeatureKind::polygon, id}; }
[[nodiscard]] constexpr Feature seed_named(const SeedName& seed) {
  return {seed.kind == SeedKind::hole ? FeatureKind::hole : FeatureKind::region, seed.id};
}

/// "point 3", "segment 5" (of a polyline, too), "polygon 2", "hole 1", "region 4"; of none "".
[[nodiscard]] std::string text_of(const Feature& feature);

}  // namespace mesher
