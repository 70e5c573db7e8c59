// The examples on trees and graphs (sac/examples): from scratch and under edits.
//
//   graph_examples_bench [SCALE [EXAMPLE]]     default 1 and all; 0.1: with a tenth of the elements
//
// The figures are explained in measure_example.hpp.
#include <algorithm>
#include <cstdint>
#include <queue>
#include <type_traits>
#include <utility>
#include <vector>

#include "../examples/breadth_first_search.hpp"
#include "../examples/build_graph.hpp"
#include "../examples/connected_components.hpp"
#include "../examples/expression_tree.hpp"
#include "../examples/k_core.hpp"
#include "../examples/spanning_forest.hpp"
#include "../examples/tree_contraction.hpp"
#include "bench_help.hpp"
#include "measure_example.hpp"
#include "sac/sac.hpp"

namespace {

using namespace examples;
using bench::IntRandom;
using bench::ScopeOf;

// --- Expression tree: n numbers under a balanced tree of + and -; a number changes ---------------

struct Expression {
  static constexpr const char* kName = "expression_tree";

  struct Term {
    char op = 0;
    std::uint64_t number = 0;
    int left = 0, right = 0;
  };
  struct Input {
    std::vector<Term> terms;  // node i has operands 2i + 1 and 2i + 2
    explicit Input(int n) : terms(static_cast<std::size_t>(2 * n - 1)) {
      IntRandom random;
      for (int i = 0; i < 2 * n - 1; ++i) {
        auto& term = terms[static_cast<std::size_t>(i)];
        if (i >= n - 1) {
          term.number = random.next() % 1000;
        } else {
          term = {"+-"[random(2)], 0, 2 * i + 1, 2 * i + 2};
        }
      }
    }
    std::uint64_t value_of(int i) const {
      const Term& term = terms[static_cast<std::size_t>(i)];
      if (term.op == 0) return term.number;
      const std::uint64_t left = value_of(term.left);
      const std::uint64_t right = value_of(term.right);
      return term.op == '+' ? left + right : left - right;
    }
    std::uint64_t baseline() const { return value_of(0); }
  };

  template <class Host>
  struct World {
    using S = ScopeOf<Host>;
    using Node = expression_tree::Node<S>;
    Host& host;
    std::vector<expression_tree::Operand<S>> operands;  // by number of the term
    expression_tree::NumberMod<S> out;

    World(Host& h, const Input& input)
        : host(h), operands(input.terms.size()), out(h.template cell<std::uint64_t>()) {
      for (std::size_t i = operands.size(); i-- > 0;) {
        const auto& term = input.terms[i];
        if (term.op == 0) {
          operands[i].number = host.input(std::uint64_t{term.number});
          continue;
        }
        Node& node = host.template make<Node>();
        operands[i].node = &node;
        host.set(node.term,
                 expression_tree::Term<S>{term.op, operands[static_cast<std::size_t>(term.left)],
                                          operands[static_cast<std::size_t>(term.right)]});
      }
    }
    void run() { host.template run<expression_tree::total>(operands[0].node, out); }
    std::uint64_t result() { return host.get(out); }
    void edit(Input& input, IntRandom& random) {
      const std::size_t leaves = (input.terms.size() + 1) / 2;
      const std::size_t i = leaves - 1 + random.next() % leaves;
      input.terms[i].number = random.next() % 1000;
      host.set(operands[i].number, std::uint64_t{input.terms[i].number});
    }
  };
};

// --- Tree contraction ----------------------------------------------------------------------------

// A tree of n vertices; an edge is cut, then put back, in turn.
template <bool kPath>
struct Contraction {
  static constexpr const char* kName = kPath ? "tree_contraction_path" : "tree_contraction_random";

  struct Input {
    std::vector<tree_contraction::Vertex> vertices;
    std::pair<int, int> cut{-1, -1};
    std::int64_t length = 0;

