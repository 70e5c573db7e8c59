// The distance of two traces [Def 1.4.2]: |T| + |T'| - 2|C|, where C holds the common labels.
//
// Labels count as often as they occur: a label that occurs twice in T and once in T' is in C once.
// Functions with one name are counted together. By weight, a call that is not common counts with
// its weight (Trace::weight_of), so that a call with much work inside counts more.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "traces/trace.hpp"

namespace traces {

/// Counts of the calls of two traces, in all or of one function.
struct CallCounts {
  std::uint64_t calls_a = 0;
  std::uint64_t calls_b = 0;
  std::uint64_t common = 0;
  std::uint64_t weight_a = 0;  // of all calls
  std::uint64_t weight_b = 0;
  std::uint64_t weight_distance = 0;  // sum of weights of calls that only one trace has
  std::uint64_t heaviest = 0;         // greatest weight of such a call
  [[nodiscard]] std::uint64_t distance() const noexcept { return calls_a + calls_b - 2 * common; }
};

/// The distance of two traces, in all and by function.
struct Distance {
  CallCounts all;
  std::map<std::string, CallCounts> by_function;
};

/// Computes the distance of two traces. Cost: O(n log n).
[[nodiscard]] Distance distance(const Trace& a, const Trace& b);

}  // namespace traces
