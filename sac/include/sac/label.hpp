// What a call is called: names of functions, and hash, order and print of arguments.
//
// The label of a call is (function, arguments). An argument type needs ==; a hash is found by
// `hash_value(const T&)` (argument-dependent) or std::hash; order (agendas only) by <=>; print by
// operator<<, else only the type's size is shown.
#pragma once

#include <compare>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <ostream>
#include <string_view>
#include <tuple>
#include <type_traits>

namespace sac {

/// Mixes 64 bits so that every input bit reaches every output bit (finaliser of splitmix64).
[[nodiscard]] constexpr std::uint64_t mix(std::uint64_t x) noexcept {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

template <class T>
concept HashedByValue = requires(const T& value) {
  { hash_value(value) } -> std::convertible_to<std::uint64_t>;
};

template <class T>
[[nodiscard]] std::uint64_t hash_argument(const T& value) {
  if constexpr (HashedByValue<T>) {
    return hash_value(value);
  } else {
    return std::hash<T>{}(value);
  }
}

template <class... Args>
[[nodiscard]] std::uint64_t hash_arguments(std::uint64_t seed, const std::tuple<Args...>& args) {
  std::uint64_t h = seed;
  std::apply([&](const auto&... a) { ((h = mix(h + 0x9e3779b97f4a7c15u + hash_argument(a))), ...); },
             args);
  return h;
}

template <class T>
concept Printable = requires(std::ostream& out, const T& value) { out << value; };

template <class T>
void print_argument(std::ostream& out, const T& value) {
  if constexpr (Printable<T>) {
    out << value;
  } else {
    out << '<' << sizeof(T) << " bytes>";
  }
}

template <class... Args>
void print_arguments(std::ostream& out, const std::tuple<Args...>& args) {
  const char* separator = "";
  std::apply([&](const auto&... a) { ((out << separator, print_argument(out, a), separator = ", "), ...); },
             args);
}

namespace detail {

// The compiler's spelling of F, cut out of the name of this very function.
template <auto F>
[[nodiscard]] constexpr std::string_view spelled() {
  std::string_view s = __PRETTY_FUNCTION__;
  s.remove_prefix(s.find("F = ") + 4);
  s = s.substr(0, s.find_first_of(";]"));
  if (s.starts_with('&')) s.remove_prefix(1);
  if (const auto brace = s.find_last_of("{("); brace != s.npos && (s.back() == '}' || s.back() == ')')) {
    s = s.substr(0, brace);
  }
  if (s.starts_with('(')) s = s.substr(s.rfind(')') + 1);
  return s;
}

}  // namespace detail

/// The name of a traced function for people: an object's member `kName` if it has one, else the
/// name in the source without its namespaces.
template <auto F>
[[nodiscard]] constexpr std::string_view function_name() {
  if constexpr (requires { decltype(F)::kName; }) {
    return decltype(F)::kName;
  } else {
    constexpr std::string_view full = detail::spelled<F>();
    constexpr auto colon = full.rfind("::");
    return colon == full.npos ? full : full.substr(colon + 2);
  }
}

}  // namespace sac
