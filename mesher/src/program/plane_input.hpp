// Segments of the input put into the program's world in the plane, traced or not.
#pragma once

#include "plane/planarity.hpp"
#include "program/split_segments.hpp"
#include "program/world.hpp"

namespace mesher::detail {

/// The segment `id` between the points a and b.
/// Throws: Error(repeated_segment) if it is there under another id.
template <class S>
const Segment& add_segment(World<S, 2>& world, LineId id, VertexHandle a, VertexHandle b,
                           const Names& names) {
  if (const Segment* same = world.segments.store().find(a, b)) {
    fail_repeated(id, names.line(same->self), *same);
  }
  const PieceRef all = world.segments.insert(a, b);
  world.splits.template post_from_outside<split_segment>(split_segment_key(world.box, all), all);
  return *all.segment;
}

inline void erase_segment(World<sac::Scope, 2>& world, const Segment& s) {
  const PieceRef all = world.segments.erase(s.a, s.b);
  world.splits.retract_from_outside<split_segment>(all);
}

}  // namespace mesher::detail
