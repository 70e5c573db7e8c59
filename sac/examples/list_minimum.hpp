// The least element of a list: contraction.hpp with min.
//
// From scratch O(n); an insertion or deletion O(log n) expected, and mostly O(1): an element that
// is not the least of its group changes only the members of the group.
#pragma once

#include <algorithm>
#include <limits>

#include "contraction.hpp"

namespace examples {

struct Minimum {
  using Value = int;
  static constexpr int kNone = std::numeric_limits<int>::max();
  static Value of(const Element& e) { return e.id == 0 ? kNone : e.value; }
  static Value join(Value a, Value b) { return std::min(a, b); }
};

/// Writes the least value of `list` to `result`; of an empty list Minimum::kNone.
inline constexpr Fold<Minimum> minimum_list{};

}  // namespace examples
