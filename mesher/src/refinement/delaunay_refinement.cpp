// The triangulation of all points, and the loop.
#include "refinement/delaunay_refinement.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "delaunay/build.hpp"
#include "delaunay/spatial_order.hpp"

namespace mesher::detail {

template <int D, template <class> class Queue, class Mesh>
DelaunayRefinement<D, Queue, Mesh>::DelaunayRefinement(const MeshBox<D>& box,
                                                       std::span<const Point<D>> points,
                                                       const Settings& settings)
    : Base(box, settings, points.size()), points_(points), order_(settings.order) {}

template <int D, template <class> class Queue, class Mesh>
void DelaunayRefinement<D, Queue, Mesh>::run() {
  triangulate();
  age_.resize(kernel_.simplices().places());
  this->look_at_all([&](std::uint32_t s, const Shape& shape) { look_at(s, shape); });
  if constexpr (kConforms) this->conformity_.start();
  for (std::size_t steps = 1;; ++steps) {
    this->watch(steps, kernel_.places());
    if (!conforms()) continue;
    if (!queue_.empty()) {
      const Entry poor = queue_.delete_min();
      if (age_[poor.simplex] == poor.age) split(poor.simplex);
    } else if (const std::uint32_t large = this->take_large(); large != kNone) {
      split_large(large);
    } else if (const auto v = this->dig_sliver()) {
      fill(*v);
    } else if (!this->looks_again()) {
      break;
    }
  }
  if constexpr (kConforms) this->finish();
}

/// Else a vertex is inserted that is needed for it.
template <int D, template <class> class Queue, class Mesh>
bool DelaunayRefinement<D, Queue, Mesh>::conforms() {
  if constexpr (kConforms) {
    if (const auto wanted = this->conformity_.next()) {
      if (const auto v = this->dig(*wanted)) fill(*v);
      return false;
    }
  }
  return true;
}

template <int D, template <class> class Queue, class Mesh>
void DelaunayRefinement<D, Queue, Mesh>::triangulate() {
  std::vector<Point<D>> places = this->boundary();
  const std::size_t sides = places.size();
  places.insert(places.end(), points_.begin(), points_.end());
  for (const std::uint32_t i : spatial_order<D>(places)) {
    add(places[i], i < sides ? VertexKind::boundary : VertexKind::input,
        i < sides ? kNone : static_cast<std::uint32_t>(i - sides));
  }
  std::vector<std::uint32_t> vertices(places.size());
  std::iota(vertices.begin(), vertices.end(), 1u);
  std::size_t inserted = 0;
  build<D>(
      kernel_, vertices, [](std::uint32_t, std::uint32_t) {},
      [&] { ++inserted, this->watch(inserted, inserted); });
}

template <int D, template <class> class Queue, class Mesh>
std::uint32_t DelaunayRefinement<D, Queue, Mesh>::add(const Point<D>& p, VertexKind kind,
                                                      std::uint32_t point) {
  if constexpr (kConforms) {
    return this->add_place({p, {}}, kind, point == kNone ? 0 : this->handles_[point]);
  } else {
    return this->add_place(p, kind);
  }
}

template <int D, template <class> class Queue, class Mesh>
void DelaunayRefinement<D, Queue, Mesh>::look_at(std::uint32_t s, const Shape& shape) {
  if (this->is_poor(shape)) queue_.insert(key_of(shape), {s, age_[s]});
  this->look_for_others(s);
}

/// Where doubles end, all are alike.
template <int D, template <class> class Queue, class Mesh>
double DelaunayRefinement<D, Queue, Mesh>::key_of(const Shape& shape) const noexcept {
  const double key = order_ == RefineOrder::largest_first ? 1 / shape.radius2 : shape.shortest2;
  return std::clamp(key, std::numeric_limits<double>::min(), std::numeric_limits<double>::max());
}

template <int D, template <class> class Queue, class Mesh>
void DelaunayRefinement<D, Queue, Mesh>::split(std::uint32_t s) {
  if (this->is_below_floor(s)) return;
  if constexpr (kConforms) {
    if (!this->is_split(s)) return;
  }
  split_at_centre(s);
}

template <int D, template <class> class Queue, class Mesh>
void DelaunayRefinement<D, Queue, Mesh>::split_large(std::uint32_t s) {
  if (const auto v = this->dig_on_lattice(s)) return fill(*v);
  split_at_centre(s);
}

template <int D, template <class> class Queue, class Mesh>
void DelaunayRefinement<D, Queue, Mesh>::split_at_centre(std::uint32_t s) {
  const Centre<D> centre = this->centre_of(s);
  centres_.require_apart(kernel_, s, centre);
  const VertexKind kind = centre.on_side ? VertexKind::boundary : VertexKind::steiner;
  const std::uint32_t v = add(centre.place, kind);
  kernel_.dig(v, s);
  if constexpr (kConforms) {
    if (this->conformity_.yields(v)) {
      this->undo_place();
      return look_at(s, kernel_.measure(s));  // later again
    }
  }
  fill(v);
  on_sides_ += centre.on_side ? 1 : 0;
}

/// Requires: v is dug.
template <int D, template <class> class Queue, class Mesh>
void DelaunayRefinement<D, Queue, Mesh>::fill(std::uint32_t v) {
  for (const std::uint32_t gone : kernel_.doomed()) ++age_[gone];
  Base::before_fill(v);
  if constexpr (kConforms) this->conformity_.before_fill(v);
  kernel_.fill(v);
  age_.resize(kernel_.simplices().places());
  const auto& made = kernel_.made();
  for (std::size_t k = 0; k < made.size(); ++k) look_at(made[k], kernel_.shape_made(k));
  Base::after_fill();
  if constexpr (kConforms) this->conformity_.after_fill(v);
}

template <int D, template <class> class Queue, class Mesh>
RefineStats DelaunayRefinement<D, Queue, Mesh>::stats() const {
  RefineStats stats;
  this->set_figures(stats);
  return stats;
}

template class DelaunayRefinement<2, PowersOfTwo>;
template class DelaunayRefinement<2, StrictQueue>;
template class DelaunayRefinement<2, PowersOfTwo, ConformingMesh<2>>;
#ifndef MESHER_PLANE_ONLY
template class DelaunayRefinement<3, PowersOfTwo>;
template class DelaunayRefinement<3, StrictQueue>;
template class DelaunayRefinement<3, PowersOfTwo, ConformingMesh<3>>;
#endif

}  // namespace mesher::detail
