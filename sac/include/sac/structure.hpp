// Structures: traceable data types, which calls observe and change, and their interface to the
// engine.
//
// Modifiables and agendas are structures, and users write their own; docs/traceable_types.md shows
// how. A structure keeps its records in trace order (Engine::precedes), and tells the engine which
// calls' observations may have changed (Engine::invalidate, Engine::doubt).
//
// Rules that the engine and a structure keep together:
// (1) An observation at a call sees the effects of the calls before it in trace order, and the
//     call's own effects of this execution.
// (2) Effects of a running call's last execution that it has not repeated yet are hidden from the
//     call itself, and from the calls in its interval, which may become its children again. Later
//     calls still see them. If the call repeats an effect, every call sees it again; if not, the
//     effect is undone when the call has settled.
// (3) An effect that children of the same call should have seen comes too late: the engine reports
//     an error as soon as one of them that has run is invalidated or would see something else.
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

  /// Hides the effect `edge`, which the running `call` has not repeated, before `call` has
  /// children: the structure invalidates or doubts the observations of the effect by calls behind
  /// `call`, up to the time stamp `end` (0: the end of the trace). Observations made from now on
  /// must skip it (rule 2); see `unrepeated`. For an observation there is nothing to do.
  virtual void hide(Call& call, Edge& edge, Handle end) noexcept {
    static_cast<void>(call), static_cast<void>(edge), static_cast<void>(end);
  }

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
