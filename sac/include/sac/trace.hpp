// The trace: calls in pre-order, and the edges that tie them to memory.
//
// Notation. A call's interval runs from its own time stamp to its end stamp; its descendants are
// the calls whose stamps lie inside. A leaf has no end stamp: its interval is itself. Calls made
// by tail share the end stamp of the call that they continue.
//
// Every effect and observation of a call is an edge in its list, in the order of execution. An edge
// belongs to a `Structure` (structure.hpp), which can undo it; the engine keeps the lists.
//
// A call's children cut it into segments. The first one has the place of the call itself in time; a
// later one in which the call has effects or observations has a time stamp of its own, right behind
// the child before it.
//
// A call in memory is its head, 32 bytes, followed by the parts that its function needs: the slot
// of a posted call, the result, the arguments, the keyed object, and the hash if client code
// computes it.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <ostream>
#include <string_view>

#include "sac/arena.hpp"
#include "sac/internal/timeline.hpp"
#include "sac/label.hpp"

namespace sac {

class Scope;
class Agenda;
struct Call;
struct Edge;
struct PostEdge;
namespace detail {
struct Version;
}  // namespace detail

/// A modifiable: its version in place (internal/mod_structure.hpp).
using ModRef = Ref<detail::Version>;

/// The description of a traced function for the engine; one constant object per function and
/// signature. `arguments` is the tuple that a call keeps.
struct Function {
  std::string_view name;                        // for people; not unique
  Identity (*identity)() = nullptr;             // null unless posted
  std::uint32_t frame_bytes = 0;                // of the call with everything behind its head
  std::uint32_t object_offset = 0;              // of the keyed object; 0: none
  bool posted = false;                          // runs from an agenda
  bool has_result = false;                      // a ResultHead lies behind the head
  const void* (*query)(const Call&) = nullptr;  // that it computes; null: none
  void (*execute)(Scope&, Call&) = nullptr;     // null: a keyed object without a body
  void (*destroy)(Call&) = nullptr;             // null: nothing needs destroying
  bool (*equal)(const Call&, const void* arguments) = nullptr;
  const void* (*arguments)(const Call&) = nullptr;
  std::strong_ordering (*compare)(const Call&, const Call&) = nullptr;  // null unless posted
  std::uint32_t (*hash)(const Call&) noexcept = nullptr;
  bool (*has_agenda)(const Call&, const Agenda&) = nullptr;    // among its arguments; null: none
  void (*print)(const Call&, std::ostream&) = nullptr;         // the arguments, for people
  void (*label)(const Call&, LabelSink&) = nullptr;            // names of the arguments in all runs
  void (*print_result)(const Call&, std::ostream&) = nullptr;  // null: no result
  void (*label_result)(const Call&, LabelSink&) = nullptr;     // null: no result
};

/// The order of posted functions whose calls have equal keys.
[[nodiscard]] std::strong_ordering order_of_functions(const Function& a, const Function& b);

/// The state of a call (docs/propagate.md has the diagram).
enum class Life : std::uint8_t {
  waiting,  // not placed: it waits on an agenda, or is a tail call to be run
  placed,   // in the trace
  running,  // in the trace, and its body runs
  dead      // has left the trace; freed when the propagation ends
};

/// Whether a placed call must run again.
enum class Validity : std::uint8_t {
  valid,
  doubtful,  // runs again if it would see something else
  invalid    // runs again
};

/// A node of the trace.
struct Call : TimeNode {
  std::uint16_t function_number = 0;
  Life life : 2 = Life::placed;
  Validity validity : 2 = Validity::valid;
  std::uint8_t round : 1 = 0;   // changes with each execution; old edges have the other bit
  bool posted : 1 = false;      // runs from an agenda; a Slot lies behind the head
  std::uint8_t unused : 2 = 0;  // so that a new call's byte is written whole
  std::uint8_t work_queue = 0;  // of a posted call: the number of its agenda as a structure
  Place end;                    // end stamp; null: a leaf
  Ref<Edge> edges;              // effects and observations, oldest first
  std::uint32_t queue = 0;      // 1 + position in the propagation queue; 0: not in it

  static constexpr Kind kKind = Kind::call;

  [[nodiscard]] bool running() const noexcept { return life == Life::running; }
  [[nodiscard]] bool waiting() const noexcept { return life == Life::waiting; }
  [[nodiscard]] bool dead() const noexcept { return life == Life::dead; }
  [[nodiscard]] bool invalid() const noexcept { return validity == Validity::invalid; }
  /// Requires: the call lies in its engine's arena.
  [[nodiscard]] const Function& function() const noexcept {
    return *Arena::header_of(this).functions[function_number];
  }
};
static_assert(sizeof(Call) == 32 && alignof(Call) == 4);

/// Behind the head of a posted call: its turn on its agenda, and its posts.
struct Slot {
  std::uint64_t order = 0;
  std::uint32_t rank = 0;
  Ref<PostEdge> posts{};  // those that count, chained; null: it is dying
  /// Requires: the call is posted.
  [[nodiscard]] static Slot& of(Call& call) noexcept { return *reinterpret_cast<Slot*>(&call + 1); }
  [[nodiscard]] static const Slot& of(const Call& call) noexcept {
    return *reinterpret_cast<const Slot*>(&call + 1);
  }
};
static_assert(sizeof(Slot) == 16);

/// Behind the head of a call whose function returns a value.
struct ResultHead {
  Ref<Call> caller;  // the call that depends on the result
  [[nodiscard]] static ResultHead& of(Call& call) noexcept {
    return *reinterpret_cast<ResultHead*>(&call + 1);
  }
};

/// The head of every edge; structures derive their own edges from it.
struct Edge {
  Ref<Edge> next{};  // next edge of the same call
  std::uint8_t structure = 0;
  std::uint8_t kind : 6 = 0;            // meaning defined by the structure
  std::uint8_t begins_segment : 1 = 0;  // of no structure: it lies in a Segment
  std::uint8_t round : 1 = 0;           // the call's round when it was made or repeated
  std::uint16_t granules = 0;           // its size
};
static_assert(sizeof(Edge) == 8);

/// Whether `edge` of a call that runs is of its last execution and not yet repeated.
[[nodiscard]] inline bool is_old(const Call& call, const Edge& edge) noexcept {
  return call.running() && edge.round != call.round;
}

/// What a call does behind a child of its own and before the next one: the time stamp of the edges
/// that follow in the call's list.
struct Segment : TimeNode {
  Edge edge;  // in the call's list
  Ref<Call> call;

  static constexpr Kind kKind = Kind::segment;
  [[nodiscard]] static Segment& of(Edge& edge) noexcept {
    return *reinterpret_cast<Segment*>(reinterpret_cast<std::byte*>(&edge) - sizeof(TimeNode));
  }
};
static_assert(sizeof(Segment) == 28);

}  // namespace sac
