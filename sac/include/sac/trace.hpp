// The trace: calls in pre-order, and the edges that tie them to memory.
//
// Notation. A call's interval runs from its own time stamp to its end stamp; its descendants are
// the calls whose stamps lie inside. A leaf has no end stamp: its interval is itself. Calls made
// by tail share the end stamp of the call that they continue.
//
// Everything a call did or saw is an edge in its list, in the order of execution. An edge belongs
// to a `Structure`, which knows how to take it back; the engine only keeps the lists.
//
// A call in memory is its head, 32 bytes, then what its function asks for and others do not pay
// for: the slot of a posted call, the result, the arguments, the keyed object, the hash if client
// code computes it.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <ostream>
#include <string_view>

#include "sac/internal/arena.hpp"
#include "sac/label.hpp"
#include "sac/internal/timeline.hpp"

namespace sac {

class Engine;
class Scope;
struct Call;

/// What the engine knows of a traced function; one constant object per function and signature.
struct Function {
  std::string_view name;            // for people; others may have it, too
  std::string_view identity = {};   // all that the compiler says of it; empty unless posted
  std::uint32_t frame_bytes = 0;    // the call with all that lies behind it
  std::uint32_t object_offset = 0;  // of the keyed object; 0: there is none
  bool posted = false;              // runs from an agenda
  bool has_result = false;          // a ResultHead lies behind the head
  void (*execute)(Scope&, Call&) = nullptr;  // null: a keyed object without a body
  void (*destroy)(Call&) = nullptr;          // null where nothing needs destroying
  bool (*equal)(const Call&, const void* arguments) = nullptr;
  std::strong_ordering (*compare)(const Call&, const Call&) = nullptr;  // null unless posted
  std::uint32_t (*hash)(const Call&) noexcept = nullptr;
  void (*print)(const Call&, std::ostream&) = nullptr;     // the arguments, for people
  void (*label)(const Call&, LabelSink&) = nullptr;        // the arguments' names in all runs
  void (*print_result)(const Call&, std::ostream&) = nullptr;  // null unless there is one
  void (*label_result)(const Call&, LabelSink&) = nullptr;     // null unless there is one
};

/// The order of posted functions whose calls have equal keys.
[[nodiscard]] inline std::strong_ordering order_by_name(const Function& a, const Function& b) {
  return a.name != b.name ? a.name <=> b.name : a.identity <=> b.identity;
}

/// A node of the trace.
struct Call : TimeNode {
  std::uint16_t function_number = 0;
  std::uint16_t state = 0;  // flags
  Handle end = 0;           // end stamp; 0: a leaf
  Handle edges = 0;         // what it did and saw, oldest first
  std::uint32_t queue = 0;  // 1 + position in the propagation queue; 0: not there

  static constexpr std::uint16_t kInvalid = 1;   // must run again
  static constexpr std::uint16_t kDead = 2;      // discarded, not yet freed
  static constexpr std::uint16_t kRunning = 4;
  static constexpr std::uint16_t kPending = 8;   // has no place yet: on an agenda, or a tail call
  static constexpr std::uint16_t kPosted = 16;   // runs from an agenda
  static constexpr std::uint16_t kAside = 32;    // waits beside the queue
  static constexpr std::uint16_t kDoubtful = 64;  // must run again if it would read other values

  [[nodiscard]] bool has(std::uint16_t flag) const noexcept { return (state & flag) != 0; }
  void set(std::uint16_t flag) noexcept { state = static_cast<std::uint16_t>(state | flag); }
  void clear(std::uint16_t flag) noexcept { state = static_cast<std::uint16_t>(state & ~flag); }
  /// Requires: the call lies in its engine's arena.
  [[nodiscard]] const Function& function() const noexcept {
    return *Arena::header_of(this).functions[function_number];
  }
};
static_assert(sizeof(Call) == 32 && alignof(Call) == 4);

/// Behind the head of a call whose function returns something.
struct ResultHead {
  Handle caller = 0;  // who depends on the result
};

/// The head of every edge; structures derive their own edges from it.
struct Edge {
  Handle next = 0;  // next edge of the same call
  std::uint8_t structure = 0;
  std::uint8_t kind = 0;       // the structure's own
  std::uint16_t granules = 0;  // its size
};
static_assert(sizeof(Edge) == 8);

/// A traceable data type: anything that calls observe or act on.
///
/// An implementation keeps the history it needs ordered by trace time (Engine::precedes) and calls
/// Engine::invalidate for exactly the calls whose observation may have changed.
class Structure {
 public:
  virtual ~Structure() = default;
  /// Takes `edge` back: an observation is forgotten; an effect is reverted, and the observations
  /// it reached later in time are invalidated. Must not throw.
  virtual void retract(Call& call, Edge& edge) noexcept = 0;
  /// Names what an observation saw, equally in every run (label.hpp): a part of the call's label
  /// [Def 1.4.1]. An effect has nothing to say.
  virtual void label(const Call&, const Edge&, LabelSink&) const {}
  /// Prints what an edge saw or did, for people; nothing by default.
  virtual void print(const Call&, const Edge&, std::ostream&) const {}
};

}  // namespace sac
