// Numbers as decimal text, four digits at a time.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>

namespace mesher::detail {

/// 0 to 9999, each as four digits.
inline constexpr auto kFourDigits = [] {
  std::array<char, 40000> all{};
  for (std::size_t i = 0; i < 10000; ++i) {
    for (std::size_t k = 0, n = i; k < 4; ++k, n /= 10) {
      all[4 * i + 3 - k] = static_cast<char>('0' + n % 10);
    }
  }
  return all;
}();

/// Writes a number. Returns: its end, at most ten characters on. Requires: there is room for ten.
inline char* put_number(char* at, std::uint32_t n) noexcept {
  const auto put_four = [&](std::uint32_t four, std::uint32_t skipped) {
    std::memcpy(at, kFourDigits.data() + 4 * four + skipped, 4);
    at += 4 - skipped;
  };
  const auto put_first = [&](std::uint32_t four) {
    put_four(four,
             std::uint32_t{four < 1000} + std::uint32_t{four < 100} + std::uint32_t{four < 10});
  };
  if (n < 10000) return put_first(n), at;
  const std::uint32_t high = n / 10000;
  if (high < 10000) {
    put_first(high);
  } else {
    put_first(high / 10000);
    put_four(high % 10000, 0);
  }
  put_four(n % 10000, 0);
  return at;
}

}  // namespace mesher::detail
