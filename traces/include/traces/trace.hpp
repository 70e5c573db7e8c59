// A trace in memory: hashes of labels and depths in pre-order. 24 bytes a call; texts stay in the
// file.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "traces/label_hash.hpp"

namespace traces {

struct Trace {
  struct Call {
    LabelHash hash;
    std::uint32_t function = 0;    // index
    std::uint32_t depth : 31 = 0;  // at most one more than that of the call before
    std::uint32_t tail : 1 = 0;    // continues its parent: see CallRecord
  };
  std::vector<Call> calls;             // in pre-order
  std::vector<std::uint64_t> weights;  // what calls said by Scope::weigh; empty: nothing
  std::vector<std::string> functions;  // names by index; two functions may have one name
  std::uint64_t unnamed = 0;           // calls whose hash is good within their run only

  /// The weight of the call with this number: 1 for itself, and what it said it did inside.
  [[nodiscard]] std::uint64_t weight_of(std::uint32_t call) const noexcept {
    return weights.empty() ? 1 : 1 + weights[call];
  }
  /// Adds a call and what it said; memory for that is taken once a call has said something.
  void add(const Call& call, std::uint64_t said);
};

/// Throws: FileError.
[[nodiscard]] Trace load_trace(const std::string& path);

/// The labels of some calls, as text, with their edges if they were recorded. `calls`: numbers in
/// pre-order from 0, in any order. Throws: FileError.  Cost: O(file).
[[nodiscard]] std::vector<std::string> labels_at(const std::string& path,
                                                 const std::vector<std::uint32_t>& calls);

/// Calls of two traces paired by label.
struct Pair {
  std::uint32_t a;  // number of the call in the one
  std::uint32_t b;  // and in the other
};

/// Calls that only one of two traces has, by number, ascending.
struct Difference {
  std::vector<std::uint32_t> only_a;
  std::vector<std::uint32_t> only_b;
};

/// The labels common to `a` and `b` as multisets: the k-th call of a label in one is paired with
/// the k-th in the other. In the order of `a`.  Cost: O(n log n).
[[nodiscard]] std::vector<Pair> common_calls(const Trace& a, const Trace& b);

/// What common_calls() leaves unpaired.  Cost: O(n log n).
[[nodiscard]] Difference difference(const Trace& a, const Trace& b);

}  // namespace traces
