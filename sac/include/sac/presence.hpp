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
//       tell(thing, presences_.produced(thing.presence, edge, s.place()));
//     }
//     void retract(sac::Call&, sac::Edge& edge) noexcept override {
//       auto& e = static_cast<Producing&>(edge);
//       tell(*e.thing, presences_.retracted(e.thing->presence, e));
//     }
//     ...                       // tell: invalidates the observers of thing that are in the window
//   };
//
// A place does not see a thing by its own production (Scope::place).
#pragma once

#include <optional>

#include "sac/check.hpp"
#include "sac/engine.hpp"

namespace sac {

/// The effect of producing a thing; a structure derives its own edge from it, which names the
/// thing.
struct ProducerEdge : Edge {
  Place place;             // of the producer (Scope::place)
  Ref<ProducerEdge> next;  // another producer of the same thing
};

/// The record that a structure keeps for each thing. Eight bytes; all zero: no call produces it.
class Presence {
 public:
  /// Whether some call produces it.
  [[nodiscard]] bool there() const noexcept { return birth_ != nullptr; }
  /// The place of the earliest producer; null if there is none.
  [[nodiscard]] Place birth() const noexcept { return birth_; }

 private:
  friend class Presences;
  Ref<ProducerEdge> producers_;  // the newest first
  Place birth_;
};

/// The places behind `after`, up to and including `last` (null: all places behind).
struct Window {
  const TimeNode* after;
  const TimeNode* last;

  [[nodiscard]] bool contains(const Engine& engine, const TimeNode& place) const noexcept {
    return engine.precedes(*after, place) && (last == nullptr || !engine.precedes(*last, place));
  }
};

/// The operations on the presences of an engine.
class Presences {
 public:
  explicit Presences(Engine& engine) noexcept : engine_(engine) {}

  /// Whether a producer precedes `place`. Cost: O(1).
  [[nodiscard]] bool seen_at(const Presence& p, Place place) const noexcept {
    if (!p.there() || p.birth_ == place) return false;
    return engine_.appending() || engine_.precedes(engine_.time(p.birth_), engine_.time(place));
  }

  /// The same before the children of `call`.
  [[nodiscard]] bool seen_by(const Presence& p, const Call& call) const noexcept {
    return seen_at(p, engine_.handle_of(call));
  }

  /// Records that the thing is produced at `place`: `edge` is the new effect. Returns the places
  /// that see the thing now and did not before; nothing if there are none. Cost: O(1).
  [[nodiscard]] std::optional<Window> produced(Presence& p, ProducerEdge& edge,
                                               Place place) noexcept;
  /// Records that the effect is undone. Returns the places that saw the thing and no longer do.
  /// Requires: produced(p, edge, ...) before. Cost: O(producers).
  [[nodiscard]] std::optional<Window> retracted(Presence& p, ProducerEdge& edge) noexcept;

  /// Throws: InvariantError if p's birth is not its earliest producer. Cost: O(producers).
  void check_invariants(const Presence& p) const;

 private:
  [[nodiscard]] ProducerEdge& at(Ref<ProducerEdge> edge) const noexcept {
    return engine_.arena()[edge];
  }
  [[nodiscard]] Place earliest(const Presence& p) const noexcept;

  Engine& engine_;
};

inline std::optional<Window> Presences::produced(Presence& p, ProducerEdge& edge,
                                                 Place place) noexcept {
  edge.place = place;
  edge.next = p.producers_;
  p.producers_ = Arena::ref(edge);
  const Place old = p.birth_;
  const bool earlier = old == nullptr || (!engine_.appending() &&
                                          engine_.precedes(engine_.time(place), engine_.time(old)));
  if (!earlier) return std::nullopt;
  p.birth_ = place;
  if (engine_.appending()) return std::nullopt;  // nothing is behind
  return Window{&engine_.time(place), old == nullptr ? nullptr : &engine_.time(old)};
}

inline std::optional<Window> Presences::retracted(Presence& p, ProducerEdge& gone) noexcept {
  const Ref<ProducerEdge> self = Arena::ref(gone);
  Ref<ProducerEdge>* link = &p.producers_;
  while (*link != self) link = &at(*link).next;
  *link = gone.next;
  const Place old = p.birth_;
  if (old != gone.place) return std::nullopt;
  p.birth_ = earliest(p);
  if (p.birth_ == old || engine_.appending()) return std::nullopt;
  return Window{&engine_.time(old), p.birth_ == nullptr ? nullptr : &engine_.time(p.birth_)};
}

inline Place Presences::earliest(const Presence& p) const noexcept {
  Place first;
  for (Ref<ProducerEdge> e = p.producers_; e != nullptr; e = at(e).next) {
    const Place place = at(e).place;
    if (first == nullptr || engine_.precedes(engine_.time(place), engine_.time(first)))
      first = place;
  }
  return first;
}

inline void Presences::check_invariants(const Presence& p) const {
  SAC_INVARIANT(p.birth_ == earliest(p));
  for (Ref<ProducerEdge> e = p.producers_; e != nullptr; e = at(e).next) {
    SAC_INVARIANT(!engine_.call_at(at(e).place).dead());
  }
}

}  // namespace sac
