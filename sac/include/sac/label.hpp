// Labels of calls: names of functions; hash, order and print of arguments.
//
// The label of a call is (function, arguments). An argument type needs ==; order (agendas only) is
// by <=>; print by `print_argument(std::ostream&, const T&, const void* neighbour)`
// (argument-dependent) or operator<<; otherwise only the size of the type is shown. The hash is the
// first of these that applies; it is the same in every run, but for addresses of the outside:
//   (1) `hash_value(const T&)` (argument-dependent), std::hash;
//   (2) that of the elements of a pair, tuple, array, vector or other range, of the content of an
//       optional or variant, or of the members, up to 12, of an aggregate without bases;
//   (3) that of the bytes of a type without padding.
// A type whose == takes values for equal that differ in a part needs (1).
//
// To compare traces of different runs, a label needs a name that is the same in all runs. Hashes
// and prints of handles are not. label_arguments() gives this name to a LabelSink. The name of an
// argument is the first of these that applies:
//   (1) the output of `label_bytes(LabelSink&, const T&)` (argument-dependent);
//   (2) the value of a number, an enumerator or a string;
//   (3) the object that a pointer points to, whose name the sink must know;
//   (4) the output of operator<<, with all digits; a type of your own that prints a handle or an
//       address therefore needs (1);
//   (5) the names of its parts, as for hashes; but of an aggregate with hash_value, none;
//   (6) none: the sink is told so.
#pragma once

#include <array>
#include <bit>
#include <compare>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <ostream>
#include <ranges>
#include <sstream>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <typeinfo>

#include "sac/arena.hpp"
#include "sac/internal/parts.hpp"

namespace sac {

template <class T, class Same>
class Mod;
class Agenda;

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
concept HashedByStd = requires(const T& value) {
  { std::hash<T>{}(value) } -> std::convertible_to<std::size_t>;
};
/// Types whose values are equal exactly if their bytes are equal.
template <class T>
concept HashedByBytes =
    std::is_trivially_copyable_v<T> && std::has_unique_object_representations_v<T>;

namespace detail {

// Whether the bytes of a T are known to be numbers: no addresses, nothing with a hash of its own.
template <class T>
struct IsNumbers : std::bool_constant<std::is_integral_v<T> || std::is_enum_v<T>> {};
template <class T>
struct IsNotNumbers : std::bool_constant<!IsNumbers<T>::value> {};
template <class T>
requires(std::is_class_v<T>&& HashedByBytes<T> && !HashedByValue<T> &&
         !HashedByStd<T>) struct IsNumbers<T> : std::bool_constant<[] {
  if constexpr (TupleLike<T> || kHasMembers<T>) return !any_part<IsNotNumbers, T>();
  return false;
}()> {
};

[[nodiscard]] inline std::uint64_t hash_bytes(const void* bytes, std::size_t size) noexcept {
  std::uint64_t h = 0;
  for (std::size_t i = 0; i < size; i += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, static_cast<const char*>(bytes) + i, size - i < 8 ? size - i : 8);
    h = mix(h + word + 0x9e3779b97f4a7c15u);
  }
  return h;
}

}  // namespace detail

template <class T>
[[nodiscard]] std::uint64_t hash_argument(const T& value);

namespace detail {

template <class T>
[[nodiscard]] std::uint64_t hash_parts(const T& value) {
  std::uint64_t h = 0;
  if constexpr (requires { value.hash_function(); }) {  // its order of elements means nothing
    for (const auto& element : value) h += mix(hash_argument(element));
  } else {
    for_each_part(
        value, [&](const auto& part) { h = mix(h + 0x9e3779b97f4a7c15u + hash_argument(part)); });
  }
  return h;
}

}  // namespace detail

/// The hash of an argument, by the rules above.
template <class T>
[[nodiscard]] std::uint64_t hash_argument(const T& value) {
  if constexpr (HashedByValue<T>) {
    return hash_value(value);
  } else if constexpr (std::is_same_v<T, Agenda*>) {
    return value->number();
  } else if constexpr (std::is_pointer_v<T>) {
    // By its offset in an arena, so that engines with equal traces have equal hashes.
    return reinterpret_cast<std::uintptr_t>(value) & (Arena::kReserve - 1);
  } else if constexpr (HashedByStd<T> && !detail::kIsOptional<T> && !detail::kIsVariant<T>) {
    return std::hash<T>{}(value);
  } else if constexpr (detail::kHasParts<T> && !detail::IsNumbers<T>::value) {
    return detail::hash_parts(value);
  } else {
    static_assert(HashedByBytes<T>,
                  "a type of arguments needs a hash: write "
                  "`friend std::uint64_t hash_value(const T&)` in its class, or std::hash");
    return detail::hash_bytes(&value, sizeof(T));
  }
}

