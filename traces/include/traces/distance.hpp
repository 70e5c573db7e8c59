// The distance of two traces [Def 1.4.2]: |T| + |T'| - 2|C|, where C holds the common labels.
//
// Labels count as often as they occur: a label that occurs twice in T and once in T' is in C once.
// Functions with one name are counted together. By weight, a call that is not common counts as much
// as it weighs (Trace::weight_of), so that a call which does much inside does not look like any
// other.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "traces/trace.hpp"

namespace traces {

struct CallCounts {
  std::uint64_t calls_a = 0;
  std::uint64_t calls_b = 0;
  std::uint64_t common = 0;
  std::uint64_t weight_a = 0;  // of all calls
  std::uint64_t weight_b = 0;
  std::uint64_t weight_distance = 0;  // of the calls that only one of the traces has
  std::uint64_t heaviest = 0;         // weight of one of these, the greatest
  [[nodiscard]] std::uint64_t distance() const noexcept { return calls_a + calls_b - 2 * common; }
};

struct Distance {
  CallCounts all;
  std::map<std::string, CallCounts> by_function;
};

/// Cost: O(n log n).
[[nodiscard]] Distance distance(const Trace& a, const Trace& b);

}  // namespace traces
