// The program of sac/docs/propagate.md: an auction, one bid of which is raised.
//
// tests/sac/propagate_snippets_test.cpp runs it, and compares text and output with the document.
// clang-format off
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

#include <sac/event_log.hpp>
#include <sac/sac.hpp>

namespace propagate {

void check(bool holds, int line = __builtin_LINE()) {
  if (!holds) throw std::logic_error("not true: line " + std::to_string(line));
}

struct Bid {
  char bidder;
  sac::Mod<int> amount;  // input
};

struct House {
  std::vector<Bid> bids;
  sac::Mod<int> highest;                // so far: written again and again
  std::vector<sac::Mod<int>> receipts;  // of each bid: 1 when it is acknowledged
  std::vector<sac::Mod<int>> prices;    // of each bidder: what the letter says; 0: no letter
  sac::Agenda& letters;                 // to those who have led, in the order of their names
};

void acknowledge(sac::Scope& s, int i) { s.write(s.environment<House>().receipts[i], 1); }

void announce(sac::Scope&, int, char) {}

void letter(sac::Scope& s, char bidder) {
  auto& house = s.environment<House>();
  s.write(house.prices[bidder - 'a'], s.read(house.highest));
}

void consider(sac::Scope& s, int i) {
  auto& house = s.environment<House>();
  const Bid& bid = house.bids[i];
  const int amount = s.read(bid.amount);
  const bool leads = amount > s.read(house.highest);
  if (leads) {
    const sac::Key by_name{.order = static_cast<unsigned>(bid.bidder)};
    s.write(house.highest, amount);
    house.letters.post<letter>(s, by_name, bid.bidder);
  }
  s.call<acknowledge>(i);
  if (leads) s.call<announce>(i, bid.bidder);
  if (i + 1 < static_cast<int>(house.bids.size())) s.tail<consider>(i + 1);
}

void sell(sac::Scope& s) {
  auto& house = s.environment<House>();
  s.write(house.highest, 30);  // the reserve
  for (const auto price : house.prices) s.write(price, 0);
  s.call<consider>(0);
  house.letters.drain(s);
}

/// Every call that has a place, deeper ones to the right.
void print_trace(const sac::Engine& e, std::ostream& print) {
  e.walk([&](const sac::Call& call, std::size_t depth) {
    print << std::string(2 * depth, ' ') << sac::Engine::describe(call) << '\n';
  });
}

// Handles are other numbers in a build with SAC_CHECKS: names are enough here.
std::string without_handles(std::string text) {
  for (auto at = text.find(" (@"); at != text.npos; at = text.find(" (@")) {
    text.erase(at, text.find(')', at) + 1 - at);
  }
  return text;
}

/// Prints what the document shows.
void run_all(std::ostream& print) {
  sac::Engine e;
  House house{.bids = {}, .highest = e.cell<int>(), .receipts = {}, .prices = {},
              .letters = e.make_agenda("letters")};
  house.bids = {{'b', e.input(20)}, {'a', e.input(50)}, {'d', e.input(40)}, {'c', e.input(70)}};
  for (const char bidder : {'a', 'b', 'c', 'd'}) {
    house.receipts.push_back(e.cell<int>());
    house.prices.push_back(e.cell<int>());
    e.name(house.prices.back(), std::string(1, bidder) + "'s price");
  }
  e.name(house.highest, "highest");
  e.name(house.bids[0].amount, "b's bid");
  e.set_environment(&house);
  e.run<sell>();
  print_trace(e, print);

  sac::EventLog log(e);
  e.set(house.bids[0].amount, 50);  // as much as a's, and before it
  const sac::Counts work = e.propagate();
  for (std::size_t i = 0; i < log.size(); ++i) print << without_handles(log.line(i)) << '\n';
  print_trace(e, print);

  check(work.executed == 4 && work.confirmed == 0 && work.reused == 4);
  check(work.created == 2 && work.discarded == 2);
  check(work.edges_made == 4 && work.edges_removed == 4);
  check(e.get(house.prices[0]) == 0 && e.get(house.prices[1]) == 70);
}

}  // namespace propagate
