// Plain execution: runs the same program text without a trace.
//
// A program written as `template <class S> void operator()(S& s, ...)` runs on sac::Scope (traced)
// or on sac::PlainScope (not traced); the compiler chooses. Here modifiables are plain memory, a
// call is a function call, a tail call is a loop, and keyed allocation takes the next free bytes.
//
// All memory is freed with the scope, which is meant for one run.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "sac/check.hpp"
#include "sac/internal/parameters.hpp"
#include "sac/internal/plain_agenda.hpp"
#include "sac/internal/plain_queries.hpp"

namespace sac {

template <class T, class Same>
class PlainMod;

/// A modifiable of a plain run, as a member of an object. It cannot be copied or moved.
template <class T, class Same = std::equal_to<>>
class PlainCell {
 public:
  PlainCell() = default;
  PlainCell(const PlainCell&) = delete;
  PlainCell& operator=(const PlainCell&) = delete;

 private:
  friend class PlainMod<T, Same>;
  mutable std::optional<T> value_;
};

/// A handle of a modifiable of a plain run.
template <class T, class Same = std::equal_to<>>
class PlainMod {
 public:
  PlainMod() = default;
  PlainMod(const PlainCell<T, Same>& cell) : place_(&cell.value_) {}
  [[nodiscard]] std::optional<T>& place() const { return *place_; }
  explicit operator bool() const noexcept { return place_ != nullptr; }
  friend bool operator==(const PlainMod&, const PlainMod&) = default;
  friend std::uint64_t hash_value(const PlainMod& mod) noexcept {
    return reinterpret_cast<std::uintptr_t>(mod.place_);
  }

 private:
  std::optional<T>* place_ = nullptr;
};

namespace detail {
template <class T, class Same>
struct ArrivedAs<PlainCell<T, Same>> {
  using type = PlainMod<T, Same>;
};
}  // namespace detail

/// The counterpart of sac::Scope that records nothing.
class PlainScope {
 public:
  template <class T, class Same = std::equal_to<>>
  using ModType = PlainMod<T, Same>;
  template <class T, class Same = std::equal_to<>>
  using CellType = PlainCell<T, Same>;
  using AgendaType = PlainAgenda;
  static constexpr bool kTraced = false;

  PlainScope() = default;
  PlainScope(const PlainScope&) = delete;
  PlainScope& operator=(const PlainScope&) = delete;
  ~PlainScope() {
    drop_tail();
    for (auto it = owned_.rbegin(); it != owned_.rend(); ++it) it->destroy(it->object);
  }

  /// Reads a modifiable. Throws: UsageError if it has no value yet, or is null.
  template <class T, class Same>
  const T& read(PlainMod<T, Same> mod) {
    require_modifiable(mod);
    if (!mod.place().has_value()) throw UsageError("read of a modifiable that nobody has written");
    return *mod.place();
  }
  template <class T, class Same>
  const T& read(const PlainCell<T, Same>& cell) {
    return read(PlainMod<T, Same>(cell));
  }
  template <class T, class Same>
  void write(PlainMod<T, Same> mod, std::type_identity_t<T> value) {
    require_modifiable(mod);
    mod.place() = std::move(value);
  }
  template <class T, class Same>
  void write(const PlainCell<T, Same>& cell, std::type_identity_t<T> value) {
    write(PlainMod<T, Same>(cell), std::move(value));
  }

  void weigh(std::uint64_t) noexcept {}

  /// Calls F; returns what it returns, by value.
  template <auto F, class... Args>
  auto call(Args&&... args) {
    return call_kept<F, detail::Arrived<Args>...>(std::forward<Args>(args)...);
  }
  template <auto F, class... Args>
  void tail(Args&&... args) {
    set_tail([](PlainScope& s, const Kept<Args>&... stored) { F(s, stored...); },
             Kept<Args>(std::forward<Args>(args))...);
  }

  /// The value that F returns, computed once for each label (query.hpp).
  template <auto F, class... Args>
  decltype(auto) query(Args&&... args) {
    const auto& value = queries_.answer<F>(
        std::tuple<Kept<Args>...>(std::forward<Args>(args)...),
        [this](const Kept<Args>&... kept) {
          require_no_tail();
          return F(*this, kept...);
        },
        [this] { run_tails(); });
    using R = std::invoke_result_t<decltype(F), PlainScope&, const Kept<Args>&...>;
    if constexpr (!std::is_void_v<R>) return value;
  }

  /// Makes a default-constructed T.
  template <class T, class... Key>
  T& make(Key&&...) {
    T& object = *::new (allocate(sizeof(T), alignof(T))) T();
    if constexpr (!std::is_trivially_destructible_v<T>) {
      owned_.push_back({&object, [](void* o) { static_cast<T*>(o)->~T(); }});
    }
    return object;
  }
  /// Makes a T and fills it by F(scope, object, key...).
  template <class T, auto F, class... Key>
  T& make(Key&&... key) {
    require_no_tail();
    T& object = make<T>();
    fill<F, T, detail::Arrived<Key>...>(object, std::forward<Key>(key)...);
    run_tails();
    return object;
  }
  /// Makes a T; F(scope, object, key...) fills it after the running function.
  template <class T, auto F, class... Key>
  T& tail_make(Key&&... key) {
    T& object = make<T>();
    set_tail([](PlainScope& s, T* o, const Kept<Key>&... stored) { F(s, *o, stored...); }, &object,
             Kept<Key>(std::forward<Key>(key))...);
    return object;
  }
  template <class T, class Same = std::equal_to<>, class... Key>
  PlainMod<T, Same> cell(Key&&...) {
    return make<PlainCell<T, Same>>();
  }