    explicit Input(int n) : vertices(static_cast<std::size_t>(n)) {
      IntRandom random;
      std::vector<int> open{0};  // with fewer than three edges
      for (int v = 0; v < n; ++v) {
        at(v).weight = random(100);
        if (v == 0) continue;
        const auto place = kPath ? open.size() - 1 : random.next() % open.size();
        const int parent = open[place];
        link(parent, v, 1 + random(100));
        if (at(parent).edges.size() == 3) {
          open[place] = open.back();
          open.pop_back();
        }
        open.push_back(v);
      }
    }
    tree_contraction::Vertex& at(int v) { return vertices[static_cast<std::size_t>(v)]; }
    const tree_contraction::Vertex& at(int v) const {
      return vertices[static_cast<std::size_t>(v)];
    }
    static auto place(tree_contraction::Vertex& vertex, int to) {
      return std::find_if(vertex.edges.begin(), vertex.edges.end(),
                          [&](const auto& edge) { return edge.to >= to; });
    }
    void link(int v, int w, std::int64_t edge_length) {
      at(v).edges.insert(place(at(v), w), {w, edge_length});
      at(w).edges.insert(place(at(w), v), {v, edge_length});
    }
    void unlink(int v, int w) {
      at(v).edges.erase(place(at(v), w));
      at(w).edges.erase(place(at(w), v));
    }
    // Sum of the trees' diameters, by an order of search and one sweep back.
    std::uint64_t baseline() const {
      const std::size_t n = vertices.size();
      std::vector<int> parent(n, -1), order;
      std::vector<std::int64_t> reach(n, 0), up(n, 0);
      std::vector<char> seen(n, 0);
      std::uint64_t sum = 0;
      for (std::size_t root = 0; root < n; ++root) {
        if (seen[root] != 0) continue;
        order.assign(1, static_cast<int>(root));
        seen[root] = 1;
        for (std::size_t i = 0; i < order.size(); ++i) {
          for (const auto& edge : at(order[i]).edges) {
            const auto to = static_cast<std::size_t>(edge.to);
            if (seen[to] != 0) continue;
            seen[to] = 1;
            parent[to] = order[i];
            up[to] = edge.length;
            order.push_back(edge.to);
          }
        }
        std::int64_t diameter = 0;
        for (std::size_t i = order.size(); i-- > 1;) {
          const auto v = static_cast<std::size_t>(order[i]);
          const auto p = static_cast<std::size_t>(parent[v]);
          diameter = std::max(diameter, reach[p] + reach[v] + up[v]);
          reach[p] = std::max(reach[p], reach[v] + up[v]);
        }
        sum += static_cast<std::uint64_t>(diameter);
      }
      return sum;
    }
  };

  template <class Host>
  struct World {
    Host& host;
    tree_contraction::Forest<ScopeOf<Host>> forest;

    World(Host& h, const Input& input)
        : host(h), forest(h, static_cast<int>(input.vertices.size())) {
      for (int v = 0; v < static_cast<int>(input.vertices.size()); ++v) set(input, v);
    }
    void set(const Input& input, int v) {
      host.set(forest.vertices[static_cast<std::size_t>(v)],
               input.vertices[static_cast<std::size_t>(v)]);
    }
    void run() { host.template run<tree_contraction::contract>(); }
    std::uint64_t result() {
      std::uint64_t sum = 0;
      for (std::size_t v = 0; v < forest.vertices.size(); ++v) {
        if (host.get(forest.outcomes[v]).fate != tree_contraction::Fate::last) continue;
        sum += static_cast<std::uint64_t>(host.get(forest.loads[v]).diameter);
      }
      return sum;
    }
    void edit(Input& input, IntRandom& random) {
      if (input.cut.first >= 0) {
        input.link(input.cut.first, input.cut.second, input.length);
        set(input, input.cut.first);
        set(input, input.cut.second);
        input.cut.first = -1;
        return;
      }
      const int v = random(static_cast<int>(input.vertices.size()));
      const auto edge = input.at(v).edges[random.next() % input.at(v).edges.size()];
      input.cut = {v, edge.to};
      input.length = edge.length;
      input.unlink(v, edge.to);
      set(input, v);
      set(input, edge.to);
    }
  };
};

// --- Graphs: an edge is taken out, then put back, in turn ----------------------------------------

struct GraphInput {
  std::vector<std::vector<int>> edges;
  std::pair<int, int> out{-1, -1};