/// Whether hashing a T needs no client code: calls with such arguments do not store their hash.
template <class T>
inline constexpr bool kCheapHash = std::is_arithmetic_v<T> || std::is_enum_v<T> ||
                                   (std::is_pointer_v<T> && !std::is_same_v<T, Agenda*>);
template <class T, class Same>
inline constexpr bool kCheapHash<Mod<T, Same>> = true;

template <class... Args>
[[nodiscard]] std::uint64_t hash_arguments(std::uint64_t seed, const std::tuple<Args...>& args) {
  std::uint64_t h = seed;
  std::apply(
      [&](const auto&... a) { ((h = mix(h + 0x9e3779b97f4a7c15u + hash_argument(a))), ...); },
      args);
  return h;
}

template <class T>
concept PrintsItself = requires(std::ostream& out, const T& value) {
  operator<<(out, value);  // a function, not a member of the stream
};

/// Whether T is a pointer that a stream would print as an address.
template <class T>
inline constexpr bool kPointerToObject =
    std::is_pointer_v<T>&& std::is_convertible_v<T, const void*> && !PrintsItself<T>;

template <class T>
concept Printable = requires(std::ostream& out, const T& value) {
  out << value;
};

/// Prints an argument for people. `neighbour`: any object in the engine's arena; pointers into that
/// arena are printed as @handle.
template <class T>
void print_argument(std::ostream& out, const T& value, const void* neighbour = nullptr) {
  if constexpr (std::is_same_v<T, Agenda*>) {
    out << value->name();
  } else if constexpr (kPointerToObject<T>) {
    if (value == nullptr) {
      out << "null";
    } else if (neighbour != nullptr && Arena::same_arena(value, neighbour)) {
      out << '@' << Arena::handle_of(value);
    } else {
      out << static_cast<const void*>(value);
    }
  } else if constexpr (Printable<T>) {
    out << value;
  } else {
    out << '<' << sizeof(T) << " bytes>";
  }
}

/// Receives the names of arguments: equal arguments of any two runs give equal names in equal
/// order.
class LabelSink {
 public:
  virtual void number(std::uint64_t value) = 0;
  virtual void text(std::string_view value) = 0;
  /// An object in the engine's arena, by handle.
  virtual void handle(std::uint32_t handle) = 0;
  /// An object anywhere; null: none.
  virtual void address(const void* object) = 0;
  /// Text of unknown length: everything printed to the stream of print_begin() before print_end().
  virtual std::ostream& print_begin() = 0;
  virtual void print_end() = 0;
  /// The argument has no name; `hash` distinguishes it from others in this run.
  virtual void nameless(std::uint64_t hash) = 0;

 protected:
  ~LabelSink() = default;
};

template <class T, class Same>
void label_bytes(LabelSink& sink, const Mod<T, Same>& mod) {
  sink.handle(mod.head().handle());
}

// A template, since Agenda is incomplete here.
template <std::same_as<Agenda> A>
void label_bytes(LabelSink& sink, A* const& agenda) {
  sink.text(agenda->name());
}

namespace detail {

template <class T>
concept NamedByItself = requires(LabelSink& sink, const T& value) {
  label_bytes(sink, value);
};

template <class T>
concept SmartPointer = requires(const T& value) {
  *value;
  { value.get() } -> std::convertible_to<const void*>;
};

// -0.0 equals 0.0 and gets its name.
inline std::uint64_t number_of(double value) { return std::bit_cast<std::uint64_t>(value + 0.0); }

template <class T>
void name_argument(LabelSink& sink, const T& value) {
  if constexpr (NamedByItself<T>) {
    label_bytes(sink, value);
  } else if constexpr (std::is_integral_v<T> || std::is_enum_v<T>) {
    sink.number(static_cast<std::uint64_t>(value));
  } else if constexpr (std::is_same_v<T, float> || std::is_same_v<T, double>) {
    sink.number(number_of(value));
  } else if constexpr (std::is_same_v<T, const char*> || std::is_same_v<T, char*>) {
    value != nullptr ? sink.text(value) : sink.address(nullptr);
  } else if constexpr (std::is_convertible_v<const T&, std::string_view>) {
    sink.text(value);
  } else if constexpr (std::is_convertible_v<const T&, const void*>) {
    sink.address(value);
  } else if constexpr (SmartPointer<T>) {
    sink.address(value.get());
  } else if constexpr (Printable<T>) {
    sink.print_begin() << value;
    sink.print_end();
  } else if constexpr (kContainsOthers<T> || (kHasMembers<T> && !HashedByValue<T>)) {
    for_each_part(value, [&](const auto& part) { name_argument(sink, part); });
  } else if constexpr (HashedByValue<T> || HashedByStd<T> || HashedByBytes<T>) {
    sink.nameless(hash_argument(value));
  } else {
    sink.nameless(0);  // a value may be of a type that cannot be an argument
  }
}

}  // namespace detail

