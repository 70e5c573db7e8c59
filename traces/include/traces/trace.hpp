// A trace in memory: hashes of labels and depths in pre-order, 24 bytes for each call; texts stay
// in the file.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "traces/label_hash.hpp"

namespace traces {

/// The calls of a trace.
struct Trace {
  struct Call {
    LabelHash hash;
    std::uint32_t function = 0;    // index
    std::uint32_t depth : 31 = 0;  // at most one more than that of the call before
    std::uint32_t tail : 1 = 0;    // continues its parent: see CallRecord
  };
  std::vector<Call> calls;             // in pre-order
  std::vector<std::uint64_t> weights;  // reported by Scope::weigh; empty: none
  std::vector<std::string> functions;  // names by index; two functions may have one name
  std::uint64_t unnamed = 0;           // calls whose hash is valid only within their run

  /// The weight of the call with this number: 1 plus the weight that it reported.
  [[nodiscard]] std::uint64_t weight_of(std::uint32_t call) const noexcept {
    return weights.empty() ? 1 : 1 + weights[call];
  }
  /// Adds a call and its reported weight; memory for weights is allocated only after a call has
  /// reported one.
  void add(const Call& call, std::uint64_t said);
};

/// Loads a trace from a file. Throws: FileError.
[[nodiscard]] Trace load_trace(const std::string& path);

/// The labels of some calls, as text, with their edges if they were recorded. `calls`: numbers in
/// pre-order from 0, in any order. Throws: FileError.  Cost: O(file).
[[nodiscard]] std::vector<std::string> labels_at(const std::string& path,
                                                 const std::vector<std::uint32_t>& calls);

/// Calls of two traces paired by label.
struct Pair {
  std::uint32_t a;  // number of the call in the first trace
  std::uint32_t b;  // and in the second
};

/// Calls that only one of two traces has, by number, ascending.
struct Difference {
  std::vector<std::uint32_t> only_a;
  std::vector<std::uint32_t> only_b;
};

/// The labels common to `a` and `b` as multisets: the k-th call of a label in one is paired with
/// the k-th in the other. In the order of `a`.  Cost: O(n log n).
[[nodiscard]] std::vector<Pair> common_calls(const Trace& a, const Trace& b);

/// The calls that common_calls() leaves unpaired.  Cost: O(n log n).
[[nodiscard]] Difference difference(const Trace& a, const Trace& b);

}  // namespace traces
