// The triangulation of all points, and the loop.
#include "svr/delaunay_refinement.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "delaunay/build.hpp"
#include "delaunay/spatial_order.hpp"

namespace mesher::detail {

template <int D, template <class> class Queue>
DelaunayRefinement<D, Queue>::DelaunayRefinement(const MeshBox<D>& box,
                                                 std::span<const Point<D>> points,
                                                 const Settings& settings)
    : Base(box, settings, points.size()), points_(points), order_(settings.order) {}

template <int D, template <class> class Queue>
void DelaunayRefinement<D, Queue>::run() {
  triangulate();
  age_.resize(kernel_.simplices().places());
  this->look_at_all([&](std::uint32_t s) { look_at(s, kernel_.measure(s)); });
  for (std::size_t steps = 1; !queue_.empty(); ++steps) {
    this->watch(steps, kernel_.places());
    const Entry poor = queue_.delete_min();
    if (age_[poor.simplex] == poor.age) split(poor.simplex);
  }
}

template <int D, template <class> class Queue>
void DelaunayRefinement<D, Queue>::triangulate() {
  std::vector<Point<D>> places = this->boundary();
  const std::size_t sides = places.size();
  places.insert(places.end(), points_.begin(), points_.end());
  for (const std::uint32_t i : spatial_order<D>(places)) {
    this->add_place(places[i], i < sides ? VertexKind::boundary : VertexKind::input);
  }
  std::vector<std::uint32_t> vertices(places.size());
  std::iota(vertices.begin(), vertices.end(), 1u);
  std::size_t inserted = 0;
  build<D>(
      kernel_, vertices, [](std::uint32_t, std::uint32_t) {},
      [&] { ++inserted, this->watch(inserted, inserted); });
}

template <int D, template <class> class Queue>
void DelaunayRefinement<D, Queue>::look_at(std::uint32_t s, const Shape& shape) {
  if (this->is_poor(shape)) queue_.insert(key_of(shape), {s, age_[s]});
}

/// Where doubles end, all are alike.
template <int D, template <class> class Queue>
double DelaunayRefinement<D, Queue>::key_of(const Shape& shape) const noexcept {
  const double key = order_ == RefineOrder::largest_first ? 1 / shape.radius2 : shape.shortest2;
  return std::clamp(key, std::numeric_limits<double>::min(), std::numeric_limits<double>::max());
}

template <int D, template <class> class Queue>
void DelaunayRefinement<D, Queue>::split(std::uint32_t s) {
  const Centre<D> centre = centres_.of(kernel_, s);
  centres_.require_apart(kernel_, s, centre);
  const std::uint32_t v =
      this->add_place(centre.place, centre.on_side ? VertexKind::boundary : VertexKind::steiner);
  on_sides_ += centre.on_side ? 1 : 0;
  kernel_.dig(v, s);
  for (const std::uint32_t gone : kernel_.doomed()) ++age_[gone];
  this->count_degrees(kernel_.doomed(), -1);
  kernel_.fill(v);
  age_.resize(kernel_.simplices().places());
  const auto& made = kernel_.made();
  for (std::size_t k = 0; k < made.size(); ++k) look_at(made[k], kernel_.shape_made(k));
  this->count_made();
}

template <int D, template <class> class Queue>
RefineStats DelaunayRefinement<D, Queue>::stats() const {
  RefineStats stats;
  this->set_figures(stats);
  return stats;
}

template class DelaunayRefinement<2, PowersOfTwo>;
template class DelaunayRefinement<3, PowersOfTwo>;
template class DelaunayRefinement<2, StrictQueue>;
template class DelaunayRefinement<3, StrictQueue>;

}  // namespace mesher::detail
