// The sorted index beside std::set.
#include "sac/internal/sorted_index.hpp"

#include <catch2/catch.hpp>
#include <cstdint>
#include <set>
#include <stdexcept>
#include <vector>

#include "failing_new.hpp"
#include "sac/sac.hpp"

namespace {

using Index = sac::SortedIndex<std::uint32_t>;
const auto less = [](std::uint32_t a, std::uint32_t b) { return a < b; };

struct Random {
  std::uint64_t state = 11;
  std::uint32_t operator()(std::uint32_t n) {
    state = sac::mix(state + 0x9e3779b97f4a7c15u);
    return static_cast<std::uint32_t>(state % n);
  }
};

// The entries of both, and what they say of `probe`.
void require_equal(const Index& index, const std::set<std::uint32_t>& oracle, std::uint32_t probe) {
  REQUIRE(index.size() == oracle.size());
  REQUIRE(index.empty() == oracle.empty());
  if (oracle.empty()) return;
  REQUIRE(index.first() == *oracle.begin());
  REQUIRE(index.last() == *oracle.rbegin());
  const auto behind = oracle.upper_bound(probe);
  const auto there = oracle.lower_bound(probe);
  const Index::Place place = index.place_of(probe, less);
  REQUIRE((place.behind == nullptr) == (behind == oracle.end()));
  REQUIRE((place.behind == nullptr || *place.behind == *behind));
  REQUIRE((place.before == nullptr) == (behind == oracle.begin()));
  REQUIRE((place.before == nullptr || *place.before == *std::prev(behind)));
  const std::uint32_t* predecessor = index.predecessor(probe, less);
  REQUIRE((predecessor == nullptr) == (there == oracle.begin()));
  REQUIRE((predecessor == nullptr || *predecessor == *std::prev(there)));
}

std::vector<std::uint32_t> entries_of(const Index& index) {
  std::vector<std::uint32_t> entries;
  index.for_each([&](std::uint32_t e) { entries.push_back(e); });
  return entries;
}

enum class Where { anywhere, front, back };

TEST_CASE("a sorted index holds what a std::set holds, wherever entries come and go") {
  for (const Where where : {Where::anywhere, Where::front, Where::back}) {
    Index index;
    std::set<std::uint32_t> oracle;
    Random random;
    for (int step = 0; step < 60000; ++step) {
      const bool grows = step / 15000 % 2 == 0;
      if (oracle.empty() || random(10) < (grows ? 8u : 2u)) {
        const std::uint32_t e = where == Where::back && !oracle.empty()
                                    ? *oracle.rbegin() + 1 + random(3)
                                    : random(1000000);
        if (oracle.insert(e).second) {
          where == Where::back&& random(2) == 0 ? index.append(e) : index.insert(e, less);
        }
      } else if (where == Where::front) {
        REQUIRE(index.pop_first() == *oracle.begin());
        oracle.erase(oracle.begin());
      } else {
        auto it = oracle.lower_bound(random(*oracle.rbegin() + 1));
        const std::uint32_t e = *it;
        oracle.erase(it);
        random(100) == 0 ? index.erase_if([&](std::uint32_t x) { return x == e; })
                         : index.erase(e, less);
      }
      require_equal(index, oracle, random(1000000));
      if (step % 3000 == 0) {
        REQUIRE(entries_of(index) == std::vector<std::uint32_t>(oracle.begin(), oracle.end()));
        REQUIRE(index.bytes() < 200 + 40 * oracle.size());
      }
    }
  }
}

TEST_CASE("if a comparison throws or memory runs out, a sorted index is as it was") {
  Index index;
  for (std::uint32_t e = 0; e < 5000; e += 2) index.append(e);
  const auto before = entries_of(index);
  Random random;
  for (int i = 0; i < 300; ++i) {
    const std::uint32_t e = 2 * random(2500) + 1;
    std::uint32_t left = random(12);
    const auto fails = [&](std::uint32_t a, std::uint32_t b) {
      if (left-- == 0) throw std::runtime_error("no order");
      return a < b;
    };
    try {
      index.insert(e, fails);
      index.erase(e, less);
    } catch (const std::runtime_error&) {
    }
    REQUIRE(entries_of(index) == before);
  }
}

TEST_CASE("an entry taken from the front of a sorted index costs what any other does") {
  // Comparisons are counted: moves follow them, as no node holds more than 32.
  const auto cost = [](std::uint32_t n) {
    Index index;
    for (std::uint32_t e = 0; e < n; ++e) index.append(e);
    std::uint64_t asked = 0;
    const auto counted = [&](std::uint32_t a, std::uint32_t b) { return ++asked, a < b; };
    for (std::uint32_t e = 0; e < n; ++e) index.erase(e, counted);
    return asked / n;
  };
  CHECK(cost(100000) <= 2 * cost(1000));
}

}  // namespace
