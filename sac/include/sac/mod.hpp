// Modifiables: memory whose readers run again when it changes.
//
// A modifiable has one version of its value for each call that writes it, in trace order; a read
// sees the last version before it. internal/mod_structure.hpp describes how versions and readers
// are kept.
//
// Equality: writing a value that is the same as the old one invalidates no reader. The default
// comparison is ==, which must mean that either value may replace the other everywhere; for
// floating-point numbers it is equality of their bits (so -0.0 is not 0.0, and a NaN equals
// itself). With a coarser `Same` of your own, a modifiable keeps whichever of two same values came
// first: results then equal those of a run from scratch only up to that Same. A roll-back restores
// the exact values.
//
// Handles: a modifiable lives as long as the object that contains it: until its release, or until
// no call makes it any more. With SAC_CHECKS a handle knows its engine and its modifiable, and the
// use of a handle of another engine, or of a modifiable that no longer exists, throws UsageError.
// Without SAC_CHECKS such a use is not detected: it reads and changes whatever is at that address.
//
// Example (imperative): call A writes 1, call B reads 1, call C writes 2, call D reads 2.
#pragma once

#include <compare>
#include <functional>
#include <memory>
#include <new>
#include <ostream>
#include <type_traits>
#include <utility>

#include "sac/engine.hpp"
#include "sac/internal/mod_structure.hpp"
#include "sac/internal/watches.hpp"
#include "sac/scope.hpp"

namespace sac {

/// A handle of a modifiable that holds a T; 4 bytes (8 with SAC_CHECKS), cheap to copy.
template <class T, class Same>
class Mod {
 public:
  Mod() = default;
  /// The modifiable at a handle. Requires: it is one of this type.
  explicit Mod(ModRef head) : head_(head) {}
  /// The modifiable of a cell. Requires: the cell is part of an object that an engine made.
  Mod(const Cell<T, Same>& cell)
      : head_(Arena::ref<detail::Version>(cell.version_)), stamp_(cell.version_.stamp_in_arena()) {}
  [[nodiscard]] ModRef head() const noexcept { return head_; }
  [[nodiscard]] detail::Stamp stamp() const noexcept { return stamp_; }
  explicit operator bool() const noexcept { return head_ != nullptr; }
  friend bool operator==(const Mod& a, const Mod& b) noexcept { return a.head_ == b.head_; }
  friend auto operator<=>(const Mod& a, const Mod& b) noexcept {
    return a.head_.handle() <=> b.head_.handle();
  }
  friend std::uint64_t hash_value(const Mod& m) noexcept { return m.head_.handle(); }
  friend std::ostream& operator<<(std::ostream& out, const Mod& m) {
    return out << '@' << m.head_.handle();
  }

 private:
  ModRef head_;
  [[no_unique_address]] detail::Stamp stamp_;
};

/// A modifiable as a member of an object that an engine made. It cannot be copied or moved.
template <class T, class Same>
class alignas(Arena::kGranule) Cell {
 public:
  Cell() = default;
  Cell(const Cell&) = delete;
  Cell& operator=(const Cell&) = delete;
  ~Cell() { version_.end(); }

