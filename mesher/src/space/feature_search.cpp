// Exact tests behind the trees, and what two features share.
#include "space/feature_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sets/common_items.hpp"
#include "space/polygon_shape.hpp"

namespace mesher::detail {

namespace {

// The nearest to x of what it is shown; of equally near ones the first by places.
class Nearest {
 public:
  Nearest(const Point<3>& x, const FeatureStore& store) : x_(x), store_(store) {}

  void show_edge(EdgeHandle h) {
    const Edge& e = store_.edges()[h];
    show(distance2_to(x_, e), e.place_a, e.place_b, Feature(e));
  }
  void show_point(VertexHandle h) {
    const Vertex<3>& v = store_.points()[h];
    show(distance2_to(x_, v), v.p, v.p, Feature(v));
  }
  [[nodiscard]] Feature found() const noexcept { return found_; }

 private:
  void show(double d2, const Point<3>& a, const Point<3>& b, Feature f) {
    const std::tuple key(d2, a, b);
    if (!found_ || key < key_) key_ = key, found_ = f;
  }
  const Point<3>& x_;
  const FeatureStore& store_;
  std::tuple<double, Point<3>, Point<3>> key_;
  Feature found_;
};

// Some are found repeatedly.
template <class F>
void put_in_canonical_order(std::vector<const F*>& all) {
  std::sort(all.begin(), all.end(), [](const F* a, const F* b) { return comes_before(*a, *b); });
  all.erase(std::unique(all.begin(), all.end()), all.end());
}

}  // namespace

bool disjoint(const Polygon& f, const Polygon& g) {
  return !visit_common(f.points, g.points, [](VertexHandle) { return true; });
}

template <class F>
std::vector<const F*> find_near(const Point<3>& place, double radius, FeatureStore& store) {
  FoundFeatures<F> found;
  store.visit_near<F>(place, place, radius * (1 + 0x1p-29), [&](const F& f) noexcept {
    return is_in_ball(place, radius * radius, f) && found.take(f);
  });
  auto all = std::move(found).all();
  put_in_canonical_order(all);
  return all;
}
template std::vector<const Edge*> find_near(const Point<3>& place, double radius, FeatureStore&);
template std::vector<const Polygon*> find_near(const Point<3>& place, double radius, FeatureStore&);

void FeaturesBeside::ask(const Point<3>& x, double radius) const {
  const double within = (std::sqrt(squared_distance(x, place_)) + radius) * (1 + 0x1p-20);
  asked_ = std::max(asked_, std::min(within, most_));
}

const std::vector<const Polygon*>& FeaturesBeside::polygons(const Point<3>& x,
                                                            double radius) const {
  ask(x, radius);
  if (asked_ > known_) polygons_ = find_near<Polygon>(place_, asked_, store_), known_ = asked_;
  return polygons_;
}

std::vector<const Edge*> FeaturesBeside::edges(const Point<3>& x, double radius) const {
  ask(x, radius);
  auto edges = find_near<Edge>(x, radius, store_);
  std::erase_if(edges, [&](const Edge* e) { return !is_in_ball(place_, most_ * most_, *e); });
  return edges;
}

/// The one with the least measure, which may be `most_measure` at most; of equal ones the first.
/// `measure(f, least)`: anything above `least` if it is above; `distance(measure)`: of f from x.
template <class F, class Measure, class Distance>
const F* FeaturesBeside::nearest(const Point<3>& x, double most, double most_measure,
                                 Measure&& measure, Distance&& distance) const {
  const F* found = nullptr;
  double least = most_measure, within = most;
  store_.visit_nearest<F>(x, within, [&](const F& f) {
    const double m = measure(f, least);
    if (!(m <= least) || !is_in_ball(place_, most_ * most_, f)) return;
    if (found != nullptr && m == least && !comes_before(f, *found)) return;
    found = &f, least = m;
    within = distance(m) * (1 + 0x1p-29);
  });
  ask(x, within);
  return found;
}

const Edge* FeaturesBeside::nearest_edge(const Point<3>& x, double most) const {
  return nearest<Edge>(
      x, most, most * most, [&](const Edge& e, double) { return distance2_to(x, e); },
      [](double d2) { return std::sqrt(d2); });
}

const Polygon* FeaturesBeside::nearest_under(const Point<3>& x, double most) const {
  const auto height = [&](const Polygon& f, double least) {
    const double h = std::abs(f.plane.height(x));
    return h <= least && contains(f, f.plane.foot(x)) ? h : std::numeric_limits<double>::infinity();
  };
  return nearest<Polygon>(x, most, most, height, [](double h) { return h; });
}

Feature common(const Edge& e, const Edge& t, const Point<3>& x, const FeatureStore& store) {
  Nearest nearest(x, store);
  if (e.self == t.self) return Feature(e);
  for (const VertexHandle end : {e.a, e.b}) {
    if (t.has_end(end)) nearest.show_point(end);
  }
  return nearest.found();
}

Feature common(const Edge& e, const Polygon& f, const Point<3>& x, const FeatureStore& store) {
  if (f.has_edge(e.self)) return Feature(e);
  Nearest nearest(x, store);
  for (const VertexHandle end : {e.a, e.b}) {
    if (f.has(end)) nearest.show_point(end);
  }
  return nearest.found();
}

Feature common(const Polygon& f, const Edge& e, const Point<3>& x, const FeatureStore& store) {
  return common(e, f, x, store);
}

Feature common(const Polygon& f, const Polygon& g, const Point<3>& x, const FeatureStore& store) {
  Nearest nearest(x, store);
  visit_common(f.all_edges, g.all_edges, [&](EdgeHandle e) { return nearest.show_edge(e), false; });
  if (nearest.found()) return nearest.found();
  visit_common(f.points, g.points, [&](VertexHandle v) { return nearest.show_point(v), false; });
  return nearest.found();
}

}  // namespace mesher::detail
