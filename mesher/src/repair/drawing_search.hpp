// What is near what in a drawing in space, within the tolerance; and all that has come since.
#pragma once

#include <cstdint>
#include <new>
#include <vector>

#include "repair/space_drawing.hpp"
#include "sets/make_set.hpp"
#include "space/validity.hpp"

namespace mesher::detail {

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
