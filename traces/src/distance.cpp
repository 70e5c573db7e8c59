// Counting common labels, in all and by function.
#include "traces/distance.hpp"

#include <algorithm>
#include <vector>

namespace traces {
namespace {

// counts[i] is where calls of the trace's function i are counted.
std::vector<CallCounts*> counters(Distance& d, const Trace& trace) {
  std::vector<CallCounts*> counts;
  for (const std::string& name : trace.functions) counts.push_back(&d.by_function[name]);
  return counts;
}

// All calls of a trace, in calls_a and weight_a or in calls_b and weight_b.
void count(const Trace& trace, const std::vector<CallCounts*>& counts,
           std::uint64_t CallCounts::*calls, std::uint64_t CallCounts::*weight) {
  for (std::uint32_t i = 0; i < trace.calls.size(); ++i) {
    CallCounts& c = *counts[trace.calls[i].function];
    ++(c.*calls);
    c.*weight += trace.weight_of(i);
  }
}

// Weights of the calls that the other trace has not.
void weigh(const Trace& trace, const std::vector<CallCounts*>& counts,
           const std::vector<std::uint32_t>& only) {
  for (const std::uint32_t i : only) {
    CallCounts& c = *counts[trace.calls[i].function];
    c.weight_distance += trace.weight_of(i);
    c.heaviest = std::max(c.heaviest, trace.weight_of(i));
  }
}

void add(CallCounts& sum, const CallCounts& c) {
  sum.calls_a += c.calls_a;
  sum.calls_b += c.calls_b;
  sum.common += c.common;
  sum.weight_a += c.weight_a;
  sum.weight_b += c.weight_b;
  sum.weight_distance += c.weight_distance;
  sum.heaviest = std::max(sum.heaviest, c.heaviest);
}

}  // namespace

Distance distance(const Trace& a, const Trace& b) {
  Distance d;
  const auto counts_a = counters(d, a), counts_b = counters(d, b);
  count(a, counts_a, &CallCounts::calls_a, &CallCounts::weight_a);
  count(b, counts_b, &CallCounts::calls_b, &CallCounts::weight_b);
  const Difference apart = difference(a, b);
  weigh(a, counts_a, apart.only_a);
  weigh(b, counts_b, apart.only_b);
  for (auto& [name, c] : d.by_function) c.common = c.calls_a;
  for (const std::uint32_t i : apart.only_a) --counts_a[a.calls[i].function]->common;
  for (const auto& [name, c] : d.by_function) add(d.all, c);
  return d;
}

}  // namespace traces
