// What values consist of: the elements of pairs, tuples, arrays and ranges, the content of
// optionals and variants, the members of aggregates. Hashes and names of arguments are made of
// those of their parts.
#pragma once

#include <concepts>
#include <cstddef>
#include <optional>
#include <ranges>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "sac/internal/parameters.hpp"

namespace sac::detail {

template <class T>
concept TupleLike = requires {
  std::tuple_size<T>::value;
};
template <class T>
concept RangeOfOthers =
    std::ranges::range<const T> && !std::is_same_v<std::ranges::range_value_t<const T>, T>;
template <class T>
inline constexpr bool kIsOptional = false;
template <class T>
inline constexpr bool kIsOptional<std::optional<T>> = true;
template <class T>
inline constexpr bool kIsVariant = false;
template <class... T>
inline constexpr bool kIsVariant<std::variant<T...>> = true;
template <class T>
inline constexpr bool kIsVector = false;
template <class T, class Allocator>
inline constexpr bool kIsVector<std::vector<T, Allocator>> = true;

// --- Members of aggregates -------------------------------------------------------------------

// Initializes a member of any type.
struct AnyMember {
  template <class T>
  operator T() const;
};
// Initializes a base class: its members are out of reach.
template <class Derived>
struct AnyBase {
  template <class Base>
  requires(std::is_base_of_v<Base, Derived> && !std::is_same_v<Base, Derived>) operator Base()
      const;
};

template <class T, std::size_t... i>
constexpr bool takes_members(std::index_sequence<i...>) {
  return requires { T{(static_cast<void>(i), AnyMember())...}; };
}

inline constexpr std::size_t kMostMembers = 12;

// clang-format off
/// The number of an aggregate's members; more than kMostMembers: it is not known.
template <class T, std::size_t kMost = kMostMembers + 1>
constexpr std::size_t count_members() {
  if constexpr (requires { T{}; }) {  // with braces a member may be an array, too
    if constexpr (requires { T{{}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}}; }) return 13;
    else if constexpr (requires { T{{}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}}; }) return 12;
    else if constexpr (requires { T{{}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}}; }) return 11;
    else if constexpr (requires { T{{}, {}, {}, {}, {}, {}, {}, {}, {}, {}}; }) return 10;
    else if constexpr (requires { T{{}, {}, {}, {}, {}, {}, {}, {}, {}}; }) return 9;
    else if constexpr (requires { T{{}, {}, {}, {}, {}, {}, {}, {}}; }) return 8;
    else if constexpr (requires { T{{}, {}, {}, {}, {}, {}, {}}; }) return 7;
    else if constexpr (requires { T{{}, {}, {}, {}, {}, {}}; }) return 6;
    else if constexpr (requires { T{{}, {}, {}, {}, {}}; }) return 5;
    else if constexpr (requires { T{{}, {}, {}, {}}; }) return 4;
    else if constexpr (requires { T{{}, {}, {}}; }) return 3;
    else if constexpr (requires { T{{}, {}}; }) return 2;
    else if constexpr (requires { T{{}}; }) return 1;
    else return 0;
  } else if constexpr (takes_members<T>(std::make_index_sequence<kMost>())) {
    return kMost;
  } else if constexpr (kMost > 0) {
    return count_members<T, kMost - 1>();
  } else {
    return kMostMembers + 1;
  }
}

