// The types in which the arguments of a traced function are kept: those of its parameters, so that
// a call has one label however its arguments are written (1 or 1L, a literal or a std::string). For
// a function that is a template or overloaded, and for keys, the types of the arguments are kept;
// character strings and std::string_view become std::string.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <type_traits>

namespace sac {

class Scope;
template <class T, class Same>
class Mod;
template <class T, class Same>
class Cell;

namespace detail {

template <class... T>
struct Types {};

/// A pointer to characters that somebody else keeps.
template <class T>
inline constexpr bool kCString = std::is_same_v<T, char*> || std::is_same_v<T, const char*>;

/// As what an argument of no declared type is kept.
template <class T>
using Kept = std::conditional_t<kCString<T> || std::is_same_v<T, std::string_view>, std::string, T>;

/// As what an argument arrives: a cell as its modifiable.
template <class T>
struct ArrivedAs {
  using type = T;
};
template <class T, class Same>
struct ArrivedAs<Cell<T, Same>> {
  using type = Mod<T, Same>;
};
template <class T>
using Arrived = typename ArrivedAs<std::decay_t<T>>::type;

// Of a function or member function that takes a scope first; void for others.
template <class F>
struct Declared {
  using type = void;
};
template <class R, class... P, bool kNoexcept>
struct Declared<R (*)(Scope&, P...) noexcept(kNoexcept)> {
  using type = Types<P...>;
};
template <class R, class C, class... P, bool kNoexcept>
struct Declared<R (C::*)(Scope&, P...) const noexcept(kNoexcept)> {
  using type = Types<P...>;
};

// Member functions that may change their object.
template <class F>
inline constexpr bool kChangesItself = false;
template <class R, class C, class... P, bool kNoexcept>
inline constexpr bool kChangesItself<R (C::*)(P...) noexcept(kNoexcept)> = true;

template <class F>
constexpr auto declared() {
  if constexpr (requires { &F::operator(); }) {
    static_assert(!kChangesItself<decltype(&F::operator())>,
                  "a traced function has no state: its operator() is const");
    return std::type_identity<typename Declared<decltype(&F::operator())>::type>();
  } else {
    return std::type_identity<typename Declared<F>::type>();
  }
}

template <class First, class... Rest>
constexpr Types<Rest...> behind_first(Types<First, Rest...>) {
  return {};
}

template <class P>
inline constexpr bool kChangesArgument =
    std::is_lvalue_reference_v<P> && !std::is_const_v<std::remove_reference_t<P>>;

template <class... Args, class... P>
constexpr auto kept_as(Types<P...>) {
  constexpr bool kSameNumber = sizeof...(Args) == sizeof...(P);
  static_assert(kSameNumber, "the traced function takes another number of arguments");
  static_assert(!(kChangesArgument<P> || ...),
                "a traced function changes modifiables, not its arguments: take a value, a const "
                "reference or a pointer");
  if constexpr (kSameNumber) {
    static_assert((std::is_convertible_v<Args, std::decay_t<P>> && ...),
                  "an argument is not of the type that the traced function takes");
  }
  return Types<std::conditional_t<std::is_same_v<std::decay_t<P>, std::string_view>, std::string,
                                  std::decay_t<P>>...>();
}

/// Types<...>: as what arguments of the types `Args` are kept for a call of F. kObject: F takes an
/// object, too, before them.
template <auto F, bool kObject, class... Args>
constexpr auto parameters() {
  using List = typename decltype(declared<std::remove_cv_t<decltype(F)>>())::type;
  if constexpr (std::is_void_v<List>) {
    static_assert(kObject || std::is_invocable_v<decltype(F), Scope&, const Kept<Args>&...>,
                  "a traced function takes a Scope&, then arguments of these types");
    return Types<Kept<Args>...>();
  } else if constexpr (kObject) {
    return kept_as<Args...>(behind_first(List()));
  } else {
    return kept_as<Args...>(List());
  }
}

}  // namespace detail
}  // namespace sac
