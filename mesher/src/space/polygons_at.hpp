// Finds the polygons that have an edge, or a point, of the input: an index into which others can be
// merged, and from which they can be removed, without allocating memory.
#pragma once

#include <set>
#include <utility>
#include <vector>

#include "space/feature_store.hpp"

namespace mesher::detail {

class PolygonsAt {
 public:
  /// Throws: std::bad_alloc, and then has part of it. Cost: O(its edges and points, log).
  void add(const Polygon& f) {
    for (const EdgeHandle e : f.all_edges) edges_.emplace(e, f.self);
    for (const VertexHandle v : f.points) points_.emplace(v, f.self);
  }
  void erase(const Polygon& f) noexcept {
    for (const EdgeHandle e : f.all_edges) edges_.erase({e, f.self});
    for (const VertexHandle v : f.points) points_.erase({v, f.self});
  }
  /// All of `more`, which is empty or has what was here already afterwards.
  void merge(PolygonsAt& more) noexcept {
    edges_.merge(more.edges_);
    points_.merge(more.points_);
  }

  /// Calls visit(polygon's handle) for each, ascending. Cost: O(log + what is visited).
  template <class Visit>
  void visit_with_edge(EdgeHandle e, Visit&& visit) const {
    visit_at(edges_, e, visit);
  }
  template <class Visit>
  void visit_with_point(VertexHandle v, Visit&& visit) const {
    visit_at(points_, v, visit);
  }

  [[nodiscard]] std::size_t bytes() const noexcept {
    return (edges_.size() + points_.size()) * kNodeBytes;
  }
  friend bool operator==(const PolygonsAt&, const PolygonsAt&) = default;

 private:
  using Pairs = std::set<std::pair<std::uint32_t, PolygonHandle>>;
  static constexpr std::size_t kNodeBytes = 48;  // with what the allocator takes

  template <class Visit>
  static void visit_at(const Pairs& all, std::uint32_t key, Visit&& visit) {
    for (auto it = all.lower_bound({key, 0}); it != all.end() && it->first == key; ++it) {
      visit(it->second);
    }
  }

  Pairs edges_, points_;
};

/// Those of all polygons that are there.
[[nodiscard]] inline PolygonsAt polygons_at(const FeatureStore& store) {
  PolygonsAt all;
  store.polygons().for_each([&](const Polygon& f) {
    if (f.alive) all.add(f);
  });
  return all;
}

}  // namespace mesher::detail