/// visit(members...). Requires: kHasMembers<T>.
template <class T, class Visit>
constexpr decltype(auto) with_members(const T& value, Visit&& visit) {
  constexpr std::size_t n = count_members<T>();
  if constexpr (n == 0) { return visit(); }
  if constexpr (n == 1) { const auto& [a] = value; return visit(a); }
  if constexpr (n == 2) { const auto& [a, b] = value; return visit(a, b); }
  if constexpr (n == 3) { const auto& [a, b, c] = value; return visit(a, b, c); }
  if constexpr (n == 4) { const auto& [a, b, c, d] = value; return visit(a, b, c, d); }
  if constexpr (n == 5) { const auto& [a, b, c, d, e] = value; return visit(a, b, c, d, e); }
  if constexpr (n == 6) { const auto& [a, b, c, d, e, f] = value; return visit(a, b, c, d, e, f); }
  if constexpr (n == 7) {
    const auto& [a, b, c, d, e, f, g] = value;
    return visit(a, b, c, d, e, f, g);
  }
  if constexpr (n == 8) {
    const auto& [a, b, c, d, e, f, g, h] = value;
    return visit(a, b, c, d, e, f, g, h);
  }
  if constexpr (n == 9) {
    const auto& [a, b, c, d, e, f, g, h, i] = value;
    return visit(a, b, c, d, e, f, g, h, i);
  }
  if constexpr (n == 10) {
    const auto& [a, b, c, d, e, f, g, h, i, j] = value;
    return visit(a, b, c, d, e, f, g, h, i, j);
  }
  if constexpr (n == 11) {
    const auto& [a, b, c, d, e, f, g, h, i, j, k] = value;
    return visit(a, b, c, d, e, f, g, h, i, j, k);
  }
  if constexpr (n == 12) {
    const auto& [a, b, c, d, e, f, g, h, i, j, k, l] = value;
    return visit(a, b, c, d, e, f, g, h, i, j, k, l);
  }
}
// clang-format on

template <class T>
constexpr bool has_members() {
  if constexpr (std::is_class_v<T> && std::is_aggregate_v<T>) {
    constexpr bool kHasBase = requires { T{AnyBase<T>()}; };
    return !kHasBase && count_members<T>() <= kMostMembers;
  }
  return false;
}
template <class T>
inline constexpr bool kHasMembers = has_members<T>();

// --- Parts -----------------------------------------------------------------------------------

/// Whether a T of the standard library, or one like it, has parts that its == and <=> compare.
template <class T>
inline constexpr bool kContainsOthers =
    TupleLike<T> || RangeOfOthers<T> || kIsOptional<T> || kIsVariant<T>;
template <class T>
inline constexpr bool kHasParts = kContainsOthers<T> || kHasMembers<T>;

template <class... T>
constexpr Types<T...> alternatives(const std::variant<T...>*) {
  return {};
}

/// Types<...> of the parts. Requires: kHasParts<T>.
template <class T>
constexpr auto parts() {
  constexpr auto types_of = [](const auto&... part) {
    return Types<std::remove_cvref_t<decltype(part)>...>();
  };
  if constexpr (kIsOptional<T>) {
    return Types<typename T::value_type>();
  } else if constexpr (kIsVariant<T>) {
    return alternatives(static_cast<const T*>(nullptr));
  } else if constexpr (RangeOfOthers<T>) {  // also an array, of any length
    return Types<std::ranges::range_value_t<const T>>();
  } else if constexpr (TupleLike<T>) {
    return decltype(std::apply(types_of, std::declval<const T&>()))();
  } else {
    return decltype(with_members(std::declval<const T&>(), types_of))();
  }
}
/// Whether Is<P>::value holds for some part P of T.
template <template <class> class Is, class T>
constexpr bool any_part() {
  return []<class... P>(Types<P...>) { return (Is<P>::value || ...); }(parts<T>());
}

/// visit(part) for all, and before for what else there is to know: a size, or which alternative.
template <class T, class Visit>
void for_each_part(const T& value, Visit&& visit) {
  const auto visit_all = [&](const auto&... part) { (visit(part), ...); };
  if constexpr (kIsOptional<T>) {
    visit(value.has_value());
    if (value.has_value()) visit(*value);
  } else if constexpr (kIsVariant<T>) {
    visit(value.index());
    if (!value.valueless_by_exception()) std::visit(visit_all, value);
  } else if constexpr (RangeOfOthers<T>) {
    if constexpr (!TupleLike<T>) visit(static_cast<std::size_t>(std::ranges::distance(value)));
    for (const auto& part : value) visit(part);
  } else if constexpr (TupleLike<T>) {
    std::apply(visit_all, value);
  } else {
    with_members(value, visit_all);
  }
}

}  // namespace sac::detail
