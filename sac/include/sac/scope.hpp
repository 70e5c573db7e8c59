// What a traced function sees of the engine: its first argument.
//
// A traced function is a free function or a captureless object F with
//     void f(sac::Scope& s, Args... args)
// that depends on nothing but its arguments and what it reads through `s`.
#pragma once

#include <memory>
#include <new>
#include <tuple>
#include <utility>

#include "sac/engine.hpp"

namespace sac {

class Scope;

namespace detail {

// A call in memory: header, then arguments.
template <class... Args>
struct Frame {
  static_assert(((alignof(Args) <= 8) && ...), "arguments in the arena are aligned to 8 bytes");
  Call call;
  std::tuple<Args...> args;
};

// A keyed allocation in memory: header, key, object.
template <class T, class... Key>
struct MakeFrame {
  static_assert(alignof(T) <= 8 && ((alignof(Key) <= 8) && ...),
                "objects in the arena are aligned to 8 bytes");
  Call call;
  std::tuple<Key...> args;
  alignas(T) std::byte storage[sizeof(T)];
  bool built = false;

  T& object() noexcept { return *std::launder(reinterpret_cast<T*>(storage)); }
};

template <class F>
bool equal_args(const Call& call, const void* args) {
  using Tuple = decltype(F::args);
  return reinterpret_cast<const F&>(call).args == *static_cast<const Tuple*>(args);
}

template <class F>
void construct_args(void* frame, const void* args) {
  using Tuple = decltype(F::args);
  ::new (&static_cast<F*>(frame)->args) Tuple(*static_cast<const Tuple*>(args));
}

template <class F>
void destroy_args(Call& call) {
  std::destroy_at(&reinterpret_cast<F&>(call).args);
}

template <class F>
void print_args(const Call& call, std::ostream& out) {
  print_arguments(out, reinterpret_cast<const F&>(call).args);
}

template <class F>
std::uint64_t hash_args(const Call& call) {
  return hash_arguments(0, reinterpret_cast<const F&>(call).args);
}

template <class F>
std::strong_ordering compare_args(const Call& a, const Call& b) {
  const auto order = reinterpret_cast<const F&>(a).args <=> reinterpret_cast<const F&>(b).args;
  return order < 0 ? std::strong_ordering::less
                   : order > 0 ? std::strong_ordering::greater : std::strong_ordering::equal;
}

// Runs F on the arguments stored in the frame.
template <auto F, class FrameType, class S>
void execute_frame(S& scope, Call& call) {
  auto& frame = reinterpret_cast<FrameType&>(call);
  std::apply([&](const auto&... args) { F(scope, args...); }, frame.args);
}

template <class F>
inline constexpr bool kTrivialArgs = std::is_trivially_destructible_v<decltype(F::args)>;

template <auto F, class... Args>
inline constexpr Function kFunction{
    .name = function_name<F>(),
    .frame_bytes = sizeof(Frame<Args...>),
    .posted = false,
    .execute = &execute_frame<F, Frame<Args...>, Scope>,
    .destroy = kTrivialArgs<Frame<Args...>> ? nullptr : &destroy_args<Frame<Args...>>,
    .equal = &equal_args<Frame<Args...>>,
    .compare = nullptr,
    .hash = &hash_args<Frame<Args...>>,
    .print = &print_args<Frame<Args...>>,
};

template <class T, class... Key>
void build_object(Scope&, Call& call) {
  auto& frame = reinterpret_cast<MakeFrame<T, Key...>&>(call);
  if (frame.built) return;
  ::new (static_cast<void*>(frame.storage)) T();
  frame.built = true;
}

template <class T, class... Key>
void destroy_object(Call& call) {
  auto& frame = reinterpret_cast<MakeFrame<T, Key...>&>(call);
  if (frame.built) frame.object().~T();
  std::destroy_at(&frame.args);
}

template <class T, class... Key>
void construct_key(void* memory, const void* key) {
  auto* frame = static_cast<MakeFrame<T, Key...>*>(memory);
  ::new (&frame->args) std::tuple<Key...>(*static_cast<const std::tuple<Key...>*>(key));
  frame->built = false;
}

template <class T, class... Key>
inline constexpr Function kMaker{
    .name = "make",
    .frame_bytes = sizeof(MakeFrame<T, Key...>),
    .posted = false,
    .execute = &build_object<T, Key...>,
    .destroy = &destroy_object<T, Key...>,
    .equal = &equal_args<MakeFrame<T, Key...>>,
    .compare = nullptr,
    .hash = &hash_args<MakeFrame<T, Key...>>,
    .print = &print_args<MakeFrame<T, Key...>>,
};

// A function's identity enters its calls' hashes by name, so that hashes are the same in every run.
constexpr std::uint64_t hash_name(std::string_view name) {
  std::uint64_t h = name.size();
  for (const char c : name) h = mix(h + static_cast<unsigned char>(c));
  return h;
}

template <class... Args>
std::uint32_t label_hash(const Function& function, const std::tuple<Args...>& args) {
  return static_cast<std::uint32_t>(hash_arguments(hash_name(function.name), args));
}

template <auto F, class... Args>
std::uint32_t label_hash(const std::tuple<Args...>& args) {
  constexpr std::uint64_t seed = hash_name(function_name<F>());
  return static_cast<std::uint32_t>(hash_arguments(seed, args));
}

}  // namespace detail

class Scope {
 public:
  template <class T>
  using ModType = Mod<T>;
  using AgendaType = Agenda;
  static constexpr bool kTraced = true;

