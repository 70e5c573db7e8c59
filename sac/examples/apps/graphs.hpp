// The examples on trees and graphs (sac/examples), as Apps (app.hpp).
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "../breadth_first_search.hpp"
#include "../build_graph.hpp"
#include "../connected_components.hpp"
#include "../expression_tree.hpp"
#include "../k_core.hpp"
#include "../spanning_forest.hpp"
#include "../tree_contraction.hpp"
#include "app.hpp"

namespace apps {

// --- Expression tree -----------------------------------------------------------------------------

struct ExpressionApp {
  static constexpr const char* kName = "expression tree";

  struct Term {
    char op = 0;
    std::uint64_t number = 0;
    int left = -1;
    int right = -1;
  };
  struct Input {
    std::vector<Term> terms;  // by node; node 0 is the root
    int used = 1;             // the nodes from here on have never been in the tree, and are numbers
    const Term& at(int node) const { return terms[static_cast<std::size_t>(node)]; }
  };
  struct Edit {
    int node;
    Term term;
  };

  static char random_op(Random& random) { return "+-*"[random(3)]; }
  static Term number(Random& random) { return {.number = static_cast<std::uint64_t>(random(9))}; }

  static void collect(const Input& input, int node, std::vector<int>& nodes) {
    nodes.push_back(node);
    if (input.at(node).op == 0) return;
    collect(input, input.at(node).left, nodes);
    collect(input, input.at(node).right, nodes);
  }
  static int random_node(Random& random, const Input& input) {
    std::vector<int> nodes;
    collect(input, 0, nodes);
    return nodes[static_cast<std::size_t>(random(static_cast<int>(nodes.size())))];
  }
  // An operator with two new numbers below it, while there are new nodes.
  static Term grown(Random& random, const Input& input) {
    if (input.used + 2 > static_cast<int>(input.terms.size())) return number(random);
    return {.op = random_op(random), .left = input.used, .right = input.used + 1};
  }
  static Input random_input(Random& random, int size) {
    Input input{.terms = std::vector<Term>(static_cast<std::size_t>(2 * size + 100))};
    for (auto& term : input.terms) term = number(random);
    for (int i = 0; i < size / 2; ++i) {
      const int node = random_node(random, input);
      if (input.at(node).op == 0) apply(input, {node, grown(random, input)});
    }
    return input;
  }
  static Edit random_edit(Random& random, const Input& input) {
    const int node = random_node(random, input);
    Term term = input.at(node);
    if (term.op == 0) return {node, random(2) == 0 ? grown(random, input) : number(random)};
    if (random(3) == 0) return {node, number(random)};  // cuts off what is below
    term.op = random_op(random);
    return {node, term};
  }
  static Edit inverse(const Input& before, const Edit& edit) {
    return {edit.node, before.at(edit.node)};
  }
  static void apply(Input& input, const Edit& edit) {
    input.terms[static_cast<std::size_t>(edit.node)] = edit.term;
    input.used = std::max(input.used, edit.term.right + 1);
  }
  static std::uint64_t value_of(const Input& input, int node) {
    const Term& term = input.at(node);
    if (term.op == 0) return term.number;
    const std::uint64_t left = value_of(input, term.left);
    const std::uint64_t right = value_of(input, term.right);
    return term.op == '+' ? left + right : term.op == '-' ? left - right : left * right;
  }
  static std::uint64_t oracle(const Input& input) { return value_of(input, 0); }

  template <class Host>
  class World {
   public:
    using S = ScopeOf<Host>;
    using Node = examples::expression_tree::Node<S>;
    using Operand = examples::expression_tree::Operand<S>;
    using ExpressionTerm = examples::expression_tree::Term<S>;

