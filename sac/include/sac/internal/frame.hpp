// The parts of a call behind its head in memory, and the description of its function for the
// engine.
#pragma once

#include <concepts>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>

#include "sac/internal/core.hpp"
#include "sac/internal/parameters.hpp"
#include "sac/internal/same.hpp"

namespace sac::detail {

// What lies behind the head of a call: first what only some functions have, then the arguments.
struct Nothing {};

// A hash that client code computes is stored: that code may throw, and must not when a call leaves.
template <class... Args>
inline constexpr bool kStoresHash = !(kCheapHash<Args> && ...);
template <bool kStored>
struct HashField {
  std::uint32_t hash;
};
template <>
struct HashField<false> {};

template <class R>
struct Result {
  std::optional<R> value;
};
template <class T>
struct Object {
  static_assert(alignof(T) <= 8, "objects in the arena are aligned to 8 bytes");
  alignas(Arena::kGranule) T value;
};

// Whether == of a T compiles: that of containers is declared for elements of any type.
template <class T>
constexpr bool has_equality();
template <class T>
struct LacksEquality : std::bool_constant<!has_equality<T>()> {};
template <class T>
constexpr bool has_equality() {
  if constexpr (TupleLike<T> || kIsOptional<T> || kIsVariant<T> || kIsVector<T>) {
    return std::equality_comparable<T> && !any_part<LacksEquality, T>();
  }
  return std::equality_comparable<T>;
}

// What an argument of a call must be like; a type of its own, so that the compiler names T.
template <class T>
struct Argument {
  static_assert(alignof(T) <= 8, "arguments in the arena are aligned to 8 bytes");
  static_assert(!kCString<T>,
                "the characters behind a pointer may change or go: pass a std::string");
  static_assert(has_equality<T>(),
                "an argument of a call needs ==: calls are told apart by their arguments; write "
                "`bool operator==(const T&) const = default`");
  static constexpr bool kFits = true;
};

// `Head`: Nothing, the Slot of a posted call, or ResultHead. `Tail`: Nothing, Result or Object.
template <class Head, class Tail, class... Args>
struct Frame {
  static_assert((Argument<Args>::kFits && ...));
  using Arguments = std::tuple<Args...>;
  Call call;
  [[no_unique_address]] Head head;
  [[no_unique_address]] HashField<kStoresHash<Args...>> hash;
  Arguments args;
  [[no_unique_address]] Tail tail;

  static Frame& of(Call& call) noexcept { return reinterpret_cast<Frame&>(call); }
  static const Frame& of(const Call& call) noexcept { return reinterpret_cast<const Frame&>(call); }

