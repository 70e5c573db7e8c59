// Finding equal labels by sorting, and moved calls by a longest increasing subsequence.
#include "traces/audit.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace traces {
namespace {

// Numbers of calls, by (label, function), then in pre-order.
std::vector<std::uint32_t> sorted(const Trace& trace) {
  std::vector<std::uint32_t> order(trace.calls.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto key = [&](std::uint32_t i) {
    return std::tuple(trace.calls[i].hash, trace.calls[i].function, i);
  };
  std::sort(order.begin(), order.end(), [&](auto x, auto y) { return key(x) < key(y); });
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
