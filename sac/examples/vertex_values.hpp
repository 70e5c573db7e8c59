// A graph whose edges change, and a value for each vertex that a fixed point gives
// (sac/iterate.hpp).
#pragma once

#include <vector>

#include "sac/sac.hpp"

namespace examples {

template <class S, class T>
struct VertexValues {
  std::vector<typename S::template ModType<std::vector<int>>> edges;  // inputs: of each vertex
  std::vector<typename S::template ModType<T>> values;
  typename S::AgendaType* rounds = nullptr;

  /// A graph without edges.
  template <class Host>
  VertexValues(Host& host, int size) : rounds(&host.make_agenda("rounds")) {
    for (int v = 0; v < size; ++v) {
      edges.push_back(host.input(std::vector<int>{}));
      values.push_back(host.template cell<T>());
    }
    host.set_environment(this);
  }
  VertexValues(const VertexValues&) = delete;  // it is the environment
  VertexValues& operator=(const VertexValues&) = delete;
};

/// The part of a rule that all have: T is the type of values.
template <class T>
struct VertexRule {
  template <class S>
  static auto& graph(S& s) {
    return s.template environment<VertexValues<S, T>>();
  }
  static auto& rounds(auto& s) { return *graph(s).rounds; }
  static auto value(auto& s, int v) { return graph(s).values[v]; }
  static const std::vector<int>& dependents(auto& s, int v) { return s.read(graph(s).edges[v]); }
};

/// Computes the fixed point of Rule for all vertices.
template <class Rule>
void iterate_all(auto& s) {
  sac::iterate<Rule>(s, static_cast<int>(Rule::graph(s).edges.size()));
}

}  // namespace examples
