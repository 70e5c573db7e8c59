// Ids of the features of the input.
//
// The caller chooses ids. Points, lines (segments and polylines together), polygons, holes and
// regions are numbered separately: point 3 and line 3 may both exist. Each kind has an id type of
// its own, so the compiler tells them apart. A `Feature` holds an id of any kind.
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

/// The id of a point.
enum class PointId : std::int64_t {};
/// The id of a segment or a polyline.
enum class LineId : std::int64_t {};
/// The id of a polygon.
enum class PolygonId : std::int64_t {};

enum class SeedKind : std::uint8_t { hole, region };

/// The id of a hole or a region. Holes and regions are numbered separately.
struct SeedId {
  SeedKind kind = SeedKind::region;
  std::int64_t number = 0;
  friend auto operator<=>(const SeedId&, const SeedId&) = default;
};

[[nodiscard]] constexpr SeedId hole_id(std::int64_t number) { return {SeedKind::hole, number}; }
[[nodiscard]] constexpr SeedId region_id(std::int64_t number) { return {SeedKind::region, number}; }

/// The kind of a feature. A line is a segment or a polyline.
enum class FeatureKind : std::uint8_t { none, point, line, polygon, hole, region };

/// The id of a feature of any kind. Ordered by kind, then by number.
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

/// "point 3", "segment 5" (also for a polyline), "polygon 2", "hole 1", "region 4"; "" for none.
[[nodiscard]] std::string text_of(const Feature& feature);

}  // namespace mesher
