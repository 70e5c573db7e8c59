// What a traced function sees of the engine: its first argument.
//
// A traced function is a free function or a captureless object F with
//     void f(sac::Scope& s, Args... args)
// that depends on nothing but its arguments and what it reads through `s`.
#pragma once

#include <concepts>
#include <memory>
#include <new>
#include <optional>
#include <tuple>
#include <type_traits>
#include <utility>

#include "sac/engine.hpp"
#include "sac/internal/parameters.hpp"

namespace sac {

class Scope;

namespace detail {

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

// Arguments on their way into a call.
template <class... Args>
struct Label {
  std::tuple<Args...> args;
  std::uint32_t hash;
};

// `Head`: Nothing, the Slot of a posted call, or ResultHead. `Tail`: Nothing, Result or Object.
template <class Head, class Tail, class... Args>
struct Frame {
  static_assert(((alignof(Args) <= 8) && ...), "arguments in the arena are aligned to 8 bytes");
  static_assert(!(kCString<Args> || ...),
                "the characters behind a pointer may change or go: pass a std::string");
  static_assert((std::equality_comparable<Args> && ...),
                "an argument of a call needs ==: calls are told apart by their arguments");
  using LabelType = Label<Args...>;
  Call call;
  [[no_unique_address]] Head head;
  [[no_unique_address]] HashField<kStoresHash<Args...>> hash;
  std::tuple<Args...> args;
  [[no_unique_address]] Tail tail;

