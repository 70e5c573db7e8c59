// Counting common labels, in all and by function.
#include "traces/distance.hpp"

#include <vector>

namespace traces {
namespace {

// counts[i] is where calls of the trace's function i are counted.
std::vector<CallCounts*> counters(Distance& d, const Trace& trace) {
  std::vector<CallCounts*> counts;
  for (const std::string& name : trace.functions) counts.push_back(&d.by_function[name]);
  return counts;
}

}  // namespace

Distance distance(const Trace& a, const Trace& b) {
  Distance d;
  const auto counts_a = counters(d, a), counts_b = counters(d, b);
  for (const Trace::Call& call : a.calls) ++counts_a[call.function]->calls_a;
  for (const Trace::Call& call : b.calls) ++counts_b[call.function]->calls_b;
  for (const Pair& pair : common_calls(a, b)) ++counts_a[a.calls[pair.a].function]->common;
  for (const auto& [name, counts] : d.by_function) {
    d.all.calls_a += counts.calls_a;
    d.all.calls_b += counts.calls_b;
    d.all.common += counts.common;
  }
  return d;
}

}  // namespace traces
