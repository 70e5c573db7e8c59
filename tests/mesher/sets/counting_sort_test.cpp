// Counting sorts against std::stable_sort and std::sort.
#include "sets/counting_sort.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

namespace {

using Item = std::pair<std::uint64_t, std::uint32_t>;  // a key, and where it came

std::vector<Item> items_of(const std::vector<std::uint64_t>& keys) {
  std::vector<Item> items;
  for (const std::uint64_t key : keys) items.emplace_back(key, items.size());
  return items;
}

// Keys over their range as `spread` says: 0 evenly, else with so many bits at random.
std::vector<std::uint64_t> keys_of(std::size_t n, int spread, std::mt19937_64& random) {
  std::vector<std::uint64_t> keys(n);
  for (std::uint64_t& key : keys) {
    key = random();
    if (spread > 0) key >>= random() % static_cast<unsigned>(spread);
  }
  return keys;
}

}  // namespace

TEST_CASE("parts come in order, in each the items as they were given") {
  std::mt19937_64 random(3);
  for (const std::size_t n : {0, 1, 5, 1000}) {
    for (const std::size_t parts : {1, 2, 7, 3000}) {
      const auto part_of = [&](const Item& i) { return static_cast<std::size_t>(i.first % parts); };
      const std::vector<Item> items = items_of(keys_of(n, 0, random));
      std::vector<Item> sorted(n), expected = items;
      const auto begin = mesher::detail::sort_by_part<Item>(items, sorted, parts, part_of);
      std::stable_sort(expected.begin(), expected.end(),
                       [&](const Item& a, const Item& b) { return part_of(a) < part_of(b); });
      CHECK(sorted == expected);
      REQUIRE(begin.size() == parts + 1);
      CHECK(begin.back() == n);
      for (std::size_t part = 0; part < parts; ++part) {
        for (std::size_t i = begin[part]; i < begin[part + 1]; ++i) {
          REQUIRE(part_of(sorted[i]) == part);
        }
      }
    }
  }
}

TEST_CASE("keys spread in any way are sorted as by comparing") {
  std::mt19937_64 random(5);
  for (const std::size_t n : {0, 1, 2, 63, 64, 65, 1000, 20000}) {
    for (const int spread : {0, 2, 40, 64}) {
      INFO(n << " items, spread " << spread);
      std::vector<Item> items = items_of(keys_of(n, spread, random)), expected = items;
      const auto key_of = [](const Item& i) { return i.first; };
      mesher::detail::sort_spread(items, key_of, std::less<Item>());
      std::sort(expected.begin(), expected.end());
      CHECK(items == expected);
    }
  }
}

TEST_CASE("equal keys, two of them, and keys at both ends of the range are sorted") {
  for (const auto& few : std::vector<std::vector<std::uint64_t>>{
           {7}, {0, UINT64_MAX}, {UINT64_MAX - 1, UINT64_MAX}, {0, 1, UINT64_MAX}}) {
    std::vector<std::uint64_t> keys;
    for (std::size_t i = 0; i < 500; ++i) keys.push_back(few[i * 7 % few.size()]);
    std::vector<Item> items = items_of(keys), expected = items;
    std::reverse(items.begin(), items.end());
    mesher::detail::sort_spread(
        items, [](const Item& i) { return i.first; }, std::less<Item>());
    std::sort(expected.begin(), expected.end());
    CHECK(items == expected);
  }
}