    World(Host& host, const Input& input)
        : host_(host), out_(host.template cell<std::uint64_t>()), parents_(input.terms.size(), -1) {
      for (const Term& term : input.terms) {
        terms_.push_back({});
        nodes_.push_back(&host.template make<Node>());
        numbers_.push_back(host.input(std::uint64_t{term.number}));
      }
      for (std::size_t i = 0; i < terms_.size(); ++i) edit({static_cast<int>(i), input.terms[i]});
      host.template run<examples::expression_tree::total>(static_cast<const Node*>(root_), out_);
    }
    void edit(const Edit& e) {
      const auto i = static_cast<std::size_t>(e.node);
      terms_[i] = e.term;
      if (e.term.op == 0) {
        host_.set(numbers_[i], std::uint64_t{e.term.number});
      } else {
        for (const int side : {e.term.left, e.term.right}) {
          parents_[static_cast<std::size_t>(side)] = e.node;
        }
        set_term(e.node);
      }
      set_term(parents_[i]);  // which sees whether its operand is a number
    }
    std::uint64_t result() { return host_.get(out_); }

    template <class Recorder>
    void name(Recorder& recorder) const {
      recorder.name(root_, "root");
      recorder.name(zero_, "zero");
      recorder.name(out_, "out");
      for (std::size_t i = 0; i < nodes_.size(); ++i) recorder.name(nodes_[i], "node", i);
      name_all(recorder, numbers_, "number");
    }

   private:
    // The root of all: node 0 plus 0, so that node 0 may be a number.
    void set_term(int node) {
      const auto zero = Operand{nullptr, zero_};
      if (node < 0) return host_.set(root_->term, ExpressionTerm{'+', operand(0), zero});
      const Term& term = terms_[static_cast<std::size_t>(node)];
      host_.set(nodes_[static_cast<std::size_t>(node)]->term,
                ExpressionTerm{term.op, operand(term.left), operand(term.right)});
    }
    Operand operand(int node) const {
      const auto i = static_cast<std::size_t>(node);
      if (terms_[i].op != 0) return {nodes_[i], {}};
      return {nullptr, numbers_[i]};
    }

    Host& host_;
    examples::expression_tree::NumberMod<S> out_;
    std::vector<Term> terms_;
    std::vector<int> parents_;
    std::vector<Node*> nodes_;
    std::vector<examples::expression_tree::NumberMod<S>> numbers_;
    examples::expression_tree::NumberMod<S> zero_ = host_.input(std::uint64_t{0});
    Node* root_ = &host_.template make<Node>();
  };
};

// --- Tree contraction ----------------------------------------------------------------------------

struct ForestApp {
  static constexpr const char* kName = "tree contraction";
  using Vertex = examples::tree_contraction::Vertex;
  using Input = std::vector<Vertex>;
  struct Edit {
    enum Kind { link, cut, weigh } kind;
    int v, w;
    std::int64_t length;  // or weight
  };

  static std::vector<int> tree_of(const Input& input, int v) {
    std::vector<int> tree{v};
    std::set<int> seen{v};
    for (std::size_t i = 0; i < tree.size(); ++i) {
      for (const auto& edge : input[static_cast<std::size_t>(tree[i])].edges) {
        if (seen.insert(edge.to).second) tree.push_back(edge.to);
      }
    }
    return tree;
  }
  static Edit random_edit(Random& random, const Input& input) {
    const int n = static_cast<int>(input.size());
    const auto at = [&](int v) -> const Vertex& { return input[static_cast<std::size_t>(v)]; };
    const int v = random(n);
    const int kind = random(8);
    if (kind < 2 && !at(v).edges.empty()) {
      const auto& edge =
          at(v).edges[static_cast<std::size_t>(random(static_cast<int>(at(v).edges.size())))];
      return {Edit::cut, v, edge.to, edge.length};
    }
    if (kind < 7) {
      const int w = random(n);
      const auto tree = tree_of(input, v);
      const auto full = [&](int u) { return at(u).edges.size() == 3; };
      if (!full(v) && !full(w) && std::find(tree.begin(), tree.end(), w) == tree.end()) {
        return {Edit::link, v, w, 1 + random(9)};
      }
    }
    return {Edit::weigh, v, v, random(9)};
  }
  static Input random_input(Random& random, int size) {
    Input input(static_cast<std::size_t>(size + 1));
    for (int i = 0; i < 2 * size; ++i) apply(input, random_edit(random, input));
    return input;
  }
  static Edit inverse(const Input& before, Edit edit) {
    switch (edit.kind) {
      case Edit::link:
        edit.kind = Edit::cut;
        break;
      case Edit::cut:
        edit.kind = Edit::link;
        break;
      case Edit::weigh:
        edit.length = before[static_cast<std::size_t>(edit.v)].weight;
        break;
    }
    return edit;
  }
  // What an edit makes of one of its vertices.
  static Vertex edited(Vertex vertex, const Edit& edit, int other) {
    const auto place = std::find_if(vertex.edges.begin(), vertex.edges.end(),
                                    [&](const auto& edge) { return edge.to >= other; });
    switch (edit.kind) {
      case Edit::link:
        vertex.edges.insert(place, {other, edit.length});
        break;
      case Edit::cut:
        vertex.edges.erase(place);
        break;
      case Edit::weigh:
        vertex.weight = edit.length;
        break;
    }
    return vertex;
  }
  static void apply(Input& input, const Edit& edit) {
    const auto change = [&](int v, int other) {
      auto& vertex = input[static_cast<std::size_t>(v)];
      vertex = edited(vertex, edit, other);
    };
    change(edit.v, edit.w);
    if (edit.v != edit.w) change(edit.w, edit.v);
  }

