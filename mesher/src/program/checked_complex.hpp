// A validated graph in the plane, or complex in space: its features, and their ids.
#pragma once

#include <memory>
#include <vector>

#include "geometry/grid.hpp"
#include "mesher/mesher.hpp"
#include "program/world.hpp"
#include "space/feature_store.hpp"
#include "space/validity.hpp"

namespace mesher::detail {

class CheckedGraph {
 public:
  /// Throws: as mesh_statically of these.
  CheckedGraph(const std::vector<Point<2>>& points, const std::vector<mesher::Segment>& segments,
               const Options<2>& options, const std::vector<PointId>& ids,
               const RunControl& control);
  ~CheckedGraph();

  [[nodiscard]] const MeshBox<2>& box() const { return store().box; }
  /// Its vertices are the points.
  [[nodiscard]] World<sac::PlainScope, 2>& store() const;
  [[nodiscard]] const Names& names() const { return *store().names; }

 private:
  struct Run;
  std::unique_ptr<Run> run_;
};

class CheckedComplex {
 public:
  /// Throws: as mesh_statically of these.
  CheckedComplex(const std::vector<Point<3>>& points, const std::vector<mesher::Segment>& segments,
                 const std::vector<mesher::Polygon>& polygons, const Options<3>& options,
                 const std::vector<PointId>& ids, const RunControl& control);
  ~CheckedComplex();

  [[nodiscard]] const MeshBox<3>& box() const;
  /// Its points are those with `input`.
  [[nodiscard]] FeatureStore& store() const;
  [[nodiscard]] const SpaceNames& names() const;

 private:
  struct Run;
  std::unique_ptr<Run> run_;
};

}  // namespace mesher::detail
