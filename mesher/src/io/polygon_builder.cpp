// Rings as lines, and seeds of regions and holes.
#include "io/polygon_builder.hpp"

#include <utility>

namespace mesher {

void PolygonBuilder::add_line(const Ring& places, std::int64_t marker,
                              const FilePosition& position) {
  std::vector<PointId> points;
  for (const Point<2>& place : places) {
    points.push_back(build_.point_at(place, marker, position));
    if (points.size() > 1) lines_.push_back({places[points.size() - 2], place});
  }
  build_.add_line(std::move(points), marker, position);
}

void PolygonBuilder::add(RingPolygon polygon) {
  for (std::size_t i = 0; i < polygon.rings.size(); ++i) add_ring(polygon, i);
  polygons_.push_back(std::move(polygon));
}

// Less what is a line already.
void PolygonBuilder::add_ring(const RingPolygon& polygon, std::size_t ring) {
  const Ring& places = polygon.rings[ring];
  std::size_t pieces = 0;
  for (const Ring& run : borders_.add(places, polygons_.size(), ring == 0)) {
    add_line(run, polygon.marker, polygon.positions[ring]);
    pieces += run.size() - 1;
  }
  if (pieces == places.size() - 1) return;
  note("a border that polygons share is a line of the first of them", polygon.positions[ring]);
}

// An inner ring makes a hole, unless another polygon borders it from inside.
bool PolygonBuilder::is_hole(std::size_t polygon, std::size_t ring) const {
  return !borders_.is_filled(polygons_[polygon].rings[ring], polygon);
}

// For each polygon its region, then its holes.
std::vector<SeedQuestion> PolygonBuilder::questions() const {
  std::vector<SeedQuestion> questions;
  for (std::size_t p = 0; p < polygons_.size(); ++p) {
    const auto& rings = polygons_[p].rings;
    SeedQuestion region{&rings.front(), {}};
    for (std::size_t i = 1; i < rings.size(); ++i) region.inner.push_back(&rings[i]);
    questions.push_back(std::move(region));
    for (std::size_t i = 1; i < rings.size(); ++i) {
      if (is_hole(p, i)) questions.push_back({&rings[i], {}});
    }
  }
  return questions;
}

void PolygonBuilder::add_seeds() {
  const auto seeds = find_seeds(questions(), lines_);
  auto seed = seeds.begin();
  for (std::size_t p = 0; p < polygons_.size(); ++p) {
    const RingPolygon& polygon = polygons_[p];
    add_region(polygon, *seed++, static_cast<double>(p + 1));
    for (std::size_t i = 1; i < polygon.rings.size(); ++i) {
      if (is_hole(p, i)) add_hole(*seed++, polygon.positions[i]);
    }
  }
}

void PolygonBuilder::add_region(const RingPolygon& polygon, const std::optional<Point<2>>& seed,
                                double number) {
  if (seed) {
    const double attribute = polygon.attribute.value_or(number);
    build_.add_region(*seed, attribute, polygon.max_area, polygon.positions[0]);
    return build_.name_region(attribute, polygon.name);
  }
  note("a polygon too thin to have a place inside: only its lines are used", polygon.positions[0]);
}

void PolygonBuilder::add_hole(const std::optional<Point<2>>& seed, const FilePosition& position) {
  if (seed) return build_.add_hole(*seed, position);
  note("a hole too thin to have a place inside: only its lines are used", position);
}

void PolygonBuilder::note(const std::string& what, const FilePosition& position) {
  build_.note(what, {file_, position.line, position.column});
}

}  // namespace mesher
