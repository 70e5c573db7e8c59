// A list map under random edits: cost, memory, detectors, and the same text run plainly.
#include <catch2/catch.hpp>
#include <memory>
#include <vector>

#include "random_program.hpp"
#include "sac/sac.hpp"

namespace {

template <class S>
struct List {
  int value;
  typename S::template ModType<const List*> next;
};

struct Map {
  template <class S>
  void operator()(S& s, typename S::template ModType<const List<S>*> in,
                  typename S::template ModType<const List<S>*> out) const {
    const List<S>* cell = s.read(in);
    if (cell == nullptr) return s.template write<const List<S>*>(out, nullptr);
    auto& mine = s.template make<List<S>>(cell);
    mine.value = cell->value * 10;
    mine.next = s.template cell<const List<S>*>(cell, 1);
    s.template write<const List<S>*>(out, &mine);
    s.template tail<Map{}>(cell->next, mine.next);
  }
};

template <class S>
std::vector<int> mapped(auto& engine, typename S::template ModType<const List<S>*> head) {
  std::vector<int> values;
  for (const List<S>* l = engine.get(head); l != nullptr; l = engine.get(l->next)) {
    values.push_back(l->value);
  }
  return values;
}

TEST_CASE(
    "a mapped list under random edits: constant work, flat memory, silent detectors, plain twin") {
  using Cell = List<sac::Scope>;
  using PlainCell = List<sac::PlainScope>;
  support::Random random(5);
  sac::Engine e;
  e.set_audit(true);
  std::vector<std::unique_ptr<Cell>> cells;
  const auto head = e.input<const Cell*>(nullptr);
  const auto out = e.cell<const Cell*>();
  e.run<Map{}>(head, out);
  std::size_t bytes = 0;
  std::vector<sac::Mod<const Cell*>> links{head};  // links[i] holds the i-th cell
  for (int step = 0; step < 3000; ++step) {
    const int size = static_cast<int>(links.size()) - 1;
    if (size < 30 || (size < 60 && random(2) == 0)) {
      const auto i = static_cast<std::size_t>(random(size + 1));
      cells.push_back(std::make_unique<Cell>(Cell{step, e.input<const Cell*>(e.get(links[i]))}));
      e.set<const Cell*>(links[i], cells.back().get());
      links.insert(links.begin() + static_cast<std::ptrdiff_t>(i) + 1, cells.back()->next);
    } else {
      const auto i = static_cast<std::size_t>(random(size));
      e.set<const Cell*>(links[i], e.get(links[i + 1]));
      links.erase(links.begin() + static_cast<std::ptrdiff_t>(i) + 1);
    }
    const auto counts = e.propagate();
    REQUIRE(counts.executed <= 5);
    REQUIRE(e.live_calls() == 3 * (links.size() - 1) + 1);
    REQUIRE(e.audit().duplicates == 0);
    REQUIRE(e.audit().reordered == 0);
    if (step % 50 != 0) continue;
    e.check_invariants();
    sac::PlainScope plain;
    std::vector<std::unique_ptr<PlainCell>> twins;
    const auto plain_head = plain.input<const PlainCell*>(nullptr);
    auto link = plain_head;
    for (const Cell* c = e.get(head); c != nullptr; c = e.get(c->next)) {
      twins.push_back(
          std::make_unique<PlainCell>(PlainCell{c->value, plain.input<const PlainCell*>(nullptr)}));
      link.place() = twins.back().get();
      link = twins.back()->next;
    }
    const auto plain_out = plain.cell<const PlainCell*>();
    plain.run<Map{}>(plain_head, plain_out);
    REQUIRE(mapped<sac::Scope>(e, out) == mapped<sac::PlainScope>(plain, plain_out));
    bytes = e.bytes();
  }
  CHECK(bytes < 1'000'000);
}

}  // namespace
