// The untyped half of modifiables: versions, readers, and the calls that must run again.
//
// The version of the only writer lies in place, where the modifiable's handle points, and a read
// checks one number more than a plain load would. With more writers a `History` keeps the versions
// in order: O(log) a read or write. Each version lists its readers; a write that appears between
// two others takes over the readers behind it. Where it had to pass many others to find them, the
// readers of that version are kept in order from then on.
//
// A replaced value is kept as a past version for the calls that have seen it, until their turn:
// they are in doubt, and run again only if they would read another value.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <new>
#include <ostream>
#include <type_traits>
#include <unordered_map>
#include <utility>
#include <vector>

#include "sac/engine.hpp"
#include "sac/internal/chain.hpp"
#include "sac/internal/sorted_index.hpp"
#include "sac/internal/versions.hpp"
#include "sac/scope.hpp"

namespace sac {
namespace detail {

// With SAC_CHECKS, what a handle knows of its modifiable beside its place: the engine's number and
// one of its own. 0: not known.
template <bool kKept>
class BasicStamp {
 public:
  [[nodiscard]] std::uint32_t get() const noexcept { return value_; }
  // Volatile: what is set at the end of an object's life is seen by those who have kept its handle.
  void set(std::uint32_t value) noexcept { value_ = value; }

 private:
  volatile std::uint32_t value_ = 0;
};
template <>
class BasicStamp<false> {
 public:
  [[nodiscard]] static std::uint32_t get() noexcept { return 0; }
  static void set(std::uint32_t) noexcept {}
};
using Stamp = BasicStamp<kChecked>;

struct ReadEdge;

// One value over a stretch of the trace: 16 bytes (20 with SAC_CHECKS), value behind it.
struct Version {
  Place place;            // where a call wrote it; null: the outside
  Ref<ReadEdge> readers;  // chained
  union {
    std::uint32_t history = 0;  // in place: number of the History; 0: this is the only version
    Handle modifiable;          // apart: its handle
  };
  std::uint16_t type = 0;
  bool written : 1 = false;
  bool outside : 1 = false;    // an input
  bool apart : 1 = false;      // not where the modifiable's handle points
  bool past : 1 = false;       // apart, and gone: kept for those who have seen it
  bool ordered : 1 = false;    // its readers are in reader_orders_ as well
  bool watched : 1 = false;    // in place: the client wants to know of changes
  std::uint8_t round : 1 = 0;  // the writer's when it wrote or repeated it
  std::uint8_t unused : 1 = 0;
  [[no_unique_address]] Stamp stamp;

  /// The stamp of a version that lies in place, given on first use.
  [[nodiscard]] Stamp stamp_in_arena() noexcept {
    if (kChecked && stamp.get() == 0) stamp.set(Arena::next_stamp(this));
    return stamp;
  }
};
static_assert(kChecked || sizeof(Version) == 16);

template <class T>
struct TypedVersion : Version {
  static_assert(alignof(T) <= 8, "values in the arena are aligned to 8 bytes");
  static_assert(std::is_nothrow_move_constructible_v<T> && std::is_nothrow_move_assignable_v<T>,
                "a value that may throw when it is moved would be lost: hold it by a pointer");
  alignas(T) std::byte storage[sizeof(T)];
  T& value() noexcept { return *std::launder(reinterpret_cast<T*>(storage)); }
  const T& value() const noexcept { return *std::launder(reinterpret_cast<const T*>(storage)); }
  void give(T&& value) noexcept {
    ::new (static_cast<void*>(storage)) T(std::move(value));
    written = true;
  }
  /// The modifiable's memory is about to be freed. Nobody may read it any more; what its readers
  /// saw is gone.
  void end() noexcept;
};

// The versions of a modifiable that more than one call writes, in trace order.
struct History {
  Versions versions;
  ModRef head;
};

struct ReadEdge : Edge {
  Ref<Version> version;  // what it saw; null: that is gone, and the call is invalid
  Place place;           // of the call that read it
  Ref<ReadEdge> prev;    // previous reader; null: first
  Ref<ReadEdge> next_reader;
};
static_assert(sizeof(ReadEdge) == 24);
using Readers = Chain<ReadEdge, &ReadEdge::prev, &ReadEdge::next_reader>;

struct WriteEdge : Edge {
  ModRef head;  // the modifiable
  Ref<Version> version;
};
static_assert(sizeof(WriteEdge) == 16);

// What can be done with a version without knowing the type of its value.
struct ValueType {
  bool (*same)(const Version&, const Version&);
  void (*destroy)(Version&);
  void (*move)(Version& from, Version& to);  // leaves `from` without a value
  void (*print)(const Version&, std::ostream&);
  void (*label)(const Version&, LabelSink&);
  // Null if what is the same is equal: else what is replaced is kept for a roll-back.
  void (*keep)(Originals&, const Call& writer, ModRef head, const Version&) noexcept;
  std::uint32_t bytes;
};

template <class T>
const T& value_of(const Version& v) noexcept {
  return static_cast<const TypedVersion<T>&>(v).value();
}

template <class T, class Same>
inline constexpr ValueType kValueType{
    [](const Version& a, const Version& b) { return same<Same>(value_of<T>(a), value_of<T>(b)); },
    [](Version& v) { static_cast<TypedVersion<T>&>(v).value().~T(); },
    [](Version& from, Version& to) {
      T& value = static_cast<TypedVersion<T>&>(from).value();
      ::new (static_cast<void*>(static_cast<TypedVersion<T>&>(to).storage)) T(std::move(value));
      value.~T();
    },
    [](const Version& v, std::ostream& out) { print_argument(out, value_of<T>(v), &v); },
    [](const Version& v, LabelSink& sink) { name_argument(sink, value_of<T>(v)); },
    kKeepsOriginals<T, Same>
        ? [](Originals& originals, const Call& writer, ModRef head, const Version& v) noexcept {
            if constexpr (kKeepsOriginals<T, Same>) originals.keep(writer, head, value_of<T>(v));
          }
        : static_cast<void (*)(Originals&, const Call&, ModRef, const Version&) noexcept>(nullptr),
    sizeof(TypedVersion<T>)};

}  // namespace detail

class ModStructure final : public Structure {
 public:
  static constexpr std::uint8_t kRead = 0;
  static constexpr std::uint8_t kWrite = 1;

