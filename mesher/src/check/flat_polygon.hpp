// A polygon for checks: its plane and outline in long doubles, found apart from the mesher's.
#pragma once

#include <array>
#include <vector>

#include "mesher/mesh.hpp"

namespace mesher::detail {

class FlatPolygon {
 public:
  using Real = long double;
  using Place = std::array<Real, 3>;

  /// `loops`: the places of their corners.
  explicit FlatPolygon(const std::vector<std::vector<Point<3>>>& loops);

  /// How far a place is from the plane; above it if positive.
  [[nodiscard]] Real height(const Point<3>& p) const { return height(wide(p)); }
  [[nodiscard]] Real height(const Place& p) const;
  /// Whether an odd number of loops goes around the foot of a place.
  [[nodiscard]] bool contains(const Place& p) const;
  [[nodiscard]] Real area() const;
  /// Of a triangle, seen across the plane.
  [[nodiscard]] Real area_of(const Point<3>& a, const Point<3>& b, const Point<3>& c) const;
  /// Whether it is counterclockwise, seen from above.
  [[nodiscard]] bool is_left(const Point<3>& a, const Point<3>& b, const Point<3>& c) const;
  /// A place as far from the middle of ab as these are from each other, on the left of ab as seen
  /// from above, in the plane.
  [[nodiscard]] Place beside(const Point<3>& a, const Point<3>& b) const;
  /// Some place well inside.
  [[nodiscard]] Point<3> inner_place() const;

  static Place wide(const Point<3>& p) { return {p[0], p[1], p[2]}; }

 private:
  using Flat = std::array<Real, 2>;
  [[nodiscard]] Flat in_frame(const Place& p) const;
  [[nodiscard]] bool contains(const Flat& p) const;

  Place origin_, normal_, eu_, ev_;
  std::vector<std::vector<Flat>> loops_;
};

}  // namespace mesher::detail
