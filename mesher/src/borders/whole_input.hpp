// What tiles look at of the whole input. Nobody changes it while one of them runs.
#pragma once

#include "index/feature_tree.hpp"
#include "records/vertex.hpp"

namespace mesher::detail {

template <int D>
struct WholeInput {
  /// In the plane: who has the points at which segments end; null: there are no segments.
  const VertexPool<D>* ends = nullptr;
  /// Points of features, which keep the lattice away; null: there are no limits of size.
  const FeatureTree<D>* features = nullptr;
};

}  // namespace mesher::detail