  // If a constructor throws, what was made before is destroyed again.
  static void construct(void* memory, const void* arguments, std::uint32_t hash) {
    Frame& frame = *static_cast<Frame*>(memory);
    ::new (static_cast<void*>(&frame.head)) Head();
    if constexpr (kStoresHash<Args...>) frame.hash.hash = hash;
    ::new (static_cast<void*>(&frame.args)) Arguments(*static_cast<const Arguments*>(arguments));
    if constexpr (!std::is_empty_v<Tail>) {
      try {
        ::new (static_cast<void*>(&frame.tail)) Tail();
      } catch (...) {
        std::destroy_at(&frame.args);
        throw;
      }
    }
  }
};

// A function's identity enters its calls' hashes by name, so that hashes are the same in every run.
constexpr std::uint64_t hash_name(std::string_view name) {
  std::uint64_t h = name.size();
  for (const char c : name) h = mix(h + static_cast<unsigned char>(c));
  return h;
}
template <auto Name, class... Args>
std::uint32_t label_hash(const std::tuple<Args...>& args) {
  constexpr std::uint64_t seed = hash_name(Name());
  return static_cast<std::uint32_t>(hash_arguments(seed, args));
}

// --- What the engine is told -----------------------------------------------------------------

template <class F, auto Name>
std::uint32_t hash_frame(const Call& call) noexcept {
  if constexpr (requires { F::of(call).hash.hash; }) {
    return F::of(call).hash.hash;
  } else {
    return label_hash<Name>(F::of(call).args);
  }
}

template <class Arguments>
inline constexpr bool kHasAgenda = false;
template <class... Args>
inline constexpr bool kHasAgenda<std::tuple<Args...>> = (std::is_same_v<Args, Agenda*> || ...);
template <class T>
bool is_agenda(const T& argument, const Agenda& agenda) {
  if constexpr (std::is_same_v<T, Agenda*>) return argument == &agenda;
  return false;
}

// Of a call with this frame, but for running it.
template <class F, auto Name>
constexpr Function describe_frame() {
  Function f{.name = Name(), .frame_bytes = sizeof(F)};
  if constexpr (!std::is_trivially_destructible_v<decltype(F::args)> ||
                !std::is_trivially_destructible_v<decltype(F::tail)>) {
    f.destroy = [](Call& call) {
      std::destroy_at(&F::of(call).tail);
      std::destroy_at(&F::of(call).args);
    };
  }
  f.equal = [](const Call& call, const void* arguments) {
    return identical(F::of(call).args, *static_cast<const typename F::Arguments*>(arguments));
  };
  f.arguments = [](const Call& call) -> const void* { return &F::of(call).args; };
  f.hash = &hash_frame<F, Name>;
  if constexpr (kHasAgenda<typename F::Arguments>) {
    f.has_agenda = [](const Call& call, const Agenda& agenda) {
      return std::apply([&](const auto&... a) { return (is_agenda(a, agenda) || ...); },
                        F::of(call).args);
    };
  }
  f.print = [](const Call& c, std::ostream& out) { print_arguments(out, F::of(c).args, &c); };
  f.label = [](const Call& c, LabelSink& sink) { label_arguments(sink, F::of(c).args); };
  return f;
}

// How results of F are compared: its member type Same, or ==.
template <auto F>
struct SameResult {
  using type = std::equal_to<>;
};
template <auto F>
requires requires { typename decltype(F)::Same; }
struct SameResult<F> {
  using type = typename decltype(F)::Same;
};

template <auto F, class... Args>
using ResultOf = std::invoke_result_t<decltype(F), Scope&, const Args&...>;

// A call F(scope, args...), and its frame.
template <auto F, class... Args>
struct Called {
  using R = ResultOf<F, Args...>;
  static constexpr auto name = &function_name<F>;
  using FrameType = std::conditional_t<
      std::is_void_v<R>, Frame<Nothing, Nothing, Args...>,
      Frame<ResultHead, Result<std::conditional_t<std::is_void_v<R>, char, std::decay_t<R>>>,
            Args...>>;
  template <class AnyFrame>
  static void execute_in(Scope& scope, Call& call);
  static constexpr Function function = [] {
    Function f = describe_frame<FrameType, name>();
    f.execute = &execute_in<FrameType>;
    if constexpr (requires { decltype(F)::kAnswersQuery; }) {
      f.query = [](const Call& c) -> const void* {
        return std::get<0>(FrameType::of(c).args).query;
      };
    }
    if constexpr (!std::is_void_v<R>) {
      f.has_result = true;
      f.print_result = [](const Call& c, std::ostream& out) {
        if (const auto& r = FrameType::of(c).tail.value) print_argument(out, *r, &c);
      };
      f.label_result = [](const Call& c, LabelSink& sink) {
        if (const auto& r = FrameType::of(c).tail.value) name_argument(sink, *r);
      };
    }
    return f;
  }();
};

// A keyed object, with F(scope, object, key...), or without a body: F is nullptr.
template <class T, auto F, class... Key>
struct Made {
  static constexpr bool kHasBody = !std::is_null_pointer_v<decltype(F)>;
  static constexpr auto name = [] {
    if constexpr (kHasBody) {
      return &function_name<F>;
    } else {
      return &maker_name<T>;
    }
  }();
  using FrameType = Frame<Nothing, Object<T>, Key...>;
  static constexpr Function function = [] {
    Function f = describe_frame<FrameType, name>();
    f.object_offset = sizeof(FrameType) - sizeof(Object<T>);  // it is what lies last
    if constexpr (kHasBody) {
      f.execute = [](Scope& scope, Call& call) {
        auto& frame = FrameType::of(call);
        std::apply([&](const auto&... a) { F(scope, frame.tail.value, a...); }, frame.args);
      };
    }
    return f;
  }();
};

// --- Asking for a call -----------------------------------------------------------------------

// What a request with arguments of the types `Args` asks for.
template <auto F, class... P>
Called<F, P...> called(Types<P...>);
template <class T, auto F, class... P>
Made<T, F, P...> made(Types<P...>);
template <auto F, class... Args>
using CallBy = decltype(called<F>(parameters<F, false, Arrived<Args>...>()));
template <class T, auto F, class... Key>
using MadeBy = decltype(made<T, F>(parameters<F, true, Arrived<Key>...>()));

// A label on its way into a call of `What`: Called, Made or Posted.
template <class What>
struct Label {
  typename What::FrameType::Arguments args;
  std::uint32_t hash;

  [[nodiscard]] Asked asked() const {
    return {What::function, &args, hash, &What::FrameType::construct};
  }
  /// For people. `neighbour` as for print_argument.
  [[nodiscard]] std::string describe(const void* neighbour) const {
    return describe_call(What::function.name, args, neighbour);
  }
};

// With arguments converted to what they are kept as.
template <class What, class... Args>
Label<What> make_label(Args&&... args) {
  using Arguments = typename What::FrameType::Arguments;
  return [&]<class... P>(std::type_identity<std::tuple<P...>>) {
    Arguments kept(static_cast<P>(std::forward<Args>(args))...);
    const std::uint32_t hash = label_hash<What::name>(kept);
    return Label<What>{std::move(kept), hash};
  }(std::type_identity<Arguments>());
}

}  // namespace sac::detail
