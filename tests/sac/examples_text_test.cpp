// The examples on words, strings and formulas (sac/examples) under random edits.
#include <catch2/catch.hpp>
#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "apps/text.hpp"
#include "example_harness.hpp"

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
