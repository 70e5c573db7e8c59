// A number as whatever id is asked for, so that tests can say 3 of a point, a line or a polygon.
#pragma once

#include <cstdint>

#include "mesher/ids.hpp"

struct AnyId {
  std::int64_t number = 0;
  friend constexpr bool operator==(const AnyId&, const AnyId&) = default;
  constexpr operator mesher::PointId() const { return mesher::PointId{number}; }
  constexpr operator mesher::LineId() const { return mesher::LineId{number}; }
  constexpr operator mesher::PolygonId() const { return mesher::PolygonId{number}; }
};
