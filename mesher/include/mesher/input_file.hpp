// What files of graphs in the plane and of complexes in space have in common.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "mesher/error.hpp"
#include "mesher/mesh.hpp"

namespace mesher {

template <int D>
struct MarkedPoint {
  FeatureId id{};
  Point<D> at{};
  std::int64_t marker = 0;  ///< 0: none
  friend bool operator==(const MarkedPoint&, const MarkedPoint&) = default;
};

struct MarkedSegment {
  FeatureId id{};
  FeatureId from{}, to{};  ///< points
  std::int64_t marker = 0;
  friend bool operator==(const MarkedSegment&, const MarkedSegment&) = default;
};

/// What is enclosed around `seed` is no part of the domain.
template <int D>
struct HoleSeed {
  FeatureId id{};
  Point<D> seed{};
  friend bool operator==(const HoleSeed&, const HoleSeed&) = default;
};

/// Where the parts of a file stood: one position for each element of the array of that name.
struct FileParts {
  std::string file;
  std::string point_file;  ///< `file`, or the .node file beside it
  std::vector<FilePosition> points, segments, holes, regions;
  std::vector<Note> notes;

  [[nodiscard]] FileLocation location_of_point(std::size_t i) const {
    return at(point_file, points[i]);
  }
  [[nodiscard]] FileLocation location_of_segment(std::size_t i) const {
    return at(file, segments[i]);
  }
  [[nodiscard]] FileLocation location_of_hole(std::size_t i) const { return at(file, holes[i]); }
  [[nodiscard]] FileLocation location_of_region(std::size_t i) const {
    return at(file, regions[i]);
  }

 protected:
  static FileLocation at(const std::string& file, FilePosition p) {
    return {file, p.line, p.column};
  }
};

}  // namespace mesher
