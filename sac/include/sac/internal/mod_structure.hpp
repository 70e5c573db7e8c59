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

// One value over a stretch of the trace: 16 bytes (20 with SAC_CHECKS), value behind it.
struct Version {
  Handle place = 0;    // where a call wrote it; 0: the outside
  Handle readers = 0;  // chain of ReadEdges
  union {
    std::uint32_t history = 0;  // in place: number of the History; 0: this is the only version
    Handle modifiable;          // apart
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
  Handle head = 0;
};

struct ReadEdge : Edge {
  Handle version;  // what it saw; 0: that is gone, and the call is invalid
  Handle place;    // of the call that read it
  Handle prev;     // previous reader; 0: first
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
  // Null if what is the same is equal: else what is replaced is kept for a roll-back.
  void (*keep)(Originals&, const Call& writer, Handle head, const Version&) noexcept;
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
        ? [](Originals& originals, const Call& writer, Handle head, const Version& v) noexcept {
            if constexpr (kKeepsOriginals<T, Same>) originals.keep(writer, head, value_of<T>(v));
          }
        : static_cast<void (*)(Originals&, const Call&, Handle, const Version&) noexcept>(nullptr),
    sizeof(TypedVersion<T>)};

}  // namespace detail

class ModStructure final : public Structure {
 public:
  static constexpr std::uint8_t kRead = 0;
  static constexpr std::uint8_t kWrite = 1;

  explicit ModStructure(Engine& engine) : engine_(engine), id_(engine.add_structure(*this)) {}

  // --- For calls

  /// The version that the running call sees, with the read recorded.
  detail::Version& observe(Handle head);
  /// Writes `value` as the running call.
  template <class T, class Same>
  void write(Handle head, T value);

  // --- For watches

  /// The last version; null: nothing is written.
  [[nodiscard]] detail::Version* newest(Handle head) const noexcept;
  void set_watched(Handle head, bool on) noexcept { at(head)->watched = on; }

  // --- For queries

  /// Whether a call has written it before `place`. Cost: O(1), or O(log of its versions).
  [[nodiscard]] bool is_written_before(Handle place, Handle head) const noexcept {
    const Version* const last = versions_around(place, head).before;
    return last != nullptr && (last->place != place || predecessor(head, *last) != nullptr);
  }
  /// Whether no call writes or reads it. Requires: nothing is in doubt.
  [[nodiscard]] bool is_unused(Handle head) const noexcept {
    return is_untouched(*at(head)) && at(head)->readers == 0;
  }

  // --- For the outside

  /// Throws: UsageError, with SAC_CHECKS, if the handle is not of this engine or its modifiable is
  /// gone; in any build if it is null.
  void require_live(Handle head, detail::Stamp stamp, const char* what) const {
    if (kChecked) check_live(head, stamp, what);
    if (head == 0) [[unlikely]]
      fail_null(what);
  }
  [[nodiscard]] detail::Version* version(Handle head) const noexcept { return at(head); }
  [[nodiscard]] bool is_input(Handle head) const noexcept { return at(head)->outside; }
  template <class T>
  [[nodiscard]] const T& value(Handle head) const noexcept {
    return detail::value_of<T>(*at(head));
  }
  /// Throws: UsageError if the program has written it.
  void require_unwritten(Handle head) const;
  template <class T>
  void make_input(Handle head, std::uint16_t type, T value) noexcept {
    auto& version = static_cast<detail::TypedVersion<T>&>(*at(head));
    version.type = type;
    version.outside = true;
    version.give(std::move(value));
    if (version.watched) engine_.touched(head);
  }
  void unmake_input(Handle head) noexcept;
  template <class T>
  void change_input(Handle head, T value) noexcept {
    auto& version = static_cast<detail::TypedVersion<T>&>(*at(head));
    replace(head, version, 0);
    version.give(std::move(value));
  }
  /// The last version. Throws: UsageError if nothing is written.
  [[nodiscard]] const detail::Version& last(Handle head) const;
  /// The number of a type of values. Throws: std::bad_alloc.
  [[nodiscard]] std::uint16_t number(const detail::ValueType& type) { return types_.number(type); }

