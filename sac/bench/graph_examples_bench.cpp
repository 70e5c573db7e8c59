// The examples on trees, graphs and text (sac/examples): from scratch and under edits.
//
//   graph_examples_bench [SCALE [EXAMPLE]]     default 1: sizes as printed; 0.1: a tenth of them
//
// One JSON line per figure. Times from scratch are medians of 3 runs, in processor time, as is the
// mean of the updates; their median and 99th percentile are in real time, of all updates:
//   baseline       ms of ordinary C++ on ordinary data
//   plain          ms of the same program text on sac::PlainScope
//   from_scratch   ms of the traced run
//   overhead       from_scratch / plain
//   bytes          bytes of trace and values per element
//   update_median, update_mean, update_p99    us per edit and propagation
//   reexecuted, created, discarded, reused    calls, mean per update
//   work           the sum of the first three
//   speedup        baseline / mean update
// Results are compared with the baseline's, before and after the edits.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <map>
#include <memory>
#include <queue>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "../examples/breadth_first_search.hpp"
#include "../examples/connected_components.hpp"
#include "../examples/expression_tree.hpp"
#include "../examples/spell_check.hpp"
#include "../examples/spreadsheet.hpp"
#include "../examples/string_hash.hpp"
#include "../examples/tree_contraction.hpp"
#include "sac/sac.hpp"

