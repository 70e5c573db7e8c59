// Lengths as observations keep them, and how far a cell reaches.
#include "index/vertex_search.hpp"

#include <limits>

#include "input.hpp"
#include "mesher/error.hpp"

namespace mesher::detail {

// The least float that is not below x: a bound stays a bound.
float VertexSearch::packed(double x) const noexcept {
  x /= box_.side;
  const auto f = static_cast<float>(x);
  return double{f} >= x ? f : std::nextafter(f, std::numeric_limits<float>::infinity());
}

Reach<2> VertexSearch::concern(const VoronoiCell& cell) const noexcept {
  const Vertex<2>& v = cell.center();
  Point<2> outward{0, 0};
  for (int i = 0; v.boundary && i < 2; ++i) {
    outward[i] = v.p[i] == box_.lo[i] ? -1 : v.p[i] == box_.hi(i) ? 1 : 0;
  }
  Box<2> extent = cell.extent_inside(outward);
  for (double& x : extent.lo) x /= box_.side;
  for (double& x : extent.hi) x /= box_.side;
  return Reach<2>(extent);
}

void VertexSearch::fail_coincident(const Point<2>& p) const {
  if (refuse_) refuse_(p);
  throw Error(ErrorCode::too_close, "input points are too close for double precision near " +
                                        place_text(p) +
                                        ": a new vertex would coincide with another");
}

}  // namespace mesher::detail
