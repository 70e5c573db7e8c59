// Finds the causes of slow change propagation: calls that break conciseness or monotonicity.
//
// A trace is concise if no two of its calls have equal labels [Def 1.4.2]; two traces are monotone
// if their common labels come in the same order [Def 1.4.3]. Calls are numbered in pre-order from
// 0; labels_at() returns their texts.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "traces/trace.hpp"

namespace traces {

/// A label that occurs more than once.
struct Repetition {
  std::uint32_t first;   // the first call with the label
  std::uint32_t second;  // the second one
  std::uint64_t times;   // number of calls with the label
};

/// The result of check_concise().
struct Conciseness {
  std::uint64_t surplus = 0;            // calls with the label of an earlier call
  std::vector<Repetition> repetitions;  // every such label, ordered by `second`
};

/// Finds the repeated labels of a trace. Two calls have equal labels if they are calls of one
/// function with equal hashes. Cost: O(n log n).
[[nodiscard]] Conciseness check_concise(const Trace& trace);

/// Two common calls: `left` comes first in trace a, `right` in trace b.
struct Inversion {
  Pair left;   // left.a < right.a
  Pair right;  // right.b < left.b
};

/// The result of check_monotone().
struct Monotonicity {
  std::uint64_t common = 0;        // calls in both traces
  std::uint64_t moved = 0;         // common calls outside a longest common order
  std::optional<Inversion> first;  // smallest right.a, then largest left.b
};

/// Finds the common calls of two traces that are in another order. Cost: O(n log n).
[[nodiscard]] Monotonicity check_monotone(const Trace& a, const Trace& b);

}  // namespace traces
