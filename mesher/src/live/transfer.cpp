// Interpolation at the vertices that an update added. The simplices that it removed cover them: a
// new vertex is in one or more, and any of these gives it a value.
#include "mesher/transfer.hpp"

#include <algorithm>
#include <cmath>

#include "mesh/locate.hpp"
#include "sac/check.hpp"

namespace mesher {
namespace {

double cross(const Point<2>& u, const Point<2>& v) { return u[0] * v[1] - u[1] * v[0]; }
#ifndef MESHER_PLANE_ONLY
double triple(const Point<3>& u, const Point<3>& v, const Point<3>& w) {
  return u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0]) +
         u[2] * (v[0] * w[1] - v[1] * w[0]);
}
#endif

// Twice the area (six times the volume) between the origin and the side across from corner i, from
// the side of the inside positive or not, the same for all i.
double across(const std::array<Point<2>, 3>& t, std::size_t i) {
  return cross(t[(i + 1) % 3], t[(i + 2) % 3]);
}
#ifndef MESHER_PLANE_ONLY
double across(const std::array<Point<3>, 4>& t, std::size_t i) {
  const double volume = triple(t[(i + 1) % 4], t[(i + 2) % 4], t[(i + 3) % 4]);
  return i % 2 == 0 ? volume : -volume;
}
#endif

// Barycentric coordinates of p. Rounding may not take them out of 0 to 1.
template <int D>
std::array<double, D + 1> weights_at(std::array<Point<D>, D + 1> t, const Point<D>& p) {
  for (Point<D>& corner : t) {
    for (std::size_t i = 0; i < D; ++i) corner[i] -= p[i];
  }
  std::array<double, D + 1> weights;
  double sum = 0;
  for (std::size_t i = 0; i <= D; ++i) sum += weights[i] = across(t, i);
  const double sign = sum < 0 ? -1 : 1;
  sum = 0;
  for (double& w : weights) sum += w = std::max(sign * w, 0.0);
  if (!(sum > 0)) return {1};  // no volume but for rounding: any corner is as good
  for (double& w : weights) w /= sum;
  return weights;
}

}  // namespace

template <int D>
Transfer<D>::Transfer(const Change<D>& change, const LiveMesh<D>& live)
    : added_(change.slots.vertices_added), places_(change.vertices_added) {
  SAC_EXPECTS(added_.size() == places_.size());
  SAC_EXPECTS(change.slots.simplices_removed.size() == change.simplices_removed.size());
  removed_.reserve(change.simplices_removed.size());
  for (std::size_t i = 0; i < change.simplices_removed.size(); ++i) {
    const Slot slot = change.slots.simplices_removed[i];
    removed_.push_back({change.simplices_removed[i], live.simplices()[slot]});
  }
}

template <int D>
std::vector<Interpolated<D>> Transfer<D>::interpolation() const {
  const auto corners = [&](std::uint32_t t) { return removed_[t].corners; };
  const std::vector<std::uint32_t> in =
      detail::first_holding<D>(places_, removed_.size(), corners, kNoSlot);
  std::vector<Interpolated<D>> all(added_.size());
  for (std::size_t i = 0; i < added_.size(); ++i) {
    all[i].vertex = added_[i];
    all[i].from.fill(kNoSlot);
    if (in[i] == kNoSlot) continue;
    all[i].from = removed_[in[i]].slots;
    all[i].weights = weights_at<D>(removed_[in[i]].corners, places_[i]);
  }
  return all;
}

template class Transfer<2>;
#ifndef MESHER_PLANE_ONLY
template class Transfer<3>;
#endif

}  // namespace mesher
