// The triangulation of all points, and the loop.
#include "svr/complex_refinement.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "delaunay/build.hpp"
#include "delaunay/spatial_order.hpp"

namespace mesher::detail {

void ComplexRefinement::run() {
  triangulate();
  age_.resize(kernel_.simplices().places());
  look_at_all([&](std::uint32_t s) { look_at(s, kernel_.measure(s)); });
  conformity_.start();
  for (std::size_t steps = 1;; ++steps) {
    watch(steps, kernel_.places());
    if (const auto wanted = conformity_.next()) {
      if (const auto v = dig(*wanted)) fill(*v);
    } else if (!queue_.empty()) {
      const Entry poor = queue_.delete_min();
      if (age_[poor.simplex] == poor.age) split(poor);
    } else {
      break;
    }
  }
}

void ComplexRefinement::triangulate() {
  std::vector<Point<3>> places = boundary();
  const std::size_t sides = places.size();
  std::vector<VertexHandle> points(sides, 0);
  store_.points().for_each([&](const Vertex<3>& v) {
    if (!v.input) return;
    places.push_back(v.p);
    points.push_back(v.self);
  });
  for (const std::uint32_t i : spatial_order<3>(places)) {
    add_place({places[i], {}}, i < sides ? VertexKind::boundary : VertexKind::input, points[i]);
  }
  std::vector<std::uint32_t> vertices(places.size());
  std::iota(vertices.begin(), vertices.end(), 1u);
  std::size_t inserted = 0;
  build<3>(
      kernel_, vertices, [](std::uint32_t, std::uint32_t) {},
      [&] { ++inserted, watch(inserted, inserted); });
}

void ComplexRefinement::look_at(std::uint32_t s, const Shape& shape) {
  if (!is_poor(shape)) return;
  const double key = order_ == RefineOrder::largest_first ? 1 / shape.radius2 : shape.shortest2;
  queue_.insert(
      std::clamp(key, std::numeric_limits<double>::min(), std::numeric_limits<double>::max()),
      {s, age_[s]});
}

/// What yields is looked at again later.
void ComplexRefinement::split(const Entry& poor) {
  const std::uint32_t s = poor.simplex;
  if (!is_split(s)) return;
  const Centre<3> centre = centres_.of(kernel_, s);
  centres_.require_apart(kernel_, s, centre);
  const std::uint32_t v = add_place({centre.place, {}},
                                    centre.on_side ? VertexKind::boundary : VertexKind::steiner);
  kernel_.dig(v, s);
  if (conformity_.yields(v)) {
    undo_place();
    return look_at(s, kernel_.measure(s));
  }
  on_sides_ += centre.on_side ? 1 : 0;
  fill(v);
}

void ComplexRefinement::fill(std::uint32_t v) {
  for (const std::uint32_t gone : kernel_.doomed()) ++age_[gone];
  count_degrees(kernel_.doomed(), -1);
  conformity_.before_fill(v);
  kernel_.fill(v);
  age_.resize(kernel_.simplices().places());
  const auto& made = kernel_.made();
  for (std::size_t k = 0; k < made.size(); ++k) look_at(made[k], kernel_.shape_made(k));
  count_made();
  conformity_.after_fill(v);
}

RefineStats ComplexRefinement::stats() const {
  RefineStats stats;
  set_figures(stats);
  return stats;
}

}  // namespace mesher::detail
