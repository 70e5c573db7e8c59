// Gaps between polygons that lie beside each other, and how many vertices they take.
//
// A tetrahedron between two polygons a width w apart is poor unless its edges are about rho w or
// shorter. Between parallel squares with sides of length a the mesh has 1.6 (a / rho w)^2 vertices,
// measured for svr and refine with w from 0.002 a to 0.03 a and rho from 1.5 to 10. So what faces
// have beside them says how large a mesh must get, long before it is.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>

#include "space/feature_store.hpp"

namespace mesher::detail {

class NarrowGaps {
 public:
  explicit NarrowGaps(FeatureStore& store) : store_(store) {}

  struct Gap {
    PolygonHandle one = 0, other = 0;
    double width = 0;
    Point<3> at{};
  };

  /// A part of a polygon, a triangle, of which the side of `beside` is refined. Polygons that have
  /// nothing in common with f are looked for. Cost: O(log L/s), and what is near, for up to 340
  /// places; for four when many have been asked about.
  void add(const Polygon& f, const std::array<Point<3>, 3>& part, const Point<3>& beside);

  /// How many vertices there will be in gaps, rather too few.
  [[nodiscard]] double vertices(double rho) const noexcept { return 0.5 * squares_ / (rho * rho); }
  /// Of the polygon with most of them, where it has most. Nothing: there are none.
  [[nodiscard]] std::optional<Gap> worst() const;

 private:
  struct Found {
    double squares = 0, most = 0;
    Gap gap;
  };
  struct Facing {
    PolygonHandle other = 0;
    double distance = 0;
  };
  [[nodiscard]] std::optional<Facing> facing(const Polygon& f, const Point<3>& x,
                                             const Point<3>& up, double most) noexcept;
  void add(const Polygon& f, const std::array<Point<3>, 3>& part, const Point<3>& up, int level);

  FeatureStore& store_;
  std::map<PolygonHandle, Found> by_polygon_;
  double squares_ = 0;  // of sides as long as the gaps are wide, that faces have room for
  std::size_t asked_ = 0;
};

}  // namespace mesher::detail
