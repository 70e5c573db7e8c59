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

#include "vertex_values.hpp"

namespace examples::k_core {

template <class S>
using Graph = VertexValues<S, int>;

struct Core : VertexRule<int> {
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
  void operator()(auto& s) const { iterate_all<Core>(s); }
};
inline constexpr Cores cores{};

}  // namespace examples::k_core
