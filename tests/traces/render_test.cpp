#include "traces/render.hpp"

#include <catch2/catch.hpp>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "icicle.hpp"
#include "programs.hpp"
#include "scratch_file.hpp"
#include "svg.hpp"
#include "traces/trace_file.hpp"

namespace {

using support::ScratchFolder;
using traces::Bar;

constexpr traces::Layout kLayout{600, 40};

// Calls of one function with these depths; a negative depth is that of a tail call.
traces::Trace trace_of(const std::vector<int>& depths) {
  traces::Trace trace;
  trace.functions = {"f"};
  std::uint64_t label = 0;
  for (const int depth : depths) {
    trace.calls.push_back(
        {{1, ++label}, 0, static_cast<std::uint32_t>(std::abs(depth)), depth < 0 ? 1u : 0u});
  }
  return trace;
}

traces::Trace random_trace(std::mt19937& random, std::size_t size) {
  std::vector<int> depths;
  int depth = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const bool tail = depth > 0 && random() % 3 == 0;
    depths.push_back(tail ? -depth : depth);
    depth = static_cast<int>(random() % static_cast<unsigned>(depth + 2));
  }
  return trace_of(depths);
}

std::vector<std::uint32_t> random_calls(std::mt19937& random, const traces::Trace& trace) {
  std::vector<std::uint32_t> calls;
  const unsigned rarity = 1 + random() % 20;
  for (std::uint32_t i = 0; i < trace.calls.size(); ++i) {
    if (random() % rarity == 0) calls.push_back(i);
  }
  return calls;
}

// Bars of a row do not overlap, and none sticks out of those above it.
void require_nested(const std::vector<Bar>& bars) {
  for (const Bar& bar : bars) {
    REQUIRE(bar.begin >= -1e-9);
    REQUIRE(bar.end <= kLayout.width + 1e-6);
    REQUIRE(bar.begin < bar.end);
    if (bar.row == 0 || bar.row >= kLayout.rows) continue;
    double covered = 0;
    for (const Bar& other : bars) {
      const double common = std::min(bar.end, other.end) - std::max(bar.begin, other.begin);
      if (other.row == bar.row && &other != &bar) REQUIRE(common < 1e-6);
      if (other.row == bar.row - 1 && common > 0) covered += common;
    }
    const double gaps = bar.kind == Bar::Kind::column ? 2 : 0;  // a column spans them
    REQUIRE(covered == Approx(bar.end - bar.begin).margin(gaps));
  }
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

// Every element that opens closes, in order; no text holds a bare '<' or '&'.
void require_well_formed(const std::string& svg) {
  std::vector<std::string> open;
  for (std::size_t at = 0; (at = svg.find('<', at)) != std::string::npos; ++at) {
    const std::size_t end = svg.find('>', at);
    REQUIRE(end != std::string::npos);
    const std::string tag = svg.substr(at + 1, end - at - 1);
    REQUIRE(tag.find('<') == std::string::npos);
    if (tag.back() == '/') continue;
    const std::string name = tag.substr(0, tag.find(' '));
    if (name[0] != '/') {
      open.push_back(name);
    } else {
      REQUIRE(!open.empty());
      REQUIRE("/" + open.back() == name);
      open.pop_back();
    }
  }
  CHECK(open.empty());
  for (std::size_t at = 0; (at = svg.find('&', at)) != std::string::npos; ++at) {
    const std::string entity = svg.substr(at, svg.find(';', at) - at);
    REQUIRE((entity == "&amp" || entity == "&lt" || entity == "&gt"));
  }
}

void record_lists(const ScratchFolder& folder) {
  programs::ListMap({1, 2, 4, 5}).record(folder.path("a"));
  programs::ListMap({1, 2, 3, 4, 5}).record(folder.path("b"));
}

}  // namespace

TEST_CASE("A tail call stands in the row of the call that it continues") {
  CHECK(traces::rows_of(trace_of({0, 1, -1, 2, -2, 1, 0, -1})) ==
        std::vector<std::uint32_t>{0, 1, 0, 1, 0, 1, 0, 0});
}

