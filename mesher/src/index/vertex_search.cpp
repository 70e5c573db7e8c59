// Lengths as observations keep them, and how far a cell reaches.
#include "index/vertex_search.hpp"

#include <limits>

#include "input.hpp"
#include "mesher/error.hpp"

namespace mesher::detail {

// The least float that is not below x: a bound stays a bound.
template <int D>
float VertexSearch<D>::packed(double x) const noexcept {
  x /= box_.side;
  const auto f = static_cast<float>(x);
  return double{f} >= x ? f : std::nextafter(f, std::numeric_limits<float>::infinity());
}

template <int D>
double VertexSearch<D>::concern(const Cell& cell) const noexcept {
  const Vertex<D>& v = cell.center();
  if (!v.boundary) return 2 * std::sqrt(cell.reach2());
  Point<D> outward;
  for (int i = 0; i < D; ++i) {
    outward[i] = v.p[i] == box_.lo[i] ? -1 : v.p[i] == box_.hi(i) ? 1 : 0;
  }
  return 2 * std::sqrt(cell.reach2_inside(outward));
}

template <int D>
void VertexSearch<D>::fail_coincident(const Point<D>& p) {
  throw Error(ErrorCode::too_close, "input points are too close for double precision near " +
                                        place_text(p) +
                                        ": a new vertex would coincide with another");
}

template class VertexSearch<2>;
template class VertexSearch<3>;

}  // namespace mesher::detail