  static Frame& of(Call& call) noexcept { return reinterpret_cast<Frame&>(call); }
  static const Frame& of(const Call& call) noexcept { return reinterpret_cast<const Frame&>(call); }
};

template <class Same, class T>
bool same(const T& a, const T& b) {
  constexpr bool kCompares = requires { static_cast<bool>(Same{}(a, b)); };
  static_assert(kCompares,
                "a value or result needs ==, or a Same of its own: an equal one disturbs nobody");
  if constexpr (kCompares) return static_cast<bool>(Same{}(a, b));
}

template <class R>
struct Result {
  std::optional<R> value;
};
template <class T>
struct Object {
  static_assert(alignof(T) <= 8, "objects in the arena are aligned to 8 bytes");
  alignas(Arena::kGranule) T value;
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

// The label of a call of what has this name, with arguments kept as P.
template <auto Name, class... P, class... Args>
Label<P...> make_label(Types<P...>, Args&&... args) {
  std::tuple<P...> kept(static_cast<P>(std::move(args))...);
  const std::uint32_t hash = label_hash<Name>(kept);
  return {std::move(kept), hash};
}

// --- The operations of a frame ---------------------------------------------------------------

template <class F>
bool equal_args(const Call& call, const void* label) {
  return F::of(call).args == static_cast<const typename F::LabelType*>(label)->args;
}

// If the object's constructor throws, the arguments are destroyed again.
template <class Head, class Tail, class... Args>
void construct_frame(void* memory, const void* label) {
  using F = Frame<Head, Tail, Args...>;
  const auto& from = *static_cast<const Label<Args...>*>(label);
  F& frame = *static_cast<F*>(memory);
  ::new (static_cast<void*>(&frame.head)) Head();
  if constexpr (kStoresHash<Args...>) frame.hash.hash = from.hash;
  ::new (static_cast<void*>(&frame.args)) std::tuple<Args...>(from.args);
  if constexpr (!std::is_nothrow_default_constructible_v<Tail>) {
    try {
      ::new (static_cast<void*>(&frame.tail)) Tail();
    } catch (...) {
      std::destroy_at(&frame.args);
      throw;
    }
  } else if constexpr (!std::is_empty_v<Tail>) {
    ::new (static_cast<void*>(&frame.tail)) Tail();
  }
}

template <class F>
struct ConstructorOf;
template <class Head, class Tail, class... Args>
struct ConstructorOf<Frame<Head, Tail, Args...>> {
  static constexpr auto value = &construct_frame<Head, Tail, Args...>;
};
template <class F>
constexpr auto constructor_of() {
  return ConstructorOf<F>::value;
}

template <class F>
void destroy_frame(Call& call) {
  F& frame = F::of(call);
  std::destroy_at(&frame.tail);
  std::destroy_at(&frame.args);
}

template <class F>
std::strong_ordering compare_args(const Call& a, const Call& b) {
  const auto order = F::of(a).args <=> F::of(b).args;
  return order < 0 ? std::strong_ordering::less
                   : order > 0 ? std::strong_ordering::greater : std::strong_ordering::equal;
}

template <class F, auto Name>
std::uint32_t hash_frame(const Call& call) noexcept {
  if constexpr (requires { F::of(call).hash.hash; }) {
    return F::of(call).hash.hash;
  } else {
    return label_hash<Name>(F::of(call).args);
  }
}

template <class F>
void print_args(const Call& call, std::ostream& out) {
  print_arguments(out, F::of(call).args, &call);
}
template <class F>
void label_args(const Call& call, LabelSink& sink) {
  label_arguments(sink, F::of(call).args);
}
template <class F>
void print_result(const Call& call, std::ostream& out) {
  if (const auto& result = F::of(call).tail.value) print_argument(out, *result, &call);
}
template <class F>
void label_result(const Call& call, LabelSink& sink) {
  if (const auto& result = F::of(call).tail.value) name_argument(sink, *result);
}

// --- Running a frame -------------------------------------------------------------------------

template <auto F, class FrameType>
void execute_frame(Scope& scope, Call& call) {
  std::apply([&](const auto&... args) { F(scope, args...); }, FrameType::of(call).args);
}

template <auto F, class FrameType>
void execute_body(Scope& scope, Call& call) {
  auto& frame = FrameType::of(call);
  std::apply([&](const auto&... args) { F(scope, frame.tail.value, args...); }, frame.args);
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

template <auto F, class FrameType>
void execute_with_result(Scope& scope, Call& call);

template <class F, auto Name>
constexpr Function describe_frame() {
  Function f{.name = Name(), .frame_bytes = sizeof(F)};
  constexpr bool trivial = std::is_trivially_destructible_v<decltype(F::args)> &&
                           std::is_trivially_destructible_v<decltype(F::tail)>;
  if constexpr (!trivial) f.destroy = &destroy_frame<F>;
  f.equal = &equal_args<F>;
  f.hash = &hash_frame<F, Name>;
  f.print = &print_args<F>;
  f.label = &label_args<F>;
  return f;
}

// --- Descriptors -----------------------------------------------------------------------------

// A call.
template <auto F, class... Args>
constexpr Function describe_call() {
  using R = std::invoke_result_t<decltype(F), Scope&, const Args&...>;
  if constexpr (std::is_void_v<R>) {
    using Type = Frame<Nothing, Nothing, Args...>;
    Function f = describe_frame<Type, &function_name<F>>();
    f.execute = &execute_frame<F, Type>;
    return f;
  } else {
    using Type = Frame<ResultHead, Result<std::decay_t<R>>, Args...>;
    Function f = describe_frame<Type, &function_name<F>>();
    f.execute = &execute_with_result<F, Type>;
    f.has_result = true;
    f.print_result = &print_result<Type>;
    f.label_result = &label_result<Type>;
    return f;
  }
}
template <auto F, class... Args>
inline constexpr Function kFunction = describe_call<F, Args...>();

// A keyed object, with or without a body.
template <class T, class... Key>
using ObjectFrame = Frame<Nothing, Object<T>, Key...>;

template <class T, class... Key>
constexpr Function describe_object() {
  using Type = ObjectFrame<T, Key...>;
  Function f = describe_frame<Type, &maker_name<T>>();
  f.object_offset = sizeof(Type) - sizeof(Object<T>);  // it is what lies last
  return f;
}
template <class T, class... Key>
inline constexpr Function kMaker = describe_object<T, Key...>();

template <class T, auto F, class... Key>
constexpr Function describe_built() {
  using Type = ObjectFrame<T, Key...>;
  Function f = describe_frame<Type, &function_name<F>>();
  f.object_offset = sizeof(Type) - sizeof(Object<T>);  // it is what lies last
  f.execute = &execute_body<F, Type>;
  return f;
}
template <class T, auto F, class... Key>
inline constexpr Function kBuilder = describe_built<T, F, Key...>();

}  // namespace detail

class Scope {
 public:
  template <class T, class Same = std::equal_to<>>
  using ModType = Mod<T, Same>;
  template <class T, class Same = std::equal_to<>>
  using CellType = Cell<T, Same>;
  using AgendaType = Agenda;
  static constexpr bool kTraced = true;

  explicit Scope(Engine& engine) : engine_(engine) {}