TEST_CASE("Bars are as wide as their calls, and lie below their callers") {
  const auto bars = traces::lay_out_whole(trace_of({0, 1, 2, 1, 0, 1}), {}, kLayout);
  std::vector<std::vector<double>> places(6);
  for (const Bar& bar : bars) {
    CHECK(bar.kind == Bar::Kind::call);
    places[bar.first] = {static_cast<double>(bar.row), bar.begin, bar.end,
                         static_cast<double>(bar.calls)};
  }
  CHECK(places == std::vector<std::vector<double>>{{0, 0, 400, 4},
                                                   {1, 100, 300, 2},
                                                   {2, 200, 300, 1},
                                                   {1, 300, 400, 1},
                                                   {0, 400, 600, 2},
                                                   {1, 500, 600, 1}});
}

TEST_CASE("Every call is drawn once, alone or in a column, whatever the tree") {
  const unsigned seed = std::random_device{}();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  for (int round = 0; round < 60; ++round) {
    const auto trace = random_trace(random, 1 + random() % (round % 2 == 0 ? 60 : 3000));
    const auto changed = random_calls(random, trace);
    const auto bars = traces::lay_out_whole(trace, changed, kLayout);
    require_nested(bars);
    std::uint64_t calls = 0;
    for (const Bar& bar : bars) {
      calls += bar.kind == Bar::Kind::call ? 1 : bar.calls;
      std::uint64_t shares = 0;
      for (const Bar::Share& share : bar.shares) shares += share.calls;
      if (bar.kind == Bar::Kind::column) REQUIRE(shares == bar.calls);
    }
    REQUIRE(calls == trace.calls.size());
  }
}

TEST_CASE("The blame region shows the changed calls and their ancestors, and folds the rest") {
  const unsigned seed = std::random_device{}();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  for (int round = 0; round < 60; ++round) {
    const auto trace = random_trace(random, 1 + random() % 40);
    const auto changed = random_calls(random, trace);
    const auto rows = traces::rows_of(trace);
    const auto bars = traces::lay_out_changed(trace, changed, kLayout);
    require_nested(bars);
    std::vector<std::uint32_t> shown, marked;
    std::uint64_t folded = 0;
    for (const Bar& bar : bars) {
      REQUIRE(bar.kind != Bar::Kind::column);
      if (bar.kind == Bar::Kind::fold) folded += bar.calls;
      if (bar.kind != Bar::Kind::call) continue;
      shown.push_back(bar.first);
      if (bar.changed) marked.push_back(bar.first);
      // A changed call lies in the bar, itself or one below it.
      bool wanted = false;
      for (const std::uint32_t call : changed) {
        bool below = call >= bar.first;
        for (std::uint32_t i = bar.first + 1; i <= call && below; ++i) {
          below = rows[i] > rows[bar.first];
        }
        wanted = wanted || below;
      }
      REQUIRE(wanted);
    }
    std::sort(marked.begin(), marked.end());
    REQUIRE(marked == changed);
    REQUIRE(shown.size() + folded == (changed.empty() ? folded : trace.calls.size()));
  }
}

TEST_CASE("What is deeper than the rows of the picture shares one row") {
  std::vector<int> chain(100);
  for (int i = 0; i < 100; ++i) chain[static_cast<std::size_t>(i)] = i;
  const auto bars = traces::lay_out_whole(trace_of(chain), {}, {600, 10});
  std::size_t deep = 0;
  for (const Bar& bar : bars) {
    REQUIRE(bar.row <= 10);
    if (bar.row == 10) ++deep;
  }
  CHECK(deep == 90);
}

TEST_CASE("A picture has the labels, the functions and their calls") {
  ScratchFolder folder;
  record_lists(folder);
  const std::string svg = traces::render(folder.path("a"));
  require_well_formed(svg);
  CHECK(svg.find("<title>a: 13 calls</title>") != std::string::npos);
  CHECK(svg.find(">make Item 4<") != std::string::npos);
  CHECK(svg.find(">map 5<") != std::string::npos);
  CHECK(svg.find("<title>make Item(copy, 4)\ncall ") != std::string::npos);
  CHECK(svg == traces::render(folder.path("a")));
}