  template <class T>
  void set_environment(T* environment) noexcept {
    environment_ = const_cast<std::remove_const_t<T>*>(environment);
    environment_type_ =
        environment != nullptr ? &detail::kTypeName<std::remove_const_t<T>> : nullptr;
  }
  /// Throws: UsageError if there is none, or it is of another type.
  template <class T>
  [[nodiscard]] T& environment() const {
    using Type = std::remove_cv_t<T>;
    if (environment_type_ != &detail::kTypeName<Type>) require_environment(detail::kTypeName<Type>);
    return *static_cast<T*>(environment_);
  }

  /// The functions of sac::Engine for clients.
  template <class T, class Same = std::equal_to<>>
  PlainMod<T, Same> input(T value) {
    const PlainMod<T, Same> mod = cell<T, Same>();
    mod.place() = std::move(value);
    return mod;
  }
  template <class T, class Same>
  void set(PlainMod<T, Same> mod, std::type_identity_t<T> value) {
    write(mod, std::move(value));
  }
  template <class T, class Same>
  void set(const PlainCell<T, Same>& cell, std::type_identity_t<T> value) {
    write(cell, std::move(value));
  }
  template <class M>
  [[nodiscard]] bool has_value(const M& mod) const {
    return PlainMod(mod).place().has_value();
  }
  template <class M>
  decltype(auto) get(const M& mod) {
    return read(mod);
  }
  /// If it throws, the next run begins anew; what has been written stays.
  template <auto F, class... Args>
  void run(Args&&... args) {
    try {
      call<F>(std::forward<Args>(args)...);
    } catch (...) {
      drop_tail();
      throw;
    }
  }
  PlainAgenda& make_agenda(std::string name, const KeyWidths& widths = {}) {
    widths.require_possible(name);
    PlainAgenda& agenda = make<PlainAgenda>();
    agenda.name_ = std::move(name);
    agenda.widths_ = widths;
    return agenda;
  }

  void run_tails() {
    while (tail_ != nullptr) std::exchange(tail_, nullptr)(*this, true);
  }

 private:
  static constexpr std::size_t kTailBytes = 256;
  static constexpr std::size_t kBlock = std::size_t{1} << 18;

  struct Owned {
    void* object;
    void (*destroy)(void*);
  };

  // As what an argument waits for a tail call.
  template <class T>
  using Kept = detail::Kept<detail::Arrived<T>>;

  template <auto F, class... P>
  auto call_kept(P... args) {
    require_no_tail();
    if constexpr (std::is_void_v<std::invoke_result_t<decltype(F), PlainScope&, P&...>>) {
      F(*this, args...);
      run_tails();
    } else {
      std::decay_t<std::invoke_result_t<decltype(F), PlainScope&, P&...>> result =
          F(*this, args...);
      run_tails();
      return result;
    }
  }
  template <auto F, class T, class... P>
  void fill(T& object, P... key) {
    F(*this, object, key...);
  }
  template <class T, class Same>
  static void require_modifiable(PlainMod<T, Same> mod) {
    if (!mod) throw UsageError("a modifiable that is null is read or written");
  }
  void require_environment(std::string_view type) const {
    if (environment_type_ != nullptr && *environment_type_ == type) return;
    throw UsageError("there is no environment, or it is of another type");
  }
  void drop_tail() {
    if (tail_ != nullptr) std::exchange(tail_, nullptr)(*this, false);
  }
  void require_no_tail() const {
    if (tail_ != nullptr) throw UsageError("call: a tail call must be the last thing done");
  }

  template <class Body, class... Args>
  void set_tail(Body, Args... args) {
    using Tuple = std::tuple<Args...>;
    static_assert(sizeof(Tuple) <= kTailBytes && alignof(Tuple) <= 16);
    require_no_tail();
    ::new (static_cast<void*>(tail_args_)) Tuple(std::move(args)...);
    tail_ = [](PlainScope& s, bool runs) {
      Tuple* stored = std::launder(reinterpret_cast<Tuple*>(s.tail_args_));
      const Tuple mine(std::move(*stored));
      stored->~Tuple();
      if (!runs) return;
      std::apply([&](const auto&... a) { Body{}(s, a...); }, mine);
    };
  }

  void* allocate(std::size_t bytes, std::size_t alignment) {
    used_ = (used_ + alignment - 1) / alignment * alignment;
    if (used_ + bytes > block_bytes_) {
      block_bytes_ = bytes > kBlock ? bytes : kBlock;
      blocks_.push_back(std::make_unique_for_overwrite<std::byte[]>(block_bytes_));
      used_ = 0;
    }
    return blocks_.back().get() + std::exchange(used_, used_ + bytes);
  }

  void* environment_ = nullptr;
  const std::string_view* environment_type_ = nullptr;
  void (*tail_)(PlainScope&, bool runs) = nullptr;
  alignas(16) std::byte tail_args_[kTailBytes];
  std::vector<std::unique_ptr<std::byte[]>> blocks_;
  std::size_t block_bytes_ = 0;
  std::size_t used_ = 0;
  std::vector<Owned> owned_;
  PlainQueries queries_;
};

}  // namespace sac
