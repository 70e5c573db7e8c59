// Features of the input, asked by looking at all of them.
#pragma once

#include <algorithm>
#include <deque>
#include <vector>

#include "index/vertex_index.hpp"
#include "plc/polygon_shape.hpp"

namespace mesher::detail {

template <class S>
class InputFeatures {
 public:
  explicit InputFeatures(const VertexPool<3>& pool) : pool_(&pool) {}
  [[nodiscard]] bool any() const noexcept { return edges_.size() + polygons_.size() != 0; }
  [[nodiscard]] const Edge& edge(EdgeHandle h) const { return edges_[h]; }
  [[nodiscard]] const Polygon& polygon(PolygonHandle h) const { return polygons_[h - 1]; }
  [[nodiscard]] std::size_t polygons() const { return polygons_.size(); }
  template <class Visit>
  void for_each_edge(Visit&& visit) const { edges_.for_each(visit); }

  Edge& add_edge(const Vertex<3>& v, const Vertex<3>& w) {
    const Vertex<3>& a = v.p < w.p ? v : w;
    const Vertex<3>& b = v.p < w.p ? w : v;
    Edge* found = nullptr;
    edges_.for_each([&](Edge& e) { if (e.a == a.self && e.b == b.self) found = &e; });
    return found != nullptr ? *found : edges_.create(a, b);
  }
  Polygon& add_polygon(const std::vector<std::vector<const Vertex<3>*>>& loops_in, const std::vector<const Vertex<3>*>& on, const std::vector<EdgeHandle>& inner) {
    auto loops = loops_in;
    put_in_order(loops, [](const Vertex<3>* v) { return v->p; });
    Polygon& f = polygons_.emplace_back();
    f.self = static_cast<PolygonHandle>(polygons_.size());
    for (const auto& loop : loops) {
      for (const auto* v : loop) f.corners.push_back(v->self), f.places.push_back(v->p), f.points.push_back(v->self);
      f.loop_end.push_back(static_cast<std::uint32_t>(f.corners.size()));
      for (std::size_t i = 0; i < loop.size(); ++i) f.edges.push_back(add_edge(*loop[i], *loop[(i + 1) % loop.size()]).self);
    }
    f.all_edges = f.edges;
    f.all_edges.insert(f.all_edges.end(), inner.begin(), inner.end());
    for (const auto* v : on) f.points.push_back(v->self);
    for (const EdgeHandle e : inner) f.points.push_back(edges_[e].a), f.points.push_back(edges_[e].b);
    std::sort(f.points.begin(), f.points.end());
    f.points.erase(std::unique(f.points.begin(), f.points.end()), f.points.end());
    std::sort(f.all_edges.begin(), f.all_edges.end());
    static_cast<void>(find_shape(f));
    return f;
  }
  FeaturesNear near(S&, const Vertex<3>&, const Point<3>& x, double r) const {
    FeaturesNear near;
    edges_.for_each([&](const Edge& e) { if (distance2(x, e.place_a, e.place_b) <= r * r) near.edges.push_back(&e); });
    for (const Polygon& f : polygons_) if (distance2(x, f) <= r * r) near.polygons.push_back(&f);
    std::sort(near.edges.begin(), near.edges.end(), [](auto* a, auto* b) { return std::tie(a->place_a, a->place_b) < std::tie(b->place_a, b->place_b); });
    std::sort(near.polygons.begin(), near.polygons.end(), [](auto* a, auto* b) { return PolygonRef{a} < PolygonRef{b}; });
    return near;
  }
  bool crowded(S&, const EdgePiece& piece) const {
    const Edge& s = *piece.edge;
    const Point<3> m = place_at(s, piece.middle());
    const double r2 = piece.length() * piece.length() / 4 * (1 + 0x1p-30);
    bool crowded = false;
    const auto shares = [&](const Edge& e) { return e.has_end(s.a) || e.has_end(s.b); };
    edges_.for_each([&](const Edge& e) { crowded = crowded || (!shares(e) && distance2(m, e.place_a, e.place_b) < r2); });
    for (const Polygon& f : polygons_) crowded = crowded || (!f.has(s.a) && !f.has(s.b) && distance2(m, f) < r2);
    pool_->for_each([&](const Vertex<3>& v) { crowded = crowded || (v.input && !s.has_end(v.self) && squared_distance(v.p, m) < r2); });
    return crowded;
  }
  double spacing2(const Point<3>& x, const Polygon& f) const {
    double d2 = 1e300;
    edges_.for_each([&](const Edge& e) { if (!f.has(e.a) && !f.has(e.b)) d2 = std::min(d2, distance2(x, e.place_a, e.place_b)); });
    for (const Polygon& g : polygons_) {
      bool shares = false;
      for (const auto v : g.points) shares = shares || f.has(v);
      if (!shares) d2 = std::min(d2, distance2(x, g));
    }
    pool_->for_each([&](const Vertex<3>& v) { if (v.input && !f.has(v.self)) d2 = std::min(d2, squared_distance(v.p, x)); });
    return d2;
  }
  Feature common(const Feature& f, const Feature& g, const Point<3>& x) const {
    using K = Feature::Kind;
    const auto edges = [&](const Feature& q) { return q.kind() == K::edge ? std::vector<EdgeHandle>{q.handle()} : polygon(q.handle()).all_edges; };
    const auto points = [&](const Feature& q) { return q.kind() == K::edge ? std::vector<VertexHandle>{edges_[q.handle()].a, edges_[q.handle()].b} : polygon(q.handle()).points; };
    Feature best; double d2 = 1e300;
    for (auto e : edges(f)) for (auto h : edges(g)) if (e == h) {
      const Edge& q = edges_[e];
      const double d = distance2(x, q.place_a, q.place_b);
      if (d < d2) d2 = d, best = Feature(q);
    }
    if (best) return best;
    for (auto v : points(f)) for (auto w : points(g)) if (v == w) {
      const double d = squared_distance((*pool_)[v].p, x);
      if (d < d2) d2 = d, best = Feature((*pool_)[v]);
    }
    return best;
  }
  [[nodiscard]] const Point<3>& place(VertexHandle v) const { return (*pool_)[v].p; }
  [[nodiscard]] std::vector<const Polygon*> polygons_at(const Edge& e) const {
    std::vector<const Polygon*> at;
    for (const Polygon& f : polygons_) if (f.has_edge(e.self)) at.push_back(&f);
    return at;
  }

 private:
  const VertexPool<3>* pool_;
  EdgePool edges_;
  std::deque<Polygon> polygons_;
};

}  // namespace mesher::detail
