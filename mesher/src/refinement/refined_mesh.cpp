// The box, the budget of vertices, degrees.
#include "refinement/refined_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace mesher::detail {

namespace {

// Of a square: more than twice the error of a radius that the balls have, 2^-21 (simplex_ball.hpp).
constexpr double kSurely = 1 - 0x1p-18;

template <int D>
auto slivers_in([[maybe_unused]] const MeshBox<D>& box,
                [[maybe_unused]] const typename RefinedMesh<D>::Settings& settings) {
  if constexpr (D == 3) {
    return Slivers(box, settings.rho, settings.min_dihedral, settings.thorough);
  } else {
    return std::monostate();
  }
}

}  // namespace

template <int D>
RefinedMesh<D>::RefinedMesh(const MeshBox<D>& box, const Settings& settings, std::size_t points)
    : box_(box),
      rho2_(settings.rho * settings.rho * kSurely),
      centres_(box, settings.rho),
      large_(settings.limits, settings.least_limit, settings.growth),
      slivers_(slivers_in<D>(box, settings)),
      settings_(settings) {
  kernel_.reserve(points + points / 2 + 1024);
}

template <int D>
std::uint32_t RefinedMesh<D>::add_place(const Point<D>& p, VertexKind kind) {
  if (const std::size_t most = full_with(); most != 0) {
    throw Error(ErrorCode::too_many, "more than " + std::to_string(most) + " vertices are needed");
  }
  const std::uint32_t v = kernel_.add_place(p);
  kinds_.push_back(kind);
  return v;
}

template <int D>
std::vector<Point<D>> RefinedMesh<D>::boundary() const {
  std::vector<Point<D>> places;
  MeshBox<D> box = box_;
  if (const int steps = settings_.box_steps; steps != 0) {
    box.boundary_steps = std::min(box.boundary_steps, steps);
  }
  box.for_each_boundary_point([&](const Point<D>& p) { places.push_back(p); });
  return places;
}

/// Of n facets around a vertex in space, n / 2 + 2 corners are its neighbours [Euler].
template <int D>
void RefinedMesh<D>::count_degrees(std::span<const std::uint32_t> simplices, int change) {
  if (!settings_.follow_degrees) return;
  star_size_.resize(kernel_.places() + 1);
  for (const std::uint32_t s : simplices) {
    for (const std::uint32_t w : kernel_.simplices().corners(s)) {
      std::size_t& size = star_size_[w];
      size += static_cast<std::size_t>(change);
      if (w == kInfinite) continue;
      largest_degree_ = std::max(largest_degree_, D == 2 ? size : size / 2 + 2);
    }
  }
}

template <int D>
void RefinedMesh<D>::set_figures(RefineStats& stats) const {
  stats.made = made_;
  stats.most_simplices = kernel_.simplices().places();
  stats.on_sides = on_sides_;
  stats.worst_radius_edge = std::sqrt(worst2_);
  stats.largest_degree = largest_degree_;
  if constexpr (D == 3) {
    stats.slivers_split = slivers_.split();
    stats.slivers_left = slivers_.left();
  }
}

template class RefinedMesh<2>;
#ifndef MESHER_PLANE_ONLY
template class RefinedMesh<3>;
#endif

}  // namespace mesher::detail
