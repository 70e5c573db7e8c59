// Which places are filled where triangles must not be large [rules A7]: a function of space.
//
// The vertices come from a lattice first: were too large a triangle but one more reason to insert,
// the mesh would be one advancing front, and an edit would move all of it.
//
// A point of a lattice is a *candidate* if its pitch is that of the lattice, and no candidate of a
// smaller pitch is within half of it.
#pragma once

#include <vector>

#include "geometry/grid.hpp"
#include "sizes/limits.hpp"

namespace mesher::detail {

/// A place that may be filled.
struct Candidate {
  Point<2> place{};
  double pitch = 0;
  // The six around it on the lattice are candidates, its six triangles have no other candidates in
  // their circumcircles, and they fit.
  bool amid = false;
};
/// Those in a cell, by pitch and rows.
using Candidates = std::vector<Candidate>;

/// What is to be done about a cell.
struct CellPlan {
  bool parts = false;     // it is too large to be filled at once
  Candidates candidates;  // else
  Box<2> looked_at{};     // where the limits matter for this
};
/// Cost: O(1) looks at the limits, by the number of pitches beside it.
[[nodiscard]] CellPlan plan_of(const Limits& limits, const MeshBox<2>& box, const Cell<2>& c);

}  // namespace mesher::detail
