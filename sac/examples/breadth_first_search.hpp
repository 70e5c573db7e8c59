// Hops from a source to every vertex of a graph whose edges change.
//
// Idea: the queue of breadth-first search is an agenda, its buckets are the levels. The first call
// that finds a vertex gives it its level; the modifiable of a vertex is written twice: "not
// reached" at first, and by that call.
//
// Source: Moore, *The shortest path through a maze* (1959); the queue as [§1.5] of Hudson's
// *Dynamic Mesh Refinement*.
// Cost of an update: O(degree) for each vertex whose level changes, and every update needs at least
// one step for each, since the levels are the output; an edge at the source may change all of them.
// Stable because: calls are named by vertex and level, and the agenda orders them by level. A
// vertex of an undirected graph has three calls at most: its own level, and two later ones that its
// neighbours ask for in vain.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

#include "sac/sac.hpp"

namespace examples::breadth_first_search {

inline constexpr int kUnreached = std::numeric_limits<int>::max();

template <class S>
struct Graph {
  template <class T>
  using Mod = typename S::template ModType<T>;

  Mod<int> source;                           // input: a vertex
  std::vector<Mod<std::vector<int>>> edges;  // inputs: where each vertex leads
  std::vector<Mod<int>> hops;                // from the source, or kUnreached
  typename S::AgendaType* queue = nullptr;

  /// A graph without edges. Requires: size > 0.
  template <class Host>
  Graph(Host& host, int size) : source(host.input(0)), queue(&host.make_agenda("levels")) {
    for (int v = 0; v < size; ++v) {
      edges.push_back(host.input(std::vector<int>{}));
      hops.push_back(host.template cell<int>());
    }
    host.set_environment(this);
  }
  Graph(const Graph&) = delete;  // it is the environment
  Graph& operator=(const Graph&) = delete;
};

struct Visit {
  static constexpr std::string_view kName = "visit";
  template <class S>
  void operator()(S& s, int v, int level) const;
};
inline constexpr Visit visit{};

template <class S>
void post_visit(S& s, int v, int level) {
  constexpr int kLastBucket = 32767;  // levels beyond share it, in order
  const sac::Key key{.bucket = std::min(level, kLastBucket),
                     .order = static_cast<std::uint64_t>(level) << 32 | static_cast<unsigned>(v)};
  s.template environment<Graph<S>>().queue->template post<visit>(s, key, v, level);
}

template <class S>
void Visit::operator()(S& s, int v, int level) const {
  auto& graph = s.template environment<Graph<S>>();
  if (s.read(graph.hops[v]) <= level) return;
  s.write(graph.hops[v], level);
  const std::vector<int>& edges = s.read(graph.edges[v]);
  s.weigh(edges.size());
  for (const int w : edges) post_visit(s, w, level + 1);
}

struct Begin {
  static constexpr std::string_view kName = "begin";
  template <class S>
  void operator()(S& s) const {
    post_visit(s, s.read(s.template environment<Graph<S>>().source), 0);
  }
};
inline constexpr Begin begin{};

struct Search {
  static constexpr std::string_view kName = "search";
  template <class S>
  void operator()(S& s) const {
    auto& graph = s.template environment<Graph<S>>();
    for (const auto hops : graph.hops) s.write(hops, kUnreached);
    s.template call<begin>();
    graph.queue->drain(s);
  }
};
/// The program: searches the graph of the environment.
inline constexpr Search search{};

}  // namespace examples::breadth_first_search