  // For each vertex: the least vertex of its tree, the tree's sum and diameter.
  struct Answer {
    int least;
    std::int64_t sum, diameter;
    friend bool operator==(const Answer&, const Answer&) = default;
  };
  static std::pair<std::int64_t, int> farthest(const Input& input, int v, int from) {
    std::pair<std::int64_t, int> best{0, v};
    for (const auto& edge : input[static_cast<std::size_t>(v)].edges) {
      if (edge.to == from) continue;
      auto below = farthest(input, edge.to, v);
      below.first += edge.length;
      best = std::max(best, below);
    }
    return best;
  }
  static std::vector<Answer> oracle(const Input& input) {
    std::vector<Answer> answers;
    for (int v = 0; v < static_cast<int>(input.size()); ++v) {
      const auto tree = tree_of(input, v);
      Answer answer{*std::min_element(tree.begin(), tree.end()), 0, 0};
      for (const int u : tree) answer.sum += input[static_cast<std::size_t>(u)].weight;
      answer.diameter = farthest(input, farthest(input, v, -1).second, -1).first;
      answers.push_back(answer);
    }
    return answers;
  }

  template <class Host>
  class World {
   public:
    World(Host& host, const Input& input)
        : host_(host), forest_(host, static_cast<int>(input.size())) {
      for (std::size_t v = 0; v < input.size(); ++v) host.set(forest_.vertices[v], input[v]);
      host.template run<examples::tree_contraction::contract>();
    }
    void edit(const Edit& e) {
      const auto change = [&](int v, int other) {
        const auto& vertex = forest_.vertices[static_cast<std::size_t>(v)];
        host_.set(vertex, edited(host_.get(vertex), e, other));
      };
      change(e.v, e.w);
      if (e.v != e.w) change(e.w, e.v);
    }
    std::vector<Answer> result() {
      std::map<int, int> least;
      std::vector<Answer> answers;
      for (int v = 0; v < static_cast<int>(forest_.vertices.size()); ++v) {
        const int last = examples::tree_contraction::last_vertex(host_, forest_, v);
        const auto load = host_.get(forest_.loads[static_cast<std::size_t>(last)]);
        answers.push_back({least.emplace(last, v).first->second, load.sum, load.diameter});
      }
      return answers;
    }

    template <class Recorder>
    void name(Recorder& recorder) const {
      name_all(recorder, forest_.vertices, "vertex");
      name_all(recorder, forest_.shapes, "shape");
      name_all(recorder, forest_.loads, "load");
      name_all(recorder, forest_.outcomes, "outcome");
    }

