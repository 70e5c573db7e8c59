// Connected components of a graph whose edges are added and removed: union-find over the edges in
// random order.
//
// Idea: every edge is a call on an agenda: it walks from its ends to their roots and, if these
// differ, hangs the one with the lower lot under the other. A root's parent is a modifiable,
// written twice at most: itself at first, and by the edge that hangs it. The edges that hang
// something are the minimum spanning forest, the lots of the edges taken as lengths.
//
// Source: Goel, Khanna, Larkin, Tarjan, *Disjoint set union with randomized linking* (SODA 2014):
// depth O(log n) expected without path compression, which would write much and be read by many.
// Cost of an update: an edge that closes a cycle, O(log n). Any other moves the time at which a
// root is hung, and runs again the edges that ask for that root in between: in the mean some 40 of
// 2 * 10^5 edges drawn at random, 90 on a grid, and it grows with n, but slowly.
// Stable because: a call is named by its edge, its place is a hash of that name, and the lots of
// vertices are hashes too: nothing depends on what else is in the graph, or was.
#pragma once

#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "sac/sac.hpp"

namespace examples::connected_components {

inline std::uint64_t lot_of_vertex(int v) { return sac::mix(static_cast<std::uint64_t>(v) + 1); }
inline std::uint64_t lot_of_edge(int v, int w) {
  return sac::mix(static_cast<std::uint64_t>(v) << 32 | static_cast<unsigned>(w));
}

template <class S>
struct Components {
  std::vector<typename S::template ModType<int>> parents;  // itself: a root
  typename S::AgendaType* edges = nullptr;

  /// A graph without edges.
  template <class Host>
  Components(Host& host, int size) : edges(&host.make_agenda("edges")) {
    for (int v = 0; v < size; ++v) parents.push_back(host.template cell<int>());
    host.set_environment(this);
  }
  Components(const Components&) = delete;  // it is the environment
  Components& operator=(const Components&) = delete;

  /// Edits. Requires: v < w; the edge is not there, is there.
  void insert(int v, int w);
  void erase(int v, int w);
};

/// The root of v's component by what `parent_of(v)` says: equal for connected vertices only, and a
/// function of the graph alone. Cost: O(log n) expected.
template <class ParentOf>
int root_of(int v, ParentOf&& parent_of) {
  for (int up = parent_of(v); up != v; up = parent_of(v)) v = up;
  return v;
}

struct Join {
  static constexpr std::string_view kName = "join";
  template <class S>
  void operator()(S& s, int v, int w) const {
    auto& parents = s.template environment<Components<S>>().parents;
    std::uint64_t steps = 0;
    const auto parent_of = [&](int u) { return ++steps, s.read(parents[u]); };
    int low = root_of(v, parent_of);
    int high = root_of(w, parent_of);
    s.weigh(steps);
    if (low == high) return;
    if (lot_of_vertex(low) > lot_of_vertex(high)) std::swap(low, high);
    s.write(parents[low], high);
  }
};
inline constexpr Join join{};

template <class S>
void Components<S>::insert(int v, int w) {
  edges->template post_from_outside<join>({.order = lot_of_edge(v, w)}, v, w);
}
template <class S>
void Components<S>::erase(int v, int w) {
  edges->template retract_from_outside<join>(v, w);
}

struct Connect {
  static constexpr std::string_view kName = "connect";
  template <class S>
  void operator()(S& s) const {
    auto& components = s.template environment<Components<S>>();
    for (int v = 0; v < static_cast<int>(components.parents.size()); ++v) {
      s.write(components.parents[v], v);
    }
    components.edges->drain(s);
  }
};
/// The program: joins the edges of the environment.
inline constexpr Connect connect{};

}  // namespace examples::connected_components