 private:
  friend class Mod<T, Same>;
  mutable detail::TypedVersion<T> version_;
};

template <class T>
T& Engine::make() {
  begin_edit("make");
  return make_inside<T>();
}

template <class T, class... Args>
T& Engine::make_inside(Args&&... args) {
  static_assert(alignof(T) <= 8, "objects in the arena are aligned to 8 bytes");
  const Ref<OutsideHead> head = new_outside(kOutsideType<T>);
  try {
    return *::new (static_cast<void*>(&arena()[head] + 1)) T(std::forward<Args>(args)...);
  } catch (...) {
    outside_.pop_back();
    arena().release(head, kOutsideType<T>.bytes);
    throw;
  }
}

template <class T>
void Engine::release(T& object) {
  release_outside(&object, "object");
}
template <class T, class Same>
void Engine::release(Mod<T, Same> mod) {
  begin_edit("release");
  mods_->require_live(mod.head(), mod.stamp(), "release");
  release_outside(&arena()[mod.head()], "modifiable");
}

template <class T, class Same>
Mod<T, Same> Engine::cell() {
  return make<Cell<T, Same>>();
}

template <class T, class Same>
Mod<T, Same> Engine::input(T value) {
  begin_edit("input");
  const std::uint16_t type = mods_->number(detail::kValueType<T, Same>);
  const Mod<T, Same> mod = cell<T, Same>();
  mods_->make_input(mod.head(), type, std::move(value));
  return mod;
}

template <class T, class Same>
void Engine::set(Mod<T, Same> mod, std::type_identity_t<T> value) {
  static_assert(
      std::is_copy_constructible_v<T>,
      "set keeps a copy of the old value, to take the edit back: a value that only moves is "
      "written by calls; hold it by a shared pointer");
  begin_edit("set");
  mods_->require_live(mod.head(), mod.stamp(), "set");
  if (!mods_->is_input(mod.head())) {
    mods_->require_unwritten(mod.head());
    const std::uint16_t type = mods_->number(detail::kValueType<T, Same>);
    on_rollback([this, head = mod.head()] { mods_->unmake_input(head); });
    return mods_->make_input(mod.head(), type, std::move(value));
  }
  const T& old = mods_->template value<T>(mod.head());
  if (detail::same<Same>(old, value)) return;
  on_rollback(
      [this, head = mod.head(), old]() mutable { mods_->change_input(head, std::move(old)); });
  mods_->change_input(mod.head(), std::move(value));
}

template <class T, class Same>
void Engine::set_unrecorded(const Cell<T, Same>& cell, std::type_identity_t<T> value) {
  const ModRef head = Mod<T, Same>(cell).head();
  if (mods_->is_input(head)) return mods_->change_input(head, std::move(value));
  const std::uint16_t type = mods_->number(detail::kValueType<T, Same>);
  mods_->make_input(head, type, std::move(value));
}

template <class T, class Same>
void Engine::unset_unrecorded(const Cell<T, Same>& cell) noexcept {
  mods_->unmake_input(Mod<T, Same>(cell).head());
}

template <class T, class Same>
void Engine::set(const Cell<T, Same>& cell, std::type_identity_t<T> value) {
  require_own(&cell, "set: the cell");
  set(Mod<T, Same>(cell), std::move(value));
}

template <class T, class Same>
const T& Engine::get(Mod<T, Same> mod) const {
  require_settled("get");
  mods_->require_live(mod.head(), mod.stamp(), "get");
  return detail::value_of<T>(mods_->last(mod.head()));
}

template <class T, class Same>
const T& Engine::get(const Cell<T, Same>& cell) const {
  require_own(&cell, "get: the cell");
  return get(Mod<T, Same>(cell));
}

template <class T, class Same>
bool Engine::has_value(Mod<T, Same> mod) const {
  require_settled("has_value");
  mods_->require_live(mod.head(), mod.stamp(), "has_value");
  return mods_->newest(mod.head()) != nullptr;
}

template <class T, class Same>
void Engine::watch(Mod<T, Same> mod) {
  static_cast<void>(watch_of(mod));
}

template <class T, class Same>
void Engine::on_change(Mod<T, Same> mod, std::type_identity_t<std::function<void(const T&)>> f) {
  watch_of(mod).add(std::move(f));
}

template <class T, class Same>
detail::TypedWatch<T, Same>& Engine::watch_of(Mod<T, Same> mod) {
  static_assert(std::is_copy_constructible_v<T>, "the value of a watched modifiable is copied");
  require_idle("on_change");
  if (!settled()) throw UsageError("on_change: propagate the edits first");
  mods_->require_live(mod.head(), mod.stamp(), "on_change");
  settings.watching = true;
  return watches_->template at<T, Same>(mod.head());
}

template <class T, class Same>
void Engine::unwatch(Mod<T, Same> mod) noexcept {
  watches_->drop(mod.head());
}

template <class T, class Same>
bool Engine::changed(Mod<T, Same> mod) const noexcept {
  return watches_->has_changed(mod.head());
}

template <class T, class Same>
const T& Scope::read(Mod<T, Same> mod) {
  return core_.guarded([&]() -> const T& {
    ModStructure& mods = engine().mods();
    mods.require_live(mod.head(), mod.stamp(), "read");
    return static_cast<detail::TypedVersion<T>&>(mods.observe(mod.head())).value();
  });
}

template <class T, class Same>
const T& Scope::read(const Cell<T, Same>& cell) {
  core_.guarded([&] { core_.require_own(&cell, "read: the cell"); });
  return read(Mod<T, Same>(cell));
}

template <class T, class Same>
void Scope::write(Mod<T, Same> mod, std::type_identity_t<T> value) {
  core_.guarded([&] {
    ModStructure& mods = engine().mods();
    mods.require_live(mod.head(), mod.stamp(), "write");
    mods.template write<T, Same>(mod.head(), std::move(value));
  });
}

template <class T, class Same>
void Scope::write(const Cell<T, Same>& cell, std::type_identity_t<T> value) {
  core_.guarded([&] { core_.require_own(&cell, "write: the cell"); });
  write(Mod<T, Same>(cell), std::move(value));
}

template <class T, class Same, class... Key>
Mod<T, Same> Scope::cell(Key&&... key) {
  return make<Cell<T, Same>>(std::forward<Key>(key)...);
}

}  // namespace sac
