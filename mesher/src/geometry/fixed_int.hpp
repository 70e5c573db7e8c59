// Signed integers of a fixed number of 64-bit limbs, and doubles turned into them without rounding.
//
// It has only the operations of determinants: difference, sum, product, sign. Two's complement,
// lowest limb first. A sum wraps; a product has the limbs of both factors and is always exact.
// Callers prove that their sums fit.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

namespace mesher::predicates::detail {

__extension__ typedef unsigned __int128 Wide;

/// The integer sum over i of limb[i] 2^(64 i), less 2^(64 W) if the top bit is set.
template <std::size_t W>
struct FixedInt {
  std::array<std::uint64_t, W> limb{};

  [[nodiscard]] bool negative() const noexcept { return limb[W - 1] >> 63 != 0; }
};

template <std::size_t W>
[[nodiscard]] inline FixedInt<W> operator+(const FixedInt<W>& a, const FixedInt<W>& b) noexcept {
  FixedInt<W> sum;
  Wide carry = 0;
  for (std::size_t i = 0; i < W; ++i) {
    carry += static_cast<Wide>(a.limb[i]) + b.limb[i];
    sum.limb[i] = static_cast<std::uint64_t>(carry);
    carry >>= 64;
  }
  return sum;
}

template <std::size_t W>
[[nodiscard]] inline FixedInt<W> operator-(const FixedInt<W>& a, const FixedInt<W>& b) noexcept {
  FixedInt<W> difference;
  std::uint64_t borrow = 0;
  for (std::size_t i = 0; i < W; ++i) {
    const Wide t = static_cast<Wide>(a.limb[i]) - b.limb[i] - borrow;
    difference.limb[i] = static_cast<std::uint64_t>(t);
    borrow = static_cast<std::uint64_t>(t >> 64) & 1;
  }
  return difference;
}

/// Subtracts `a` 2^(64 V) from `product`, if `when`.
template <std::size_t V, std::size_t W>
inline void subtract_high(FixedInt<V + W>& product, const FixedInt<W>& a, bool when) noexcept {
  const std::uint64_t mask = when ? ~std::uint64_t{0} : 0;
  std::uint64_t borrow = 0;
  for (std::size_t i = 0; i < W; ++i) {
    const Wide t = static_cast<Wide>(product.limb[V + i]) - (a.limb[i] & mask) - borrow;
    product.limb[V + i] = static_cast<std::uint64_t>(t);
    borrow = static_cast<std::uint64_t>(t >> 64) & 1;
  }
}

/// The exact product: the schoolbook one of the limbs as unsigned numbers, where a negative factor
/// counts 2^(64 limbs) too much, which is then taken back.
template <std::size_t V, std::size_t W>
[[nodiscard]] inline FixedInt<V + W> operator*(const FixedInt<V>& a,
                                               const FixedInt<W>& b) noexcept {
  FixedInt<V + W> product;
  for (std::size_t i = 0; i < V; ++i) {
    Wide carry = 0;
    for (std::size_t j = 0; j < W; ++j) {
      carry += static_cast<Wide>(a.limb[i]) * b.limb[j] + product.limb[i + j];
      product.limb[i + j] = static_cast<std::uint64_t>(carry);
      carry >>= 64;
    }
    product.limb[i + W] = static_cast<std::uint64_t>(carry);
  }
  subtract_high<V>(product, b, a.negative());
  subtract_high<W>(product, a, b.negative());
  return product;
}

template <std::size_t W>
[[nodiscard]] inline int sign(const FixedInt<W>& a) noexcept {
  if (a.negative()) return -1;
  std::uint64_t any = 0;
  for (const std::uint64_t limb : a.limb) any |= limb;
  return any != 0 ? 1 : 0;
}

/// fraction * 2^exponent.
struct Leading {
  double fraction = 0;  // below 2^65, and 0 or at least 2^63
  int exponent = 0;
};

/// The number itself, but for at most 1 + 2^-10 roundings.
template <std::size_t W>
[[nodiscard]] inline Leading leading(const FixedInt<W>& a) noexcept {
  if (a.negative()) {
    const Leading positive = leading(FixedInt<W>{} - a);
    return {-positive.fraction, positive.exponent};
  }
  std::size_t top = W;
  while (top > 0 && a.limb[top - 1] == 0) --top;
  if (top == 0) return {};
  const auto limb = [&](std::size_t i) { return i < top ? a.limb[top - 1 - i] : 0; };
  const int shift = std::countl_zero(limb(0));
  const std::uint64_t first = shift == 0 ? limb(0) : limb(0) << shift | limb(1) >> (64 - shift);
  return {static_cast<double>(first), static_cast<int>(64 * (top - 1)) - shift};
}

/// The same as a double. Requires: below 2^1023.
template <std::size_t W>
[[nodiscard]] inline double to_double(const FixedInt<W>& a) noexcept {
  const Leading all = leading(a);
  return std::ldexp(all.fraction, all.exponent);
}

/// A normal double as fraction * 2^exponent, fraction a 53-bit integer.
struct Parts {
  explicit Parts(double x) noexcept {
    const auto bits = std::bit_cast<std::uint64_t>(x);
    fraction = (bits & 0x000f'ffff'ffff'ffff) | 0x0010'0000'0000'0000;
    exponent = static_cast<int>(bits >> 52 & 0x7ff) - 1075;  // 1023 and the 52 bits of fraction
  }
  std::uint64_t fraction;
  int exponent;
};

/// Where the bits of some numbers lie: each is an integer times 2^low, of magnitude below 2^high.
struct BitRange {
  int low = 1024;  // of no number but zeros
  int high = -1075;

  /// Requires: each of `numbers` is 0 or normal.
  explicit BitRange(std::span<const double> numbers) noexcept {
    for (const double x : numbers) {
      if (x == 0) continue;
      const Parts p(x);
      low = std::min(low, p.exponent + std::countr_zero(p.fraction));
      high = std::max(high, p.exponent + 53);
    }
  }
  [[nodiscard]] int width() const noexcept { return high - low; }
};

/// x / 2^low. Requires: an integer of magnitude below 2^(64 W - 1), and x is 0 or normal.
template <std::size_t W>
[[nodiscard]] inline FixedInt<W> to_fixed(double x, int low) noexcept {
  FixedInt<W> r;
  if (x == 0) return r;
  const Parts p(x);
  const int shift = p.exponent - low;
  const std::uint64_t fraction = shift < 0 ? p.fraction >> -shift : p.fraction;
  const auto place = static_cast<std::size_t>(std::max(shift, 0));
  const Wide moved = static_cast<Wide>(fraction) << place % 64;
  r.limb[place / 64] = static_cast<std::uint64_t>(moved);
  if (place / 64 + 1 < W) r.limb[place / 64 + 1] = static_cast<std::uint64_t>(moved >> 64);
  return x < 0 ? FixedInt<W>{} - r : r;
}

}  // namespace mesher::predicates::detail
