// The edges and polygons of the input: their records, the users of each edge, and searches near a
// position.
//
// An edge exists while a feature uses it: a segment of the input, or polygons that have it as an
// edge or inside. Listeners are notified of added and removed edges and polygons.
#pragma once

#include <boost/container/small_vector.hpp>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "plane/segment_store.hpp"
#include "records/handle_table.hpp"
#include "records/reach_tree.hpp"
#include "space/polygon_pool.hpp"
#include "space/polygon_shape.hpp"

namespace mesher::detail {

using Loop = std::vector<VertexHandle>;  // corners in their order around, either way

/// What a polygon is, by the points of the input; in any order.
struct PolygonParts {
  std::vector<Loop> loops;  // the outer one first; three corners or more, each once in a loop
  std::vector<std::pair<VertexHandle, VertexHandle>> edges;  // that lie inside
  std::vector<VertexHandle> points;                          // that lie inside, ends or not
};

/// Who wants to know of features that come and go: what has come is there, what has gone is not.
class FeatureEvents {
 public:
  virtual void came(const Edge& e) noexcept = 0;
  virtual void went(const Edge& e) noexcept = 0;
  virtual void came(const Polygon& f) noexcept = 0;
  virtual void went(const Polygon& f) noexcept = 0;

 protected:
  ~FeatureEvents() = default;
};

class FeatureStore {
 public:
  FeatureStore(const MeshBox<3>& box, const VertexPool<3>& points)
      : box_(box), points_(points), edges_(box, points), by_parts_(*this), tree_(box) {}
  FeatureStore(const FeatureStore&) = delete;
  FeatureStore& operator=(const FeatureStore&) = delete;
  void set_listener(FeatureEvents* listener) noexcept { listener_ = listener; }

  [[nodiscard]] const SegmentStoreOf<3>& segments() const noexcept { return edges_; }
  [[nodiscard]] const EdgePool& edges() const noexcept { return edges_.pool(); }
  [[nodiscard]] const PolygonPool& polygons() const noexcept { return polygons_; }
  [[nodiscard]] const VertexPool<3>& points() const noexcept { return points_; }
  /// How many there are, less those of freed records.
  [[nodiscard]] std::size_t live_edges() const noexcept { return edges_.live(); }
  [[nodiscard]] std::size_t live_polygons() const noexcept { return tree_.size(); }

  /// The live edge between two points, in either order; null if there is none. Cost: O(1).
  [[nodiscard]] const Edge* find_edge(VertexHandle a, VertexHandle b) const {
    return edges_.find(a, b);
  }
  /// The live edge that two vertices both lie on: each inside of an edge (e, t), or else (0)
  /// perhaps an input point (v, w). 0: none. Cost: O(1).
  [[nodiscard]] EdgeHandle common_edge(EdgeHandle e, VertexHandle v, EdgeHandle t,
                                       VertexHandle w) const {
    if (e != 0) return e == t || edges()[e].has_end(w) ? e : 0;
    if (t != 0) return edges()[t].has_end(v) ? t : 0;
    const Edge* both = find_edge(v, w);
    return both == nullptr ? 0 : both->self;
  }
  /// Calls visit(edge) for the live edges at a point, until it returns true.
  template <class Visit>
  bool visit_edges_at(VertexHandle point, Visit&& visit) const {
    return edges_.visit_at(point, visit);
  }

  /// The record of the edge between two points, or of a polygon, made if there is none; it is freed
  /// by commit() unless it is live then. A polygon without an area is one whose plane has no
  /// normal. Throws: std::bad_alloc, and then changes nothing.
  [[nodiscard]] Edge& record(VertexHandle a, VertexHandle b);
  [[nodiscard]] Polygon& record(PolygonParts parts);

  /// One user more of an edge, who makes it live if it is the first. Throws: std::bad_alloc, and
  /// then changes nothing.
  void use(Edge& e) { use(e, false); }
  /// One user less. Requires: use(e) before.
  void leave(Edge& e) noexcept;
  [[nodiscard]] std::uint32_t users(const Edge& e) const noexcept {
    return e.self < users_.size() ? users_[e.self] : 0;
  }
  /// Makes f live, with the edges on it. Requires: it is not, and has an area. Throws:
  /// std::bad_alloc, and then changes nothing. Cost: O(corners log L/s).
  void put(Polygon& f);
  /// Requires: f is live.
  void take(Polygon& f) noexcept;

  /// Calls visit(edge) and visit(polygon) for the live features within `slack` of the segment pq
  /// (p = q: of the point), and some others, some repeatedly, until it returns true. Returns
  /// whether it did. visit must not throw, nor search.
  template <class Visit>
  bool visit_near(const Point<3>& p, const Point<3>& q, double slack, Visit&& visit) noexcept {
    return visit_near<Edge>(p, q, slack, visit) || visit_near<Polygon>(p, q, slack, visit);
  }
  /// The same with the edges, or the polygons, alone.
  template <class F, class Visit>
  bool visit_near(const Point<3>& p, const Point<3>& q, double slack, Visit&& visit) noexcept {
    if constexpr (std::is_same_v<F, Edge>) {
      return edges_.visit_near(p, q, slack, [&](const Edge& e) { return visit(e); });
    } else {
      return tree_.visit_near(p, q, slack,
                              [&](PolygonHandle h) { return visit(std::as_const(polygons_[h])); });
    }
  }
  /// The same with the edges within `reach` of p that are not `outside(x, r)`: no place of the ball
  /// of radius r around x matters. Those that are only sides of polygons with few of them are left
  /// out.
  template <class Outside, class Visit>
  bool visit_free_edges_in(const Point<3>& p, double reach, Outside&& outside,
                           Visit&& visit) noexcept {
    return edges_.visit_free_in(p, reach, outside, [&](const Edge& e) { return visit(e); });
  }