   private:
    Host& host_;
    examples::tree_contraction::Forest<ScopeOf<Host>> forest_;
  };
};

// --- Graphs --------------------------------------------------------------------------------------

struct GraphApp {
  struct Input {
    std::vector<std::vector<int>> edges;  // ascending
    int source = 0;
  };
  struct Edit {
    int v, w;  // the edge comes or goes; v == w: the source moves to v
  };
  static Edit random_edit(Random& random, const Input& input) {
    const int n = static_cast<int>(input.edges.size());
    return {random(n), random(n)};
  }
  static Edit inverse(const Input& before, const Edit& edit) {
    return edit.v != edit.w ? edit : Edit{before.source, before.source};
  }
  static std::vector<int> toggled(std::vector<int> edges, int w) {
    const auto at = std::lower_bound(edges.begin(), edges.end(), w);
    if (at != edges.end() && *at == w) {
      edges.erase(at);
    } else {
      edges.insert(at, w);
    }
    return edges;
  }
  static void apply(Input& input, const Edit& e) {
    if (e.v == e.w) {
      input.source = e.v;
      return;
    }
    for (const auto& [v, w] : {std::pair{e.v, e.w}, {e.w, e.v}}) {
      auto& edges = input.edges[static_cast<std::size_t>(v)];
      edges = toggled(edges, w);
    }
  }
  static Input random_input(Random& random, int size) {
    Input input{.edges = std::vector<std::vector<int>>(static_cast<std::size_t>(size + 1))};
    for (int i = 0; i < size; ++i) apply(input, random_edit(random, input));
    return input;
  }
  static std::vector<int> hops(const Input& input, int source) {
    std::vector<int> hops(input.edges.size(), examples::breadth_first_search::kUnreached);
    std::deque<int> queue{source};
    hops[static_cast<std::size_t>(source)] = 0;
    for (; !queue.empty(); queue.pop_front()) {
      for (const int w : input.edges[static_cast<std::size_t>(queue.front())]) {
        int& far = hops[static_cast<std::size_t>(w)];
        if (far != examples::breadth_first_search::kUnreached) continue;
        far = hops[static_cast<std::size_t>(queue.front())] + 1;
        queue.push_back(w);
      }
    }
    return hops;
  }
};

struct SearchApp : GraphApp {
  static constexpr const char* kName = "breadth-first search";
  static std::vector<int> oracle(const Input& input) { return hops(input, input.source); }

  template <class Host>
  class World {
   public:
    World(Host& host, const Input& input)
        : host_(host), graph_(host, static_cast<int>(input.edges.size())) {
      host.set(graph_.source, input.source);
      for (std::size_t v = 0; v < input.edges.size(); ++v) {
        host.set(graph_.edges[v], input.edges[v]);
      }
      host.template run<examples::breadth_first_search::search>();
    }
    void edit(const Edit& e) {
      if (e.v == e.w) return host_.set(graph_.source, int{e.v});
      for (const auto& [v, w] : {std::pair{e.v, e.w}, {e.w, e.v}}) {
        const auto& edges = graph_.edges[static_cast<std::size_t>(v)];
        host_.set(edges, toggled(host_.get(edges), w));
      }
    }
    std::vector<int> result() {
      std::vector<int> hops;
      for (const auto& h : graph_.hops) hops.push_back(host_.get(h));
      return hops;
    }

    template <class Recorder>
    void name(Recorder& recorder) const {
      recorder.name(graph_.source, "source");
      name_all(recorder, graph_.edges, "edges");
      name_all(recorder, graph_.hops, "hops");
    }

   private:
    Host& host_;
    examples::breadth_first_search::Graph<ScopeOf<Host>> graph_;
  };
};

struct ComponentsApp : GraphApp {
  static constexpr const char* kName = "connected components";
  // For each vertex, the least one connected with it.
  static std::vector<int> oracle(const Input& input) {
    std::vector<int> least;
    for (int v = 0; v < static_cast<int>(input.edges.size()); ++v) {
      const auto from = hops(input, v);
      const auto near = std::find_if(from.begin(), from.end(), [](int h) {
        return h != examples::breadth_first_search::kUnreached;
      });
      least.push_back(static_cast<int>(near - from.begin()));
    }
    return least;
  }

