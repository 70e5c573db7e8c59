// What an update of the examples on trees, graphs and text costs in calls: the claims of their
// headers.
#include <algorithm>
#include <bit>
#include <catch2/catch.hpp>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "breadth_first_search.hpp"
#include "connected_components.hpp"
#include "edit_distance.hpp"
#include "expression_tree.hpp"
#include "random_program.hpp"
#include "spell_check.hpp"
#include "spreadsheet.hpp"
#include "string_hash.hpp"
#include "tree_contraction.hpp"

namespace {

using namespace examples;
using support::Random;

// Calls created, discarded and executed again.
std::uint64_t work(const sac::Counts& counts) { return counts.executed + counts.discarded; }

int log2_of(int n) { return std::bit_width(static_cast<unsigned>(n)) - 1; }

TEST_CASE("a new number in an expression runs again the operators above it, once each") {
  using namespace expression_tree;
  constexpr int kLevels = 10;
  sac::Engine engine;
  std::vector<sac::Mod<std::uint64_t>> numbers;
  std::vector<Operand<sac::Scope>> row;
  for (int i = 0; i < 1 << kLevels; ++i) {
    numbers.push_back(engine.input(std::uint64_t{1}));
    row.push_back({nullptr, numbers.back()});
  }
  while (row.size() > 1) {
    std::vector<Operand<sac::Scope>> above;
    for (std::size_t i = 0; i < row.size(); i += 2) {
      auto& node = engine.make<Node<sac::Scope>>();
      engine.set(node.term, Term<sac::Scope>{'+', row[i], row[i + 1]});
      above.push_back({&node, {}});
    }
    row = std::move(above);
  }
  const auto out = engine.cell<std::uint64_t>();
  engine.run<total>(row[0].node, out);
  CHECK(engine.get(out) == 1 << kLevels);
  engine.set(numbers[77], std::uint64_t{5});
  const sac::Counts counts = engine.propagate();
  CHECK(engine.get(out) == (1 << kLevels) + 4);
  CHECK(counts.executed == kLevels + 1);  // and the copy of the result
  CHECK(counts.created + counts.discarded + counts.reused == 0);
}

TEST_CASE("links and cuts of a path or a random tree change O(log n) calls of its contraction") {
  using namespace tree_contraction;
  for (const bool path : {true, false}) {
    for (const int n : {64, 1024, 16384}) {
      Random random(static_cast<std::uint64_t>(n));
      std::vector<Vertex> vertices(static_cast<std::size_t>(n));
      std::vector<std::pair<int, int>> edges;
      for (int v = 1; v < n; ++v) {
        int parent = v - 1;
        while (!path && vertices[static_cast<std::size_t>(parent = random(v))].edges.size() > 2) {
        }
        vertices[static_cast<std::size_t>(parent)].edges.push_back({v, 1});
        vertices[static_cast<std::size_t>(v)].edges.push_back({parent, 1});
        edges.emplace_back(parent, v);
      }
      sac::Engine engine;
      Forest<sac::Scope> forest(engine, n);
      const auto show = [&](int v) {
        engine.set(forest.vertices[static_cast<std::size_t>(v)],
                   vertices[static_cast<std::size_t>(v)]);
      };
      for (int v = 0; v < n; ++v) show(v);
      engine.run<contract>();
      CHECK(engine.live_calls() < 12 * static_cast<std::uint64_t>(n));
      std::uint64_t sum = 0;
      constexpr int kCuts = 100;
      for (int i = 0; i < kCuts; ++i) {
        const auto [v, w] = edges[static_cast<std::size_t>(random(n - 1))];
        const auto before = vertices;
        for (const auto& [a, b] : {std::pair{v, w}, {w, v}}) {
          std::erase_if(vertices[static_cast<std::size_t>(a)].edges,
                        [b = b](const auto& edge) { return edge.to == b; });
        }
        show(v), show(w);
        sum += work(engine.propagate());
        CHECK(last_vertex(engine, forest, v) != last_vertex(engine, forest, w));
        vertices = before;
        show(v), show(w);
        sum += work(engine.propagate());
        CHECK(last_vertex(engine, forest, v) == last_vertex(engine, forest, w));
      }
      INFO((path ? "path of " : "random tree of ") << n);
      const double mean = static_cast<double>(sum) / (2 * kCuts);
      CHECK(mean < (path ? 22 : 6) * log2_of(n));
    }
  }
}

TEST_CASE("a search runs again near vertices whose level changes, with few calls for each") {
  using namespace breadth_first_search;
  constexpr int kSide = 30;
  constexpr int kSize = kSide * kSide;
  sac::Engine engine;
  Graph<sac::Scope> graph(engine, kSize);
  std::vector<std::vector<int>> edges(kSize);
  const auto toggle = [&](int v, int w) {
    for (const auto& [a, b] : {std::pair{v, w}, {w, v}}) {
      auto& from = edges[static_cast<std::size_t>(a)];
      const auto at = std::find(from.begin(), from.end(), b);
      at == from.end() ? from.push_back(b) : static_cast<void>(from.erase(at));
      engine.set(graph.edges[static_cast<std::size_t>(a)], from);
    }
  };
  for (int v = 0; v < kSize; ++v) {
    if (v % kSide + 1 < kSide) toggle(v, v + 1);
    if (v + kSide < kSize) toggle(v, v + kSide);
  }
  engine.run<search>();
  CHECK(engine.live_calls() <= 3 * kSize + 2);
  const auto levels = [&] {
    std::vector<int> all;
    for (const auto& h : graph.hops) all.push_back(engine.get(h));
    return all;
  };
  Random random(1);
  auto before = levels();
  std::uint64_t most_changed = 0;
  for (int i = 0; i < 2000; ++i) {
    const int v = random(kSize);
    toggle(v, v % kSide + 1 < kSide ? v + 1 : v - 1);
    const std::uint64_t calls = work(engine.propagate());
    const auto now = levels();
    std::uint64_t changed = 0;
    for (std::size_t u = 0; u < now.size(); ++u) changed += now[u] != before[u] ? 1 : 0;
    most_changed = std::max(most_changed, changed);
    CHECK(calls <= 10 + 4 * changed);
    before = now;
  }
  CHECK(most_changed > 50);
}

TEST_CASE("an edge of the graph that closes a cycle is one call of its components") {
  using namespace connected_components;
  constexpr int kSize = 50;
  sac::Engine engine;
  Components<sac::Scope> graph(engine, kSize);
  // A cycle: the edge that comes last in the order of the lots joins nothing.
  std::vector<std::pair<int, int>> edges{{0, kSize - 1}};
  for (int v = 0; v + 1 < kSize; ++v) edges.emplace_back(v, v + 1);
  for (const auto& [v, w] : edges) graph.insert(v, w);
  engine.run<connect>();
  CHECK(engine.live_calls() == kSize + 2);  // and the program and its drain
  const auto last = std::max_element(edges.begin(), edges.end(), [](const auto& a, const auto& b) {
    return lot_of_edge(a.first, a.second) < lot_of_edge(b.first, b.second);
  });
  graph.erase(last->first, last->second);
  sac::Counts counts = engine.propagate();
  CHECK((counts.discarded == 1 && counts.executed == 0));
  graph.insert(last->first, last->second);
  counts = engine.propagate();
  CHECK((counts.created == 1 && counts.executed == 1 && counts.discarded == 0));
}

TEST_CASE("a new entry of a dictionary is one distance and the ranges that it is in") {
  using namespace spell_check;
  constexpr int kSize = 1024;
  sac::Engine engine;
  Dictionary<sac::Scope> dictionary(engine, kSize);
  engine.set(dictionary.word, std::string("stable"));
  for (int i = 0; i < kSize; ++i) {
    engine.set(dictionary.entries[static_cast<std::size_t>(i)], "unlikely" + std::to_string(i));
  }
  engine.run<check>();
  CHECK(engine.live_calls() == 2 * kSize);
  engine.set(dictionary.entries[500], std::string("table"));
  sac::Counts counts = engine.propagate();
  CHECK(engine.get(dictionary.nearest)[0] == Match{1, 500});
  CHECK((counts.executed == 12 && counts.created == 0));  // the entry, 10 ranges, the program
  engine.set(dictionary.entries[501], std::string("a very different word"));
  counts = engine.propagate();
  CHECK(counts.executed <= 5);  // it is soon not among the nearest
  engine.set(dictionary.word, std::string("fable"));
  counts = engine.propagate();
  CHECK(counts.executed >= kSize);
  CHECK(engine.get(dictionary.nearest)[0] == Match{1, 500});
}

TEST_CASE("a letter put into a string or taken out changes O(log n) chunks of its hash") {
  using namespace string_hash;
  using Item = Item<sac::Scope>;
  for (const int n : {64, 1024, 16384}) {
    Random random(static_cast<std::uint64_t>(n));
    sac::Engine engine;
    std::vector<Item*> letters;
    for (int i = 0; i < n; ++i) letters.push_back(&engine.make<Item>());
    for (std::size_t i = 0; i < letters.size(); ++i) {
      const Item* next = i + 1 < letters.size() ? letters[i + 1] : nullptr;
      engine.set(letters[i]->content,
                 Content<sac::Scope>{hash_of(static_cast<char>('a' + random(26))), next});
    }
    const auto head = engine.input<const Item*>(letters[0]);
    const auto out = engine.cell<std::uint64_t>();
    engine.run<string_hash::hash>(head, out);
    const std::uint64_t first = engine.get(out);
    std::uint64_t sum = 0;
    constexpr int kEdits = 200;
    for (int i = 0; i < kEdits; ++i) {
      const Item& at = *letters[static_cast<std::size_t>(random(n - 2))];
      const auto content = engine.get(at.content);
      engine.set(at.content,
                 Content<sac::Scope>{content.hash, engine.get(content.next->content).next});
      sum += work(engine.propagate());
      CHECK(engine.get(out) != first);
      engine.set(at.content, content);
      sum += work(engine.propagate());
      CHECK(engine.get(out) == first);
    }
    INFO(n << " letters");
    const double mean = static_cast<double>(sum) / (2 * kEdits);
    CHECK(mean < 2.5 * log2_of(n));
    CHECK(engine.live_calls() < static_cast<std::uint64_t>(n));
  }
}

TEST_CASE("a letter of two strings near to each other changes few blocks, however long they are") {
  double of_shorter = 0;
  for (const int n : {4000, 16000}) {
    Random random(static_cast<std::uint64_t>(n));
    std::vector<char> a;
    for (int i = 0; i < n; ++i) a.push_back(static_cast<char>('a' + random(26)));
    std::vector<char> b = a;
    for (int i = 0; i < n / 50; ++i) b[static_cast<std::size_t>(random(n))] = 'x';
    sac::Engine engine;
    sac::Sequence<char> first(engine, a), second(engine, b);
    const auto out = engine.cell<std::int64_t>();
    constexpr int kBand = 500;
    engine.run<edit_distance::edit_distance>(first.list(), second.list(), kBand, 64, out);
    const std::int64_t distance = engine.get(out);
    std::uint64_t sum = 0;
    constexpr int kEdits = 100;
    for (int i = 0; i < kEdits; ++i) {
      auto& string = i % 2 == 0 ? first : second;
      const sac::ElementId at = string.insert_after(
          sac::ElementId{static_cast<std::uint64_t>(random(n) + 1)}, static_cast<char>('A'));
      sum += work(engine.propagate());
      CHECK(engine.get(out) == distance + 1);
      string.erase(at);
      sum += work(engine.propagate());
      CHECK(engine.get(out) == distance);
    }
    const double mean = static_cast<double>(sum) / (2 * kEdits);
    INFO(n << " letters: " << mean);
    CHECK(mean < 150);  // a row or column of the band has some 25 blocks
    if (n == 4000) of_shorter = mean;
    CHECK(mean < 1.5 * of_shorter);
  }
}

TEST_CASE("a new number in a sheet runs again the formulas that see it") {
  using namespace spreadsheet;
  sac::Engine engine;
  Sheet<sac::Scope> sheet(engine, 50);
  const auto cell = [](char column, int row) { return (row - 1) * kColumns + column - 'A'; };
  for (int row = 1; row <= 50; ++row) {
    const std::string r = std::to_string(row);
    sheet.set(engine, cell('A', row), r);
    sheet.set(engine, cell('B', row), "=A" + r + (row > 1 ? "+B" + std::to_string(row - 1) : ""));
    sheet.set(engine, cell('C', row), "=MAX(A1:A50)");
  }
  engine.run<calculate>();
  CHECK(to_text(engine.get(sheet.values[static_cast<std::size_t>(cell('B', 50))])) == "1275");
  sheet.set(engine, cell('A', 20), "21");
  const sac::Counts counts = engine.propagate();
  CHECK(to_text(engine.get(sheet.values[static_cast<std::size_t>(cell('B', 50))])) == "1276");
  CHECK(counts.executed == 1 + 31 + 50);  // the number, sums from B20 on, and the maxima
  CHECK(counts.created + counts.discarded == 0);
}

TEST_CASE("levels beyond the last bucket of an agenda are in order too") {
  constexpr int kSize = 40000;
  sac::Engine engine;
  breadth_first_search::Graph<sac::Scope> graph(engine, kSize);
  for (int v = 0; v + 1 < kSize; ++v) {
    engine.set(graph.edges[static_cast<std::size_t>(v)], std::vector<int>{v + 1});
  }
  engine.run<breadth_first_search::search>();
  CHECK(engine.get(graph.hops.back()) == kSize - 1);
  engine.set(graph.edges[35000], std::vector<int>{35001, 39000});
  engine.propagate();
  CHECK(engine.get(graph.hops.back()) == 35001 + 999);
  CHECK(engine.get(graph.hops[38999]) == 38999);
}

}  // namespace
