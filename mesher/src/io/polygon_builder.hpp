// Polygons under construction: their rings become lines, each piece once; then each region and hole
// gets a seed.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/read_pslg.hpp"
#include "io/ring_seeds.hpp"
#include "io/shared_borders.hpp"

namespace mesher {

/// The first ring is the outer one; each has a position.
struct RingPolygon {
  std::vector<Ring> rings;
  std::vector<FilePosition> positions;
  std::int64_t marker = 0;
  std::optional<double> attribute;
  std::optional<double> max_area;
  NameInFile name{};
};

class PolygonBuilder {
 public:
  /// `build` gets all that is made, and must outlive this. `file`: for notes.
  PolygonBuilder(PslgBuilder& build, const std::string& file) : build_(build), file_(file) {}

  /// A line that is no part of a polygon.
  void add_line(const Ring& places, std::int64_t marker, const FilePosition& position);
  void add(RingPolygon polygon);

  /// The seeds of all polygons, in their order, once there are all lines.
  void add_seeds();

 private:
  void add_ring(const RingPolygon& polygon, std::size_t ring);
  [[nodiscard]] bool is_hole(std::size_t polygon, std::size_t ring) const;
  [[nodiscard]] std::vector<SeedQuestion> questions() const;
  void add_region(const RingPolygon& polygon, const std::optional<Point<2>>& seed, double number);
  void add_hole(const std::optional<Point<2>>& seed, const FilePosition& position);
  void note(const std::string& what, const FilePosition& position);

  PslgBuilder& build_;
  std::string file_;
  std::vector<RingPolygon> polygons_;
  SharedBorders borders_;
  std::vector<std::array<Point<2>, 2>> lines_;  // the pieces of all
};

}  // namespace mesher