/// `a, b, c`, for people.
template <class... Args>
void print_arguments(std::ostream& out, const std::tuple<Args...>& args,
                     const void* neighbour = nullptr) {
  const char* separator = "";
  std::apply(
      [&](const auto&... a) {
        ((out << separator, print_argument(out, a, neighbour), separator = ", "), ...);
      },
      args);
}

/// `name(a, b, c)`, for people.
template <class... Args>
[[nodiscard]] std::string describe_call(std::string_view name, const std::tuple<Args...>& args,
                                        const void* neighbour = nullptr) {
  std::ostringstream out;
  out << name << '(';
  print_arguments(out, args, neighbour);
  out << ')';
  return out.str();
}

/// Gives the names of the arguments, which are the same in all runs, to `sink`.
template <class... Args>
void label_arguments(LabelSink& sink, const std::tuple<Args...>& args) {
  std::apply([&](const auto&... a) { (detail::name_argument(sink, a), ...); }, args);
}

namespace detail {

// The compiler's spelling of F, cut out of the name of this function.
[[nodiscard]] constexpr std::string_view spelling(std::string_view parameter, std::string_view s) {
  s.remove_prefix(s.find(parameter) + parameter.size());
  return s.substr(0, s.find_first_of(";]"));
}
template <auto F>
[[nodiscard]] constexpr std::string_view spelled() {
  std::string_view s = spelling("F = ", __PRETTY_FUNCTION__);
  if (s.starts_with('&')) s.remove_prefix(1);
  if (const auto brace = s.find_last_of("{(");
      brace != s.npos && (s.back() == '}' || s.back() == ')')) {
    s = s.substr(0, brace);
  }
  if (s.starts_with('(')) s = s.substr(s.rfind(')') + 1);
  return s;
}

// The same for a type, which every compiler spells alike: some write an object as {}.
template <class T>
[[nodiscard]] constexpr std::string_view spelled_type() {
  const std::string_view s = spelling("T = ", __PRETTY_FUNCTION__);
  if (s.find("lambda") != s.npos) return "lambda";
  return s;
}

// One object for each type, whose address stands for it within a library.
template <class T>
inline constexpr std::string_view kTypeName = spelled_type<T>();

template <auto F>
[[nodiscard]] constexpr std::string_view spelled_function() {
  if constexpr (std::is_class_v<std::remove_cv_t<decltype(F)>>) {
    return spelled_type<std::remove_cv_t<decltype(F)>>();
  } else {
    return spelled<F>();
  }
}

// "make " and the name of a type without namespaces and template arguments (which compilers spell
// differently), composed by the compiler.
template <class T>
struct MakerName {
  static constexpr std::string_view short_type() {
    constexpr std::string_view full = spelled_type<T>();
    constexpr std::string_view bare = full.substr(0, full.find('<'));
    constexpr auto colon = bare.rfind("::");
    return colon == bare.npos ? bare : bare.substr(colon + 2);
  }
  static constexpr auto text = [] {
    constexpr std::string_view prefix = "make ";
    std::array<char, prefix.size() + short_type().size()> joined{};
    std::size_t n = 0;
    for (const char c : prefix) joined[n++] = c;
    for (const char c : short_type()) joined[n++] = c;
    return joined;
  }();
};
template <class T>
inline constexpr std::string_view kMakerName{MakerName<T>::text.data(), MakerName<T>::text.size()};

}  // namespace detail

/// The name of a traced function for people: an object's member `kName` if it has one, else the
/// name in the source without its namespaces.
template <auto F>
[[nodiscard]] constexpr std::string_view function_name() {
  if constexpr (requires { decltype(F)::kName; }) {
    return decltype(F)::kName;
  } else {
    constexpr std::string_view full = detail::spelled_function<F>();
    constexpr auto colon = full.rfind("::", full.find('<'));
    return colon == full.npos ? full : full.substr(colon + 2);
  }
}

namespace detail {
template <auto F, class Args>
struct FunctionType {};
}  // namespace detail

/// What distinguishes functions of one name, and one function with different argument types, in an
/// order that is the same in every run of a build.
struct Identity {
  const char* type;  ///< as the compiler names it for the linker: it numbers lambdas
  const char* file;  ///< that was compiled: functions of one name and type are local to theirs
};
/// Args: the std::tuple of the arguments.
template <auto F, class Args>
[[nodiscard]] Identity identity() {
#ifdef __BASE_FILE__
  return {typeid(detail::FunctionType<F, Args>).name(), __BASE_FILE__};
#else
  return {typeid(detail::FunctionType<F, Args>).name(), ""};
#endif
}

/// The name of a keyed allocation of a T, for people and in labels: `make Node`.
template <class T>
[[nodiscard]] constexpr std::string_view maker_name() {
  return detail::kMakerName<T>;
}

}  // namespace sac
