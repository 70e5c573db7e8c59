// Equality of values of modifiables, results and arguments.
#pragma once

#include <bit>
#include <compare>
#include <concepts>
#include <cstdint>
#include <functional>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

namespace sac::detail {

/// Equality of which one may stand for the other everywhere: of the bits of a floating-point
/// number (-0.0 is not 0.0, a NaN is itself), == of others.
template <class T>
bool identical(const T& a, const T& b) {
  if constexpr (std::is_same_v<T, float>) {
    return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
  } else if constexpr (std::is_same_v<T, double>) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
  } else {
    return static_cast<bool>(a == b);
  }
}
template <class... T>
bool identical(const std::tuple<T...>& a, const std::tuple<T...>& b) {
  return [&]<std::size_t... i>(std::index_sequence<i...>) {
    return (identical(std::get<i>(a), std::get<i>(b)) && ...);
  }
  (std::index_sequence_for<T...>());
}

/// Whether each argument equals itself, as a NaN does not.
template <class... T>
bool reflexive(const std::tuple<T...>& args) {
  return std::apply([](const auto&... a) { return (static_cast<bool>(a == a) && ...); }, args);
}

template <class T>
std::strong_ordering compare_argument(const T& a, const T& b) {
  if constexpr (std::is_floating_point_v<T>) {
    return std::strong_order(a, b);
  } else if constexpr (std::three_way_comparable<T>) {
    const auto order = a <=> b;
    return order < 0   ? std::strong_ordering::less
           : order > 0 ? std::strong_ordering::greater
                       : std::strong_ordering::equal;
  } else {
    return a < b   ? std::strong_ordering::less
           : b < a ? std::strong_ordering::greater
                   : std::strong_ordering::equal;
  }
}
[[noreturn]] void fail_unordered(std::string_view function);

/// An order of the function's arguments in which two are equal only if they are identical.
/// Throws: UsageError where the client's <=> does not tell apart what == does.
template <class... T>
std::strong_ordering compare_arguments(std::string_view function, const std::tuple<T...>& a,
                                       const std::tuple<T...>& b) {
  std::strong_ordering order = std::strong_ordering::equal;
  [&]<std::size_t... i>(std::index_sequence<i...>) {
    (void)((order = compare_argument(std::get<i>(a), std::get<i>(b)), order == 0) && ...);
  }
  (std::index_sequence_for<T...>());
  if (order == 0 && !identical(a, b)) fail_unordered(function);
  return order;
}

/// Whether `Same` takes a and b for the same; std::equal_to<> stands for identical().
template <class Same, class T>
bool same(const T& a, const T& b) {
  constexpr bool kCompares = requires { static_cast<bool>(Same{}(a, b)); };
  static_assert(kCompares,
                "a value or result needs ==, or a Same of its own: an equal one disturbs nobody");
  if constexpr (std::is_same_v<Same, std::equal_to<>> && std::is_floating_point_v<T>) {
    return identical(a, b);
  } else if constexpr (kCompares) {
    return static_cast<bool>(Same{}(a, b));
  }
}

/// Whether what is replaced is kept until a propagation has succeeded: see Originals.
template <class T, class Same>
constexpr bool keeps_originals() {
  constexpr bool kOwnSame = !std::is_same_v<Same, std::equal_to<>>;
  static_assert(
      !kOwnSame || std::is_copy_constructible_v<T>,
      "a value with a Same of its own is copied, so that a roll-back restores it: make it "
      "copyable, or hold it by a shared pointer");
  return kOwnSame;
}
template <class T, class Same>
inline constexpr bool kKeepsOriginals = keeps_originals<T, Same>();

}  // namespace sac::detail
