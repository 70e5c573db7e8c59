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

double VertexSearch::concern(const VoronoiCell& cell) const noexcept {
  const Vertex<2>& v = cell.center();
  if (!v.boundary) return 2 * std::sqrt(cell.reach2());
  Point<2> outward;
  for (int i = 0; i < 2; ++i) {
    outward[i] = v.p[i] == box_.lo[i] ? -1 : v.p[i] == box_.hi(i) ? 1 : 0;
  }
  return 2 * std::sqrt(cell.reach2_inside(outward));
}

void VertexSearch::fail_coincident(const Point<2>& p) const {
  if (refuse_) refuse_(p);
  throw Error(ErrorCode::too_close, "input points are too close for double precision near " +
                                        place_text(p) +
                                        ": a new vertex would coincide with another");
}

}  // namespace mesher::detail
