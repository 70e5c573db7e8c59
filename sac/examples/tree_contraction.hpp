// Sum and diameter of every tree of a forest under links and cuts, by tree contraction.
//
// Idea: in rounds, a leaf is raked into its neighbour, and a vertex with two neighbours gives way
// to an edge between them if its coin says so; the remaining vertices and edges carry the sums and
// distances of the contracted ones, and the last vertex of a tree has those of the tree. Each round
// removes a constant fraction of the vertices, so it takes O(log n) expected rounds and O(n) calls.
//
// Source: Miller, Reif, *Parallel tree contraction* (FOCS 1985); made dynamic as in Acar, Blelloch,
// Harper, Vittes, Woo, *Dynamizing static algorithms* (SODA 2004). Departure: the coin is a number,
// and the vertex whose number is greatest among itself and its two neighbours is compressed: a
// third of a path instead of an eighth.
// Cost of an update: O(log n) expected for a link, a cut or a new weight: on a path some 20 calls
// for each doubling of n, on a random tree 3.
// Stable because: coins are hashes of vertex and round; a call is named by vertex and round, and
// rounds are the buckets of an agenda, so common calls come in one order. An edit changes a
// constant number of vertices in each round: those whose surroundings it reaches.
//
// A vertex's neighbours, which decide, and its load, which does not, are two modifiables that its
// rounds write.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "forest.hpp"
#include "sac/sac.hpp"

namespace examples::tree_contraction {

template <class S>
struct Forest {
  template <class T>
  using Mod = typename S::template ModType<T>;

  std::vector<Mod<Vertex>> vertices;  // inputs
  std::vector<Mod<Shape>> shapes;
  std::vector<Mod<Load>> loads;
  std::vector<Mod<Outcome>> outcomes;
  typename S::AgendaType* rounds = nullptr;

  /// A forest of isolated vertices.
  template <class Host>
  Forest(Host& host, int size) : rounds(&host.make_agenda("rounds")) {
    for (int v = 0; v < size; ++v) {
      vertices.push_back(host.input(Vertex{}));
      shapes.push_back(host.template cell<Shape>());
      loads.push_back(host.template cell<Load>());
      outcomes.push_back(host.template cell<Outcome>());
    }
    host.set_environment(this);
  }
  Forest(const Forest&) = delete;  // it is the environment
  Forest& operator=(const Forest&) = delete;
};

/// The last vertex of v's tree, the same for all of its vertices; its load has the tree's sum and
/// diameter. Cost: O(log n) expected.
template <class Host, class S>
int last_vertex(Host& host, const Forest<S>& forest, int v) {
  for (;;) {
    const Outcome outcome = host.get(forest.outcomes[v]);
    if (outcome.fate == Fate::last) return v;
    v = outcome.into;
  }
}

inline std::uint64_t coin(int v, int round) {
  return sac::mix(static_cast<std::uint64_t>(v) << 32 | static_cast<unsigned>(round));
}

struct Start {
  static constexpr std::string_view kName = "start";
  template <class S>
  void operator()(S& s, int v) const;
};
struct Decide {
  static constexpr std::string_view kName = "decide";
  template <class S>
  void operator()(S& s, int v, int round) const;
};
struct Advance {
  static constexpr std::string_view kName = "advance";
  template <class S>
  void operator()(S& s, int v, int round) const;
};
inline constexpr Start start{};
inline constexpr Decide decide{};
inline constexpr Advance advance{};

inline sac::Key key_of(int round, unsigned phase, int v) {
  return {.bucket = round, .phase = phase, .order = static_cast<unsigned>(v)};
}

template <class S>
void Start::operator()(S& s, int v) const {
  auto& forest = s.template environment<Forest<S>>();
  const Vertex& vertex = s.read(forest.vertices[v]);
  SAC_EXPECTS(vertex.edges.size() <= kDegree);
  Shape shape;
  Load load{.sum = vertex.weight, .paths = {}};
  for (const auto& edge : vertex.edges) {
    load.paths[shape.degree].length = edge.length;
    shape.to[shape.degree++] = edge.to;
  }
  s.write(forest.shapes[v], shape);
  s.write(forest.loads[v], load);
  s.write(forest.outcomes[v], Outcome{});
  forest.rounds->template post<decide>(s, key_of(0, 1, v), v, 0);
}

// What v does in this round, by the degrees of its neighbours.
template <class S>
Outcome outcome_of(S& s, int v, int round) {
  auto& forest = s.template environment<Forest<S>>();
  const Shape shape = s.read(forest.shapes[v]);
  const auto degree = [&](int w) { return s.read(forest.shapes[w]).degree; };
  const int next = shape.to[0];
  if (shape.degree == 0) return {Fate::last, v};
  if (shape.degree == 1) {
    return degree(next) > 1 || next < v ? Outcome{Fate::raked, next} : Outcome{};
  }
  if (shape.degree > 2) return {};
  const auto gives_way = [&](int w) { return coin(w, round) < coin(v, round) && degree(w) > 1; };
  return gives_way(next) && gives_way(shape.to[1]) ? Outcome{Fate::compressed, next} : Outcome{};
}

template <class S>
void Decide::operator()(S& s, int v, int round) const {
  auto& forest = s.template environment<Forest<S>>();
  const Outcome outcome = outcome_of(s, v, round);
  if (outcome.fate != Fate::stays) return s.write(forest.outcomes[v], outcome);
  forest.rounds->template post<advance>(s, key_of(round, 2, v), v, round);
}

template <class S>
void Advance::operator()(S& s, int v, int round) const {
  auto& forest = s.template environment<Forest<S>>();
  const Shape old_shape = s.read(forest.shapes[v]);
  const Load old_load = s.read(forest.loads[v]);
  Shape shape;
  Load load = old_load;
  load.paths = {};
  const auto keep = [&](int to, const Path& path) {
    load.paths[shape.degree] = path;
    shape.to[shape.degree++] = to;
  };
  for (int i = 0; i < old_shape.degree; ++i) {
    const int w = old_shape.to[i];
    const Path& path = old_load.paths[i];
    const Fate fate = s.read(forest.outcomes[w]).fate;
    if (fate == Fate::stays) {
      keep(w, path);
    } else if (const Load& gone = s.read(forest.loads[w]); fate == Fate::raked) {
      rake(load, path, gone);
    } else {
      const Shape& ends = s.read(forest.shapes[w]);
      const int other = ends.to[0] == v ? 1 : 0;
      keep(ends.to[other], join(path, gone, gone.paths[other]));
    }
  }
  s.write(forest.loads[v], load);
  if (shape != old_shape) s.write(forest.shapes[v], shape);
  forest.rounds->template post<decide>(s, key_of(round + 1, 1, v), v, round + 1);
}

struct Contract {
  static constexpr std::string_view kName = "contract";
  template <class S>
  void operator()(S& s) const {
    auto& forest = s.template environment<Forest<S>>();
    for (int v = 0; v < static_cast<int>(forest.vertices.size()); ++v) {
      forest.rounds->template post<start>(s, key_of(0, 0, v), v);
    }
    forest.rounds->drain(s);
  }
};
/// The program: contracts the forest of the environment.
inline constexpr Contract contract{};

}  // namespace examples::tree_contraction
