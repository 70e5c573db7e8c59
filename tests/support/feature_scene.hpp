// Random edges, polygons and points in space, that need not fit together, in a store; and what a
// look at all of them says.
#pragma once

#include <algorithm>
#include <memory>
#include <set>
#include <vector>

#include "polygons.hpp"
#include "program/input_features.hpp"

namespace support {

/// What is near a place, in canonical order.
struct FeaturesNear {
  std::vector<const mesher::detail::Edge*> edges;
  std::vector<const mesher::detail::Polygon*> polygons;
  friend bool operator==(const FeaturesNear&, const FeaturesNear&) = default;
};
inline FeaturesNear all_near(const Point<3>& place, double radius,
                             mesher::detail::FeatureStore& store) {
  return {mesher::detail::find_near<mesher::detail::Edge>(place, radius, store),
          mesher::detail::find_near<mesher::detail::Polygon>(place, radius, store)};
}

template <class S>
class FeatureScene {
 public:
  using Edge = mesher::detail::Edge;
  using Polygon = mesher::detail::Polygon;
  using Vertex = mesher::detail::Vertex<3>;
  using VertexHandle = mesher::detail::VertexHandle;

  template <class Host>
  FeatureScene(std::uint64_t seed, Host& host)
      : random_(seed),
        points_(box_, pool_, host),
        features_(box_, static_cast<const mesher::detail::VertexPool<3>&>(pool_), points_, host) {}

  mesher::SplitMix64& random() { return random_; }
  auto& features() { return features_; }
  const mesher::detail::FeatureStore& store() const { return features_.store(); }
  const mesher::detail::VertexPool<3>& pool() const { return pool_; }
  const auto& point_tree() const { return points_; }
  const mesher::detail::MeshBox<3>& box() const { return box_; }
  const std::vector<VertexHandle>& points() const { return handles_; }

  Point<3> place() { return {random_.unit(), random_.unit(), random_.unit()}; }
  double radius() {
    const int exponent = -static_cast<int>(random_.below(8));  // first, by any compiler
    return std::ldexp(random_.unit(), exponent);
  }

  /// A point of the input; null if its place is taken.
  const Vertex* add_point(const Point<3>& p) {
    if (points_tree_has(p)) return nullptr;
    Vertex& v = pool_.create(p);
    v.input = true;
    put(v);
    handles_.push_back(v.self);
    return &v;
  }
  VertexHandle some_point() {
    while (handles_.size() < 4) add_point(place());
    return handles_[random_.below(handles_.size())];
  }
  void remove_point(VertexHandle h) {
    take(pool_[h]);
    handles_.erase(std::find(handles_.begin(), handles_.end(), h));
  }
  /// Between points that are there, or new ones nearby.
  const Edge& add_edge() {
    for (;;) {
      const VertexHandle a = some_point();
      const VertexHandle b = random_.below(2) == 0 ? some_point() : point_near(pool_[a].p);
      if (a != b) return features_.insert(a, b);
    }
  }
  /// A triangle between points that are there, or a flat star of new points with an inner edge.
  const Polygon& add_polygon() {
    mesher::detail::PolygonParts parts;
    while (random_.below(2) == 0) {
      const std::set<VertexHandle> corners{some_point(), some_point(), some_point()};
      if (corners.size() < 3) continue;
      parts.loops = {{corners.begin(), corners.end()}};
      if (const Polygon* f = insert(parts)) return *f;
    }
    const Motion motion = random_motion(random_);
    const double scale = radius() / 4 + 0x1p-10;
    Motion placed = motion;
    placed.to = place();
    const auto add = [&](const Point<3>& p) {
      return add_point(placed(mesher::detail::scaled(scale, p)))->self;
    };
    auto& loop = parts.loops.emplace_back();
    for (const Point<3>& p : random_star(random_, {0, 0}, 1, 3 + random_.below(6))) {
      loop.push_back(add(p));
    }
    if (random_.below(2) == 0) parts.edges = {{add({0.05, 0.02, 0}), add({-0.04, 0.07, 0})}};
    if (random_.below(2) == 0) parts.points = {add({0.01, -0.08, 0})};
    return *insert(parts);
  }

  /// Calls visit(feature) for all points, live edges and live polygons.
  template <class Visit>
  void for_each(Visit&& visit) const {
    for (const VertexHandle h : handles_) visit(pool_[h]);
    store().edges().for_each([&](const Edge& e) {
      if (e.alive) visit(e);
    });
    store().polygons().for_each([&](const Polygon& f) {
      if (f.alive) visit(f);
    });
  }
  FeaturesNear naive_near(const Point<3>& place, double radius) const {
    FeaturesNear near;
    struct Take {
      FeaturesNear& near;
      const Point<3>& place;
      double radius;
      bool has(double d2) const { return mesher::detail::touches(d2, radius * radius); }
      void operator()(const Vertex&) const {}
      void operator()(const Edge& e) const {
        if (has(mesher::detail::distance2_to(place, e))) near.edges.push_back(&e);
      }
      void operator()(const Polygon& f) const {
        if (has(mesher::detail::distance2_to(place, f))) near.polygons.push_back(&f);
      }
    };
    for_each(Take{near, place, radius});
    std::sort(near.edges.begin(), near.edges.end(), [](const Edge* a, const Edge* b) {
      return std::tie(a->place_a, a->place_b) < std::tie(b->place_a, b->place_b);
    });
    std::sort(near.polygons.begin(), near.polygons.end(), [](const Polygon* a, const Polygon* b) {
      return std::tie(a->places, a->loop_end, a->inside) <
             std::tie(b->places, b->loop_end, b->inside);
    });
    return near;
  }
  /// `ball`: one of those that pieces have.
  template <class Ball>
  bool naive_any_in(const Ball& ball) const {
    bool any = false;
    for_each([&](const auto& f) { any = any || ball.has(f); });
    return any;
  }
  bool naive_crowded(const mesher::detail::EdgePiece& piece) const {
    return naive_any_in(mesher::detail::EdgeBall(piece));
  }

 private:
  bool points_tree_has(const Point<3>& p) const {
    return std::any_of(handles_.begin(), handles_.end(),
                       [&](VertexHandle h) { return pool_[h].p == p; });
  }
  void put(Vertex& v) {
    if constexpr (S::kTraced) {
      points_.insert(v);
    } else {
      points_.tree().insert_only(v);
    }
  }
  void take(Vertex& v) {
    v.input = false;
    if constexpr (S::kTraced) {
      points_.erase(v);
    } else {
      points_.tree().erase(v, [](Vertex&) {});
    }
  }
  VertexHandle point_near(const Point<3>& p) {
    const double r = radius() / 4 + 0x1p-10;
    for (;;) {
      Point<3> q = mesher::detail::plus(p, mesher::detail::scaled(r, place()));
      if (const Vertex* v = add_point(q)) return v->self;
    }
  }
  // Null if it is there already, or has no area.
  const Polygon* insert(const mesher::detail::PolygonParts& parts) {
    const Polygon& f = features_.store().record(parts);
    return f.alive || !mesher::detail::has_area(f) ? nullptr : &features_.insert(parts);
  }

  mesher::SplitMix64 random_;
  mesher::detail::MeshBox<3> box_{.lo = {-4, -4, -4}, .side = 8};
  mesher::detail::VertexPool<3> pool_;
  mesher::detail::Features<S, 3> points_;
  mesher::detail::InputFeatures<S> features_;
  std::vector<VertexHandle> handles_;
};

}  // namespace support
