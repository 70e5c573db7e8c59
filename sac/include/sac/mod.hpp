// Modifiables: memory whose readers run again when it changes.
//
// A modifiable is a chain of versions in trace order, the first one in place; with a single write
// the chain is one version and a read checks one pointer more than a plain load would. Each version
// lists its readers. A write that appears between two others takes over the readers behind it.
//
// Example (imperative): call A writes 1, call B reads 1, call C writes 2, call D reads 2.
#pragma once

#include <compare>
#include <new>
#include <ostream>
#include <utility>

#include "sac/engine.hpp"
#include "sac/scope.hpp"

namespace sac {

namespace detail {

// One value over a stretch of the trace: 16 bytes, value behind it.
struct Version {
  Handle writer = 0;   // the call that wrote it; 0: the outside
  Handle readers = 0;  // chain of ReadEdges
  Handle next = 0;     // next version in trace order
  bool written = false;
  bool outside = false;  // written by Engine::input / set
};
static_assert(sizeof(Version) == 16);

template <class T>
struct TypedVersion : Version {
  static_assert(alignof(T) <= 8, "values in the arena are aligned to 8 bytes");
  alignas(T) std::byte storage[sizeof(T)];
  T& value() noexcept { return *std::launder(reinterpret_cast<T*>(storage)); }
};

struct ReadEdge : Edge {
  Handle version;
  Handle call;
  Handle prev;  // previous reader; 0: first
  Handle next_reader;
};
static_assert(sizeof(ReadEdge) == 24);

// How to compare, destroy and move the value of a version, and how large the version is.
struct ValueOps {
  bool (*equal)(Version&, Version&);
  void (*destroy)(Version&);
  void (*move)(Version& from, Version& to);  // leaves `from` without a value
  std::uint32_t bytes;
};

struct WriteEdge : Edge {
  Handle head;  // first version of the modifiable
  Handle version;
  const ValueOps* ops;
};
static_assert(sizeof(WriteEdge) == 24);

template <class T>
inline constexpr ValueOps kValueOps{
    [](Version& a, Version& b) {
      return static_cast<TypedVersion<T>&>(a).value() == static_cast<TypedVersion<T>&>(b).value();
    },
    [](Version& v) { static_cast<TypedVersion<T>&>(v).value().~T(); },
    [](Version& from, Version& to) {
      T& old = static_cast<TypedVersion<T>&>(from).value();
      ::new (static_cast<void*>(static_cast<TypedVersion<T>&>(to).storage)) T(std::move(old));
      old.~T();
    },
    sizeof(TypedVersion<T>)};

}  // namespace detail

/// A handle of a modifiable holding a T; 4 bytes, copied freely.
template <class T>
class Mod {
 public:
  Mod() = default;
  explicit Mod(Handle head) : head_(head) {}
  [[nodiscard]] Handle head() const noexcept { return head_; }
  explicit operator bool() const noexcept { return head_ != 0; }
  friend auto operator<=>(const Mod&, const Mod&) = default;
  friend std::uint64_t hash_value(const Mod& m) noexcept { return m.head_; }
  friend std::ostream& operator<<(std::ostream& out, const Mod& m) { return out << '@' << m.head_; }

 private:
  Handle head_ = 0;
};

/// The untyped half of modifiables: versions, readers, and who must run again.
class ModStructure final : public Structure {
 public:
  static constexpr std::uint8_t kRead = 0;
  static constexpr std::uint8_t kWrite = 1;

  explicit ModStructure(Engine& engine) : engine_(engine), id_(engine.add_structure(*this)) {}

  /// The version that the running call sees, with the read recorded.
  detail::Version& observe(Scope& scope, Handle head);

  struct Slot {
    detail::Version* version;
    bool fresh;  // the value is not constructed yet
  };
  /// The running call's own version: last time's, confirmed, or a fresh one in its place.
  Slot own_version(Scope& scope, Handle head, const detail::ValueOps& ops);
  /// The value of `version` changed: its readers run again.
  void changed(Scope& scope, detail::Version& version);
  /// A fresh version got its value: takes over the readers behind it; those of an equal value do
  /// not run again.
  void appeared(Scope& scope, Handle head, detail::Version& version, bool same_as_before);
  /// The written version before `version` in the chain; null if none.
  detail::Version* before(Handle head, const detail::Version& version) const noexcept;
  /// The last version of the chain. Throws: UsageError if nothing is written.
  detail::Version& last(Handle head) const;
  void invalidate_readers(detail::Version& version) noexcept;

