// Finding equal labels by sorting, and moved calls by a longest increasing subsequence.
#include "traces/audit.hpp"

#include <algorithm>

#include "by_label.hpp"

namespace traces {
namespace {

// Numbers of calls, by (label, function), then in pre-order.
std::vector<std::uint32_t> sorted(const Trace& trace) {
  auto order = by_label(trace);
  const auto& calls = trace.calls;
  for (auto begin = order.begin(); begin != order.end();) {
    const auto differs = [&](std::uint32_t x) { return calls[x].hash != calls[*begin].hash; };
    const auto end = std::find_if(begin, order.end(), differs);
    if (end - begin > 1) {
      std::stable_sort(begin, end, [&](std::uint32_t x, std::uint32_t y) {
        return calls[x].function < calls[y].function;
      });
    }
    begin = end;
  }
  return order;
}

// Length of a longest increasing subsequence of the pairs' b: ends[k] is the least end of one of
// length k + 1.
std::uint64_t longest_common_order(const std::vector<Pair>& pairs) {
  std::vector<std::uint32_t> ends;
  for (const Pair& pair : pairs) {
    const auto place = std::lower_bound(ends.begin(), ends.end(), pair.b);
    place == ends.end() ? ends.push_back(pair.b) : void(*place = pair.b);
  }
  return ends.size();
}

std::optional<Inversion> first_inversion(const std::vector<Pair>& pairs) {
  if (pairs.empty()) return {};
  Pair latest = pairs.front();  // in b, of those seen
  for (const Pair& pair : pairs) {
    if (pair.b < latest.b) return Inversion{latest, pair};
    latest = pair;
  }
  return {};
}

}  // namespace

Conciseness check_concise(const Trace& trace) {
  const auto order = sorted(trace);
  const auto same = [&](std::uint32_t x, std::uint32_t y) {
    return trace.calls[x].hash == trace.calls[y].hash &&
           trace.calls[x].function == trace.calls[y].function;
  };
  Conciseness result;
  for (std::size_t i = 0, next = 0; i < order.size(); i = next) {
    for (next = i + 1; next < order.size() && same(order[i], order[next]);) ++next;
    if (next - i == 1) continue;
    result.surplus += next - i - 1;
    result.repetitions.push_back({order[i], order[i + 1], next - i});
  }
  std::sort(result.repetitions.begin(), result.repetitions.end(),
            [](const Repetition& x, const Repetition& y) { return x.second < y.second; });
  return result;
}

Monotonicity check_monotone(const Trace& a, const Trace& b) {
  const auto pairs = common_calls(a, b);
  return {pairs.size(), pairs.size() - longest_common_order(pairs), first_inversion(pairs)};
}

}  // namespace traces