  explicit GraphInput(int n) : edges(static_cast<std::size_t>(n)) {}
  void add(int v, int w) {
    insert(v, w);
    insert(w, v);
  }
  void insert(int v, int w) {
    auto& from = edges[static_cast<std::size_t>(v)];
    const auto at = std::lower_bound(from.begin(), from.end(), w);
    if (at == from.end() || *at != w) from.insert(at, w);
  }
  void erase(int v, int w) {
    auto& from = edges[static_cast<std::size_t>(v)];
    from.erase(std::lower_bound(from.begin(), from.end(), w));
  }
  // Returns the edge that came or went.
  std::pair<int, int> toggle(IntRandom& random) {
    if (out.first >= 0) {
      add(out.first, out.second);
      return std::exchange(out, {-1, -1});
    }
    for (;;) {
      const int v = random(static_cast<int>(edges.size()));
      const auto& from = edges[static_cast<std::size_t>(v)];
      if (from.empty()) continue;
      out = {v, from[random.next() % from.size()]};
      erase(out.first, out.second);
      erase(out.second, out.first);
      return out;
    }
  }
  std::vector<int> hops(int source) const {
    std::vector<int> hops(edges.size(), breadth_first_search::kUnreached);
    std::queue<int> queue;
    queue.push(source);
    hops[static_cast<std::size_t>(source)] = 0;
    for (; !queue.empty(); queue.pop()) {
      const auto v = static_cast<std::size_t>(queue.front());
      for (const int w : edges[v]) {
        int& far = hops[static_cast<std::size_t>(w)];
        if (far != breadth_first_search::kUnreached) continue;
        far = hops[v] + 1;
        queue.push(w);
      }
    }
    return hops;
  }
};

// n vertices and 2n edges at random.
struct RandomGraph : GraphInput {
  explicit RandomGraph(int n) : GraphInput(n) {
    IntRandom random;
    for (int i = 0; i < 2 * n; ++i) {
      const int v = random(n);
      const int w = random(n);
      if (v != w) add(v, w);
    }
  }
};
// A square grid of about n vertices.
struct Grid : GraphInput {
  explicit Grid(int n) : GraphInput(n) {
    int side = 1;
    while ((side + 1) * (side + 1) <= n) ++side;
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        if (x + 1 < side) add(y * side + x, y * side + x + 1);
        if (y + 1 < side) add(y * side + x, y * side + x + side);
      }
    }
  }
};

std::uint64_t hash_of(const std::vector<int>& values) {
  std::uint64_t sum = 0;
  for (const int v : values) sum = sac::mix(sum + static_cast<unsigned>(v));
  return sum;
}

template <class Graph>
struct Search {
  static constexpr const char* kName =
      std::is_same_v<Graph, Grid> ? "breadth_first_search_grid" : "breadth_first_search_random";
  struct Input : Graph {
    using Graph::Graph;
    std::uint64_t baseline() const { return hash_of(this->hops(0)); }
  };
  template <class Host>
  struct World {
    Host& host;
    breadth_first_search::Graph<ScopeOf<Host>> graph;

    World(Host& h, const Input& input) : host(h), graph(h, static_cast<int>(input.edges.size())) {
      for (std::size_t v = 0; v < input.edges.size(); ++v) {
        host.set(graph.edges[v], input.edges[v]);
      }
    }
    void run() { host.template run<breadth_first_search::search>(); }
    std::uint64_t result() {
      std::vector<int> hops;
      for (const auto& h : graph.hops) hops.push_back(host.get(h));
      return hash_of(hops);
    }
    void edit(Input& input, IntRandom& random) {
      const auto [v, w] = input.toggle(random);
      for (const int u : {v, w}) {
        host.set(graph.edges[static_cast<std::size_t>(u)],
                 input.edges[static_cast<std::size_t>(u)]);
      }
    }
  };
};

template <class Graph>
struct Connect {
  static constexpr const char* kName =
      std::is_same_v<Graph, Grid> ? "connected_components_grid" : "connected_components_random";
  // Components are told by their least vertex.
  template <class RootOf>
  static std::uint64_t hash_components(int n, RootOf&& root_of) {
    std::vector<int> least(static_cast<std::size_t>(n), -1), all;
    for (int v = 0; v < n; ++v) {
      int& first = least[static_cast<std::size_t>(root_of(v))];
      if (first < 0) first = v;
      all.push_back(first);
    }
    return hash_of(all);
  }
  struct Input : Graph {
    using Graph::Graph;
    std::uint64_t baseline() const {
      const int n = static_cast<int>(this->edges.size());
      std::vector<int> parents(static_cast<std::size_t>(n));
      for (int v = 0; v < n; ++v) parents[static_cast<std::size_t>(v)] = v;
      const auto root_of = [&](int v) {
        while (parents[static_cast<std::size_t>(v)] != v) {
          int& up = parents[static_cast<std::size_t>(v)];
          v = up = parents[static_cast<std::size_t>(up)];
        }
        return v;
      };
      for (int v = 0; v < n; ++v) {
        for (const int w : this->edges[static_cast<std::size_t>(v)]) {
          if (v < w) parents[static_cast<std::size_t>(root_of(v))] = root_of(w);
        }
      }
      return hash_components(n, root_of);
    }
  };
  template <class Host>
  struct World {
    Host& host;
    connected_components::Components<ScopeOf<Host>> graph;

