// Structures: what calls observe and act on, and what the engine asks of them.
//
// Modifiables and agendas are structures, and users write their own; docs/traceable_types.md goes
// through one. A structure keeps what it needs to know in trace order (Engine::precedes), and tells
// the engine whose observations may have changed (Engine::invalidate, Engine::doubt).
//
// Rules that the engine and a structure keep together:
// (1) An observation at a call sees the effects of the calls before it in trace order, and the
//     call's own of this execution.
// (2) What a running call did last time and has not repeated is hidden: from itself, and from the
//     calls in its interval, which may become its children again. Later calls go on seeing it. If
//     the call repeats it, it is there for all; if not, it is taken back when the call has settled.
// (3) An effect that its own call's children should have seen comes too late: an error, by the
//     engine, as soon as one of them that has run is invalidated or would see something else.
#pragma once

#include <cstddef>
#include <ostream>

#include "sac/trace.hpp"

namespace sac {

/// A traceable data type. What must not throw must not allocate.
class Structure {
 public:
  virtual ~Structure() = default;

  /// Takes `edge` back: an observation is forgotten; an effect is reverted, and the observations
  /// it reached later in time are invalidated.
  virtual void retract(Call& call, Edge& edge) noexcept = 0;

  /// `call` runs, has not repeated `edge`, and is about to have children: the observations of the
  /// effect by calls behind `call`, up to the time stamp `end` (0: the end of the trace), are
  /// invalidated or doubted. An answer that is given from now on skips it (rule 2): `unrepeated`
  /// tells. Nothing to do for an observation.
  virtual void hide(Call& call, Edge& edge, Handle end) noexcept {
    static_cast<void>(call), static_cast<void>(edge), static_cast<void>(end);
  }

  /// Whether `call`, which is in doubt and whose turn it is, would be told the same as `edge` says;
  /// that may be brought up to date. Asked of every edge, an effect says yes.
  /// Throws: what client code that compares throws.
  virtual bool unchanged(Call& call, Edge& edge) {
    static_cast<void>(call), static_cast<void>(edge);
    return true;
  }

  /// A run or propagation, or its roll-back, is over.
  virtual void finished() noexcept {}

  /// Names what an observation saw, equally in every run (label.hpp): a part of the call's label
  /// [Def 1.4.1]. An effect has nothing to say.
  virtual void label(const Call&, const Edge&, LabelSink&) const {}
  /// Prints what an edge saw or did, for people; nothing by default.
  virtual void print(const Call&, const Edge&, std::ostream&) const {}

  /// Throws: InvariantError. Called by Engine::check_invariants.
  virtual void check_invariants() const {}
};

}  // namespace sac
