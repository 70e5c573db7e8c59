// 128-bit hashes of labels: equal labels have equal hashes in every run, on every machine.
//
// Two lanes of 64 bits hash the same words by different mixers; with 10^7 labels a collision has
// probability 10^-24. The hash does not resist an adversary.
#pragma once

#include <compare>
#include <cstdint>
#include <string_view>

namespace traces {

struct LabelHash {
  std::uint64_t high = 0;
  std::uint64_t low = 0;
  friend auto operator<=>(const LabelHash&, const LabelHash&) = default;
};

/// Hashes a sequence of words and texts.
class LabelHasher {
 public:
  void word(std::uint64_t value) noexcept;
  /// Hashes length and bytes, so that ("a", "bc") differs from ("ab", "c").
  void text(std::string_view value) noexcept;
  void hash(const LabelHash& value) noexcept;
  [[nodiscard]] LabelHash result() const noexcept { return {high_, low_}; }

 private:
  // Fractional digits of the roots of 2 and 3: any two numbers would do.
  std::uint64_t high_ = 0x6a09e667f3bcc908u;
  std::uint64_t low_ = 0xbb67ae8584caa73bu;
};

}  // namespace traces
