// A presence: a thing exists while some call produces it, from its earliest producer on.
//
// For structures whose effects mean that a thing exists: members of a set, nodes of a graph.
// Several calls may produce one thing; a call sees it if a producer precedes the call. So only the
// earliest producer, the *birth*, matters. When it changes, only the calls between the old birth
// and the new one see a difference: the Window.
//
//   struct Members : sac::Structure {                       // presences_(engine), id_
//     void add(sac::Scope& s, Thing& thing) {
//       const auto same = [&](const Producing& e) { return e.thing == &thing; };
//       if (s.recall<Producing>(id_, kProducing, same) != nullptr) return;
//       auto& edge = s.effect<Producing>(id_, kProducing);  // Producing : sac::ProducerEdge
//       edge.thing = &thing;
//       tell(thing, presences_.produced(thing.presence, edge, s.self()));
//     }
//     void retract(sac::Call&, sac::Edge& edge) noexcept override {
//       auto& e = static_cast<Producing&>(edge);
//       tell(*e.thing, presences_.retracted(e.thing->presence, e));
//     }
//     ...                       // tell: invalidates the observers of thing that are in the window
//   };
//
// A call does not see a thing by its own production. Queries are made in the name of a call; a
// structure whose calls produce things and then have children must hide from the children the
// things that the call has not repeated yet.
#pragma once

#include <optional>

#include "sac/check.hpp"
#include "sac/engine.hpp"

namespace sac {

/// The effect of producing a thing; a structure derives its own edge from it, which names the
/// thing.
struct ProducerEdge : Edge {
  Handle call = 0;  // the producer
  Handle next = 0;  // another producer of the same thing
};

/// The record that a structure keeps for each thing. Eight bytes; all zero: no call produces it.
class Presence {
 public:
  /// Whether some call produces it.
  [[nodiscard]] bool there() const noexcept { return birth_ != 0; }
  /// The earliest producer; 0 if there is none.
  [[nodiscard]] Handle birth() const noexcept { return birth_; }

 private:
  friend class Presences;
  Handle producers_ = 0;  // edges, the newest first
  Handle birth_ = 0;
};

/// The calls behind `after`, up to and including `last` (null: all calls behind).
struct Window {
  const Call* after;
  const Call* last;

  [[nodiscard]] bool contains(const Engine& engine, const Call& call) const noexcept {
    return engine.precedes(*after, call) && (last == nullptr || !engine.precedes(*last, call));
  }
};

/// The operations on the presences of an engine.
class Presences {
 public:
  explicit Presences(Engine& engine) noexcept : engine_(engine) {}

  /// Whether a producer precedes `call`. Cost: O(1).
  [[nodiscard]] bool seen_by(const Presence& p, const Call& call) const noexcept {
    if (!p.there() || p.birth_ == engine_.handle_of(call)) return false;
    return engine_.appending() || engine_.precedes(engine_.call(p.birth_), call);
  }

  /// Records that `call` produces the thing: `edge` is its new effect. Returns the calls that see
  /// the thing now and did not before; nothing if there are none. Cost: O(1).
  [[nodiscard]] std::optional<Window> produced(Presence& p, ProducerEdge& edge,
                                               const Call& call) noexcept;
  /// Records that the effect is undone. Returns the calls that saw the thing and no longer do.
  /// Requires: produced(p, edge, ...) before. Cost: O(producers).
  [[nodiscard]] std::optional<Window> retracted(Presence& p, ProducerEdge& edge) noexcept;

  /// Throws: InvariantError if p's birth is not its earliest producer. Cost: O(producers).
  void check_invariants(const Presence& p) const;

 private:
  [[nodiscard]] ProducerEdge& edge(Handle h) const noexcept {
    return *engine_.arena().at<ProducerEdge>(h);
  }
  [[nodiscard]] Handle earliest(const Presence& p) const noexcept;

  Engine& engine_;
};

inline std::optional<Window> Presences::produced(Presence& p, ProducerEdge& edge,
                                                 const Call& call) noexcept {
  edge.call = engine_.handle_of(call);
  edge.next = p.producers_;
  p.producers_ = engine_.arena().handle_of(&edge);
  const Handle old = p.birth_;
  const bool earlier =
      old == 0 || (!engine_.appending() && engine_.precedes(call, engine_.call(old)));
  if (!earlier) return std::nullopt;
  p.birth_ = edge.call;
  if (engine_.appending()) return std::nullopt;  // no call is behind
  return Window{&call, old == 0 ? nullptr : &engine_.call(old)};
}

inline std::optional<Window> Presences::retracted(Presence& p, ProducerEdge& gone) noexcept {
  const Handle self = engine_.arena().handle_of(&gone);
  Handle* link = &p.producers_;
  while (*link != self) link = &edge(*link).next;
  *link = gone.next;
  const Handle old = p.birth_;
  if (old != gone.call) return std::nullopt;
  p.birth_ = earliest(p);
  if (p.birth_ == old || engine_.appending()) return std::nullopt;
  return Window{&engine_.call(old), p.birth_ == 0 ? nullptr : &engine_.call(p.birth_)};
}

inline Handle Presences::earliest(const Presence& p) const noexcept {
  Handle first = 0;
  for (Handle h = p.producers_; h != 0; h = edge(h).next) {
    const Handle call = edge(h).call;
    if (first == 0 || engine_.precedes(engine_.call(call), engine_.call(first))) first = call;
  }
  return first;
}

inline void Presences::check_invariants(const Presence& p) const {
  SAC_INVARIANT(p.birth_ == earliest(p));
  for (Handle h = p.producers_; h != 0; h = edge(h).next) {
    SAC_INVARIANT(!engine_.call(edge(h).call).dead());
  }
}

}  // namespace sac