  template <class Host>
  class World {
   public:
    World(Host& host, const Input& input)
        : host_(host), graph_(host, static_cast<int>(input.edges.size())) {
      for (int v = 0; v < static_cast<int>(input.edges.size()); ++v) {
        for (const int w : input.edges[static_cast<std::size_t>(v)]) {
          if (v >= w) continue;
          there_.insert({v, w});
          graph_.insert(v, w);
        }
      }
      host.template run<examples::connected_components::connect>();
    }
    void edit(const Edit& e) {
      const std::pair<int, int> edge = std::minmax(e.v, e.w);
      if (e.v == e.w) return;
      if (there_.insert(edge).second) return graph_.insert(edge.first, edge.second);
      there_.erase(edge);
      graph_.erase(edge.first, edge.second);
    }
    std::vector<int> result() {
      std::map<int, int> least;
      std::vector<int> answers;
      for (int v = 0; v < static_cast<int>(graph_.parents.size()); ++v) {
        const int root = examples::connected_components::root_of(
            v, [&](int u) { return host_.get(graph_.parents[static_cast<std::size_t>(u)]); });
        answers.push_back(least.emplace(root, v).first->second);
      }
      return answers;
    }

    template <class Recorder>
    void name(Recorder& recorder) const {
      name_all(recorder, graph_.parents, "parent");
    }

   private:
    Host& host_;
    examples::connected_components::Components<ScopeOf<Host>> graph_;
    std::set<std::pair<int, int>> there_;
  };
};

// --- Fixed points ----------------------------------------------------------------------------

// The world of an example that computes `program` on a graph with values of type T.
template <auto program, class T, class Host>
class ValuesWorld {
 public:
  ValuesWorld(Host& host, const GraphApp::Input& input)
      : host_(host), graph_(host, static_cast<int>(input.edges.size())) {
    for (std::size_t v = 0; v < input.edges.size(); ++v) host.set(graph_.edges[v], input.edges[v]);
    host.template run<program>();
  }
  void edit(const GraphApp::Edit& e) {
    if (e.v == e.w) return;
    for (const auto& [v, w] : {std::pair{e.v, e.w}, {e.w, e.v}}) {
      const auto& edges = graph_.edges[static_cast<std::size_t>(v)];
      host_.set(edges, GraphApp::toggled(host_.get(edges), w));
    }
  }
  std::vector<T> result() {
    std::vector<T> all;
    for (const auto& value : graph_.values) all.push_back(host_.get(value));
    return all;
  }

  template <class Recorder>
  void name(Recorder& recorder) const {
    name_all(recorder, graph_.edges, "edges");
    name_all(recorder, graph_.values, "value");
  }

 private:
  Host& host_;
  examples::VertexValues<ScopeOf<Host>, T> graph_;
};

struct CoreApp : GraphApp {
  static constexpr const char* kName = "k-core";
  // Takes away the vertices of less than k edges, for k = 1, 2, ...
  static std::vector<int> oracle(const Input& input) {
    const std::size_t n = input.edges.size();
    std::vector<int> core(n, 0), degree;
    for (const auto& edges : input.edges) degree.push_back(static_cast<int>(edges.size()));
    std::vector<bool> gone(n, false);
    std::size_t left = n;
    for (int k = 1; left > 0; ++k) {
      for (bool more = true; more;) {
        more = false;
        for (std::size_t v = 0; v < n; ++v) {
          if (gone[v] || degree[v] >= k) continue;
          gone[v] = more = true;
          core[v] = k - 1;
          --left;
          for (const int w : input.edges[v]) --degree[static_cast<std::size_t>(w)];
        }
      }
    }
    return core;
  }

  template <class Host>
  using World = ValuesWorld<examples::k_core::cores, int, Host>;
};

struct SpanApp : GraphApp {
  static constexpr const char* kName = "spanning forest";
  using Place = examples::spanning_forest::Place;
  static std::vector<Place> oracle(const Input& input) {
    std::vector<Place> places(input.edges.size(), Place{-1, 0, 0});
    for (int root = 0; root < static_cast<int>(places.size()); ++root) {
      if (places[static_cast<std::size_t>(root)].root >= 0) continue;
      const std::vector<int> far = hops(input, root);
      for (std::size_t v = 0; v < places.size(); ++v) {
        if (far[v] == examples::breadth_first_search::kUnreached) continue;
        places[v] = {root, far[v], static_cast<int>(v)};
        for (const int w : input.edges[v]) {
          if (far[static_cast<std::size_t>(w)] + 1 != far[v]) continue;
          places[v].parent = w;
          break;
        }
      }
    }
    return places;
  }

