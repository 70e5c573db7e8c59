// Modifiables: memory whose readers run again when it changes.
//
// A modifiable is one version of its value per call that writes it, in trace order; a read sees the
// last one before it. The version of the only writer lies in place, where the modifiable's handle
// points, and a read checks one number more than a plain load would. With more writers a `History`
// keeps the versions in order: O(log) a read or write. Each version lists its readers; a write that
// appears between two others takes over the readers behind it. Where it had to pass many others to
// find them, the readers of that version are kept in order from then on.
//
// Example (imperative): call A writes 1, call B reads 1, call C writes 2, call D reads 2.
#pragma once

#include <compare>
#include <functional>
#include <memory>
#include <new>
#include <ostream>
#include <type_traits>
#include <unordered_map>
#include <utility>
#include <vector>

#include "sac/engine.hpp"
#include "sac/scope.hpp"
#include "sac/internal/trace_order.hpp"

namespace sac {

namespace detail {

// One value over a stretch of the trace: 16 bytes, value behind it.
struct Version {
  Handle writer = 0;   // the call that wrote it; 0: the outside
  Handle readers = 0;  // chain of ReadEdges
  // In place: the number of the modifiable's History; 0: this version is all there is.
  // Apart: the handle of the modifiable.
  std::uint32_t history = 0;
  std::uint16_t type = 0;
  bool written : 1 = false;
  bool outside : 1 = false;  // an input
  bool apart : 1 = false;    // not where the modifiable's handle points
  bool past : 1 = false;     // apart, and gone: kept for those who have seen it, until their turn
  bool ordered : 1 = false;  // its readers are in reader_orders_ as well
};
static_assert(sizeof(Version) == 16);

template <class T>
struct TypedVersion : Version {
  static_assert(alignof(T) <= 8, "values in the arena are aligned to 8 bytes");
  static_assert(std::is_nothrow_move_constructible_v<T> && std::is_nothrow_move_assignable_v<T>,
                "a value that may throw when it is moved would be lost: hold it by a pointer");
  alignas(T) std::byte storage[sizeof(T)];
  T& value() noexcept { return *std::launder(reinterpret_cast<T*>(storage)); }
  const T& value() const noexcept { return *std::launder(reinterpret_cast<const T*>(storage)); }
};

// The versions of a modifiable that more than one call writes, in trace order.
struct History {
  Handle head = 0;
  TraceOrder versions;
};

struct ReadEdge : Edge {
  Handle version;  // what it saw; 0: that is gone, and the call is invalid
  Handle call;
  Handle prev;  // previous reader; 0: first
  Handle next_reader;
};
static_assert(sizeof(ReadEdge) == 24);

struct WriteEdge : Edge {
  Handle head;  // the modifiable
  Handle version;
};
static_assert(sizeof(WriteEdge) == 16);

// What can be done with a version without knowing the type of its value.
struct ValueType {
  bool (*same)(const Version&, const Version&);
  void (*destroy)(Version&);
  void (*move)(Version& from, Version& to);  // leaves `from` without a value
  void (*print)(const Version&, std::ostream&);
  void (*label)(const Version&, LabelSink&);
  std::uint32_t bytes;
};

template <class T, class Same>
inline constexpr ValueType kValueType{
    [](const Version& a, const Version& b) {
      return same<Same>(static_cast<const TypedVersion<T>&>(a).value(),
                        static_cast<const TypedVersion<T>&>(b).value());
    },
    [](Version& v) { static_cast<TypedVersion<T>&>(v).value().~T(); },
    [](Version& from, Version& to) {
      T& value = static_cast<TypedVersion<T>&>(from).value();
      ::new (static_cast<void*>(static_cast<TypedVersion<T>&>(to).storage)) T(std::move(value));
      value.~T();
    },
    [](const Version& v, std::ostream& out) {
      print_argument(out, static_cast<const TypedVersion<T>&>(v).value(), &v);
    },
    [](const Version& v, LabelSink& sink) {
      name_argument(sink, static_cast<const TypedVersion<T>&>(v).value());
    },
    sizeof(TypedVersion<T>)};

}  // namespace detail

/// A handle of a modifiable holding a T; 4 bytes, copied freely. A new value that is `Same` as the
/// old one disturbs nobody.
template <class T, class Same>
class Mod {
 public:
  Mod() = default;
  explicit Mod(Handle head) : head_(head) {}
  /// Requires: the cell lies in an object that an engine made.
  Mod(const Cell<T, Same>& cell) : head_(Arena::locate(&cell)) {}
  [[nodiscard]] Handle head() const noexcept { return head_; }
  explicit operator bool() const noexcept { return head_ != 0; }
  friend auto operator<=>(const Mod&, const Mod&) = default;
  friend std::uint64_t hash_value(const Mod& m) noexcept { return m.head_; }
  friend std::ostream& operator<<(std::ostream& out, const Mod& m) { return out << '@' << m.head_; }

