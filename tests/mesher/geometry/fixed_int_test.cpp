// Fixed-width integers against Boost's, of any width.
#include "geometry/fixed_int.hpp"

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <random>

namespace {

namespace detail = mesher::predicates::detail;
using boost::multiprecision::cpp_int;
using Exact = boost::multiprecision::cpp_rational;
using Random = std::mt19937_64;

constexpr std::uint64_t kSeed = 20240229;

/// 0 or of magnitude 2^-100 to 2^100, the ends often.
double any_double(Random& random) {
  const double sign = random() % 2 == 0 ? -1 : 1;
  if (random() % 8 == 0) return 0;
  if (random() % 8 == 0) return sign * 0x1p100;
  if (random() % 8 == 0) return sign * 0x1.0000000000001p-100;
  const double significand = std::uniform_real_distribution<double>(1, 2)(random);
  return sign * std::ldexp(significand, static_cast<int>(random() % 200) - 100);
}

template <std::size_t W>
cpp_int value(const detail::FixedInt<W>& a) {
  cpp_int v = 0;
  for (std::size_t i = W; i-- > 0;) v = (v << 64) + a.limb[i];
  if (a.negative()) v -= cpp_int(1) << static_cast<int>(64 * W);
  return v;
}

/// Limbs of ones, zeros, the top bit, and anything: where carries run far.
template <std::size_t W>
detail::FixedInt<W> awkward(Random& random) {
  constexpr std::uint64_t kTop = std::uint64_t{1} << 63;
  detail::FixedInt<W> a;
  for (std::uint64_t& limb : a.limb) {
    limb = std::array<std::uint64_t, 5>{0, ~std::uint64_t{0}, kTop, 1, random()}[random() % 5];
  }
  return a;
}

template <std::size_t W>
void require_ring_operations(Random& random) {
  const auto a = awkward<W>(random), b = awkward<W>(random);
  const cpp_int modulus = cpp_int(1) << static_cast<int>(64 * W);
  REQUIRE(value(a * b) == value(a) * value(b));
  REQUIRE((value(a + b) - value(a) - value(b)) % modulus == 0);
  REQUIRE((value(a - b) - value(a) + value(b)) % modulus == 0);
  REQUIRE(sign(a) == value(a).sign());
}

template <std::size_t V, std::size_t W>
void require_product(Random& random) {
  const auto a = awkward<V>(random);
  const auto b = awkward<W>(random);
  REQUIRE(value(a * b) == value(a) * value(b));
  REQUIRE(value(b * a) == value(a) * value(b));
}

}  // namespace

TEST_CASE("integers of unequal widths multiply as integers do", "[fixed_int]") {
  INFO("seed " << kSeed);
  Random random(kSeed);
  for (int i = 0; i < 4000; ++i) {
    CAPTURE(i);
    require_product<1, 2>(random);
    require_product<2, 3>(random);
    require_product<4, 8>(random);
    require_product<8, 12>(random);
  }
}

TEST_CASE("fixed-width integers add, subtract and multiply as integers do", "[fixed_int]") {
  INFO("seed " << kSeed);
  Random random(kSeed);
  for (int i = 0; i < 4000; ++i) {
    CAPTURE(i);
    require_ring_operations<1>(random);
    require_ring_operations<2>(random);
    require_ring_operations<4>(random);
    require_ring_operations<8>(random);
  }
}

TEST_CASE("doubles become fixed-width integers without rounding", "[fixed_int]") {
  INFO("seed " << kSeed);
  Random random(kSeed);
  for (int i = 0; i < 4000; ++i) {
    const std::array<double, 2> x{any_double(random), any_double(random)};
    CAPTURE(i, x[0], x[1]);
    const detail::BitRange range(x);
    REQUIRE(range.width() <= 253);
    for (const double y : x) {
      const cpp_int up = cpp_int(1) << std::max(-range.low, 0);
      const cpp_int down = cpp_int(1) << (y == 0 ? 0 : std::max(range.low, 0));
      REQUIRE(Exact(value(detail::to_fixed<4>(y, range.low)) * down) == Exact(y) * up);
    }
  }
}