  /// A call that reads or writes a modifiable in the `bytes` from `from`, and which.
  struct Use {
    const Call* call = nullptr;  // null: none does
    Handle head = 0;
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

  [[nodiscard]] Version* at(Handle h) const noexcept { return engine_.arena().at<Version>(h); }
  [[nodiscard]] ReadEdge* reader(Handle h) const noexcept {
    return engine_.arena().at<ReadEdge>(h);
  }
  [[nodiscard]] Handle handle_of(const Version& version) const noexcept {
    return engine_.arena().handle_of(&version);
  }
  [[nodiscard]] const Call& writer(const Version& version) const noexcept {
    return engine_.call_at(version.place);
  }
  [[nodiscard]] bool precedes(Handle place, Handle other) const noexcept {
    return engine_.precedes(engine_.time(place), engine_.time(other));
  }
  // Orders versions by their places; handle 0 stands for one at `probe`.
  [[nodiscard]] auto order(Handle probe = 0) const noexcept {
    return [this, probe](Handle a, Handle b) {
      return precedes(a != 0 ? at(a)->place : probe, b != 0 ? at(b)->place : probe);
    };
  }
  // Orders readers by their places; handle 0 stands for one at `probe`.
  [[nodiscard]] auto reader_order(Handle probe = 0) const noexcept {
    return [this, probe](Handle a, Handle b) {
      const Handle x = a != 0 ? reader(a)->place : probe;
      const Handle y = b != 0 ? reader(b)->place : probe;
      return x == y ? a != 0 && b != 0 && a < b : precedes(x, y);
    };
  }
  [[nodiscard]] detail::History& history(std::uint32_t number) noexcept {
    return histories_[number];
  }
  [[nodiscard]] const detail::History& history(std::uint32_t number) const noexcept {
    return histories_[number];
  }
  [[nodiscard]] Handle head_of(const Version& version) const noexcept {
    return version.apart ? version.modifiable : handle_of(version);
  }
  // Whether it has no value: no call has written it, and it is no input.
  [[nodiscard]] static bool is_untouched(const Version& first) noexcept {
    return !first.written && first.history == 0;
  }
  // Null: there is none.
  struct Around {
    Version* before;  // the last one up to the place, and at it
    Version* behind;  // the first one behind it
  };
  [[nodiscard]] Around versions_around(Handle place, Handle head) const noexcept {
    Version* const first = at(head);
    if (first->history == 0) [[likely]] {
      if (!first->written) return {nullptr, nullptr};
      if (first->place == place || precedes(first->place, place)) return {first, nullptr};
      return {nullptr, first};
    }
    const auto found = history(first->history).versions.place_of(0, order(place));
    return {found.before != 0 ? at(found.before) : nullptr,
            found.behind != 0 ? at(found.behind) : nullptr};
  }
  void check_live(Handle head, detail::Stamp stamp, const char* what) const;
  [[noreturn]] void fail_null(const char* what) const;

  // read.cpp
  // The last version before the running call's `place`, or its own of this execution; null if there
  // is none.
  [[nodiscard]] Version* seen_at(Handle place, Handle head) const {
    const Version& first = *at(head);
    if (first.history == 0 && first.written &&
        (engine_.appending() || precedes(first.place, place))) [[likely]] {
      return at(head);
    }
    return engine_.appending() ? newest(head) : seen_among(place, head);
  }
  [[nodiscard]] ReadEdge* recall_read(Handle head, Handle seen);
  [[nodiscard]] Version* seen_among(Handle place, Handle head) const;
  [[nodiscard]] Version* visible_at(Handle place, const Version& seen) const;
  [[noreturn]] void fail_unwritten(Handle place, Handle head) const;

