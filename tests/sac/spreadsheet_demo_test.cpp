// What the spreadsheet answers, and how many calls each answer takes.
#define SPREADSHEET_DEMO_WITHOUT_MAIN
#include "spreadsheet_demo.cpp"

#include <catch2/catch.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

TEST_CASE("a spreadsheet says what an edit changed, and runs again what sees it") {
  const std::vector<std::pair<std::string, std::string>> talk = {
      {"A1 20", "A1 = 20\n  (1 calls ran again, 0 are new)\n"},
      {"B1 =A1*2+2", "B1 = 42\n  (2 calls ran again, 2 are new)\n"},
      {"C1 =SUM(A1:B1)/D1", "C1 = #NUMBER!\n  (4 calls ran again, 3 are new)\n"},
      {"D1 2", "C1 = 31\nD1 = 2\n  (2 calls ran again, 0 are new)\n"},
      {"A1 10", "A1 = 10\nB1 = 22\nC1 = 16\n  (3 calls ran again, 0 are new)\n"},
      {"A1 =C1", "A1 = #CYCLE!\nB1 = #CYCLE!\nC1 = #CYCLE!\n  (4 calls ran again, 0 are new)\n"},
      {"A1 =D1", "A1 = 2\nB1 = 6\nC1 = 4\n  (3 calls ran again, 7 are new)\n"},
      {"A2 =1+", "A2 = #SYNTAX!\n  (1 calls ran again, 0 are new)\n"},
      {"ZZ9 1", "no cell is called ZZ9\n"},
      {"B1", "B1 = 0\nC1 = 1\n  (3 calls ran again, 2 are new)\n"},
  };
  std::string said, expected;
  for (const auto& [line, answer] : talk) {
    said += line + '\n';
    expected += answer;
  }
  std::istringstream in(said);
  std::ostringstream out;
  spreadsheet_demo::talk(in, out);
  CHECK(out.str() == expected);
}
