// Sum and diameter of every tree of a forest under links and cuts, by tree contraction.
//
// Idea: in rounds, a leaf is raked into its neighbour, and a vertex with two neighbours gives way
// to an edge between them if its coin says so; what is left carries the sums and distances of what
// is gone, and the last vertex of a tree has the tree's. A constant share of the vertices goes in
// each round, so it takes O(log n) expected rounds and O(n) calls.
//
// Source: Miller, Reif, *Parallel tree contraction* (FOCS 1985); made dynamic as in Acar, Blelloch,
// Harper, Vittes, Woo, *Dynamizing static algorithms* (SODA 2004). Departure: the coin is a number,
// and the vertex whose number is greatest among itself and its two neighbours is compressed: a
// third of a path instead of an eighth.
// Cost of an update: O(log n) expected for a link, a cut or a new weight.
// Stable because: coins are hashes of vertex and round; a call is named by vertex and round, and
// rounds are the buckets of an agenda, so common calls come in one order. An edit changes a
// constant number of vertices in each round: those whose surroundings it reaches.
//
// A vertex's state is one modifiable that each of its rounds writes.
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
  std::vector<Mod<State>> states;
  std::vector<Mod<Outcome>> outcomes;
  typename S::AgendaType* rounds = nullptr;

  /// A forest of isolated vertices.
  template <class Host>
  Forest(Host& host, int size) : rounds(&host.make_agenda("rounds")) {
    for (int v = 0; v < size; ++v) {
      vertices.push_back(host.input(Vertex{}));
      states.push_back(host.template cell<State>());
      outcomes.push_back(host.template cell<Outcome>());
    }
    host.set_environment(this);
  }
  Forest(const Forest&) = delete;  // it is the environment
  Forest& operator=(const Forest&) = delete;
};

/// The state of the last vertex of v's tree: the tree's sum and diameter. Equal answers from
/// `last_vertex` for two vertices: they are connected. Cost: O(log n) expected.
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

template <class S>
void post_decide(S& s, int v, int round) {
  auto& forest = s.template environment<Forest<S>>();
  forest.rounds->template post<decide>(s, {.bucket = round, .phase = 1}, v, round);
}

template <class S>
void Start::operator()(S& s, int v) const {
  auto& forest = s.template environment<Forest<S>>();
  const Vertex& vertex = s.read(forest.vertices[v]);
  SAC_EXPECTS(vertex.edges.size() <= kDegree);
  State state;
  state.sum = vertex.weight;
  for (const auto& edge : vertex.edges) {
    state.paths[state.degree++] = {.to = edge.to, .length = edge.length};
  }
  s.write(forest.states[v], state);
  s.write(forest.outcomes[v], Outcome{});
  post_decide(s, v, 0);
}

// What v does in this round, by the degrees of its neighbours.
template <class S>
Outcome outcome_of(S& s, int v, int round) {
  auto& forest = s.template environment<Forest<S>>();
  const State state = s.read(forest.states[v]);
  const int next = state.paths[0].to;
  const auto degree = [&](int w) { return s.read(forest.states[w]).degree; };
  if (state.degree == 0) return {Fate::last, v};
  if (state.degree == 1) {
    return degree(next) > 1 || next < v ? Outcome{Fate::raked, next} : Outcome{};
  }
  if (state.degree > 2) return {};
  const auto gives_way = [&](int w) { return coin(w, round) < coin(v, round) && degree(w) > 1; };
  return gives_way(next) && gives_way(state.paths[1].to) ? Outcome{Fate::compressed, next}
                                                         : Outcome{};
}

template <class S>
void Decide::operator()(S& s, int v, int round) const {
  auto& forest = s.template environment<Forest<S>>();
  const Outcome outcome = outcome_of(s, v, round);
  if (outcome.fate != Fate::stays) return s.write(forest.outcomes[v], outcome);
  forest.rounds->template post<advance>(s, {.bucket = round, .phase = 2}, v, round);
}

template <class S>
void Advance::operator()(S& s, int v, int round) const {
  auto& forest = s.template environment<Forest<S>>();
  const State before = s.read(forest.states[v]);
  State state = before;
  state.degree = 0;
  state.paths = {};
  for (int i = 0; i < before.degree; ++i) {
    const Path& path = before.paths[i];
    const Fate fate = s.read(forest.outcomes[path.to]).fate;
    if (fate == Fate::stays) {
      state.paths[state.degree++] = path;
    } else if (const State& gone = s.read(forest.states[path.to]); fate == Fate::raked) {
      rake(state, path, gone);
    } else {
      state.paths[state.degree++] = join(path, gone, other_path(gone, v));
    }
  }
  s.write(forest.states[v], state);
  post_decide(s, v, round + 1);
}

struct Contract {
  static constexpr std::string_view kName = "contract";
  template <class S>
  void operator()(S& s) const {
    auto& forest = s.template environment<Forest<S>>();
    for (int v = 0; v < static_cast<int>(forest.vertices.size()); ++v) {
      forest.rounds->template post<start>(s, {.bucket = 0}, v);
    }
    forest.rounds->drain(s);
  }
};
/// The program: contracts the forest of the environment.
inline constexpr Contract contract{};

}  // namespace examples::tree_contraction
