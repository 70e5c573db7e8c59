// The sum of a list: contraction.hpp with +.
//
// From scratch O(n); an insertion, deletion or change O(log n) expected: the sums of the groups
// that the element is in.
#pragma once

#include "contraction.hpp"

namespace examples {

struct Sum {
  using Value = std::int64_t;
  static Value of(const Element& e) { return e.id == 0 ? 0 : e.value; }
  static Value join(Value a, Value b) { return a + b; }
};

/// Writes the sum of `list` to `result`; of an empty list 0.
inline constexpr Fold<Sum> sum_list{};

}  // namespace examples
