// The interface of the engine for traced functions: their first argument.
//
// A traced function is a free function or a captureless object F with
//     void f(sac::Scope& s, Args... args)
// that depends only on its arguments and on what it reads through `s`. What it reads, writes, calls
// and posts happens in the order of its text. If an operation of the scope throws, the call fails:
// the function may clean up, but it must not go on as if nothing had happened.
#pragma once

#include <type_traits>
#include <utility>

#include "sac/engine.hpp"
#include "sac/internal/core.hpp"
#include "sac/internal/frame.hpp"

namespace sac {

class Agenda;

/// The interface of the engine for traced functions.
class Scope {
 public:
  template <class T, class Same = std::equal_to<>>
  using ModType = Mod<T, Same>;
  template <class T, class Same = std::equal_to<>>
  using CellType = Cell<T, Same>;
  using AgendaType = Agenda;
  static constexpr bool kTraced = true;

  explicit Scope(Core& core) : core_(core) {}

  [[nodiscard]] Engine& engine() noexcept { return core_.engine(); }
  /// The object given to Engine::set_environment. Throws: UsageError if there is none, or it is of
  /// another type.
  template <class T>
  [[nodiscard]] T& environment() const {
    return core_.environment<T>();
  }
  /// The running call. Throws: UsageError if none runs, i.e. the scope is used after its call.
  [[nodiscard]] Call& self() { return core_.self(); }

  /// Reads the value of `mod` at this point of the trace, and records the dependence. Throws:
  /// UsageError if no earlier call has written it.
  template <class T, class Same>
  const T& read(Mod<T, Same> mod);
  template <class T, class Same>
  const T& read(const Cell<T, Same>& cell);

  /// Gives `mod` a value from this point of the trace on. The same value as before invalidates no
  /// reader.
  template <class T, class Same>
  void write(Mod<T, Same> mod, std::type_identity_t<T> value);
  template <class T, class Same>
  void write(const Cell<T, Same>& cell, std::type_identity_t<T> value);

  /// Reports that the running call does `n` steps (for example, visits n elements of a chunk),
  /// which a count of calls does not show. Cost: a branch, unless weights are recorded
  /// (Engine::record_weights).
  void weigh(std::uint64_t n) {
    if (core_.engine().records_weights()) [[unlikely]]
      record_weight(n);
  }

  /// Makes a child call, or reuses an equal one ahead in the interval that runs again. If F returns
  /// a value, call() returns a reference to it, valid while the caller runs, and the caller depends
  /// on the value.
  template <auto F, class... Args>
  decltype(auto) call(Args&&... args) {
    using What = detail::CallBy<F, Args...>;
    const Ref<Call> child = request<What>(&Core::call_child, std::forward<Args>(args)...);
    if constexpr (What::function.has_result) {
      return std::as_const(*What::FrameType::of(core_.at(child)).tail.value);
    }
  }

  /// Makes a child call as the last operation of the function: it runs after the function, without
  /// native recursion. F must return nothing.
  template <auto F, class... Args>
  void tail(Args&&... args) {
    using What = detail::CallBy<F, Args...>;
    static_assert(!What::function.has_result, "a tail call has nobody to return to");
    request<What>(&Core::call_tail, std::forward<Args>(args)...);
  }

  /// The value that F(scope, args...) returns, computed once for all calls that ask for it
  /// (query.hpp): by the first one in trace order. Returns a reference, valid while the caller
  /// runs; nothing if F returns nothing. Throws: UsageError if F needs its own result.
  template <auto F, class... Args>
  decltype(auto) query(Args&&... args) {
    return query_as<F>(detail::parameters<F, false, detail::Arrived<Args>...>(),
                       std::forward<Args>(args)...);
  }

  /// Keyed allocation: a default-constructed T that keeps its address as long as (T, key) is
  /// requested again within the interval that runs again, by whichever call.
  template <class T, class... Key>
  T& make(Key&&... key) {
    return object<detail::Made<T, nullptr, detail::Kept<detail::Arrived<Key>>...>>(
        &Core::call_child, std::forward<Key>(key)...);
  }
  /// Keyed allocation of a T, which the call F(scope, object, key...) fills. The label is that of
  /// F(key...).
  template <class T, auto F, class... Key>
  T& make(Key&&... key) {
    return object<detail::MadeBy<T, F, Key...>>(&Core::call_child, std::forward<Key>(key)...);
  }
  /// As make(), but F runs as a tail call: the object is returned at once, still empty. Afterwards
  /// the function may still read and write, but not call: F runs behind that.
  template <class T, auto F, class... Key>
  T& tail_make(Key&&... key) {
    return object<detail::MadeBy<T, F, Key...>>(&Core::call_tail, std::forward<Key>(key)...);
  }

