// The core numbers of a graph whose edges change: the largest k such that a vertex belongs to a
// subgraph in which every vertex has k neighbours.
//
// Idea: the core number of a vertex is the largest h such that h of its neighbours have a core
// number of h or more (their h-index). Beginning with the degrees, each vertex takes the h-index of
// its neighbours' numbers until none changes: a fixed point (sac/iterate.hpp).
//
// Source: Lü, Zhou, Zhang, Stanley, *The H-index of a network node and its relation to degree and
// coreness* (2016).
// Cost of an update: O(degree) for each vertex and round in which a neighbour's number differs.
#pragma once

#include <algorithm>
#include <functional>
#include <string_view>
#include <vector>

#include "sac/iterate.hpp"
#include "sac/sac.hpp"

namespace examples::k_core {

template <class S>
struct Graph {
  std::vector<typename S::template ModType<std::vector<int>>> edges;  // inputs: of each vertex
  std::vector<typename S::template ModType<int>> core;
  typename S::AgendaType* rounds = nullptr;

  template <class Host>
  Graph(Host& host, int size) : rounds(&host.make_agenda("rounds")) {
    for (int v = 0; v < size; ++v) {
      edges.push_back(host.input(std::vector<int>{}));
      core.push_back(host.template cell<int>());
    }
    host.set_environment(this);
  }
  Graph(const Graph&) = delete;  // it is the environment
  Graph& operator=(const Graph&) = delete;
};

struct Core {
  template <class S>
  static auto& graph(S& s) {
    return s.template environment<Graph<S>>();
  }
  static auto& rounds(auto& s) { return *graph(s).rounds; }
  static auto value(auto& s, int v) { return graph(s).core[v]; }
  static const std::vector<int>& dependents(auto& s, int v) { return s.read(graph(s).edges[v]); }
  static int first(auto& s, int v) { return static_cast<int>(dependents(s, v).size()); }
  static int next(auto& s, int v) {
    std::vector<int> cores;
    for (const int w : dependents(s, v)) cores.push_back(s.read(value(s, w)));
    std::sort(cores.begin(), cores.end(), std::greater<>());
    int h = 0;
    while (h < static_cast<int>(cores.size()) && cores[h] > h) ++h;
    return h;
  }
};

struct Cores {
  static constexpr std::string_view kName = "cores";
  void operator()(auto& s) const {
    const int n = static_cast<int>(Core::graph(s).edges.size());
    sac::iterate<Core>(s, n);
  }
};
inline constexpr Cores cores{};

}  // namespace examples::k_core
