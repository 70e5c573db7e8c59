// A spanning forest of a graph whose edges change: in each component a tree of shortest paths to
// its least vertex.
//
// Idea: the place of a vertex, that is its root, its distance from that and its parent, is the
// least that its neighbours offer: a fixed point (sac/iterate.hpp).
//
// Cost of an update: O(degree) for each vertex and round in which a neighbour's place differs. The
// rounds are as many as the longest path that a root's number takes.
#pragma once

#include <algorithm>
#include <compare>
#include <ostream>
#include <string_view>

#include "vertex_values.hpp"

namespace examples::spanning_forest {

/// The place of a vertex in the forest; a root is its own parent.
struct Place {
  int root;
  int distance;
  int parent;
  friend auto operator<=>(const Place&, const Place&) = default;
  friend std::ostream& operator<<(std::ostream& out, const Place& p) {
    return out << "root " << p.root << ", distance " << p.distance << ", parent " << p.parent;
  }
};

template <class S>
using Graph = VertexValues<S, Place>;

struct Grow : VertexRule<Place> {
  static Place first(auto&, int v) { return {v, 0, v}; }
  static Place next(auto& s, int v) {
    Place least = first(s, v);
    for (const int w : dependents(s, v)) {
      const Place& place = s.read(value(s, w));
      least = std::min(least, Place{place.root, place.distance + 1, w});
    }
    return least;
  }
};

struct Span {
  static constexpr std::string_view kName = "span";
  void operator()(auto& s) const { iterate_all<Grow>(s); }
};
inline constexpr Span span{};

}  // namespace examples::spanning_forest