  explicit ModStructure(Engine& engine) : engine_(engine), id_(engine.add_structure(*this)) {}

  // --- For calls

  /// The version that the running call sees, with the read recorded.
  detail::Version& observe(ModRef head);
  /// Writes `value` as the running call.
  template <class T, class Same>
  void write(ModRef head, T value);

  // --- For watches

  /// The last version; null: nothing is written.
  [[nodiscard]] detail::Version* newest(ModRef head) const noexcept;
  void set_watched(ModRef head, bool on) noexcept { at(head).watched = on; }

  // --- For queries

  /// Whether a call has written it before `place`. Cost: O(1), or O(log of its versions).
  [[nodiscard]] bool is_written_before(Place place, ModRef head) const noexcept {
    return last_before(place, head) != nullptr;
  }
  /// Whether no call writes or reads it. Requires: nothing is in doubt.
  [[nodiscard]] bool is_unused(ModRef head) const noexcept {
    return is_untouched(at(head)) && at(head).readers == nullptr;
  }

  // --- For the outside

  /// Throws: UsageError, with SAC_CHECKS, if the handle is not of this engine or its modifiable is
  /// gone; in any build if it is null.
  void require_live(ModRef head, detail::Stamp stamp, const char* what) const {
    if (kChecked) check_live(head, stamp, what);
    if (head == nullptr) [[unlikely]]
      fail_null(what);
  }
  [[nodiscard]] bool is_input(ModRef head) const noexcept { return at(head).outside; }
  template <class T>
  [[nodiscard]] const T& value(ModRef head) const noexcept {
    return detail::value_of<T>(at(head));
  }
  /// Throws: UsageError if the program has written it.
  void require_unwritten(ModRef head) const;
  template <class T>
  void make_input(ModRef head, std::uint16_t type, T value) noexcept {
    auto& version = static_cast<detail::TypedVersion<T>&>(at(head));
    version.type = type;
    version.outside = true;
    version.give(std::move(value));
    if (version.watched) engine_.touched(head);
  }
  void unmake_input(ModRef head) noexcept;
  template <class T>
  void change_input(ModRef head, T value) noexcept {
    auto& version = static_cast<detail::TypedVersion<T>&>(at(head));
    replace(head, version, nullptr);
    version.give(std::move(value));
  }
  /// The last version. Throws: UsageError if nothing is written.
  [[nodiscard]] const detail::Version& last(ModRef head) const;
  /// The number of a type of values. Throws: std::bad_alloc.
  [[nodiscard]] std::uint16_t number(const detail::ValueType& type) { return types_.number(type); }

  /// A call that reads or writes a modifiable in the `bytes` from `from`, and which.
  struct Use {
    const Call* call = nullptr;  // null: none does
    ModRef mod{};
    bool writes = false;
  };
  [[nodiscard]] Use use_within(Handle from, std::size_t bytes) const noexcept;

  [[nodiscard]] std::size_t bytes() const noexcept;
  /// Forgets what can be found anew. Throws: std::bad_alloc, and then loses nothing else.
  void shrink();
  /// Destroys the values that `call` wrote, and the past ones that it has seen: the engine ends.
  void destroy_values(const Call& call) noexcept;

  // --- As a structure

