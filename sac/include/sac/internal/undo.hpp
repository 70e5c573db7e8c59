// How to undo an edit: a move-only function without arguments. Small ones need no memory of their
// own, unlike std::function: the undo of an edit of a modifiable holds the old value in this way.
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>

namespace sac::detail {

class Undo {
 public:
  /// Throws: what moving `f` throws; std::bad_alloc if it is large.
  template <class F>
  requires(!std::is_same_v<F, Undo>) explicit Undo(F f)
      : Undo(std::in_place, small(std::move(f))) {}
  Undo(Undo&& other) noexcept : kind_(other.kind_) { kind_->move(room_, other.room_); }
  Undo& operator=(Undo&&) = delete;
  ~Undo() { kind_->destroy(room_); }

  void operator()() { kind_->call(room_); }

 private:
  template <class F>
  Undo(std::in_place_t, F f) noexcept : kind_(&kKind<F>) {
    ::new (room_) F(std::move(f));
  }
  template <class F>
  static auto small(F f) {
    if constexpr (kFits<F>) {
      return f;
    } else {
      return [f = std::make_unique<F>(std::move(f))] { (*f)(); };
    }
  }
  static constexpr std::size_t kRoom = 32;
  template <class F>
  static constexpr bool kFits =
      sizeof(F) <= kRoom &&
      alignof(F) <= alignof(std::max_align_t) && std::is_nothrow_move_constructible_v<F>;
  struct Kind {
    void (*call)(void*);
    void (*move)(void* to, void* from) noexcept;
    void (*destroy)(void*) noexcept;
  };
  template <class F>
  static constexpr Kind kKind{
      [](void* f) { (*static_cast<F*>(f))(); },
      [](void* to, void* from) noexcept { ::new (to) F(std::move(*static_cast<F*>(from))); },
      [](void* f) noexcept { static_cast<F*>(f)->~F(); }};

  alignas(std::max_align_t) std::byte room_[kRoom];
  const Kind* kind_;
};

}  // namespace sac::detail
