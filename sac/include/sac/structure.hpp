// Structures: traceable data types, which calls observe and change, and their interface to the
// engine.
//
// Modifiables and agendas are structures, and users write their own; docs/traceable_types.md shows
// how. A structure keeps its records in trace order (Engine::precedes), and tells the engine which
// calls' observations may have changed (Engine::invalidate, Engine::doubt).
//
// Rules that the engine and a structure keep together:
// (1) What a call does has a place in time (Scope::place): an observation sees the effects before
//     it in the order of the text, its own call's included.
// (2) When a call runs again, what it does not repeat at a place is undone before it goes on to its
//     next child, or when it ends. Until then the effects of its last execution at this place
//     (`is_old`) are not there for the call itself; nobody else runs.
#pragma once

#include <cstddef>
#include <ostream>

#include "sac/trace.hpp"

namespace sac {

/// A traceable data type. A noexcept function must not allocate.
class Structure {
 public:
  virtual ~Structure() = default;

  /// Undoes `edge`: an observation is forgotten; an effect is reverted, and later observations of
  /// it are invalidated.
  virtual void retract(Call& call, Edge& edge) noexcept = 0;

  /// Whether `call`, a call in doubt whose turn it is, would observe the same as `edge` records;
  /// the function may update the record. The engine calls it for every edge of the call; for an
  /// effect it returns true. Throws: exceptions of client code that compares values.
  virtual bool unchanged(Call& call, Edge& edge) {
    static_cast<void>(call), static_cast<void>(edge);
    return true;
  }

  /// Called when a run or propagation, or its roll-back, has ended.
  virtual void finished() noexcept {}

  /// Gives the sink the name of the observed value, the same in every run (label.hpp): a part of
  /// the call's label [Def 1.4.1]. For an effect it does nothing.
  virtual void label(const Call&, const Edge&, LabelSink&) const {}
  /// Prints the observation or effect of an edge, for people; by default nothing.
  virtual void print(const Call&, const Edge&, std::ostream&) const {}

  /// Throws: InvariantError. Called by Engine::check_invariants.
  virtual void check_invariants() const {}
};

}  // namespace sac