 private:
  Handle head_ = 0;
};

/// A modifiable as a member of an object that an engine made. Neither copied nor moved.
template <class T, class Same>
class alignas(Arena::kGranule) Cell {
 public:
  Cell() = default;
  Cell(const Cell&) = delete;
  Cell& operator=(const Cell&) = delete;
  ~Cell();

 private:
  friend class Engine;
  friend class Scope;
  detail::TypedVersion<T> version_;
};

/// The untyped half of modifiables: versions, readers, and who must run again.
class ModStructure final : public Structure {
 public:
  static constexpr std::uint8_t kRead = 0;
  static constexpr std::uint8_t kWrite = 1;

  explicit ModStructure(Engine& engine) : engine_(engine), id_(engine.add_structure(*this)) {}

  /// The version that the running call sees, with the read recorded.
  detail::Version& observe(Scope& scope, Handle head);

  /// The running call's own version: last time's, confirmed; null if it has none.
  detail::Version* own_version(Scope& scope, Handle head);
  /// The last version before the running call, which has none; null if there is none.
  [[nodiscard]] detail::Version* before(Scope& scope, Handle head) const;
  /// A version for the running call, without a value yet: to be given one at once.
  detail::Version& new_version(Scope& scope, Handle head, const detail::ValueType& type);
  /// Throws: UsageError if the running call's own children have read `version`: then it may not
  /// change.
  void require_unread(Scope& scope, Handle head, const detail::Version& version);
  /// Takes the value of `version` out, to be given another at once; its readers are in doubt.
  void replace(Handle head, detail::Version& version) noexcept;
  /// A new version has its value: takes over the readers of `previous` that are behind it if its
  /// value is the same; else they are in doubt.
  void appeared(Scope& scope, Handle head, detail::Version& version, detail::Version* previous,
                bool same) noexcept;
  /// The last version. Throws: UsageError if nothing is written.
  [[nodiscard]] detail::Version& last(Handle head) const;
  /// Whether a call in doubt would read the values that it has read; if so, it is in no doubt any
  /// more. Throws: what comparing values throws. Cost: O(log versions) a read.
  [[nodiscard]] bool reads_the_same(Call& call);
  /// `call` wrote something last time (`old_edges`) that it has not repeated: what up to `end` has
  /// seen it is in doubt.
  void hide_unconfirmed(const Call& call, Handle end, Handle old_edges) noexcept;

  /// The number of a type of values. Throws: std::bad_alloc.
  [[nodiscard]] std::uint16_t number(const detail::ValueType& type) { return types_.number(type); }

  /// A call that reads or writes a modifiable in the `bytes` from `from`, and which.
  struct Use {
    const Call* call = nullptr;  // null: none does
    Handle head = 0;
    bool writes = false;
  };
  [[nodiscard]] Use use_within(Handle from, std::size_t bytes) const noexcept;

  void retract(Call& call, Edge& edge) noexcept override;
  void label(const Call& call, const Edge& edge, LabelSink& sink) const override;
  void print(const Call& call, const Edge& edge, std::ostream& out) const override;

  [[nodiscard]] std::size_t bytes() const noexcept;
  /// Forgets what can be found anew. Throws: std::bad_alloc, and then loses nothing else.
  void shrink();
  /// Destroys the values that `call` wrote, and the past ones that it has seen: the engine ends.
  void destroy_values(const Call& call) noexcept;
  /// Throws: InvariantError unless the versions of the modifiable are in trace order and every
  /// reader is at the version that it sees.
  void check_invariants(Handle head) const;
  /// The same for the modifiables that `call` wrote.
  void check_writes(const Call& call) const;

