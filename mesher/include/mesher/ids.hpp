// Names of the input's features.
//
// The caller gives ids. Those of points, of lines (segments and polylines together), of polygons,
// of holes and of regions are numbered apart: point 3 and line 3 may both be there. Each has a type
// of its own, so that the compiler tells them apart. A `Feature` is any of them.
//
// Example:
//   catch (const Error& error) {
//     for (const Feature& f : error.features()) {
//       if (const auto line = f.line()) mark(*line);
//     }
//   }
#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <string>

namespace mesher {

/// A point of the input.
enum class PointId : std::int64_t {};
/// A segment or a polyline of the input.
enum class LineId : std::int64_t {};
/// A polygon of the input.
enum class PolygonId : std::int64_t {};

enum class SeedKind : std::uint8_t { hole, region };

/// A hole or a region of the input. The two are numbered apart.
struct SeedId {
  SeedKind kind = SeedKind::region;
  std::int64_t number = 0;
  friend auto operator<=>(const SeedId&, const SeedId&) = default;
};

[[nodiscard]] constexpr SeedId hole_id(std::int64_t number) { return {SeedKind::hole, number}; }
[[nodiscard]] constexpr SeedId region_id(std::int64_t number) { return {SeedKind::region, number}; }

/// A line is a segment or a polyline.
enum class FeatureKind : std::uint8_t { none, point, line, polygon, hole, region };

/// The name of a feature of any kind. In order: by kind, then by number.
struct Feature {
  FeatureKind kind = FeatureKind::none;
  std::int64_t number = 0;

  constexpr Feature() = default;
  constexpr Feature(PointId id) : Feature(FeatureKind::point, static_cast<std::int64_t>(id)) {}
  constexpr Feature(LineId id) : Feature(FeatureKind::line, static_cast<std::int64_t>(id)) {}
  constexpr Feature(PolygonId id) : Feature(FeatureKind::polygon, static_cast<std::int64_t>(id)) {}
  constexpr Feature(const SeedId& id)
      : Feature(id.kind == SeedKind::hole ? FeatureKind::hole : FeatureKind::region, id.number) {}
  constexpr Feature(FeatureKind of, std::int64_t id) : kind(of), number(id) {}

  /// The id, if the feature is of that kind.
  [[nodiscard]] constexpr std::optional<PointId> point() const {
    return kind == FeatureKind::point ? std::optional(PointId{number}) : std::nullopt;
  }
  [[nodiscard]] constexpr std::optional<LineId> line() const {
    return kind == FeatureKind::line ? std::optional(LineId{number}) : std::nullopt;
  }
  [[nodiscard]] constexpr std::optional<PolygonId> polygon() const {
    return kind == FeatureKind::polygon ? std::optional(PolygonId{number}) : std::nullopt;
  }
  [[nodiscard]] constexpr std::optional<SeedId> seed() const {
    if (kind == FeatureKind::hole) return hole_id(number);
    return kind == FeatureKind::region ? std::optional(region_id(number)) : std::nullopt;
  }

  friend auto operator<=>(const Feature&, const Feature&) = default;
};

/// "point 3", "segment 5" (of a polyline, too), "polygon 2", "hole 1", "region 4"; of none "".
[[nodiscard]] std::string text_of(const Feature& feature);

}  // namespace mesher
