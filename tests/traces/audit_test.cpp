#include "traces/audit.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <numeric>
#include <random>
#include <vector>

#include "programs.hpp"
#include "scratch_file.hpp"

namespace {

using support::ScratchFolder;

traces::Trace visits(const ScratchFolder& folder, const std::string& text) {
  programs::record_visits(text, folder.path(text));
  return traces::load_trace(folder.path(text));
}

traces::Trace trace_of(const std::vector<int>& labels) {
  traces::Trace trace;
  trace.functions = {"f"};
  for (const int label : labels) trace.calls.push_back({{1, static_cast<std::uint64_t>(label)}, 0});
  return trace;
}

// Quadratic twin of check_monotone(...).moved for labels that occur once.
std::size_t moved_by_definition(const std::vector<int>& a, const std::vector<int>& b) {
  std::vector<std::size_t> place, best;
  for (const int label : a) {
    const auto it = std::find(b.begin(), b.end(), label);
    if (it != b.end()) place.push_back(static_cast<std::size_t>(it - b.begin()));
  }
  for (std::size_t i = 0; i < place.size(); ++i) {
    best.push_back(1);
    for (std::size_t j = 0; j < i; ++j) {
      if (place[j] < place[i]) best[i] = std::max(best[i], best[j] + 1);
    }
  }
  return place.size() - (best.empty() ? 0 : *std::max_element(best.begin(), best.end()));
}

}  // namespace

TEST_CASE("A mapped list is concise, and monotone under an insertion") {
  ScratchFolder folder;
  programs::ListMap({5, 1, 4, 2}).record(folder.path("a"));
  programs::ListMap({5, 1, 3, 4, 2}, 10).record(folder.path("b"));
  const auto a = traces::load_trace(folder.path("a")), b = traces::load_trace(folder.path("b"));
  CHECK(traces::check_concise(a).surplus == 0);
  CHECK(traces::check_concise(b).surplus == 0);
  const auto monotone = traces::check_monotone(a, b);
  CHECK(monotone.common == a.calls.size() - 1);  // one reads another item
  CHECK(monotone.moved == 0);
  CHECK_FALSE(monotone.first);
}

TEST_CASE("A program that visits a digit twice is not concise, and the labels are shown") {
  ScratchFolder folder;
  const auto result = traces::check_concise(visits(folder, "2717"));
  CHECK(result.surplus == 1);
  REQUIRE(result.repetitions.size() == 1);
  const auto& r = result.repetitions[0];
  CHECK(r.first == 2);
  CHECK(r.second == 4);
  CHECK(r.times == 2);
  CHECK(traces::labels_at(folder.path("2717"), {r.second, r.first, 1}) ==
        std::vector<std::string>{"visit(7)", "visit(7)", "visit(2)"});
}

TEST_CASE("A program that visits in the order of its input is not monotone, and a pair is shown") {
  ScratchFolder folder;
  const auto result = traces::check_monotone(visits(folder, "1234"), visits(folder, "1423"));
  CHECK(result.common == 4);
  CHECK(result.moved == 1);
  REQUIRE(result.first);
  CHECK(traces::labels_at(folder.path("1234"), {result.first->left.a, result.first->right.a}) ==
        std::vector<std::string>{"visit(3)", "visit(4)"});
  CHECK(traces::labels_at(folder.path("1423"), {result.first->left.b, result.first->right.b}) ==
        std::vector<std::string>{"visit(3)", "visit(4)"});
}

TEST_CASE("Equal hashes of two functions of one name are not the same label within a trace") {
  traces::Trace trace = trace_of({1, 1});
  trace.functions.push_back("f");
  trace.calls[1].function = 1;
  CHECK(traces::check_concise(trace).surplus == 0);
}

TEST_CASE("Moved calls are those outside a longest common order") {
  const unsigned seed = std::random_device{}();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  for (int round = 0; round < 300; ++round) {
    std::vector<int> a(random() % 20), b(random() % 20);
    std::iota(a.begin(), a.end(), 0);
    std::iota(b.begin(), b.end(), static_cast<int>(random() % 8));
    for (auto swaps = random() % 4; swaps > 0 && !b.empty(); --swaps) {
      std::swap(b[random() % b.size()], b[random() % b.size()]);
    }
    const auto result = traces::check_monotone(trace_of(a), trace_of(b));
    REQUIRE(result.moved == moved_by_definition(a, b));
    REQUIRE(result.first.has_value() == (result.moved > 0));
    if (!result.first) continue;
    const auto& [left, right] = *result.first;
    REQUIRE(left.a < right.a);
    REQUIRE(right.b < left.b);
    REQUIRE(a[left.a] == b[left.b]);
    REQUIRE(a[right.a] == b[right.b]);
  }
}
