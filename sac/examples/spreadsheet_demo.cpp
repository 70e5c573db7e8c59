// A spreadsheet to talk to. A line gives a cell a text; the answer is what that changed, and what
// it cost:
//
//   B1 =A1*2+2
//   B1 = 42
//     (2 calls ran again, 2 are new)
//
// tests/sac/spreadsheet_demo_test.cpp has a longer talk.
#include <iostream>
#include <string>
#include <vector>

#include "spreadsheet.hpp"

namespace spreadsheet_demo {

using namespace examples::spreadsheet;

/// Answers the lines of `in` until it ends.
inline void talk(std::istream& in, std::ostream& out) {
  constexpr int kRows = 20;
  sac::Engine engine;
  Sheet<sac::Scope> sheet(engine, kRows);
  engine.run<calculate>();
  std::vector<std::string> shown(sheet.values.size(), to_text({}));
  for (std::string line; std::getline(in, line);) {
    const auto blank = line.find(' ');
    const std::string name = line.substr(0, blank);
    int cell = 0;
    while (cell < static_cast<int>(shown.size()) && name_of(cell) != name) ++cell;
    if (cell == static_cast<int>(shown.size())) {
      out << "no cell is called " << name << '\n';
      continue;
    }
    sheet.set(engine, cell, blank == line.npos ? "" : line.substr(blank + 1));
    const sac::Counts work = engine.propagate();
    for (int c = 0; c < static_cast<int>(shown.size()); ++c) {
      const std::string text = to_text(engine.get(sheet.values[c]));
      if (text == shown[c]) continue;
      shown[c] = text;
      out << name_of(c) << " = " << text << '\n';
    }
    out << "  (" << work.executed - work.created << " calls ran again, " << work.created
        << " are new)\n";
  }
}

}  // namespace spreadsheet_demo

#ifndef SPREADSHEET_DEMO_WITHOUT_MAIN
int main() { spreadsheet_demo::talk(std::cin, std::cout); }
#endif