  void retract(Call& call, Edge& edge) noexcept override;
  [[nodiscard]] bool unchanged(Call& call, Edge& edge) override;
  void label(const Call& call, const Edge& edge, LabelSink& sink) const override;
  void print(const Call& call, const Edge& edge, std::ostream& out) const override;
  /// Versions are in trace order, and every reader is at the version that it sees.
  void check_invariants() const override;

 private:
  using Version = detail::Version;
  using ReadEdge = detail::ReadEdge;

  template <class T>
  [[nodiscard]] T& at(Ref<T> ref) const noexcept {
    return engine_.arena()[ref];
  }
  [[nodiscard]] const Call& writer(const Version& version) const noexcept {
    return engine_.call_at(version.place);
  }
  [[nodiscard]] bool precedes(Place place, Place other) const noexcept {
    return engine_.precedes(engine_.time(place), engine_.time(other));
  }
  // The order of versions, and of readers, is that of their places.
  struct Order {
    const ModStructure& mods;
    template <class T>
    bool operator()(Place a, Ref<T> b) const noexcept {
      return mods.precedes(a, mods.at(b).place);
    }
    bool operator()(Ref<Version> a, Ref<Version> b) const noexcept {
      return (*this)(mods.at(a).place, b);
    }
    // Of the readers at one place the handles decide.
    bool operator()(Ref<ReadEdge> a, Ref<ReadEdge> b) const noexcept {
      const Place x = mods.at(a).place;
      return x == mods.at(b).place ? a.handle() < b.handle() : (*this)(x, b);
    }
  };
  [[nodiscard]] Order order() const noexcept { return {*this}; }
  [[nodiscard]] detail::History& history(std::uint32_t number) noexcept {
    return histories_[number];
  }
  [[nodiscard]] const detail::History& history(std::uint32_t number) const noexcept {
    return histories_[number];
  }
  [[nodiscard]] static ModRef head_of(const Version& version) noexcept {
    return version.apart ? ModRef(version.modifiable) : Arena::ref(version);
  }
  // Whether it has no value: no call has written it, and it is no input.
  [[nodiscard]] static bool is_untouched(const Version& first) noexcept {
    return !first.written && first.history == 0;
  }
  [[nodiscard]] Version* pointer(Ref<Version> version) const noexcept {
    return version != nullptr ? &at(version) : nullptr;
  }
  // Null: there is none.
  struct Around {
    Version* before;  // the last one up to the place, and at it
    Version* behind;  // the first one behind it
  };
  [[nodiscard]] Around versions_around(Place place, ModRef head) const noexcept {
    Version* const first = &at(head);
    if (first->history == 0) [[likely]] {
      if (!first->written) return {nullptr, nullptr};
      if (first->place == place || precedes(first->place, place)) return {first, nullptr};
      return {nullptr, first};
    }
    const auto found = history(first->history).versions.around(place, order());
    return {pointer(found.before), pointer(found.behind)};
  }
  [[nodiscard]] Version* last_before(Place place, ModRef head) const noexcept {
    Version* const last = versions_around(place, head).before;
    return last != nullptr && last->place == place ? predecessor(head, *last) : last;
  }
  void check_live(ModRef head, detail::Stamp stamp, const char* what) const;
  [[noreturn]] void fail_null(const char* what) const;

  // read.cpp
  // The last version before the running call's `place`, or its own of this execution; null if there
  // is none.
  [[nodiscard]] Version* seen_at(Place place, ModRef head) const {
    const Version& first = at(head);
    if (first.history == 0 && first.written &&
        (engine_.appending() || precedes(first.place, place))) [[likely]] {
      return &at(head);
    }
    return engine_.appending() ? newest(head) : seen_among(place, head);
  }
  [[nodiscard]] ReadEdge* recall_read(ModRef head, Ref<Version> seen);
  [[nodiscard]] Version* seen_among(Place place, ModRef head) const;
  [[nodiscard]] Version* visible_at(Place place, const Version& seen) const;
  [[noreturn]] void fail_unwritten(Place place, ModRef head) const;

  // write.cpp
  void tell(Event::Kind kind, const Call* call, ModRef head) noexcept {
    if (at(head).watched) [[unlikely]]
      engine_.touched(head);
    engine_.note(kind, call, head);
  }
  Version* own_version(ModRef head);
  [[noreturn]] void fail_input(ModRef head) const;
  void repeat(ModRef head, Ref<Version> version);
  [[nodiscard]] bool has_passed_on(const detail::WriteEdge& edge) const noexcept;
  [[nodiscard]] Version* predecessor(ModRef head, const Version& version) const noexcept;
  Version& first_version(ModRef head, const detail::ValueType& type);
  Version& new_version(ModRef head, const detail::ValueType& type);
  Version& new_apart(ModRef head, const detail::ValueType& type);
  void enter_history(ModRef head, Version& version, const detail::ValueType& type);
  void replace(ModRef head, Version& version, Place except) noexcept;
  void appeared(ModRef head, Version& version, Version& previous, bool same) noexcept;
  [[nodiscard]] std::uint32_t new_history(ModRef head);
  void drop_history(ModRef head) noexcept;
  void leave_past(ModRef head, Version& version, Place except) noexcept;
  [[nodiscard]] Version* part_with_readers(ModRef head, Version& version, Place except) noexcept;
  [[nodiscard]] Version* new_past(ModRef head, const Version& version) noexcept;
  void forget_version(ModRef head, Version& version) noexcept;
  void free_past(Version& version) noexcept;