namespace {

using namespace examples;

double processor_microseconds() {
  timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * 1e6 + static_cast<double>(now.tv_nsec) / 1e3;
}

template <class Body>
double processor_microseconds(Body&& body) {
  const double start = processor_microseconds();
  body();
  return processor_microseconds() - start;
}

template <class Body>
double microseconds(Body&& body) {
  const auto start = std::chrono::steady_clock::now();
  body();
  const auto end = std::chrono::steady_clock::now();
  return std::chrono::duration<double, std::micro>(end - start).count();
}

double quantile(std::vector<double> x, double q) {
  const auto at = x.begin() + static_cast<std::ptrdiff_t>(q * static_cast<double>(x.size() - 1));
  std::nth_element(x.begin(), at, x.end());
  return *at;
}

struct Random {
  std::uint64_t state = 1;
  std::uint64_t next() { return sac::mix(state += 0x9e3779b97f4a7c15u); }
  int operator()(int n) { return static_cast<int>(next() % static_cast<std::uint64_t>(n)); }
};

template <class Host>
using ScopeOf = std::conditional_t<std::is_same_v<Host, sac::Engine>, sac::Scope, sac::PlainScope>;

void print(const char* example, int n, const char* figure, double value) {
  std::printf("{\"bench\":\"graph_examples\",\"example\":\"%s\",\"n\":%d,\"%s\":%.2f}\n", example,
              n, figure, value);
  std::fflush(stdout);
}

void require_equal(const char* example, std::uint64_t a, std::uint64_t b) {
  if (a == b) return;
  std::fprintf(stderr, "%s: results differ\n", example);
  std::exit(1);
}

// An Example has
//   static constexpr const char* kName;
//   struct Input;  Input(int n);  an element count n
//   std::uint64_t Input::baseline() const;
//   template <class Host> struct World { World(Host&, const Input&); void run();
//     std::uint64_t result(); void edit(Input&, Random&); };   edit: of both, not propagated
template <class Example>
void bench(int n, int updates) {
  const auto out = [&](const char* figure, double value) {
    print(Example::kName, n, figure, value);
  };
  typename Example::Input input(n);
  std::vector<double> baseline, plain, traced;
  std::uint64_t expected = 0;
  for (int round = 0; round < 3; ++round) {
    baseline.push_back(processor_microseconds([&] { expected = input.baseline(); }));
    sac::PlainScope scope;
    typename Example::template World<sac::PlainScope> world(scope, input);
    plain.push_back(processor_microseconds([&] { world.run(); }));
    require_equal(Example::kName, world.result(), expected);
  }
  for (int round = 0; round < 2; ++round) {
    sac::Engine engine;
    typename Example::template World<sac::Engine> world(engine, input);
    traced.push_back(processor_microseconds([&] { world.run(); }));
  }
  sac::Engine engine;
  typename Example::template World<sac::Engine> world(engine, input);
  const std::size_t before = engine.bytes();
  traced.push_back(processor_microseconds([&] { world.run(); }));
  require_equal(Example::kName, world.result(), expected);
  const double base = quantile(baseline, 0.5);
  out("baseline", base / 1e3);
  out("plain", quantile(plain, 0.5) / 1e3);
  out("from_scratch", quantile(traced, 0.5) / 1e3);
  out("overhead", quantile(traced, 0.5) / quantile(plain, 0.5));
  out("bytes", static_cast<double>(engine.bytes() - before) / n);
  Random random;
  std::vector<double> times;
  sac::Counts sum;
  const double start = processor_microseconds();
  for (int i = 0; i < updates; ++i) {
    sac::Counts counts;
    times.push_back(microseconds([&] {
      world.edit(input, random);
      counts = engine.propagate();
    }));
    sum.executed += counts.executed;
    sum.created += counts.created;
    sum.discarded += counts.discarded;
    sum.reused += counts.reused;
  }
  const double mean = (processor_microseconds() - start) / updates;
  require_equal(Example::kName, world.result(), input.baseline());
  const auto per_update = [&](std::uint64_t calls) { return static_cast<double>(calls) / updates; };
  out("update_median", quantile(times, 0.5));
  out("update_mean", mean);
  out("update_p99", quantile(times, 0.99));
  out("reexecuted", per_update(sum.executed - sum.created));
  out("created", per_update(sum.created));
  out("discarded", per_update(sum.discarded));
  out("reused", per_update(sum.reused));
  out("work", per_update(sum.executed + sum.discarded));
  out("speedup", base / mean);
}

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
      Random random;
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
    void edit(Input& input, Random& random) {
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
      Random random;
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
    void edit(Input& input, Random& random) {
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
  std::pair<int, int> toggle(Random& random) {
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
    Random random;
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
    void edit(Input& input, Random& random) {
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
    void edit(Input& input, Random& random) {
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

// --- Spell check: n words of 4 to 9 letters ------------------------------------------------------

template <bool kWord>  // the word changes, or an entry
struct Spelling {
  static constexpr const char* kName = kWord ? "spell_check_word" : "spell_check_entry";

  static std::string random_word(Random& random) {
    std::string word;
    for (int i = 4 + random(6); i > 0; --i) word += static_cast<char>('a' + random(26));
    return word;
  }
  struct Input {
    std::string word;
    std::vector<std::string> entries;
    explicit Input(int n) {
      Random random;
      word = random_word(random);
      for (int i = 0; i < n; ++i) entries.push_back(random_word(random));
    }
    std::uint64_t baseline() const {
      spell_check::Match best;
      for (int i = 0; i < static_cast<int>(entries.size()); ++i) {
        const auto& entry = entries[static_cast<std::size_t>(i)];
        best = std::min(best, {spell_check::edit_distance(word, entry), i});
      }
      return hash_of({best.distance, best.entry});
    }
  };
  template <class Host>
  struct World {
    Host& host;
    spell_check::Dictionary<ScopeOf<Host>> dictionary;

    World(Host& h, const Input& input)
        : host(h), dictionary(h, static_cast<int>(input.entries.size())) {
      host.set(dictionary.word, input.word);
      for (std::size_t i = 0; i < input.entries.size(); ++i) {
        host.set(dictionary.entries[i], input.entries[i]);
      }
    }
    void run() { host.template run<spell_check::check>(); }
    std::uint64_t result() {
      const auto best = host.get(dictionary.nearest)[0];
      return hash_of({best.distance, best.entry});
    }
    void edit(Input& input, Random& random) {
      if (kWord) {
        input.word[random.next() % input.word.size()] = static_cast<char>('a' + random(26));
        return host.set(dictionary.word, input.word);
      }
      const std::size_t i = random.next() % input.entries.size();
      input.entries[i] = random_word(random);
      host.set(dictionary.entries[i], input.entries[i]);
    }
  };
};

// --- String hash: n letters; one is inserted or erased -------------------------------------------

struct StringHash {
  static constexpr const char* kName = "string_hash";

  // A list, so that edits are cheap here too.
  struct Input {
    std::vector<char> letters;
    std::vector<int> next;            // of each letter; 0 stands before the first
    std::pair<int, int> out{-1, -1};  // taken from behind the first

    explicit Input(int n) : letters(1), next(1, 1) {
      Random random;
      for (int i = 1; i <= n; ++i) {
        letters.push_back(static_cast<char>('a' + random(26)));
        next.push_back(i < n ? i + 1 : -1);
      }
    }
    std::uint64_t baseline() const {
      std::vector<std::uint64_t> items, chunks;
      for (int i = next[0]; i >= 0; i = next[static_cast<std::size_t>(i)]) {
        items.push_back(string_hash::hash_of(letters[static_cast<std::size_t>(i)]));
      }
      while (items.size() > 1) {
        chunks.assign(1, sac::mix(items[0]));
        bool falling = false;
        for (std::size_t i = 1; i < items.size(); ++i) {
          const bool begins = falling && items[i] > items[i - 1];
          if (begins) chunks.push_back(0);
          chunks.back() = sac::mix(chunks.back() + items[i]);
          if (items[i] != items[i - 1]) falling = items[i] < items[i - 1];
        }
        items.swap(chunks);
      }
      return items[0];
    }
  };
  template <class Host>
  struct World {
    using S = ScopeOf<Host>;
    using Item = string_hash::Item<S>;
    using Content = string_hash::Content<S>;
    Host& host;
    std::vector<Item*> letters{nullptr};
    typename S::template ModType<const Item*> head;
    typename S::template ModType<std::uint64_t> out;

    World(Host& h, const Input& input)
        : host(h),
          head(h.template input<const Item*>(nullptr)),
          out(h.template cell<std::uint64_t>()) {
      for (std::size_t i = 1; i < input.letters.size(); ++i) {
        letters.push_back(&host.template make<Item>());
      }
      for (int i = 0; i < static_cast<int>(letters.size()); ++i) set(input, i);
    }
    void set(const Input& input, int i) {
      const int next = input.next[static_cast<std::size_t>(i)];
      const Item* item = next < 0 ? nullptr : letters[static_cast<std::size_t>(next)];
      if (i == 0) return host.set(head, item);
      host.set(letters[static_cast<std::size_t>(i)]->content,
               Content{string_hash::hash_of(input.letters[static_cast<std::size_t>(i)]), item});
    }
    void run() { host.template run<string_hash::hash>(head, out); }
    std::uint64_t result() { return host.get(out); }
    void edit(Input& input, Random& random) {
      auto& next = input.next;
      if (input.out.first >= 0) {
        next[static_cast<std::size_t>(input.out.first)] = input.out.second;
        set(input, std::exchange(input.out.first, -1));
        return;
      }
      int before;
      do {
        before = random(static_cast<int>(next.size()));
      } while (next[static_cast<std::size_t>(before)] < 0);
      const int taken = next[static_cast<std::size_t>(before)];
      input.out = {before, taken};
      next[static_cast<std::size_t>(before)] = next[static_cast<std::size_t>(taken)];
      set(input, before);
    }
  };
};

// --- Spreadsheet: n cells ------------------------------------------------------------------------

// Each row: A, B numbers, C = A * B, D = SUM(A:C), E = D - C; F sums up ten rows of E, G ten cells
// of F, ...; the rest is numbers. A number changes, or the formula of a C.
template <bool kFormula>
struct Sheet {
  static constexpr const char* kName = kFormula ? "spreadsheet_formula" : "spreadsheet_number";

  struct Input {
    int rows;
    std::vector<std::string> texts;

    explicit Input(int n)
        : rows(n / spreadsheet::kColumns),
          texts(static_cast<std::size_t>(rows * spreadsheet::kColumns)) {
      Random random;
      for (int row = 1; row <= rows; ++row) {
        const std::string r = std::to_string(row);
        for (const char column : {'A', 'B'}) at(column, row) = std::to_string(random(1000));
        at('C', row) = "=A" + r + "*B" + r;
        at('D', row) = "=SUM(A" + r + ":C" + r + ")";
        at('E', row) = "=D" + r + "-C" + r;
        for (char c = 'J'; c <= 'Z'; ++c) at(c, row) = std::to_string(random(1000));
      }
      for (int step = 10, column = 'F'; step <= rows && column < 'J'; step *= 10, ++column) {
        for (int row = step; row <= rows; row += step) {
          std::string sum;
          for (int k = 9; k >= 0; --k) {
            sum += std::string(sum.empty() ? "=" : "+") + static_cast<char>(column - 1) +
                   std::to_string(row - k * step / 10);
          }
          at(static_cast<char>(column), row) = sum;
        }
      }
    }
    std::string& at(char column, int row) {
      return texts[static_cast<std::size_t>((row - 1) * spreadsheet::kColumns + column - 'A')];
    }
    // Evaluates by recursion, each cell once.
    std::uint64_t baseline() const {
      std::vector<spreadsheet::Value> values(texts.size());
      std::vector<char> done(texts.size(), 0);
      const std::function<spreadsheet::Value(int)> value = [&](int cell) {
        const auto c = static_cast<std::size_t>(cell);
        if (done[c] == 0) values[c] = spreadsheet::value_of(texts[c], rows, value);
        done[c] = 1;
        return values[c];
      };
      std::uint64_t sum = 0;
      for (int c = 0; c < static_cast<int>(texts.size()); ++c) {
        sum = sac::mix(sum + static_cast<std::uint64_t>(value(c).number));
      }
      return sum;
    }
  };
  template <class Host>
  struct World {
    Host& host;
    spreadsheet::Sheet<ScopeOf<Host>> sheet;

    World(Host& h, const Input& input) : host(h), sheet(h, input.rows) {
      for (int c = 0; c < static_cast<int>(input.texts.size()); ++c) {
        sheet.set(host, c, input.texts[static_cast<std::size_t>(c)]);
      }
    }
    void run() { host.template run<spreadsheet::calculate>(); }
    std::uint64_t result() {
      std::uint64_t sum = 0;
      for (const auto& v : sheet.values) {
        sum = sac::mix(sum + static_cast<std::uint64_t>(host.get(v).number));
      }
      return sum;
    }
    void edit(Input& input, Random& random) {
      const int row = 1 + random(input.rows);
      const std::string r = std::to_string(row);
      const char column = kFormula ? 'C' : "AB"[random(2)];
      std::string& text = input.at(column, row);
      text = !kFormula ? std::to_string(random(1000))
                       : "=A" + r + "+*-"[random(3)] + "B" + std::to_string(1 + random(input.rows));
      sheet.set(host, (row - 1) * spreadsheet::kColumns + column - 'A', text);
    }
  };
};

}  // namespace

int main(int argc, char** argv) {
  const double scale = argc > 1 ? std::strtod(argv[1], nullptr) : 1;
  const std::string_view only = argc > 2 ? argv[2] : "";
  const auto run = [&]<class Example>(std::type_identity<Example>, int n, int updates) {
    if (!only.empty() && !std::string_view(Example::kName).starts_with(only)) return;
    bench<Example>(static_cast<int>(n * scale), updates);
  };
  run(std::type_identity<Expression>(), 1000000, 20000);
  run(std::type_identity<Contraction<false>>(), 100000, 2000);
  run(std::type_identity<Contraction<true>>(), 100000, 2000);
  run(std::type_identity<Search<RandomGraph>>(), 100000, 2000);
  run(std::type_identity<Search<Grid>>(), 100000, 200);
  run(std::type_identity<Connect<RandomGraph>>(), 100000, 2000);
  run(std::type_identity<Connect<Grid>>(), 100000, 2000);
  run(std::type_identity<Spelling<false>>(), 100000, 20000);
  run(std::type_identity<Spelling<true>>(), 100000, 10);
  run(std::type_identity<StringHash>(), 1000000, 20000);
  run(std::type_identity<Sheet<false>>(), 104000, 20000);
  run(std::type_identity<Sheet<true>>(), 104000, 20000);
}
