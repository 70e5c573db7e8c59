// The candidates for filling where simplices must not be large [rules A7]: a function of space.
//
// Vertices of a lattice come first: if a too large simplex were just one more reason to insert a
// vertex, the mesh would be one advancing front, and an edit would change all of it.
//
// A point of a lattice is a *candidate* if its pitch is that of the lattice, and no candidate of a
// smaller pitch is within half of it.
#pragma once

#include <vector>

#include "geometry/grid.hpp"
#include "sizes/limits.hpp"

namespace mesher::detail {

/// A place that may be filled.
template <int D>
struct Candidate {
  Point<D> place{};
  double pitch = 0;
  // Those around it on the lattice are candidates, the lattice's simplices at it have no other
  // candidates in their circumspheres, and they fit.
  bool amid = false;
};
/// Those in a cell, by pitch and rows.
template <int D>
using Candidates = std::vector<Candidate<D>>;

/// What is to be done about a cell.
template <int D>
struct CellPlan {
  bool parts = false;        // it is too large to be filled at once
  Candidates<D> candidates;  // else
  Box<D> looked_at{};        // where the limits matter for this
};
/// Cost: O(1) looks at the limits, by the number of pitches beside it.
template <int D>
[[nodiscard]] CellPlan<D> plan_of(const Limits<D>& limits, const MeshBox<D>& box, const Cell<D>& c);

}  // namespace mesher::detail