 private:
  [[nodiscard]] detail::Version* at(Handle h) const noexcept {
    return engine_.arena().at<detail::Version>(h);
  }
  [[nodiscard]] detail::ReadEdge* reader(Handle h) const noexcept {
    return engine_.arena().at<detail::ReadEdge>(h);
  }
  [[nodiscard]] Handle handle_of(const detail::Version& version) const noexcept {
    return engine_.arena().handle_of(&version);
  }
  [[nodiscard]] const Call& writer(const detail::Version& version) const noexcept {
    return engine_.call(version.writer);
  }
  // Orders versions by their writers; handle 0 stands for `probe`.
  [[nodiscard]] auto order(const Call* probe = nullptr) const noexcept {
    return [this, probe](Handle a, Handle b) {
      const Call& x = a != 0 ? writer(*at(a)) : *probe;
      const Call& y = b != 0 ? writer(*at(b)) : *probe;
      return engine_.precedes(x, y);
    };
  }
  [[nodiscard]] detail::History& history(std::uint32_t number) noexcept {
    return histories_[number];
  }
  [[nodiscard]] const detail::History& history(std::uint32_t number) const noexcept {
    return histories_[number];
  }
  [[nodiscard]] detail::Version* seen_by(const Call& call, Handle head) const;
  [[nodiscard]] detail::Version* find_own(const Call& call, Handle head) const noexcept;
  [[nodiscard]] bool unconfirmed(const detail::Version& version) const noexcept;
  [[nodiscard]] Use use_of(Handle head) const noexcept;
  [[nodiscard]] std::uint32_t new_history(Handle head);
  void drop_history(Handle head) noexcept;
  [[nodiscard]] detail::Version* predecessor(Handle head,
                                             const detail::Version& version) const noexcept;
  void forget_version(Handle head, detail::Version& version) noexcept;
  // Orders readers by their calls; handle 0 stands for `probe`.
  [[nodiscard]] auto reader_order(const Call* probe = nullptr) const noexcept {
    return [this, probe](Handle a, Handle b) {
      const Call& x = a != 0 ? engine_.call(reader(a)->call) : *probe;
      const Call& y = b != 0 ? engine_.call(reader(b)->call) : *probe;
      return &x == &y ? a != 0 && b != 0 && a < b : engine_.precedes(x, y);
    };
  }
  // Visits the readers of `version` behind `call`, and before time stamp `end` unless that is 0, in
  // any order, until `visit` returns false; it may unlink the one that it is given. Cost: O(log) a
  // reader visited; the first time that many others are passed, O(log) for each of these.
  template <class Visit>
  void for_each_reader_behind(const detail::Version& version, const Call& call, Handle end,
                              Visit&& visit);
  void order_readers(const detail::Version& version) noexcept;
  void forget_order(detail::Version& version) noexcept;
  void link_reader(detail::ReadEdge& edge, detail::Version& version) noexcept;
  void unlink_reader(detail::ReadEdge& edge) noexcept;
  [[nodiscard]] Handle head_of(const detail::Version& version) const noexcept {
    return version.apart ? version.history : handle_of(version);
  }
  [[nodiscard]] detail::Version* visible_to(const Call& call, const detail::Version& seen) const;
  void move_reader(detail::ReadEdge& edge, detail::Version& to) noexcept;
  void doubt_readers(Handle head, const detail::Version& version, const Call& later_than) noexcept;
  void leave_past(Handle head, detail::Version& version, Handle except) noexcept;
  void orphan(detail::ReadEdge& edge) noexcept;
  void free_past(detail::Version& version) noexcept;
  void require_ahead(const Call& reader, Handle head, Handle next) const;
  [[noreturn]] void fail_unwritten(const Call& reader, Handle head) const;