  /// Keyed allocation of a modifiable that the program writes.
  template <class T, class Same = std::equal_to<>, class... Key>
  Mod<T, Same> cell(Key&&... key);

  // --- For structures

  /// The running call's place in time, for a structure's records: it precedes what the call does
  /// behind its next child. It is valid as long as the call has an edge that was made or repeated
  /// there. Throws: std::bad_alloc.
  [[nodiscard]] Place place() { return core_.place(); }

  /// How many edges of the last execution the library's own structures look at in recall().
  static constexpr std::size_t kMostRecalled = 64;

  /// Repeats an edge of the last execution: moves the first edge E of `structure` at the same place
  /// for which `matches(const E&)` into this execution and returns it; null if there is none. The
  /// search starts where the last one ended, so edges repeated in order are found at once. It
  /// visits at most `most` edges: without that bound, a call that repeats n edges in another order
  /// takes O(n^2).
  template <class E, class Matches>
  E* recall(std::uint8_t structure, std::uint8_t kind, Matches&& matches,
            std::size_t most = ~std::size_t{0}) {
    const auto fits = [&](Edge& edge) {
      return edge.structure == structure && edge.kind == kind &&
             matches(static_cast<const E&>(edge));
    };
    return static_cast<E*>(core_.recall(fits, most));
  }

  /// Records that this call depends on something in `structure`, which `E` and `extra` bytes behind
  /// it describe. `kind` is below 64.
  template <class E>
  E& observe(std::uint8_t structure, std::uint8_t kind, std::size_t extra = 0) {
    return attach<E>(structure, kind, extra);
  }
  /// Records an effect of this call on `structure`, which `E` and `extra` bytes behind it describe.
  template <class E>
  E& effect(std::uint8_t structure, std::uint8_t kind, std::size_t extra = 0) {
    return attach<E>(structure, kind, extra);
  }

  /// Runs body(), an operation of a structure. If it throws, the running call fails, even if it
  /// catches the exception: otherwise the call would not depend on the failed operation.
  template <class Body>
  decltype(auto) guarded(Body&& body) {
    return core_.guarded(std::forward<Body>(body));
  }

 private:
  using Request = Ref<Call> (Core::*)(const Asked&);  // call_child or call_tail
  void record_weight(std::uint64_t n);
  template <auto F, class... P, class... Args>
  decltype(auto) query_as(detail::Types<P...>, Args&&... args);
  template <class What, class... Key>
  auto& object(Request how, Key&&... key) {
    const Ref<Call> made = request<What>(how, std::forward<Key>(key)...);
    return What::FrameType::of(core_.at(made)).tail.value;
  }
  template <class What, class... Args>
  Ref<Call> request(Request how, Args&&... args) {
    return core_.guarded([&] {
      const auto label = detail::make_label<What>(std::forward<Args>(args)...);
      return (core_.*how)(label.asked());
    });
  }
  template <class E>
  E& attach(std::uint8_t structure, std::uint8_t kind, std::size_t extra) {
    static_assert(std::is_base_of_v<Edge, E> && std::is_trivially_destructible_v<E>);
    SAC_EXPECTS(sizeof(E) + extra < 0xffff * Arena::kGranule);
    return core_.guarded(
        [&]() -> E& { return static_cast<E&>(core_.attach(structure, kind, sizeof(E) + extra)); });
  }

  Core& core_;
};

namespace detail {

template <auto F, class... Args>
template <class AnyFrame>
void Called<F, Args...>::execute_in(Scope& scope, Call& call) {
  auto& frame = AnyFrame::of(call);
  const auto body = [&](const auto&... args) -> decltype(auto) { return F(scope, args...); };
  if constexpr (std::is_void_v<R>) {
    std::apply(body, frame.args);
  } else {
    using Value = std::decay_t<R>;
    using Same = typename SameResult<F>::type;
    Core& core = scope.engine().core();
    Value result = std::apply(body, frame.args);
    auto& known = frame.tail.value;
    if constexpr (kKeepsOriginals<Value, Same>) {
      core.restore_original<Same>(call, nullptr, result);
    }
    if (known.has_value() && same<Same>(*known, result)) return;
    if constexpr (kKeepsOriginals<Value, Same>) {
      if (known.has_value()) core.originals().keep(call, nullptr, *known);
    }
    known.reset();
    known.emplace(std::move(result));
    core.result_changed();
  }
}

}  // namespace detail

template <auto F, class... Args>
Counts Engine::run(Args&&... args) {
  using What = detail::CallBy<F, Args...>;
  static_assert(!What::function.has_result, "what a program computes is in modifiables");
  const auto label = detail::make_label<What>(std::forward<Args>(args)...);
  return run_root(label.asked());
}

}  // namespace sac
