// What makes change propagation slow: programs that are not concise or not monotone.
//
// A trace is concise if no two of its calls have equal labels [Def 1.4.2]; two traces are monotone
// if their common labels come in the same order [Def 1.4.3]. Calls are named by their numbers in
// pre-order, from 0; labels_at() gives their texts.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "traces/trace.hpp"

namespace traces {

/// A label that occurs more than once.
struct Repetition {
  std::uint32_t first;   // the first call that has it
  std::uint32_t second;  // and the next
  std::uint64_t times;   // calls that have it
};

struct Conciseness {
  std::uint64_t surplus = 0;            // calls whose label an earlier one has
  std::vector<Repetition> repetitions;  // every such label, ordered by `second`
};

/// Equal labels are calls of the same function object with equal hashes. Cost: O(n log n).
[[nodiscard]] Conciseness check_concise(const Trace& trace);

/// Two common calls of which `left` comes first in the one trace and `right` in the other.
struct Inversion {
  Pair left;   // left.a < right.a
  Pair right;  // right.b < left.b
};

struct Monotonicity {
  std::uint64_t common = 0;        // calls in both traces
  std::uint64_t moved = 0;         // common calls outside a longest common order
  std::optional<Inversion> first;  // smallest right.a, then largest left.b
};

/// Cost: O(n log n).
[[nodiscard]] Monotonicity check_monotone(const Trace& a, const Trace& b);

}  // namespace traces