  [[nodiscard]] Engine& engine() noexcept { return engine_; }
  /// The object given to Engine::set_environment. Throws: UsageError if there is none.
  template <class T>
  [[nodiscard]] T& environment() const {
    if (engine_.environment_ == nullptr) [[unlikely]] engine_.fail_no_environment();
    return *static_cast<T*>(engine_.environment_);
  }
  /// The running call. Throws: UsageError if none runs: the scope was kept for too long.
  [[nodiscard]] Call& self() { return *engine_.running().call; }

  /// The value of `mod` at this point of the trace, recording the dependence.
  /// Throws: UsageError if no earlier call has written it.
  template <class T, class Same>
  const T& read(Mod<T, Same> mod);
  template <class T, class Same>
  const T& read(const Cell<T, Same>& cell);

  /// Gives `mod` a value from here on; one that is the same disturbs nobody.
  template <class T, class Same>
  void write(Mod<T, Same> mod, std::type_identity_t<T> value);
  template <class T, class Same>
  void write(const Cell<T, Same>& cell, std::type_identity_t<T> value);

  /// Says that the running call does `n` steps, elements of a chunk that it looks at, say: what a
  /// count of calls does not show. A branch, unless weights are recorded (Engine::record_weights).
  void weigh(std::uint64_t n) {
    if (engine_.weights_ != nullptr) [[unlikely]] record_weight(n);
  }

  /// Makes a child call, or reuses an equal one ahead in the interval that runs again. If F returns
  /// something, so does call(): by reference, good while the caller runs. The caller depends on it.
  template <auto F, class... Args>
  decltype(auto) call(Args... args) {
    return call_as<F>(detail::parameters<F, false, Args...>(), std::move(args)...);
  }

  /// As call(), as the last thing that the function does: runs after it, without native recursion.
  /// A result is not returned.
  template <auto F, class... Args>
  void tail(Args... args) {
    tail_as<F>(detail::parameters<F, false, Args...>(), std::move(args)...);
  }

  /// Keyed allocation: a default-constructed T that keeps its address while some run asks for
  /// (T, key) again within the interval that runs again, whichever call asks.
  template <class T, class... Key>
  T& make(Key... key) {
    return make_keyed<T>(detail::Types<detail::Kept<Key>...>(), std::move(key)...);
  }
  /// Keyed allocation of a T that F(scope, object, key...) works on: an object and the call that
  /// fills it in one. The label is that of F(key...).
  template <class T, auto F, class... Key>
  T& make(Key... key) {
    return make_as<T, F>(detail::parameters<F, true, Key...>(), std::move(key)...);
  }
  /// As make(), but F runs as a tail call: the object is there at once, and empty. After it the
  /// function may still read and write, but not call.
  template <class T, auto F, class... Key>
  T& tail_make(Key... key) {
    return tail_make_as<T, F>(detail::parameters<F, true, Key...>(), std::move(key)...);
  }

  /// A keyed modifiable for the program to write.
  template <class T, class Same = std::equal_to<>, class... Key>
  Mod<T, Same> cell(Key... key);

  /// Repeats something of last time: moves the first edge E of `structure` for which
  /// `matches(const E&)` into this execution and returns it; null if there is none.
  template <class E, class Matches>
  E* recall(std::uint8_t structure, std::uint8_t kind, Matches&& matches) {
    return static_cast<E*>(engine_.recall([&](Edge& edge) {
      return edge.structure == structure && edge.kind == kind &&
             matches(static_cast<const E&>(edge));
    }));
  }

  /// Records that this call depends on something in `structure`; `E`, and `extra` bytes behind it,
  /// say on what.
  template <class E>
  E& observe(std::uint8_t structure, std::uint8_t kind, std::size_t extra = 0) {
    return attach<E>(structure, kind, extra);
  }
  /// Records that this call did something to `structure`; `E`, and `extra` bytes behind it, say
  /// what.
  template <class E>
  E& effect(std::uint8_t structure, std::uint8_t kind, std::size_t extra = 0) {
    return attach<E>(structure, kind, extra);
  }

 private:
  template <auto F, class FrameType>
  friend void detail::execute_with_result(Scope& scope, Call& call);
  void result_changed(Handle caller) noexcept { engine_.result_changed(caller); }
  void record_weight(std::uint64_t n);