  // readers.cpp
  void link_reader(ReadEdge& edge, Version& version) noexcept;
  void put_in_order(const ReadEdge& edge, Version& version) noexcept;
  void unlink_reader(ReadEdge& edge) noexcept;
  void move_reader(ReadEdge& edge, Version& to) noexcept;
  void orphan(ReadEdge& edge) noexcept;
  void orphan_readers(const Version& version, Place except) noexcept;
  // Visits the readers of `version` behind `place`, in any order; `visit` may unlink the one that
  // it is given. Cost: O(log) a reader visited; the first time that many others are passed, O(log)
  // for each of these.
  template <class Visit>
  void for_each_reader_behind(const Version& version, Place place, Visit&& visit);
  [[nodiscard]] SortedIndex<Ref<ReadEdge>>& readers_in_order(const Version& version) noexcept {
    return reader_orders_.find(Arena::ref(version).handle())->second;
  }
  void order_readers(const Version& version) noexcept;
  void forget_order(Version& version) noexcept;

  [[nodiscard]] Use use_of(ModRef head) const noexcept;
  void check_version(Ref<Version> v, Ref<Version> previous, Ref<Version> next) const;
  void check_modifiable(ModRef head) const;

  Engine& engine_;
  std::uint8_t id_;
  Registry<detail::ValueType> types_;
  std::vector<detail::History> histories_;  // by number; the first is not used
  std::vector<std::uint32_t> free_histories_;
  std::unordered_map<Handle, SortedIndex<Ref<ReadEdge>>> reader_orders_;  // by version
};

template <class T, class Same>
void ModStructure::write(ModRef head, T value) {
  using Typed = detail::TypedVersion<T>;
  bool restored = false;
  if constexpr (detail::kKeepsOriginals<T, Same>) {
    restored = engine_.core().restore_original<Same>(engine_.core().self(), head, value);
  }
  const auto changed = [&] { tell(Event::Kind::changed, engine_.running_call(), head); };
  if (is_untouched(at(head))) {
    static_cast<Typed&>(first_version(head, detail::kValueType<T, Same>)).give(std::move(value));
    return changed();
  }
  if (auto* own = static_cast<Typed*>(own_version(head))) {
    if (!restored && detail::same<Same>(own->value(), value)) return;
    replace(head, *own, own->place);
    return own->give(std::move(value));
  }
  auto* previous = static_cast<Typed*>(versions_around(engine_.core().place(), head).before);
  const bool same = previous != nullptr && detail::same<Same>(previous->value(), value);
  auto& version = static_cast<Typed&>(
      new_version(head, detail::kValueType<T, Same>));  // the last that may fail
  version.give(std::move(value));
  if (!same) changed();
  if (previous != nullptr) appeared(head, version, *previous, same);
}

template <class Visit>
void ModStructure::for_each_reader_behind(const Version& version, Place place, Visit&& visit) {
  if (version.ordered) {
    const auto& readers = readers_in_order(version);
    const auto value = [](const Ref<ReadEdge>* r) { return r != nullptr ? *r : nullptr; };
    for (Ref<ReadEdge> r = value(readers.place_of(place, order()).behind); r != nullptr;) {
      const Ref<ReadEdge> next = value(readers.place_of(r, order()).behind);
      visit(at(r));
      r = next;
    }
    return;
  }
  constexpr std::size_t kMany = 64;
  std::size_t passed = 0;
  std::size_t visited = 0;
  detail::Readers::for_each(engine_.arena(), version.readers, [&](ReadEdge& edge) {
    if (precedes(place, edge.place)) {
      ++visited;
      visit(edge);
    } else {
      ++passed;
    }
  });
  if (passed > kMany && passed / 8 > visited && !engine_.appending()) order_readers(version);
}

template <class T>
void detail::TypedVersion<T>::end() noexcept {
  if (readers != nullptr && !Arena::header_of(this).ending) {
    for (Ref<ReadEdge> r = readers; r != nullptr;) {
      ReadEdge& edge = Arena::in_arena_of(this, r);
      r = edge.next_reader;
      edge.version = nullptr;
    }
  }
  if (written) value().~T();
  stamp.set(0);
}

}  // namespace sac