  void retract(Call& call, Edge& edge) noexcept override;
  /// Throws: InvariantError unless the versions of the modifiable are in trace order and every
  /// reader is at the version that it sees.
  void check_invariants(Handle head) const;
  /// The same for the modifiables whose first version `call` wrote.
  void check_writes(const Call& call) const;

 private:
  [[nodiscard]] detail::Version* at(Handle h) const noexcept {
    return engine_.arena().at<detail::Version>(h);
  }
  [[nodiscard]] detail::ReadEdge* reader(Handle h) const noexcept {
    return engine_.arena().at<detail::ReadEdge>(h);
  }
  bool sees(const Call& call, const detail::Version& version) const;
  bool unconfirmed(const detail::Version& version) const noexcept;
  void vacate(Handle head, const detail::ValueOps& ops);
  void link_reader(detail::ReadEdge& edge, detail::Version& version) noexcept;
  void unlink_reader(detail::ReadEdge& edge) noexcept;
  void move_readers(detail::Version& from, detail::Version& to, const Call* later_than,
                    bool invalidate) noexcept;
  void require_ahead(const Call& reader, const detail::Version& version, Handle head) const;
  [[noreturn]] void fail_unwritten(const Call& reader, Handle head) const;
  void require_unread(Scope& scope, const detail::Version& version) const;

  Engine& engine_;
  std::uint8_t id_;
};

namespace detail {

template <class T>
Handle new_mod(Engine& engine) {
  const Handle h = engine.arena().allocate(sizeof(TypedVersion<T>));
  ::new (engine.arena().at<void>(h)) TypedVersion<T>();
  return h;
}

template <class T>
void destroy_mod(Engine& engine, Handle head) {
  auto& version = *engine.arena().at<TypedVersion<T>>(head);
  if (version.written) version.value().~T();
  engine.arena().release(head, sizeof(TypedVersion<T>));
}

// A modifiable as a keyed object: the first version in place, where a handle can point.
template <class T>
struct Cell {
  alignas(Arena::kGranule) TypedVersion<T> version;
  ~Cell() {
    if (version.written) version.value().~T();
  }
};

}  // namespace detail

template <class T>
Mod<T> Engine::cell() {
  require_usable();
  outside_mods_.reserve(outside_mods_.size() + 1 > outside_mods_.capacity()
                            ? 2 * outside_mods_.size() + 16
                            : outside_mods_.capacity());
  const Handle head = detail::new_mod<T>(*this);
  outside_mods_.emplace_back(head, &detail::destroy_mod<T>);
  return Mod<T>(head);
}

template <class T>
Mod<T> Engine::input(T value) {
  const Mod<T> mod = cell<T>();
  auto& version = *at<detail::TypedVersion<T>>(mod.head());
  ::new (static_cast<void*>(version.storage)) T(std::move(value));
  version.written = version.outside = true;
  return mod;
}

template <class T>
void Engine::set(Mod<T> mod, T value) {
  begin_edit();
  auto& version = *at<detail::TypedVersion<T>>(mod.head());
  if (!version.outside) throw UsageError("set: this modifiable is written by the program");
  if (version.value() == value) return;
  auto undo = [this, mod, old = version.value()]() mutable {
    auto& v = *at<detail::TypedVersion<T>>(mod.head());
    std::swap(v.value(), old);
    mods_->invalidate_readers(v);
  };
  on_rollback(std::move(undo));
  version.value() = std::move(value);
  mods_->invalidate_readers(version);
}

template <class T>
const T& Engine::get(Mod<T> mod) const {
  return static_cast<detail::TypedVersion<T>&>(mods_->last(mod.head())).value();
}

template <class T>
const T& Scope::read(Mod<T> mod) {
  auto& version = engine_.mods_->observe(*this, mod.head());
  return static_cast<detail::TypedVersion<T>&>(version).value();
}

template <class T>
void Scope::write(Mod<T> mod, T value) {
  ModStructure& mods = *engine_.mods_;
  const auto slot = mods.own_version(*this, mod.head(), detail::kValueOps<T>);
  auto& version = static_cast<detail::TypedVersion<T>&>(*slot.version);
  if (!slot.fresh) {
    if (version.value() == value) return;
    version.value() = std::move(value);
    return mods.changed(*this, version);
  }
  ::new (static_cast<void*>(version.storage)) T(std::move(value));
  version.written = true;
  auto* before = static_cast<detail::TypedVersion<T>*>(mods.before(mod.head(), version));
  mods.appeared(*this, mod.head(), version,
                before != nullptr && before->value() == version.value());
}

template <class T, class... Key>
Mod<T> Scope::cell(Key... key) {
  return Mod<T>(engine_.arena_.handle_of(&make<detail::Cell<T>>(std::move(key)...).version));
}

}  // namespace sac