    World(Host& h, const Input& input) : host(h), graph(h, static_cast<int>(input.edges.size())) {
      for (int v = 0; v < static_cast<int>(input.edges.size()); ++v) {
        for (const int w : input.edges[static_cast<std::size_t>(v)]) {
          if (v < w) graph.insert(v, w);
        }
      }
    }
    void run() { host.template run<connected_components::connect>(); }
    std::uint64_t result() {
      return hash_components(static_cast<int>(graph.parents.size()), [&](int v) {
        return connected_components::root_of(
            v, [&](int u) { return host.get(graph.parents[static_cast<std::size_t>(u)]); });
      });
    }
    void edit(Input& input, IntRandom& random) {
      const auto [a, b] = input.toggle(random);
      const auto [v, w] = std::pair<int, int>(std::minmax(a, b));
      if (input.out.first >= 0) {
        graph.erase(v, w);
      } else {
        graph.insert(v, w);
      }
    }
  };
};

// --- Fixed points on a random graph --------------------------------------------------------------

struct CoreNumbers {
  static constexpr const char* kName = "k_core";
  template <class S>
  using World = k_core::Graph<S>;
  static constexpr auto program = k_core::cores;
  // Takes away a vertex of the least degree, again and again.
  static std::uint64_t baseline(const GraphInput& graph) {
    const std::size_t n = graph.edges.size();
    std::vector<int> degree;
    std::vector<std::vector<int>> of_degree;
    for (std::size_t v = 0; v < n; ++v) {
      const std::size_t d = graph.edges[v].size();
      degree.push_back(static_cast<int>(d));
      if (of_degree.size() <= d) of_degree.resize(d + 1);
      of_degree[d].push_back(static_cast<int>(v));
    }
    std::vector<int> core(n, -1);
    for (std::size_t k = 0; k < of_degree.size(); ++k) {
      while (!of_degree[k].empty()) {
        const auto v = static_cast<std::size_t>(of_degree[k].back());
        of_degree[k].pop_back();
        if (core[v] >= 0 || degree[v] != static_cast<int>(k)) continue;
        core[v] = static_cast<int>(k);
        for (const int w : graph.edges[v]) {
          int& d = degree[static_cast<std::size_t>(w)];
          if (core[static_cast<std::size_t>(w)] >= 0 || d <= static_cast<int>(k)) continue;
          of_degree[static_cast<std::size_t>(--d)].push_back(w);
        }
      }
    }
    return hash_of(core);
  }
  template <class Host, class World>
  static std::uint64_t result(Host& host, const World& graph) {
    std::vector<int> core;
    for (const auto& c : graph.values) core.push_back(host.get(c));
    return hash_of(core);
  }
};

struct Forest {
  static constexpr const char* kName = "spanning_forest";
  template <class S>
  using World = spanning_forest::Graph<S>;
  static constexpr auto program = spanning_forest::span;
  // Breadth-first from each vertex that has not been reached; of each vertex root and parent.
  static std::uint64_t baseline(const GraphInput& graph) {
    const int n = static_cast<int>(graph.edges.size());
    std::vector<int> root(graph.edges.size(), -1), far(graph.edges.size()), parent;
    std::queue<int> queue;
    for (int r = 0; r < n; ++r) {
      if (root[static_cast<std::size_t>(r)] >= 0) continue;
      root[static_cast<std::size_t>(r)] = r;
      for (queue.push(r); !queue.empty(); queue.pop()) {
        const auto v = static_cast<std::size_t>(queue.front());
        for (const int w : graph.edges[v]) {
          const auto to = static_cast<std::size_t>(w);
          if (root[to] >= 0) continue;
          root[to] = r;
          far[to] = far[v] + 1;
          queue.push(w);
        }
      }
    }
    for (std::size_t v = 0; v < root.size(); ++v) {
      parent.push_back(static_cast<int>(v));
      for (const int w : graph.edges[v]) {
        if (far[static_cast<std::size_t>(w)] + 1 != far[v]) continue;
        parent.back() = w;
        break;
      }
    }
    return hash_of(root) + hash_of(parent);
  }
  template <class Host, class World>
  static std::uint64_t result(Host& host, const World& graph) {
    std::vector<int> root, parent;
    for (const auto& p : graph.values) {
      root.push_back(host.get(p).root);
      parent.push_back(host.get(p).parent);
    }
    return hash_of(root) + hash_of(parent);
  }
};

