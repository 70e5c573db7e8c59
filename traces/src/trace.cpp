// Loading, looking up texts, and pairing the calls of two traces.
#include "traces/trace.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <system_error>

#include "by_label.hpp"
#include "traces/trace_file.hpp"

namespace traces {
namespace {

// Of a call in a file: kind, flags, depth, function, hash, length of the arguments.
constexpr std::uintmax_t kLeastBytes = 1 + 1 + 1 + 1 + 16 + 1;

}  // namespace

// Half of the hash lies beside the number, so that sorting seldom looks elsewhere.
std::vector<std::uint32_t> by_label(const Trace& trace) {
  struct Key {
    std::uint64_t high;
    std::uint32_t call;
  };
  std::vector<Key> keys;
  keys.reserve(trace.calls.size());
  for (const Trace::Call& call : trace.calls) {
    keys.push_back({call.hash.high, static_cast<std::uint32_t>(keys.size())});
  }
  std::sort(keys.begin(), keys.end(), [&](const Key& x, const Key& y) {
    if (x.high != y.high) return x.high < y.high;
    const std::uint64_t low_x = trace.calls[x.call].hash.low, low_y = trace.calls[y.call].hash.low;
    return low_x != low_y ? low_x < low_y : x.call < y.call;
  });
  std::vector<std::uint32_t> order;
  order.reserve(keys.size());
  for (const Key& key : keys) order.push_back(key.call);
  return order;
}

void Trace::add(const Call& call, std::uint64_t said) {
  if (said != 0) weights.resize(calls.size());
  calls.push_back(call);
  if (said != 0 || !weights.empty()) weights.push_back(said);
}

Trace load_trace(const std::string& path) {
  TraceReader reader(path);
  Trace trace;
  // As many calls as bytes of the file can hold: memory that is not used costs nothing, and nothing
  // is copied as the trace grows.
  std::error_code unknown;
  const auto bytes = std::filesystem::file_size(path, unknown);
  if (!unknown) trace.calls.reserve(bytes / kLeastBytes);
  while (const CallRecord* call = reader.next()) {
    trace.add({call->hash, call->function, call->depth, call->tail}, call->weight);
    if (!call->named) ++trace.unnamed;
  }
  trace.functions = reader.functions();
  return trace;
}

std::vector<std::string> labels_at(const std::string& path,
                                   const std::vector<std::uint32_t>& calls) {
  std::multimap<std::uint32_t, std::size_t> wanted;
  for (std::size_t i = 0; i < calls.size(); ++i) wanted.emplace(calls[i], i);
  std::vector<std::string> labels(calls.size());
  TraceReader reader(path);
  for (std::uint32_t number = 0; !wanted.empty(); ++number) {
    const CallRecord* call = reader.next();
    if (call == nullptr) break;
    for (auto it = wanted.begin(); it != wanted.end() && it->first == number;) {
      std::string& label = labels[it->second];
      label = label_text(reader.functions()[call->function], call->arguments);
      for (const EdgeRecord& edge : call->edges) label.append("; ").append(edge_text(edge));
      it = wanted.erase(it);
    }
  }
  return labels;
}

std::vector<Pair> common_calls(const Trace& a, const Trace& b) {
  const auto order_a = by_label(a), order_b = by_label(b);
  std::vector<Pair> pairs;
  auto i = order_a.begin(), j = order_b.begin();
  while (i != order_a.end() && j != order_b.end()) {
    const auto order = a.calls[*i].hash <=> b.calls[*j].hash;
    if (order == 0) pairs.push_back({*i, *j});
    if (order <= 0) ++i;
    if (order >= 0) ++j;
  }
  std::sort(pairs.begin(), pairs.end(), [](const Pair& x, const Pair& y) { return x.a < y.a; });
  return pairs;
}

Difference difference(const Trace& a, const Trace& b) {
  std::vector<bool> common_a(a.calls.size()), common_b(b.calls.size());
  for (const Pair& pair : common_calls(a, b)) common_a[pair.a] = common_b[pair.b] = true;
  const auto rest = [](const std::vector<bool>& common) {
    std::vector<std::uint32_t> numbers;
    for (std::uint32_t i = 0; i < common.size(); ++i) {
      if (!common[i]) numbers.push_back(i);
    }
    return numbers;
  };
  return {rest(common_a), rest(common_b)};
}

}  // namespace traces
