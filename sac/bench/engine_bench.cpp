// The engine alone: reads, calls, and a list map.
//
//   engine_bench [N]         default 1000000
//
// One JSON line per figure, medians of 5 rounds:
//   read      nanoseconds per read in a first run
//   write     nanoseconds per write of a cell of its own in a first run
//   call      nanoseconds per call in a first run
//   post      nanoseconds per call that is posted, put in order and run in a first run
//   list_map  from scratch; one insertion or deletion; bytes per element
//   write_among_readers  a write that comes or goes among n readers, 10 of them behind it
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "bench_help.hpp"
#include "bench_support.hpp"
#include "sac/sac.hpp"

namespace {

using bench::median;
using bench::nanoseconds;

void print(const char* figure, std::size_t n, const char* unit, double value) {
  std::printf("{\"bench\":\"engine\",\"figure\":\"%s\",\"n\":%zu,\"%s\":%.2f}\n", figure, n, unit,
              value);
}

// --- Calls and reads -------------------------------------------------------------------------

struct Nothing {
  static constexpr std::string_view kName = "nothing";
  void operator()(sac::Scope&, std::uint64_t) const {}
};
inline constexpr Nothing nothing{};

struct ManyCalls {
  static constexpr std::string_view kName = "many_calls";
  void operator()(sac::Scope& s, std::uint64_t n) const {
    for (std::uint64_t i = 0; i < n; ++i) s.call<nothing>(i);
  }
};
inline constexpr ManyCalls many_calls{};

struct ManyReads {
  static constexpr std::string_view kName = "many_reads";
  void operator()(sac::Scope& s, const std::vector<sac::Mod<std::uint64_t>>* mods) const {
    std::uint64_t sum = 0;
    for (const auto m : *mods) sum += s.read(m);
    bench::sink = sum;
  }
};
inline constexpr ManyReads many_reads{};

struct ManyWrites {
  static constexpr std::string_view kName = "many_writes";
  void operator()(sac::Scope& s, const std::vector<sac::Mod<std::uint64_t>>* mods) const {
    std::uint64_t i = 0;
    for (const auto m : *mods) s.write(m, i++);
  }
};
inline constexpr ManyWrites many_writes{};

struct ManyPosts {
  static constexpr std::string_view kName = "many_posts";
  void operator()(sac::Scope& s, sac::Agenda* agenda, std::uint64_t n) const {
    for (std::uint64_t i = 0; i < n; ++i) {
      agenda->post<nothing>(s, {.bucket = static_cast<int>(i % 16)}, sac::mix(i));
    }
    agenda->drain(s);
  }
};
inline constexpr ManyPosts many_posts{};

void bench_calls(std::size_t n) {
  std::vector<double> calls, reads, writes, posts;
  double bytes = 0;
  for (int round = 0; round < 5; ++round) {
    sac::Engine e;
    const std::size_t before = e.bytes();
    calls.push_back(nanoseconds([&] { e.run<many_calls>(std::uint64_t{n}); }));
    bytes = static_cast<double>(e.bytes() - before) / static_cast<double>(n);
    sac::Engine f;
    std::vector<sac::Mod<std::uint64_t>> mods;
    for (std::size_t i = 0; i < n; ++i) mods.push_back(f.input<std::uint64_t>(i));
    const auto* all = &mods;
    reads.push_back(nanoseconds([&] { f.run<many_reads>(all); }));
    sac::Engine g;
    for (auto& m : mods) m = g.cell<std::uint64_t>();
    writes.push_back(nanoseconds([&] { g.run<many_writes>(all); }));
    sac::Engine h;
    sac::Agenda* const agenda = &h.make_agenda("nothings");
    posts.push_back(nanoseconds([&] { h.run<many_posts>(agenda, std::uint64_t{n}); }));
  }
  print("call", n, "ns", median(calls) / static_cast<double>(n));
  print("call", n, "bytes_with_argument", bytes);
  print("read", n, "ns", median(reads) / static_cast<double>(n));
  print("write", n, "ns", median(writes) / static_cast<double>(n));
  print("post", n, "ns", median(posts) / static_cast<double>(n));
}

// --- A list map ------------------------------------------------------------------------------

struct Node {
  std::uint64_t value = 0;
  sac::Mod<Node*> next;
};

struct MapList {
  static constexpr std::string_view kName = "map_list";
  void operator()(sac::Scope& s, sac::Mod<Node*> in, sac::Mod<Node*> out) const;
};
inline constexpr MapList map_list{};

void MapList::operator()(sac::Scope& s, sac::Mod<Node*> in, sac::Mod<Node*> out) const {
  const Node* cell = s.read(in);
  if (cell == nullptr) return s.write(out, static_cast<Node*>(nullptr));
  Node& copy = s.make<Node>(cell);
  copy.value = cell->value / 3 + cell->value / 7 + cell->value / 9;
  copy.next = s.cell<Node*>(cell);
  s.write(out, &copy);
  s.tail<map_list>(cell->next, copy.next);
}

void bench_list_map(std::size_t n) {
  sac::Engine e;
  std::vector<Node> nodes(n);
  for (std::size_t i = n; i-- > 0;) {
    nodes[i].value = sac::mix(i);
    nodes[i].next = e.input<Node*>(i + 1 < n ? &nodes[i + 1] : nullptr);
  }
  const auto head = e.input<Node*>(&nodes[0]);
  const auto out = e.cell<Node*>();
  const std::size_t before = e.bytes();
  const double scratch = nanoseconds([&] { e.run<map_list>(head, out); });
  print("list_map_from_scratch", n, "ms", scratch / 1e6);
  print("list_map", n, "bytes_per_element",
        static_cast<double>(e.bytes() - before) / static_cast<double>(n));
  bench::Random r;
  std::vector<double> updates;
  for (int k = 0; k < 20000; ++k) {
    Node& at = nodes[r.next() % (n - 2)];
    Node* const next = e.get(at.next);
    if (next == nullptr) continue;
    updates.push_back(nanoseconds([&] {  // take one element out
      e.set(at.next, e.get(next->next));
      e.propagate();
    }));
    updates.push_back(nanoseconds([&] {  // and put it back
      e.set(at.next, next);
      e.propagate();
    }));
  }
  print("list_map_update", n, "us", median(updates) / 1e3);
}

// --- A modifiable with many readers and few writers -------------------------------------------

struct Step {
  static constexpr std::string_view kName = "step";
  void operator()(sac::Scope& s, sac::Mod<int> value, sac::Mod<int> among) const {
    if (const int v = s.read(value); v >= 0) s.write(among, v);
    bench::sink = static_cast<std::uint64_t>(s.read(among));
  }
};
inline constexpr Step step{};

struct ManySteps {
  static constexpr std::string_view kName = "many_steps";
  void operator()(sac::Scope& s, const std::vector<sac::Mod<int>>* values,
                  sac::Mod<int> among) const {
    for (const auto value : *values) s.call<step>(value, among);
  }
};
inline constexpr ManySteps many_steps{};

void bench_write_among_readers(std::size_t n) {
  sac::Engine e;
  std::vector<sac::Mod<int>> values;
  for (std::size_t i = 0; i < n; ++i) values.push_back(e.input(i == 0 ? 0 : -1));
  const auto* all = &values;
  e.run<many_steps>(all, e.cell<int>());
  std::vector<double> updates;
  for (int k = 0; k < 2000; ++k) {
    e.set(values[n - 10], k % 2 == 0 ? 1 + k : -1);
    updates.push_back(nanoseconds([&] { e.propagate(); }));
  }
  print("write_among_readers", n, "us", median(updates) / 1e3);
}

}  // namespace

int main(int argc, char** argv) {
  if (bench::shows_help(argc, argv)) return 0;
  const std::size_t n = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1000000;
  bench_calls(n);
  bench_list_map(n);
  for (const std::size_t readers : {std::size_t{1000}, n / 10, n}) {
    bench_write_among_readers(readers);
  }
}
