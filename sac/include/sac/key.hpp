// The keys of posted calls: when each has its turn on its agenda.
#pragma once

#include <cstdint>
#include <string>

namespace sac {

/// The order in which posted calls run: by bucket, phase, colour, then order; ties by the functions
/// and arguments of the calls. The widths of an agenda limit the first three.
struct Key {
  int bucket = 0;  ///< smallest first
  unsigned phase = 0;
  unsigned colour = 0;
  std::uint64_t order = 0;  ///< canonical order of the label
};

/// How many bits the parts of a key take on an agenda: together at most 32, a bucket at least 1.
struct KeyWidths {
  unsigned bucket = 22;  ///< -2^21 .. 2^21 - 1; of b bits: -2^(b-1) .. 2^(b-1) - 1
  unsigned phase = 4;    ///< 0 .. 15
  unsigned colour = 6;   ///< 0 .. 63

  /// Throws: UsageError for widths that `agenda` cannot have.
  void require_possible(const std::string& agenda) const;

  [[nodiscard]] bool fits(const Key& key) const noexcept {
    return from_least(key) >> bucket == 0 && std::uint64_t{key.phase} >> phase == 0 &&
           std::uint64_t{key.colour} >> colour == 0;
  }
  /// (bucket, phase, colour) as one number. Requires: fits(key).
  [[nodiscard]] std::uint32_t rank(const Key& key) const noexcept {
    return static_cast<std::uint32_t>((from_least(key) << phase | key.phase) << colour |
                                      key.colour);
  }
  /// Names `call`, posted on `agenda`, and the part of its key that does not fit.
  [[noreturn]] void fail(const Key& key, const std::string& call, const std::string& agenda) const;

  /// The bucket, counted from the least one. Below 2^bucket exactly if it fits.
  [[nodiscard]] std::uint64_t from_least(const Key& key) const noexcept {
    return static_cast<std::uint64_t>(std::int64_t{key.bucket} + (std::int64_t{1} << (bucket - 1)));
  }
};

}  // namespace sac
