// The record of a vertex's link in space: its neighbours and the triangles between them.
//
//   m  the m neighbours, ascending  the triangles, ascending
//
// A neighbour is a handle, or a virtual one. A triangle names neighbours by their positions, the
// least first, in the order of its orientation: three of ten bits in a word, or, if there are too
// many neighbours for that, three of 21 bits in two words. So there is one record of a link, and
// records may be compared.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sac/check.hpp"

namespace mesher::detail {

class LinkRecord {
 public:
  using Code = std::uint32_t;
  /// Codes from here on are virtual neighbours; the last one is no code.
  static constexpr Code kVirtual = 0xffffff00u;
  using Triangle = std::array<std::uint32_t, 3>;

  explicit LinkRecord(std::span<const Code> words) noexcept
      : size_(words[0]), triangles_(words.subspan(1 + words[0])), words_(words) {}

  [[nodiscard]] std::span<const Code> neighbours() const noexcept {
    return words_.subspan(1, size_);
  }
  [[nodiscard]] std::size_t triangles() const noexcept {
    return triangles_.size() / words_of(size_);
  }
  /// By positions among the neighbours.
  [[nodiscard]] Triangle triangle(std::size_t t) const noexcept {
    const std::uint64_t x = packed(t);
    const int bits = bits_of(size_);
    const std::uint64_t mask = (std::uint64_t{1} << bits) - 1;
    return {static_cast<std::uint32_t>(x >> 2 * bits), static_cast<std::uint32_t>(x >> bits & mask),
            static_cast<std::uint32_t>(x & mask)};
  }
  /// By codes.
  [[nodiscard]] std::array<Code, 3> codes(std::size_t t) const noexcept {
    const Triangle at = triangle(t);
    return {words_[1 + at[0]], words_[1 + at[1]], words_[1 + at[2]]};
  }
  /// The position of a neighbour; size() if it is none.
  [[nodiscard]] std::uint32_t find(Code code) const noexcept {
    const auto all = neighbours();
    const auto at = std::lower_bound(all.begin(), all.end(), code);
    return at != all.end() && *at == code ? static_cast<std::uint32_t>(at - all.begin()) : size_;
  }
  [[nodiscard]] std::uint32_t size() const noexcept { return size_; }
  /// Whether it is one of the triangles, from whichever corner on.
  [[nodiscard]] bool has(const Triangle& t) const noexcept {
    const std::uint64_t wanted = pack(t, size_);
    std::size_t lo = 0, hi = triangles();
    while (lo < hi) {
      const std::size_t middle = (lo + hi) / 2;
      packed(middle) < wanted ? lo = middle + 1 : hi = middle;
    }
    return lo < triangles() && packed(lo) == wanted;
  }

  /// Writes a record. `codes`: ascending; `triangles`: in any order, from any corner on. Requires:
  /// codes.size() <= 2^21.
  static void write(std::span<const Code> codes, const std::vector<Triangle>& triangles,
                    std::vector<Code>& record) {
    SAC_EXPECTS(codes.size() <= std::size_t{1} << 21);
    const auto size = static_cast<std::uint32_t>(codes.size());
    record.clear();
    record.push_back(size);
    record.insert(record.end(), codes.begin(), codes.end());
    // Packed ones are in the order of triangles.
    if (words_of(size) == 1) {
      for (const Triangle& t : triangles) record.push_back(static_cast<Code>(pack(t, size)));
      std::sort(record.begin() + 1 + size, record.end());
      return;
    }
    std::vector<std::uint64_t> packed;
    for (const Triangle& t : triangles) packed.push_back(pack(t, size));
    std::sort(packed.begin(), packed.end());
    for (const std::uint64_t x : packed) {
      record.push_back(static_cast<Code>(x >> 32));
      record.push_back(static_cast<Code>(x));
    }
  }

 private:
  static constexpr int bits_of(std::uint32_t size) noexcept { return size <= 1024 ? 10 : 21; }
  static constexpr std::size_t words_of(std::uint32_t size) noexcept {
    return size <= 1024 ? 1 : 2;
  }
  static std::uint64_t pack(const Triangle& t, std::uint32_t size) noexcept {
    const int bits = bits_of(size);
    const auto from = [&](std::size_t k) {
      return std::uint64_t{t[k]} << 2 * bits | std::uint64_t{t[(k + 1) % 3]} << bits |
             t[(k + 2) % 3];
    };
    return std::min({from(0), from(1), from(2)});
  }
  [[nodiscard]] std::uint64_t packed(std::size_t t) const noexcept {
    if (words_of(size_) == 1) return triangles_[t];
    return std::uint64_t{triangles_[2 * t]} << 32 | triangles_[2 * t + 1];
  }

  std::uint32_t size_;
  std::span<const Code> triangles_;
  std::span<const Code> words_;
};

}  // namespace mesher::detail
