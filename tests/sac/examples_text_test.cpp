// The examples on words, strings and formulas (sac/examples) under random edits.
#include <catch2/catch.hpp>
#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "apps/text.hpp"
#include "example_harness.hpp"
#include "failing_new.hpp"

namespace {

using namespace apps;
using namespace support;

TEST_CASE("strings that differ in one letter have different hashes") {
  Random random(3);
  std::set<std::uint64_t> hashes;
  std::set<std::string> strings;
  for (int i = 0; i < 2000; ++i) {
    StringApp::Input text = StringApp::random_input(random, random(40));
    for (int k = 0; k < 3; ++k) {
      std::string letters;
      for (const auto& l : text.letters) letters += l.letter;
      strings.insert(letters);
      hashes.insert(StringApp::oracle(text));
      StringApp::apply(text, StringApp::random_edit(random, text));
    }
  }
  CHECK(strings.size() > 4000);
  CHECK(hashes.size() == strings.size());
}

TEST_CASE("texts that are no formula are faults, and what refers to a cycle is one") {
  sac::PlainScope scope;
  examples::spreadsheet::Sheet<sac::PlainScope> sheet(scope, 9);
  const std::vector<std::pair<std::string, std::string>> cells = {
      {"1.5e3", "1500"},
      {"-2", "-2"},
      {"", "0"},
      {"=A1", "1500"},
      {"=E1", "#CYCLE!"},
      {"=E1+F1", "#CYCLE!"},
      {"=G1", "#CYCLE!"},
      {"=1/C1", "#NUMBER!"},
      {"=H1+1", "#NUMBER!"},
      {"x", "#SYNTAX!"},
      {"=", "#SYNTAX!"},
      {"=A0", "#SYNTAX!"},
      {"=A10", "#SYNTAX!"},
      {"=SUM(B1:A1)", "#SYNTAX!"},
      {"=SUM(A1:B1)", "1498"},
      {"=(1", "#SYNTAX!"},
      {"1+1", "#SYNTAX!"},
      {"A1", "#SYNTAX!"},
      {"=1)", "#SYNTAX!"},
      {"inf", "#SYNTAX!"},
      {"nan", "#SYNTAX!"},
      {"=" + std::string(100000, '('), "#SYNTAX!"},
      {"=-C1", "0"},
      {"1e999", "#SYNTAX!"},
      {"=J1+H1", "#SYNTAX!"},
      {"=MAX(B1:C1)*MIN(B1:C1)", "0"}};
  for (std::size_t c = 0; c < cells.size(); ++c) {
    sheet.set(scope, static_cast<int>(c), cells[c].first);
  }
  scope.run<examples::spreadsheet::calculate>();
  for (std::size_t c = 0; c < cells.size(); ++c) {
    INFO(cells[c].first.substr(0, 20));
    CHECK(examples::spreadsheet::to_text(scope.get(sheet.values[c])) == cells[c].second);
  }
}

// Programs of the edit distance: the whole grid, bands, chunks of one letter, of few and of many.
#define EDIT_DISTANCES                                                     \
  (EditDistanceApp<sac::kNoBand, 5>), (EditDistanceApp<sac::kNoBand, 64>), \
      (EditDistanceApp<10, 8>), (EditDistanceApp<0, 3>), (EditDistanceApp<2, 1>)

TEMPLATE_TEST_CASE("edit distances run plainly are those of a naive program", "", EDIT_DISTANCES) {
  check_example_plain<TestType>(200, 300);
}

TEMPLATE_TEST_CASE("edit distances under random edits", "", EDIT_DISTANCES) {
  check_example<TestType>(30, 120, 20);
}

// The distance after a run, and after edits of these strings at both ends.
std::vector<std::int64_t> distances(const std::string& a, const std::string& b, int band,
                                    int most) {
  sac::Engine engine;
  sac::Sequence<char> first(engine, a), second(engine, b);
  const auto out = engine.cell<std::int64_t>();
  engine.run<examples::edit_distance::edit_distance>(first.list(), second.list(), band, most, out);
  std::vector<std::int64_t> all{engine.get(out)};
  const auto next = [&] {
    engine.propagate();
    engine.check_invariants();
    all.push_back(engine.get(out));
  };
  first.push_front('x');
  next();
  second.push_back('y');
  next();
  first.erase(first.first());
  second.erase(second.last());
  next();
  for (sac::Sequence<char>* text : {&first, &second}) {  // chunks become empty, and then all
    while (!text->empty()) text->erase(text->size() % 2 == 0 ? text->first() : text->last());
    next();
  }
  return all;
}

TEST_CASE("edit distances of extreme strings") {
  const std::string same(400, 'a'), other(270, 'b');
  std::string mixed;
  for (int i = 0; i < 300; ++i) mixed += static_cast<char>(i * i % 251 - 128);
  const std::vector<std::pair<std::string, std::string>> pairs = {
      {"", ""},
      {"", "a"},
      {"a", ""},
      {"a", "a"},
      {"a", "b"},
      {"", same},
      {same, "a"},
      {same, same},
      {same, other},
      {mixed, mixed},
      {mixed, same},
      {same.substr(0, 64), same.substr(0, 65)},
      {mixed, mixed.substr(1)},
      {mixed, "b" + mixed + "c"}};
  for (const auto& [a, b] : pairs) {
    for (const int most : {1, 2, 63, 64}) {
      CAPTURE(a.size(), b.size(), most);
      const auto of = [](const std::string& x, const std::string& y) {
        return std::int64_t{examples::spell_check::edit_distance(x, y)};
      };
      const std::vector<std::int64_t> expected = {of(a, b), of('x' + a, b), of('x' + a, b + 'y'),
                                                  of(a, b), of("", b),      0};
      if (most > 2 || a.size() + b.size() < 200) {
        CHECK(distances(a, b, sac::kNoBand, most) == expected);
      }
      for (const int band : {0, 1, 40, 399, 2000}) {
        CAPTURE(band);
        if (most < 3 && band > 40) continue;
        const auto in_band = distances(a, b, band, most);
        REQUIRE(in_band.size() == expected.size());
        for (std::size_t i = 0; i < expected.size(); ++i) {
          if (expected[i] <= band) CHECK(in_band[i] == expected[i]);
          CHECK(in_band[i] >= expected[i]);
          CHECK(in_band[i] <= static_cast<std::int64_t>(a.size() + b.size() + 2));
        }
      }
    }
  }
}

// One letter more in each string at a place, where an update fails: at the k-th allocation, by lack
// of memory for the trace, or cancelled after k calls.
TEST_CASE("an update of an edit distance that fails or is cancelled leaves everything as before") {
  for (const int band : {8, sac::kNoBand}) {
    sac::Engine engine;
    const std::string letters = "the quick brown fox jumps over the lazy dog and runs away from it";
    sac::Sequence<char> a(engine, letters), b(engine, letters.substr(3));
    const auto out = engine.cell<std::int64_t>();
    engine.run<examples::edit_distance::edit_distance>(a.list(), b.list(), band, 8, out);
    engine.propagate();
    const auto edit = [&] {
      a.insert_after(sac::ElementId{20}, '-');
      b.erase(sac::ElementId{40});
    };
    const auto check_as_before = [&](const std::string& before) {
      engine.check_invariants();
      REQUIRE(engine.get(out) == 3);
      REQUIRE(example::sizes(engine) == before);
      REQUIRE(a.size() == letters.size());
      REQUIRE(b.size() == letters.size() - 3);
    };
    const std::string before = example::sizes(engine);
    edit();
    engine.undo_edits();
    engine.propagate();
    check_as_before(before);
    for (std::uint64_t calls = 0; calls < 5; ++calls) {
      engine.set_progress([&](const sac::Progress& p) { return p.executed <= calls; }, 1);
      edit();
      REQUIRE_THROWS_AS(engine.propagate(), sac::Cancelled);
      check_as_before(before);
    }
    engine.set_progress({}, 1);
    bool burnt = true;
    int failures = 0;
    for (std::uint64_t count = 1; failures < 1000; ++count) {
      edit();
      if (!fails(count, burnt, [&] { engine.propagate(); })) break;
      ++failures;
      check_as_before(before);
    }
    CHECK(failures > 0);
    engine.check_invariants();
    CHECK(engine.get(out) == 5);
    a.erase(a.after(sac::ElementId{20}));
    engine.propagate();
    engine.shrink();
    const std::string small = example::sizes(engine);
    for (int i = 0; i < 200; ++i) a.push_back(static_cast<char>('a' + i % 26));
    engine.set_memory_limit(engine.memory().calls_and_edges_held);
    CHECK_THROWS_AS(engine.propagate(), std::bad_alloc);
    engine.check_invariants();
    CHECK(example::sizes(engine) == small);
    CHECK(engine.get(out) == 4);
    engine.set_memory_limit(~std::size_t{0});
    for (int i = 0; i < 200; ++i) a.push_back(static_cast<char>('a' + i % 26));
    engine.propagate();
    CHECK(engine.get(out) >= 200);
  }
}

TEST_CASE("an edit distance of no such band or chunk is refused") {
  CHECK_THROWS_AS(distances("a", "b", -1, 64), sac::UsageError);
  CHECK_THROWS_AS(distances("a", "b", 9, 65), sac::UsageError);
  CHECK_THROWS_AS(distances("a", "b", 9, 0), sac::UsageError);
  CHECK_THROWS_AS(distances("a", "b", 9, -7), sac::UsageError);
}

TEMPLATE_TEST_CASE("text examples run plainly give what naive programs give", "", SpellApp,
                   StringApp, SheetApp) {
  check_example_plain<TestType>(200, 60);
}

TEMPLATE_TEST_CASE("text examples under random edits", "", SpellApp, StringApp, SheetApp) {
  check_example<TestType>(60, 40, 30);
}

TEMPLATE_TEST_CASE("text examples under many random edits", "[.soak]", SpellApp, StringApp,
                   SheetApp) {
  check_example<TestType>(300, 150, 60);
}

}  // namespace