  explicit Scope(Engine& engine) : engine_(engine) {}

  [[nodiscard]] Engine& engine() noexcept { return engine_; }
  /// The object given to Engine::set_environment.
  template <class T>
  [[nodiscard]] T& environment() const noexcept {
    return *static_cast<T*>(engine_.environment_);
  }
  /// The running call.
  [[nodiscard]] Call& self() noexcept { return *engine_.current_->call; }

  /// The value of `mod` at this point of the trace, recording the dependence.
  /// Throws: UsageError if no earlier call has written it.
  template <class T>
  const T& read(Mod<T> mod);

  /// Gives `mod` a value from here on; an equal value disturbs nobody.
  template <class T>
  void write(Mod<T> mod, T value);

  /// Makes a child call, or reuses an equal one ahead in the interval that runs again.
  template <auto F, class... Args>
  void call(Args... args) {
    using Frame = detail::Frame<Args...>;
    const std::tuple<Args...> tuple(std::move(args)...);
    engine_.call_child(detail::kFunction<F, Args...>, detail::label_hash<F>(tuple), &tuple,
                       &detail::construct_args<Frame>);
  }

  /// As call(), as the last thing that the function does: runs after it, without native recursion.
  template <auto F, class... Args>
  void tail(Args... args) {
    using Frame = detail::Frame<Args...>;
    const std::tuple<Args...> tuple(std::move(args)...);
    engine_.call_tail(detail::kFunction<F, Args...>, detail::label_hash<F>(tuple), &tuple,
                      &detail::construct_args<Frame>);
  }

  /// Keyed allocation: a default-constructed T that keeps its address while some run asks for
  /// (T, key) again within the interval that runs again, whichever call asks.
  template <class T, class... Key>
  T& make(Key... key) {
    const std::tuple<Key...> tuple(std::move(key)...);
    const auto& maker = detail::kMaker<T, Key...>;
    const Handle made = engine_.call_child(maker, detail::label_hash(maker, tuple), &tuple,
                                           &detail::construct_key<T, Key...>);
    return engine_.at<detail::MakeFrame<T, Key...>>(made)->object();
  }

  /// A keyed modifiable for the program to write.
  template <class T, class... Key>
  Mod<T> cell(Key... key);

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
  template <class E>
  E& attach(std::uint8_t structure, std::uint8_t kind, std::size_t extra) {
    static_assert(std::is_base_of_v<Edge, E> && std::is_trivially_destructible_v<E>);
    SAC_EXPECTS(sizeof(E) + extra < 0xffff * Arena::kGranule);
    return static_cast<E&>(engine_.attach(structure, kind, sizeof(E) + extra));
  }

  Engine& engine_;
};

template <auto F, class... Args>
Counts Engine::run(Args... args) {
  const std::tuple<Args...> tuple(std::move(args)...);
  return run_root(detail::kFunction<F, Args...>, detail::label_hash<F>(tuple), &tuple,
                  &detail::construct_args<detail::Frame<Args...>>);
}

}  // namespace sac