TEST_CASE("A picture of two traces shows what only one has, and folds what both have") {
  ScratchFolder folder;
  record_lists(folder);
  const std::string svg = traces::render_difference(folder.path("a"), folder.path("b"));
  require_well_formed(svg);
  CHECK(svg.find("<title>a and b: distance 5</title>") != std::string::npos);
  CHECK(svg.find("Only in a:") != std::string::npos);
  CHECK(svg.find("Only in b:") != std::string::npos);
  CHECK(svg.find(">make Item(copy, 3)</text>") != std::string::npos);
  CHECK(count(svg, "calls that both traces have</title>") > 0);
  CHECK(count(svg, "fill=\"black\"") == 1 + 4);  // marks
  const std::string same = traces::render_difference(folder.path("a"), folder.path("a"));
  CHECK(same.find("distance 0") != std::string::npos);
  CHECK(same.find("Only in a:") == std::string::npos);
  CHECK(count(same, "fill=\"black\"") == 0);
}

TEST_CASE("There are no more bars than pixels, however many calls and whatever their tree") {
  std::mt19937 random(1);
  for (const std::size_t calls : {1000, 100000}) {
    const auto trace = random_trace(random, calls);
    std::vector<std::size_t> in_row(kLayout.rows + 1);
    for (const Bar& bar : traces::lay_out_whole(trace, random_calls(random, trace), kLayout)) {
      ++in_row[bar.row];
    }
    for (const std::size_t bars : in_row) CHECK(bars <= 600);
  }
}

TEST_CASE("The size of a picture does not follow that of the trace") {
  ScratchFolder folder;
  traces::TraceWriter writer(folder.path("t"));
  writer.add_function("root");
  writer.add_function("left");
  writer.add_function("right");
  writer.add_call({0, 0, {1, 1}, true, "", false});
  for (std::uint32_t i = 0; i < 300000; ++i) {
    writer.add_call({1, 1 + i % 2, {2, i}, true, std::to_string(i), false});
  }
  writer.finish();
  const std::string svg = traces::render(folder.path("t"));
  require_well_formed(svg);
  CHECK(svg.size() < 250000);
  CHECK(svg.find("300 001 calls") != std::string::npos);
}

TEST_CASE("Any bytes in a file make a well-formed picture") {
  ScratchFolder folder;
  traces::TraceWriter writer(folder.path("t"));
  writer.add_function("<&>\"\x01");
  writer.add_call({0, 0, {1, 1}, true, "\xff\xc3\xa9\xc3 ]]> </title>", false});
  writer.finish();
  const std::string svg = traces::render(folder.path("t"));
  require_well_formed(svg);
  CHECK(svg.find("&lt;&amp;&gt;\"?(?\xc3\xa9? ]]&gt; &lt;/title&gt;)") != std::string::npos);
}

TEST_CASE("A trace without calls has a picture") {
  ScratchFolder folder;
  traces::TraceWriter(folder.path("t")).finish();
  const std::string svg = traces::render(folder.path("t"));
  require_well_formed(svg);
  CHECK(svg.find("no calls") != std::string::npos);
  require_well_formed(traces::render_difference(folder.path("t"), folder.path("t")));
}

TEST_CASE("Texts are cut to whole letters, and numbers grouped") {
  CHECK(traces::fitted("abcdef", 6 * traces::Svg::kLetter) == "abcdef");
  CHECK(traces::fitted("abcdef", 5 * traces::Svg::kLetter) == "abc..");
  CHECK(traces::fitted("\xc3\xa9\xc3\xa9\xc3\xa9\xc3\xa9", 3 * traces::Svg::kLetter) ==
        "\xc3\xa9..");
  CHECK(traces::fitted("abcdef", 2 * traces::Svg::kLetter).empty());
  CHECK(traces::grouped(0) == "0");
  CHECK(traces::grouped(123456) == "123 456");
  CHECK(traces::grouped(1234567) == "1 234 567");
}
