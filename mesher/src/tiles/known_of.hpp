// What one tile has told another, as a sum of digests: whatever the order, the sums of two tiles
// are equal if, but for one chance in 2^64, they have the same in mind.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>

#include "borders/turn.hpp"

namespace mesher::detail {

struct KnownOf {
  std::uint64_t looks = 0, looks_digest = 0;    // at the other's territory
  std::uint64_t births = 0, births_digest = 0;  // that the other sees, or has to complete
  std::uint64_t calls = 0, calls_digest = 0;    // that it has to make: cuts, slivers that are split

  template <int D>
  void add(const Look<D>& look) noexcept {
    ++looks;
    looks_digest += sac::mix(of(look.turn) ^ of(look.p) ^ sac::mix(bits(look.radius)));
  }
  template <int D>
  void add(const std::type_identity_t<Point<D>>& p, const Turn<D>& turn,
           const Role& role) noexcept {
    ++births;
    const std::uint64_t on = sac::mix(role.label.bits() + role.on);
    births_digest += sac::mix(of(turn) ^ of(p) ^ on);
  }
  template <int D>
  void add(const CutOfLeaf<D>& cut) noexcept {
    ++calls;
    calls_digest += sac::mix(of(cut.turn) ^ hash_value(cut.piece) ^ number(cut.bucket));
  }
  template <int D>
  void add(const SliverCall<D>& call) noexcept {
    ++calls;
    calls_digest += sac::mix(of(call.turn) ^ of(call.p) ^ number(call.bucket));
  }

 private:
  static std::uint64_t number(int n) noexcept { return sac::mix(static_cast<std::uint64_t>(n)); }
  static std::uint64_t bits(double x) noexcept { return std::bit_cast<std::uint64_t>(x + 0.0); }
  template <std::size_t N>
  static std::uint64_t of(const std::array<double, N>& p) noexcept {
    std::uint64_t h = N;
    for (const double x : p) h = sac::mix(h + bits(x));
    return h;
  }
  template <int D>
  static std::uint64_t of(const Turn<D>& t) noexcept {
    std::uint64_t h = sac::mix(static_cast<std::uint64_t>(t.stage) << 32 | t.rank);
    h = sac::mix(h + t.order);
    return sac::mix(h + of(t.p));
  }
};

/// What does not fit between what the tile `from` has said to the tile `to` and what that has
/// heard; empty: nothing.
[[nodiscard]] inline std::string difference(const KnownOf& said, const KnownOf& heard,
                                            std::size_t from, std::size_t to) {
  const auto tell = [&](const char* what, std::uint64_t n, std::uint64_t m) {
    return "tile " + std::to_string(from) + " has " + std::to_string(n) + ' ' + what +
           " for tile " + std::to_string(to) + ", which knows " + std::to_string(m) +
           (n == m ? " others" : "");
  };
  if (said.looks != heard.looks || said.looks_digest != heard.looks_digest) {
    return tell("looks", said.looks, heard.looks);
  }
  if (said.births != heard.births || said.births_digest != heard.births_digest) {
    return tell("births", said.births, heard.births);
  }
  if (said.calls != heard.calls || said.calls_digest != heard.calls_digest) {
    return tell("calls", said.calls, heard.calls);
  }
  return {};
}

}  // namespace mesher::detail
