// Fixed points: a value for each of many vertices, computed from those of its neighbours again and
// again until none changes.
//
//   struct Distance {                                             // of a graph's vertices
//     static auto& rounds(auto& s);                               // an agenda of its own
//     static auto value(auto& s, int v);                          // the modifiable of v
//     static int first(auto& s, int v);                           // what it is to begin with
//     static int next(auto& s, int v);                            // what its neighbours make of it
//     static const std::vector<int>& dependents(auto& s, int v);  // those whose next() reads it
//   };
//   sac::iterate<Distance>(s, vertices);
//
// In round 0 every vertex gets its next value, in each later round those do of which a neighbour
// has changed, in the order of <=>; a vertex sees what those before it have in the same round. At
// the end the value of each vertex is the next one: a fixed point. It is the one that this order
// reaches; where a rule has one fixed point above (or below) all first values, it is that. A rule
// that never comes to rest ends when the agenda has no bucket for the next round.
//
// An update runs, in each round, the vertices whose neighbours differ there from the last time.
// Cost: a call for each vertex that is looked at in a round; O(log) of those in a post.
// Source: semi-naive evaluation, as of Datalog.
#pragma once

#include <string_view>
#include <type_traits>
#include <utility>

#include "sac/agenda.hpp"
#include "sac/internal/same.hpp"

namespace sac {

namespace detail {

// A vertex in a round.
template <class Rule>
struct Round {
  static constexpr std::string_view kName = "round";
  template <class S, class V>
  void operator()(S& s, int round, const V& v) const {
    const auto value = Rule::value(s, v);
    auto next = Rule::next(s, v);
    if (identical(next, s.read(value))) return;
    s.write(value, std::move(next));
    for (const V& w : Rule::dependents(s, v)) {
      Rule::rounds(s).template post<Round{}>(s, {.bucket = round + 1}, round + 1, w);
    }
  }
};

template <class Rule>
struct FirstValue {
  static constexpr std::string_view kName = "first value";
  template <class S, class V>
  void operator()(S& s, const V& v) const {
    s.write(Rule::value(s, v), Rule::first(s, v));
    Rule::rounds(s).template post<Round<Rule>{}>(s, {.bucket = 0}, 0, v);
  }
};

}  // namespace detail

/// Computes the fixed point of a rule for a range of vertices, or for the vertices 0 .. n - 1 if a
/// number n is given, each in calls of its own. Throws:
/// UsageError if it takes more rounds than the agenda has buckets, from 0 on.
template <class Rule, class S, class Vertices>
void iterate(S& s, const Vertices& vertices) {
  if constexpr (std::is_integral_v<Vertices>) {
    for (Vertices v = 0; v < vertices; ++v) s.template call<detail::FirstValue<Rule>{}>(v);
  } else {
    for (const auto& v : vertices) s.template call<detail::FirstValue<Rule>{}>(v);
  }
  Rule::rounds(s).drain(s);
}

}  // namespace sac
