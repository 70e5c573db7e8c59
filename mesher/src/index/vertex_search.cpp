// Lengths as observations keep them, and how far a cell reaches.
#include "index/vertex_search.hpp"

#include <limits>

#include "geometry/input_point.hpp"
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
Point<D> VertexSearch<D>::outward(const Vertex<D>& v) const noexcept {
  Point<D> outward{};
  for (int i = 0; v.boundary && i < D; ++i) {
    outward[i] = v.p[i] == box_.lo[i] ? -1 : v.p[i] == box_.hi(i) ? 1 : 0;
  }
  return outward;
}

template <int D>
bool VertexSearch<D>::is_whole(const Cell& cell) const noexcept {
  const Point<D> out = outward(cell.center());
  for (int t = 0; t < cell.corners(); ++t) {
    const auto& ends = cell.ends(t);
    if (std::all_of(ends.begin(), ends.end(), [&](int i) { return cell.real(i); })) continue;
    const Point<D> q = cell.corner(t);
    bool beyond = false;
    for (int i = 0; i < D; ++i) beyond = beyond || q[i] * out[i] > 0;
    if (!beyond) return false;
  }
  return true;
}

template <int D>
Reach<D> VertexSearch<D>::concern(const Cell& cell) const noexcept {
  Box<D> extent = cell.extent_inside(outward(cell.center()));
  for (double& x : extent.lo) x /= box_.side;
  for (double& x : extent.hi) x /= box_.side;
  return Reach<D>(extent);
}

template <int D>
void VertexSearch<D>::fail_coincident(const Point<D>& p) const {
  if (refuse_) refuse_(p);
  throw Error(ErrorCode::too_close, "input points are too close for double precision near " +
                                        place_text(p) +
                                        ": a new vertex would coincide with another");
}

template class VertexSearch<2>;
#ifndef MESHER_PLANE_ONLY
template class VertexSearch<3>;
template class VertexSearch<4>;
#endif

}  // namespace mesher::detail