  Engine& engine_;
  std::uint8_t id_;
  Registry<detail::ValueType> types_;
  std::vector<detail::History> histories_;  // by number; the first is not used
  std::vector<std::uint32_t> free_histories_;
  std::unordered_map<Handle, TraceOrder> reader_orders_;  // by version
};

template <class T, class Same>
Cell<T, Same>::~Cell() {
  if (version_.readers != 0 && !Arena::header_of(this).ending) {
    // Nobody may read it any more; what the readers saw is gone.
    for (Handle r = version_.readers; r != 0;) {
      auto& edge = *Arena::in_arena_of<detail::ReadEdge>(this, r);
      r = edge.next_reader;
      edge.version = 0;
    }
  }
  if (version_.written) version_.value().~T();
}

template <class T>
T& Engine::make() {
  require_usable();
  static_assert(alignof(T) <= 8, "objects in the arena are aligned to 8 bytes");
  const Handle head = new_outside(kOutsideType<T>);
  try {
    return *::new (static_cast<void*>(at<OutsideHead>(head) + 1)) T();
  } catch (...) {
    outside_.pop_back();
    arena_.release(head, kOutsideType<T>.bytes);
    throw;
  }
}

template <class T>
void Engine::release(T& object) {
  release_outside(&object, "object");
}
template <class T, class Same>
void Engine::release(Mod<T, Same> mod) {
  release_outside(at<void>(mod.head()), "modifiable");
}

template <class T, class Same>
Mod<T, Same> Engine::cell() {
  return Mod<T, Same>(arena_.handle_of(&make<Cell<T, Same>>()));
}

template <class T, class Same>
Mod<T, Same> Engine::input(T value) {
  const std::uint16_t type = mods_->number(detail::kValueType<T, Same>);
  const Mod<T, Same> mod = cell<T, Same>();
  auto& version = *at<detail::TypedVersion<T>>(mod.head());
  ::new (static_cast<void*>(version.storage)) T(std::move(value));
  version.type = type;
  version.written = version.outside = true;
  return mod;
}

template <class T, class Same>
void Engine::set(Mod<T, Same> mod, std::type_identity_t<T> value) {
  begin_edit("set");
  if (!mod || !arena_.contains(at<void>(mod.head()))) fail_foreign("set: the modifiable");
  auto& version = *at<detail::TypedVersion<T>>(mod.head());
  if (!version.outside) {
    require_unwritten(mod.head());
    version.type = mods_->number(detail::kValueType<T, Same>);
    on_rollback([this, mod] {
      auto& v = *at<detail::TypedVersion<T>>(mod.head());
      v.written = v.outside = false;
      v.value().~T();
    });
    ::new (static_cast<void*>(version.storage)) T(std::move(value));
    version.written = version.outside = true;
    return;
  }
  if (detail::same<Same>(version.value(), value)) return;
  on_rollback([this, mod, old = version.value()]() mutable {
    auto& v = *at<detail::TypedVersion<T>>(mod.head());
    mods_->replace(mod.head(), v);
    ::new (static_cast<void*>(v.storage)) T(std::move(old));
    v.written = true;
  });
  mods_->replace(mod.head(), version);
  ::new (static_cast<void*>(version.storage)) T(std::move(value));
  version.written = true;
}

template <class T, class Same>
void Engine::set(const Cell<T, Same>& cell, std::type_identity_t<T> value) {
  require_own(&cell, "set: the cell");
  set(Mod<T, Same>(cell), std::move(value));
}

template <class T, class Same>
const T& Engine::get(Mod<T, Same> mod) const {
  return static_cast<detail::TypedVersion<T>&>(mods_->last(mod.head())).value();
}

template <class T, class Same>
const T& Engine::get(const Cell<T, Same>& cell) const {
  require_own(&cell, "get: the cell");
  return get(Mod<T, Same>(cell));
}

template <class T, class Same>
const T& Scope::read(Mod<T, Same> mod) {
  auto& version = engine_.mods_->observe(*this, mod.head());
  return static_cast<detail::TypedVersion<T>&>(version).value();
}

template <class T, class Same>
const T& Scope::read(const Cell<T, Same>& cell) {
  engine_.require_own(&cell, "read: the cell");
  return read(Mod<T, Same>(cell));
}

template <class T, class Same>
void Scope::write(Mod<T, Same> mod, std::type_identity_t<T> value) {
  ModStructure& mods = *engine_.mods_;
  const Handle head = mod.head();
  if (auto* own = static_cast<detail::TypedVersion<T>*>(mods.own_version(*this, head))) {
    if (detail::same<Same>(own->value(), value)) return;
    mods.require_unread(*this, head, *own);
    mods.replace(head, *own);
    ::new (static_cast<void*>(own->storage)) T(std::move(value));
    own->written = true;
    return;
  }
  auto* previous = static_cast<detail::TypedVersion<T>*>(mods.before(*this, head));
  const bool same = previous != nullptr && detail::same<Same>(previous->value(), value);
  if (previous != nullptr && !same) mods.require_unread(*this, head, *previous);
  auto& version = static_cast<detail::TypedVersion<T>&>(
      mods.new_version(*this, head, detail::kValueType<T, Same>));  // the last that may fail
  ::new (static_cast<void*>(version.storage)) T(std::move(value));
  version.written = true;
  mods.appeared(*this, head, version, previous, same);
}

template <class T, class Same>
void Scope::write(const Cell<T, Same>& cell, std::type_identity_t<T> value) {
  engine_.require_own(&cell, "write: the cell");
  write(Mod<T, Same>(cell), std::move(value));
}

template <class T, class Same, class... Key>
Mod<T, Same> Scope::cell(Key... key) {
  return Mod<T, Same>(engine_.arena_.handle_of(&make<Cell<T, Same>>(std::move(key)...)));
}

}  // namespace sac
