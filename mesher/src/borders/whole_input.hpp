// What tiles look at of the whole input. Nobody changes it while one of them runs.
#pragma once

#include "index/feature_tree.hpp"
#include "records/vertex.hpp"

namespace mesher::detail {

class FeatureNumbers;
class FeatureStore;

template <int D>
struct WholeInput {
  /// In the plane: who has the points at which segments end; null: there are no segments.
  const VertexPool<D>* ends = nullptr;
  /// Points of features, which keep the lattice away; null: there are no limits of size.
  const FeatureTree<D>* features = nullptr;
  /// In space: the edges and polygons, and the points that they are between; null: there are none.
  /// Where there are, tiles make the vertices alone: who has this puts the mesh together.
  const FeatureStore* complex = nullptr;
  /// What all processes call segments, in space edges, and polygons; null: there is one process.
  const FeatureNumbers* lines = nullptr;
  const FeatureNumbers* polygons = nullptr;
};

}  // namespace mesher::detail
