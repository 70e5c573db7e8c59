// What is near what in a drawing in space, within the tolerance; and all that has come since.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <new>
#include <vector>

#include "repair/space_drawing.hpp"
#include "sets/make_set.hpp"
#include "space/validity.hpp"

namespace mesher::detail {

/// Where a polygon lies: around its longest side, if it is narrow, else around its middle.
[[nodiscard]] inline FeatureExtent<3> narrow_extent_of(const Polygon& f) {
  FeatureExtent<3> around = extent_of(f), along = around;
  double longest2 = 0;
  for (std::uint32_t i = 0; i < f.places.size(); ++i) {
    const double length2 = squared_distance(f.places[i], f.places[f.next(i)]);
    if (length2 <= longest2) continue;
    longest2 = length2;
    along.p = f.places[i], along.q = f.places[f.next(i)];
  }
  double away2 = 0;
  for (const Point<3>& p : f.places) away2 = std::max(away2, distance2(p, along.p, along.q));
  along.slack = std::sqrt(away2) * (1 + 0x1p-40) + f.thickness + resolution(f.middle, f.reach);
  return 2 * along.slack < around.slack ? along : around;
}

class DrawingSearch {
 public:
  explicit DrawingSearch(Drawing<3>& drawing) : drawing_(drawing), store_(drawing.store()) {}

  [[nodiscard]] VertexHandle last_point() const {
    return static_cast<VertexHandle>(drawing_.places().size());
  }

  /// The handles of live edges, or polygons, near a feature, and others; ascending.
  template <class F>
  [[nodiscard]] std::vector<std::uint32_t> near(const FeatureExtent<3>& where) {
    std::vector<std::uint32_t> found;
    bool failed = false;
    const double slack = where.slack + drawing_.tolerance();
    store_.visit_near<F>(where.p, where.q, slack, [&](const F& f) noexcept {
      try {
        found.push_back(f.self);
      } catch (const std::bad_alloc&) {
        failed = true;
      }
      return failed;
    });
    if (failed) throw std::bad_alloc();
    make_set(found);
    return found;
  }
  /// Calls visit(handle) for the points near a feature, and others.
  template <class Visit>
  void visit_points(FeatureExtent<3> where, Visit&& visit) {
    where.slack += drawing_.tolerance();
    drawing_.points_tree().visit_points_in(validity::box_of(where), [&](const Vertex<3>& v) {
      visit(v.self);
      return false;
    });
  }
  /// Calls visit(feature) for the live ones of these.
  template <class Visit>
  void visit_edges(const std::vector<EdgeHandle>& handles, Visit&& visit) {
    visit_live(store_.edges(), handles, visit);
  }
  template <class Visit>
  void visit_polygons(const std::vector<PolygonHandle>& handles, Visit&& visit) {
    visit_live(store_.polygons(), handles, visit);
  }

 private:
  template <class Pool, class Visit>
  static void visit_live(const Pool& pool, const std::vector<std::uint32_t>& handles,
                         Visit&& visit) {
    for (const std::uint32_t h : handles) {
      if (pool[h].alive) visit(pool[h]);
    }
  }

  Drawing<3>& drawing_;
  FeatureStore& store_;
};

}  // namespace mesher::detail