  // The public operations, with arguments converted to what they are kept as.
  template <auto F, class... P, class... Args>
  decltype(auto) call_as(detail::Types<P...> kept, Args&&... args) {
    using R = std::invoke_result_t<decltype(F), Scope&, const P&...>;
    using Frame = typename decltype(frame_of<F, P...>())::type;
    const Handle child =
        child_call<Frame>(detail::kFunction<F, P...>,
                          detail::make_label<&function_name<F>>(kept, std::move(args)...));
    if constexpr (!std::is_void_v<R>) {
      return static_cast<const std::decay_t<R>&>(*Frame::of(engine_.call(child)).tail.value);
    }
  }
  template <auto F, class... P, class... Args>
  void tail_as(detail::Types<P...> kept, Args&&... args) {
    using Frame = typename decltype(frame_of<F, P...>())::type;
    static_assert(std::is_void_v<std::invoke_result_t<decltype(F), Scope&, const P&...>>,
                  "a tail call has nobody to return to");
    tail_call<Frame>(detail::kFunction<F, P...>,
                     detail::make_label<&function_name<F>>(kept, std::move(args)...));
  }
  template <class T, class... P, class... Key>
  T& make_keyed(detail::Types<P...> kept, Key&&... key) {
    using Frame = detail::ObjectFrame<T, P...>;
    const Handle made =
        child_call<Frame>(detail::kMaker<T, P...>,
                          detail::make_label<&maker_name<T>>(kept, std::move(key)...));
    return Frame::of(engine_.call(made)).tail.value;
  }
  template <class T, auto F, class... P, class... Key>
  T& make_as(detail::Types<P...> kept, Key&&... key) {
    using Frame = detail::ObjectFrame<T, P...>;
    const Handle made =
        child_call<Frame>(detail::kBuilder<T, F, P...>,
                          detail::make_label<&function_name<F>>(kept, std::move(key)...));
    return Frame::of(engine_.call(made)).tail.value;
  }
  template <class T, auto F, class... P, class... Key>
  T& tail_make_as(detail::Types<P...> kept, Key&&... key) {
    using Frame = detail::ObjectFrame<T, P...>;
    const Handle made =
        tail_call<Frame>(detail::kBuilder<T, F, P...>,
                         detail::make_label<&function_name<F>>(kept, std::move(key)...));
    return Frame::of(engine_.call(made)).tail.value;
  }
  template <auto F, class... Args>
  static auto frame_of() {
    using R = std::invoke_result_t<decltype(F), Scope&, const Args&...>;
    if constexpr (std::is_void_v<R>) {
      return std::type_identity<detail::Frame<detail::Nothing, detail::Nothing, Args...>>();
    } else {
      return std::type_identity<detail::Frame<ResultHead, detail::Result<std::decay_t<R>>, Args...>>();
    }
  }
  template <class Frame, class... Args>
  Handle child_call(const Function& function, const detail::Label<Args...>& label) {
    return engine_.call_child(function, label.hash, &label, detail::constructor_of<Frame>());
  }
  template <class Frame, class... Args>
  Handle tail_call(const Function& function, const detail::Label<Args...>& label) {
    return engine_.call_tail(function, label.hash, &label, detail::constructor_of<Frame>());
  }
  template <class E>
  E& attach(std::uint8_t structure, std::uint8_t kind, std::size_t extra) {
    static_assert(std::is_base_of_v<Edge, E> && std::is_trivially_destructible_v<E>);
    SAC_EXPECTS(sizeof(E) + extra < 0xffff * Arena::kGranule);
    return static_cast<E&>(engine_.attach(structure, kind, sizeof(E) + extra));
  }

  Engine& engine_;
};

namespace detail {

template <auto F, class FrameType>
void execute_with_result(Scope& scope, Call& call) {
  auto& frame = FrameType::of(call);
  auto result = std::apply([&](const auto&... args) { return F(scope, args...); }, frame.args);
  auto& known = frame.tail.value;
  if (known.has_value() && same<typename SameResult<F>::type>(*known, result)) return;
  known.reset();
  known.emplace(std::move(result));
  scope.result_changed(frame.head.caller);
}

}  // namespace detail

template <auto F, class... Args>
Counts Engine::run(Args... args) {
  return run_as<F>(detail::parameters<F, false, Args...>(), std::move(args)...);
}

template <auto F, class... P, class... Args>
Counts Engine::run_as(detail::Types<P...> kept, Args&&... args) {
  using Frame = detail::Frame<detail::Nothing, detail::Nothing, P...>;
  static_assert(std::is_void_v<std::invoke_result_t<decltype(F), Scope&, const P&...>>,
                "what a program computes is in modifiables");
  const auto label = detail::make_label<&function_name<F>>(kept, std::move(args)...);
  return run_root(detail::kFunction<F, P...>, label.hash, &label, detail::constructor_of<Frame>());
}

}  // namespace sac