  template <class Host>
  using World = ValuesWorld<examples::spanning_forest::span, Place, Host>;
};

// --- Queries -----------------------------------------------------------------------------------

struct BuildApp {
  static constexpr const char* kName = "build graph";
  static constexpr bool kMovesCalls = true;
  struct Input {
    std::vector<std::vector<int>> needs;  // targets of higher numbers, ascending
    std::vector<int> sources;
    std::vector<int> wanted;
  };
  struct Edit {
    int v, w;    // v needs w, or does so no more; v == w: its source changes; w < 0: it is wanted,
    int source;  // or no more
  };
  static Edit random_edit(Random& random, const Input& input) {
    const int n = static_cast<int>(input.sources.size());
    const int v = random(n), w = random(n);
    if (random(3) == 0) return {v, v, random(1000)};
    if (random(8) == 0) return {v, -1, 0};
    return {std::min(v, w), std::max(v, w), random(1000)};
  }
  static Edit inverse(const Input& before, const Edit& edit) {
    return {edit.v, edit.w, before.sources[static_cast<std::size_t>(edit.v)]};
  }
  static void apply(Input& input, const Edit& e) {
    if (e.w < 0) {
      input.wanted = GraphApp::toggled(input.wanted, e.v);
    } else if (e.v == e.w) {
      input.sources[static_cast<std::size_t>(e.v)] = e.source;
    } else {
      auto& needs = input.needs[static_cast<std::size_t>(e.v)];
      needs = GraphApp::toggled(needs, e.w);
    }
  }
  static Input random_input(Random& random, int size) {
    const auto n = static_cast<std::size_t>(size + 1);
    Input input{
        .needs = std::vector<std::vector<int>>(n), .sources = std::vector<int>(n), .wanted = {0}};
    for (int i = 0; i < 2 * size; ++i) apply(input, random_edit(random, input));
    return input;
  }
  static std::vector<std::uint64_t> oracle(const Input& input) {
    std::vector<std::uint64_t> built(input.sources.size());
    for (std::size_t t = built.size(); t-- > 0;) {
      built[t] = static_cast<std::uint64_t>(input.sources[t]);
      for (const int n : input.needs[t]) {
        built[t] = sac::mix(built[t] + built[static_cast<std::size_t>(n)]);
      }
    }
    std::vector<std::uint64_t> wanted;
    for (const int t : input.wanted) wanted.push_back(built[static_cast<std::size_t>(t)]);
    return wanted;
  }

  template <class Host>
  class World {
   public:
    World(Host& host, const Input& input)
        : host_(host), project_(host, static_cast<int>(input.sources.size())) {
      for (std::size_t t = 0; t < input.sources.size(); ++t) {
        host.set(project_.sources[t], int{input.sources[t]});
        host.set(project_.needs[t], input.needs[t]);
      }
      host.set(project_.wanted, input.wanted);
      host.template run<examples::build_graph::build_all>();
    }
    void edit(const Edit& e) {
      const auto v = static_cast<std::size_t>(e.v);
      if (e.w < 0) {
        host_.set(project_.wanted, GraphApp::toggled(host_.get(project_.wanted), e.v));
      } else if (e.v == e.w) {
        host_.set(project_.sources[v], int{e.source});
      } else {
        host_.set(project_.needs[v], GraphApp::toggled(host_.get(project_.needs[v]), e.w));
      }
    }
    std::vector<std::uint64_t> result() { return host_.get(project_.built); }

    template <class Recorder>
    void name(Recorder& recorder) const {
      name_all(recorder, project_.sources, "source");
      name_all(recorder, project_.needs, "needs");
      recorder.name(project_.wanted, "wanted");
      recorder.name(project_.built, "built");
    }

   private:
    Host& host_;
    examples::build_graph::Project<ScopeOf<Host>> project_;
  };
};

}  // namespace apps