  // write.cpp
  void tell(Event::Kind kind, const Call* call, Handle head) noexcept {
    if (at(head)->watched) [[unlikely]]
      engine_.touched(head);
    engine_.note(kind, call, head);
  }
  Version* own_version(Handle head);
  [[noreturn]] void fail_input(Handle head) const;
  void repeat(Handle head, Handle version);
  [[nodiscard]] bool has_passed_on(const detail::WriteEdge& edge) const noexcept;
  [[nodiscard]] Version* predecessor(Handle head, const Version& version) const noexcept;
  Version& first_version(Handle head, const detail::ValueType& type);
  Version& new_version(Handle head, const detail::ValueType& type);
  Version& new_apart(Handle head, const detail::ValueType& type);
  void enter_history(Handle head, Version& version, const detail::ValueType& type);
  void replace(Handle head, Version& version, Handle except) noexcept;
  void appeared(Handle head, Version& version, Version& previous, bool same) noexcept;
  [[nodiscard]] std::uint32_t new_history(Handle head);
  void drop_history(Handle head) noexcept;
  void leave_past(Handle head, Version& version, Handle except) noexcept;
  [[nodiscard]] Version* part_with_readers(Handle head, Version& version, Handle except) noexcept;
  [[nodiscard]] Version* new_past(Handle head, const Version& version) noexcept;
  void forget_version(Handle head, Version& version) noexcept;
  void free_past(Version& version) noexcept;

  // readers.cpp
  void link_reader(ReadEdge& edge, Version& version) noexcept;
  void put_in_order(const ReadEdge& edge, Version& version) noexcept;
  void unlink_reader(ReadEdge& edge) noexcept;
  void move_reader(ReadEdge& edge, Version& to) noexcept;
  void orphan(ReadEdge& edge) noexcept;
  void orphan_readers(const Version& version, Handle except) noexcept;
  // Visits the readers of `version` behind `place`, in any order; `visit` may unlink the one that
  // it is given. Cost: O(log) a reader visited; the first time that many others are passed, O(log)
  // for each of these.
  template <class Visit>
  void for_each_reader_behind(const Version& version, Handle place, Visit&& visit);
  void order_readers(const Version& version) noexcept;
  void forget_order(Version& version) noexcept;

  [[nodiscard]] Use use_of(Handle head) const noexcept;
  void check_version(Handle v, Handle previous, Handle next) const;
  void check_modifiable(Handle head) const;

  Engine& engine_;
  std::uint8_t id_;
  Registry<detail::ValueType> types_;
  std::vector<detail::History> histories_;  // by number; the first is not used
  std::vector<std::uint32_t> free_histories_;
  std::unordered_map<Handle, SortedIndex<Handle>> reader_orders_;  // by version
};

template <class T, class Same>
void ModStructure::write(Handle head, T value) {
  using Typed = detail::TypedVersion<T>;
  bool restored = false;
  if constexpr (detail::kKeepsOriginals<T, Same>) {
    const T* original = engine_.undoing()
                            ? engine_.originals()->template find<T>(engine_.core().self(), head)
                            : nullptr;
    restored = original != nullptr && detail::same<Same>(*original, value);
    if (restored) value = *original;
  }
  const auto changed = [&] { tell(Event::Kind::changed, engine_.running_call(), head); };
  if (is_untouched(*at(head))) {
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
void ModStructure::for_each_reader_behind(const Version& version, Handle place, Visit&& visit) {
  if (version.ordered) {
    const auto& readers = reader_orders_.find(handle_of(version))->second;
    const auto value = [](const Handle* h) { return h != nullptr ? *h : 0; };
    for (Handle r = value(readers.place_of(0, reader_order(place)).behind); r != 0;) {
      const Handle next = value(readers.place_of(r, reader_order()).behind);
      visit(*reader(r));
      r = next;
    }
    return;
  }
  constexpr std::size_t kMany = 64;
  std::size_t passed = 0;
  std::size_t visited = 0;
  for (Handle r = version.readers; r != 0;) {
    ReadEdge& edge = *reader(r);
    r = edge.next_reader;
    if (precedes(place, edge.place)) {
      ++visited;
      visit(edge);
    } else {
      ++passed;
    }
  }
  if (passed > kMany && passed / 8 > visited && !engine_.appending()) order_readers(version);
}

template <class T>
void detail::TypedVersion<T>::end() noexcept {
  if (readers != 0 && !Arena::header_of(this).ending) {
    for (Handle r = readers; r != 0;) {
      auto& edge = *Arena::in_arena_of<ReadEdge>(this, r);
      r = edge.next_reader;
      edge.version = 0;
    }
  }
  if (written) value().~T();
  stamp.set(0);
}

}  // namespace sac