template <class Example>
struct FixedPoint {
  static constexpr const char* kName = Example::kName;
  struct Input : RandomGraph {
    using RandomGraph::RandomGraph;
    std::uint64_t baseline() const { return Example::baseline(*this); }
  };
  template <class Host>
  struct World {
    Host& host;
    typename Example::template World<ScopeOf<Host>> graph;

    World(Host& h, const Input& input) : host(h), graph(h, static_cast<int>(input.edges.size())) {
      for (std::size_t v = 0; v < input.edges.size(); ++v) {
        host.set(graph.edges[v], input.edges[v]);
      }
    }
    void run() { host.template run<Example::program>(); }
    std::uint64_t result() { return Example::result(host, graph); }
    void edit(Input& input, IntRandom& random) {
      const auto [v, w] = input.toggle(random);
      for (const int u : {v, w}) {
        host.set(graph.edges[static_cast<std::size_t>(u)],
                 input.edges[static_cast<std::size_t>(u)]);
      }
    }
  };
};

// --- Targets in a binary tree, each fourth also needs one at random; a source changes, or what a
// target needs at random --------------------------------------------------------------------------

template <bool kNeeds>
struct Targets {
  static constexpr const char* kName = kNeeds ? "build_graph_needs" : "build_graph_sources";
  struct Input {
    std::vector<int> sources;
    std::vector<std::vector<int>> needs;

    explicit Input(int n) : sources(static_cast<std::size_t>(n), 1) {
      IntRandom random;
      for (int t = 0; t < n; ++t) needs.push_back(needs_of(t, n, random));
    }
    static std::vector<int> needs_of(int t, int n, IntRandom& random) {
      std::vector<int> some;
      if (2 * t + 1 < n) some.push_back(2 * t + 1);
      if (2 * t + 2 < n) some.push_back(2 * t + 2);
      if (t + 1 < n && random(4) == 0) some.push_back(t + 1 + random(n - t - 1));
      return some;
    }
    std::uint64_t baseline() const {
      std::vector<std::uint64_t> built(sources.begin(), sources.end());
      for (std::size_t t = built.size(); t-- > 0;) {
        for (const int n : needs[t]) {
          built[t] = sac::mix(built[t] + built[static_cast<std::size_t>(n)]);
        }
      }
      return built[0];
    }
  };
  template <class Host>
  struct World {
    Host& host;
    build_graph::Project<ScopeOf<Host>> project;

    World(Host& h, const Input& input) : host(h), project(h, static_cast<int>(input.needs.size())) {
      for (std::size_t t = 0; t < input.needs.size(); ++t) {
        host.set(project.sources[t], int{input.sources[t]});
        host.set(project.needs[t], input.needs[t]);
      }
      host.set(project.wanted, {0});
    }
    void run() { host.template run<build_graph::build_all>(); }
    std::uint64_t result() { return host.get(project.built)[0]; }
    void edit(Input& input, IntRandom& random) {
      const int n = static_cast<int>(input.needs.size());
      const int t = random(n);
      const auto i = static_cast<std::size_t>(t);
      if (kNeeds) {
        input.needs[i] = Input::needs_of(t, n, random);
        host.set(project.needs[i], input.needs[i]);
      } else {
        host.set(project.sources[i], input.sources[i] = random(1000000));
      }
    }
  };
};

}  // namespace

int main(int argc, char** argv) {
  if (bench::shows_help(argc, argv)) return 0;
  const bench::Selection selection(argc, argv);
  selection.run<Expression>(1000000, 20000);
  selection.run<Contraction<false>>(100000, 2000);
  selection.run<Contraction<true>>(100000, 2000);
  selection.run<Search<RandomGraph>>(100000, 2000);
  selection.run<Search<Grid>>(100000, 200);
  selection.run<Connect<RandomGraph>>(100000, 2000);
  selection.run<Connect<Grid>>(100000, 2000);
  selection.run<FixedPoint<CoreNumbers>>(100000, 2000);
  selection.run<FixedPoint<Forest>>(100000, 500);
  selection.run<Targets<false>>(100000, 2000);
  selection.run<Targets<true>>(100000, 2000);
}
