// The edges and polygons of the whole input as a tile has them.
//
// All tiles have all points, edges and polygons: what Complete asks of these is then answered as in
// one mesher for all. Each keeps them in a store of its own, whose handles are its own; what tiles
// say to each other has the handles of the store that has the whole input.
#pragma once

#include <unordered_map>
#include <vector>

#include "program/world.hpp"

namespace mesher::detail {

/// What has come and gone of the whole input, by the handles of who has it. Points go after what is
/// between them, and come before it.
struct FeatureOrders {
  std::vector<Point<3>> points_gone, points_come;
  std::vector<EdgeHandle> segments_gone, segments_come;  // edges, for as many users
  std::vector<PolygonHandle> polygons_gone, polygons_come;
  [[nodiscard]] bool is_empty() const noexcept {
    return points_gone.empty() && points_come.empty() && segments_gone.empty() &&
           segments_come.empty() && polygons_gone.empty() && polygons_come.empty();
  }
  [[nodiscard]] FeatureOrders inverse() const {
    return {points_come, points_gone, segments_come, segments_gone, polygons_come, polygons_gone};
  }
};

class SpaceFeatures {
 public:
  /// `whole`: who has the whole input; null: there are points alone.
  SpaceFeatures(World<sac::Scope, 3>& world, sac::Engine& engine, const FeatureStore* whole)
      : world_(world), engine_(engine), whole_(whole) {}

  [[nodiscard]] bool any() const noexcept { return whole_ != nullptr; }
  /// Outside edits, with their inverses noted for a roll-back. What has gone keeps its handle, and
  /// the records of its points, until commit(). Throws: std::bad_alloc.
  void carry_out(const FeatureOrders& orders);
  /// The role by the tile's handles, and by those of the whole input.
  [[nodiscard]] Role own(Role role) const;
  [[nodiscard]] Role named(Role role) const noexcept;
  void commit() noexcept;

 private:
  using Handles = std::unordered_map<std::uint32_t, std::uint32_t>;

  void put_point(const Point<3>& p);
  void take_point(const Point<3>& p);
  void put_segment(EdgeHandle name);
  void put_polygon(PolygonHandle name);
  [[nodiscard]] VertexHandle own_point(VertexHandle name) const;
  [[nodiscard]] const Edge& own_edge(EdgeHandle name) const;
  void note_edge(EdgeHandle name);
  static void note(std::uint32_t name, std::uint32_t own, Handles& owns,
                   std::vector<std::uint32_t>& names);

  World<sac::Scope, 3>& world_;
  sac::Engine& engine_;
  const FeatureStore* whole_;
  // Names: handles of the whole input.
  Handles own_edges_, own_polygons_;                       // by name
  std::vector<std::uint32_t> edge_names_, polygon_names_;  // by own handle
  std::vector<VertexHandle> gone_;                         // since the last commit; points
};

}  // namespace mesher::detail
