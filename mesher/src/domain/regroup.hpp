// Regions after a change of the triangulation: fragments and new triangles that are connected are
// one region, which keeps the number of its largest part that was not visited.
#pragma once

#include <cstdint>
#include <vector>

#include "domain/fragments.hpp"

namespace mesher::detail {

struct Regrouped {
  struct Moved {
    Slot slot;
    std::uint32_t from;  // component
  };
  std::vector<Moved> moved;            // survivors in another component than before
  std::vector<std::uint32_t> touched;  // components with changes, ascending; some may be empty
  std::uint64_t visited = 0;           // triangles looked at beyond the change itself
};

/// Brings components, and the triangles' numbers of them, up to date with a change of `tiles`.
/// Throws: std::bad_alloc; then it is to be taken back.
/// Cost: O(c log c) for a change of c triangles and walls; for regions that it joins, the triangles
/// of all but the largest; for one that it parts, the triangles of all parts but the largest, times
/// the parts; and see fragments.hpp.
template <int D>
[[nodiscard]] Regrouped regroup(TilesOf<D>& tiles, Components& components, Marks& marks,
                                const SeamsOf<D>& seams);

}  // namespace mesher::detail