  /// The same with all polygons that are not.
  template <class Outside, class Visit>
  bool visit_polygons_in(Outside&& outside, Visit&& visit) noexcept {
    return tree_.visit_unless(outside,
                              [&](PolygonHandle h) { return visit(std::as_const(polygons_[h])); });
  }

  /// Edges that are only sides of polygons with no more than so many are best found with these.
  static constexpr std::size_t kFewSides = 8;

  /// Visits the edges, or the polygons, within `within` of x, and some others, some repeatedly,
  /// near ones first where that is easily told. `within` may become less meanwhile. visit must not
  /// throw, nor search.
  template <class F, class Visit>
  void visit_nearest(const Point<3>& x, const double& within, Visit&& visit) noexcept {
    if constexpr (std::is_same_v<F, Edge>) {
      edges_.visit_nearest(x, within, visit);
    } else {
      tree_.visit_nearest(x, within, [&](PolygonHandle h) { visit(std::as_const(polygons_[h])); });
    }
  }

  /// The live polygons that an edge lies on, in canonical order.
  [[nodiscard]] std::span<const PolygonHandle> polygons_at(const Edge& e) const noexcept {
    if (e.self >= at_edge_.size()) return {};
    return {at_edge_[e.self].data(), at_edge_[e.self].size()};
  }

  /// How much searches have looked at so far.
  [[nodiscard]] std::uint64_t looked_at() const noexcept {
    return edges_.looked_at() + tree_.looked_at() + parts_looked_at_ + changed_looked_at_ +
           (changed_tree_ ? changed_tree_->looked_at() : 0);
  }
  /// Calls visit(edge) and visit(polygon) for those that may have come or gone since the last
  /// commit() and are not `outside`, as above, until it returns true. Returns whether it did.
  /// Throws: std::bad_alloc.
  template <class Outside, class Visit>
  bool visit_changed_in(Outside&& outside, Visit&& visit) {
    find_changed();
    return changed_tree_->visit_unless(outside, [&](const Changed& f) {
      return f.is_edge ? visit(std::as_const(edges_[f.handle]))
                       : visit(std::as_const(polygons_[f.handle]));
    });
  }
  /// Frees the records of features that are not live.
  void commit() noexcept;
  [[nodiscard]] std::size_t bytes() const noexcept;
  /// Throws InvariantError. Cost: O(features).
  void check_invariants() const;

 private:
  friend class HandleTable<FeatureStore>;
  struct Key {
    const Polygon* f;
    friend bool operator==(const Key& a, const Key& b) noexcept {
      return a.f->corners == b.f->corners && a.f->loop_end == b.f->loop_end &&
             a.f->points == b.f->points && a.f->all_edges == b.f->all_edges;
    }
  };
  [[nodiscard]] Key key(PolygonHandle h) const noexcept { return {&polygons_[h]}; }
  [[nodiscard]] static std::size_t hash(const Key& key) noexcept;
  struct Changed {
    bool is_edge;
    std::uint32_t handle;
    friend bool operator==(const Changed&, const Changed&) = default;
  };
  void touch(Polygon& f) noexcept;
  void find_changed();
  void forget_changed() noexcept;
  void use(Edge& e, bool bounds);
  void leave(std::span<const EdgeHandle> edges) noexcept;
  [[nodiscard]] Polygon shaped(PolygonParts& parts);
  void make_room_at_edges(const Polygon& f);
  void put_at_edges(const Polygon& f) noexcept;

  const MeshBox<3>& box_;
  const VertexPool<3>& points_;
  SegmentStoreOf<3> edges_;
  std::vector<std::uint32_t> users_;  // by the handles of edges
  using PolygonsAtEdge = boost::container::small_vector<PolygonHandle, 2>;
  std::vector<PolygonsAtEdge> at_edge_;  // likewise: those that are live
  PolygonPool polygons_;
  HandleTable<FeatureStore> by_parts_;
  ReachTree<PolygonHandle, 3> tree_;
  std::uint64_t parts_looked_at_ = 0;  // of polygons
  PolygonHandle changed_ = 0;
  std::uint64_t changes_ = 0;  // how many polygons have ever been in that list
  // What has changed, by place, once somebody asks: when there had been so many changes.
  std::optional<ReachTree<Changed, 3>> changed_tree_;
  std::uint64_t found_changes_ = 0;
  std::uint64_t changed_looked_at_ = 0;  // in trees that were given up
  FeatureEvents* listener_ = nullptr;
};

}  // namespace mesher::detail
