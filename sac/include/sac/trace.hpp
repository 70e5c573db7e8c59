// The trace: calls in pre-order, and the edges that tie them to memory.
//
// Notation. A call's interval runs from its own time stamp to its end stamp; its descendants are
// the calls whose stamps lie inside. A leaf has no end stamp: its interval is itself. Calls made
// by tail share the end stamp of the call that they continue.
//
// Everything a call did or saw is an edge in its list, in the order of execution. An edge belongs
// to a `Structure`, which knows how to take it back; the engine only keeps the lists.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <ostream>
#include <string_view>

#include "sac/arena.hpp"
#include "sac/timeline.hpp"

namespace sac {

class Engine;
class Scope;
struct Call;

/// What the engine knows of a traced function; one constant object per function and signature.
struct Function {
  std::string_view name;
  std::uint32_t frame_bytes;  // the call with its arguments
  bool posted;                // runs from an agenda
  void (*execute)(Scope&, Call&);
  void (*destroy)(Call&);  // null where nothing needs destroying
  bool (*equal)(const Call&, const void* arguments);
  std::strong_ordering (*compare)(const Call&, const Call&);  // null unless posted
  std::uint64_t (*hash)(const Call&);
  void (*print)(const Call&, std::ostream&);
};

/// A node of the trace: 48 bytes, arguments behind it.
struct Call : TimeNode {
  const Function* function = nullptr;
  Handle end = 0;         // end stamp; 0: a leaf
  Handle edges = 0;       // what it did and saw, oldest first
  Handle memo_next = 0;   // next call in its bucket of the memo table
  std::uint32_t hash = 0;
  std::uint32_t queue = 0;  // 1 + position in the propagation queue; 0: not there
  std::uint32_t state = 0;  // flags, and above them the number of posts

  static constexpr std::uint32_t kInvalid = 1;    // must run again
  static constexpr std::uint32_t kDead = 2;       // discarded, not yet freed
  static constexpr std::uint32_t kRunning = 4;
  static constexpr std::uint32_t kPending = 8;    // on an agenda not yet drained: has no place
  static constexpr std::uint32_t kOnePost = 16;

  [[nodiscard]] bool has(std::uint32_t flag) const noexcept { return (state & flag) != 0; }
  void set(std::uint32_t flag) noexcept { state |= flag; }
  void clear(std::uint32_t flag) noexcept { state &= ~flag; }
  [[nodiscard]] std::uint32_t posts() const noexcept { return state / kOnePost; }
};
static_assert(sizeof(Call) == 48);

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
};

}  // namespace sac
