// A complex in space while it is made one that fits together: points, the edges between them, and
// sheets: parts of polygons.
//
// Edges are led through points, and then are several; sheets are cut, lose parts, and get edges and
// points inside. What has changed is put into a FeatureStore again by settle(), so that it is found
// by place, and judged by the same functions as in a mesher.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <unordered_map>
#include <utility>
#include <vector>

#include "index/features.hpp"
#include "repair/drawn_points.hpp"
#include "space/feature_store.hpp"

namespace mesher::detail {

/// Part of a polygon: flat, but for what is_flat lets be.
struct Sheet {
  std::size_t facet = 0;     // whose part it is: by rank of ids
  PolygonParts parts;        // no loops: it is gone
  PolygonHandle record = 0;  // live, if it is settled
  bool is_redrawn = false;   // its loops are not those that it came with
  bool is_cut_up = false;    // into triangles, with nothing inside

  [[nodiscard]] bool is_gone() const noexcept { return parts.loops.empty(); }
};

/// A line of the input: from point to point along edges.
using Path = std::vector<VertexHandle>;

template <>
class Drawing<3> : public DrawnPoints<3> {
 public:
  /// What is to be done to edges, and declared to lie in live polygons.
  struct Change {
    std::map<EdgeHandle, std::vector<VertexHandle>> leads;
    std::map<PolygonHandle, PolygonParts> declared;  // without loops

    [[nodiscard]] bool any() const noexcept { return !leads.empty() || !declared.empty(); }
  };

  /// Points will be farther apart than twice the tolerance.
  Drawing(const MeshBox<3>& box, double tolerance);
  Drawing(const Drawing&) = delete;
  Drawing& operator=(const Drawing&) = delete;

  [[nodiscard]] const Vertex<3>& point(VertexHandle v) const { return pool_[v]; }
  [[nodiscard]] FeatureStore& store() noexcept { return store_; }
  [[nodiscard]] const FeatureStore& store() const noexcept { return store_; }
  [[nodiscard]] const Features<sac::PlainScope, 3>& points_tree() const noexcept { return tree_; }
  [[nodiscard]] const std::vector<Sheet>& sheets() const noexcept { return sheets_; }
  [[nodiscard]] const std::vector<Path>& paths() const noexcept { return paths_; }
  /// Facets that have lost a part, and to which.
  [[nodiscard]] const std::vector<std::pair<std::size_t, std::size_t>>& losses() const noexcept {
    return losses_;
  }
  /// The sheet of a live polygon.
  [[nodiscard]] const Sheet& sheet_of(PolygonHandle f) const { return sheets_[sheet_of_.at(f)]; }

  /// Points get the handles 1, 2, ... `on`: the ends of an edge that it is on, if it is new.
  /// Requires: none is within twice the tolerance.
  VertexHandle add_spot(const Point<3>& p, const Ends& on = {});
  [[nodiscard]] const Ends& was_on(VertexHandle v) const { return on_[v - kFirst]; }
  void add_path(Path path) { paths_.push_back(std::move(path)); }
  /// In the order of facets.
  void add_sheet(std::size_t facet, PolygonParts parts, bool is_redrawn) {
    sheets_.push_back({facet, std::move(parts), 0, is_redrawn, false});
  }

  /// Whether e may be led through a point.
  [[nodiscard]] bool may_lead(const Edge& e, VertexHandle v) const {
    return DrawnPoints::may_lead(e.a, e.b, v);
  }

  /// From now on less is made to touch. Points stay where they are.
  using DrawnPoints::set_tolerance;
  /// Makes the edges live that sheets and paths have, and no others.
  void use_edges();
  /// Edges and polygons that have come to life since it was asked; some may have gone again.
  struct Arrivals {
    std::vector<EdgeHandle> edges;
    std::vector<PolygonHandle> polygons;
  };
  [[nodiscard]] Arrivals take_arrivals() noexcept { return std::exchange(arrivals_, {}); }
  /// Whether an edge is one that was drawn, or a part of one; else it is where a polygon was cut.
  [[nodiscard]] bool is_drawn(EdgeHandle e) const { return e < drawn_.size() && drawn_[e]; }
  /// What is drawn now is that.
  void start();
  /// Leads edges, and declares; what is changed has yet to be settled.
  void apply(const Change& change);
  /// Whether there is a way to settle a live polygon of which this goes around the rest.
  [[nodiscard]] bool can_settle(PolygonHandle f, std::vector<Loop> loops);
  /// Takes from a live polygon what other facets have. `loops`: what goes around the rest.
  void take_away(PolygonHandle f, std::vector<Loop> loops, const std::vector<std::size_t>& to);
  /// Cuts a live polygon into triangles, and what becomes of these.
  void cut_up(PolygonHandle f);
  /// Puts sheets into the store: cut where their loops meet, or into triangles if they are bent.
  /// Of equal ones that of the first facet stays. Returns whether it did something.
  /// Throws: Error(not_flat) for a polygon that is too bent. `names`: of facets.
  /// `add_inside(parts)` adds to a polygon that is to be cut what lies in it.
  using AddInside = std::function<void(PolygonParts&)>;
  bool settle(const std::vector<PolygonId>& names, const AddInside& add_inside);

 private:
  using Chains = std::unordered_map<EdgeHandle, std::vector<VertexHandle>>;

  void note_drawn(VertexHandle s, VertexHandle t);
  void take(std::size_t sheet);
  void put(std::size_t sheet);
  [[nodiscard]] const std::vector<VertexHandle>* chain_of(VertexHandle s, VertexHandle t,
                                                          const Chains& chains) const;
  bool lead(std::vector<VertexHandle>& line, bool is_closed, const Chains& chains) const;
  bool lead(std::vector<Ends>& edges, const Chains& chains) const;
  template <class Visit>
  void visit_edges(Visit&& visit) const;

  MeshBox<3> box_;
  std::vector<Ends> on_;
  VertexPool<3> pool_;
  sac::PlainScope scope_;
  Features<sac::PlainScope, 3> tree_;
  FeatureStore store_;
  std::vector<Sheet> sheets_;
  std::vector<Path> paths_;
  std::unordered_map<PolygonHandle, std::size_t> sheet_of_;
  std::vector<bool> used_, drawn_;  // by handles of edges
  Arrivals arrivals_;
  std::vector<std::pair<std::size_t, std::size_t>> losses_;
};

/// What a polygon is cut into, so that each part is flat and its loops go around it, once; nothing
/// if it has no area. sheet.parts: may have loops that meet, and points more than once.
/// Throws: Error(not_flat), if it cannot be.
[[nodiscard]] std::vector<PolygonParts> settled(const Sheet& sheet, PolygonId polygon,
                                                double tolerance, FeatureStore& store,
                                                const Drawing<3>::AddInside& add_inside);

}  // namespace mesher::detail
