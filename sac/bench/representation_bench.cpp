// How to represent a call and an edge of the trace: four candidates, measured. No engine needed.
//
// A  pointers, separate time stamps    call 40 B + args, stamp 32 B, edge 40 B (the CEAL way)
// B  handles, embedded time stamps     call 48 B + args, stamp 16 B, edge 24 B
// C  pointers, embedded time stamps    call 72 B + args, stamp 32 B, edge 48 B (B's fields)
// D  B through a table of 2 MiB chunks instead of one reserved range
//
// A handle is a 32-bit index of an 8-byte granule: address = base + 8 * handle, 0 is null.
// Every candidate has the same pool (64 KiB slabs per size, free lists), the same two-level
// timeline and the same chained memo table; they differ in their records and in `at` alone.
// A call has 8 bytes of args, reads mod i and writes mod i + 1, one edge each.
//
//   g++ -std=c++20 -O3 -ffp-contract=off representation_bench.cpp -o representation_bench
//   ./representation_bench [--huge] [n ...]      default n: 100000 1000000
//
// Prints one JSON line per figure: median, least and greatest of 5 rounds, process CPU time; a
// round runs the candidates in turn. `--huge` asks the kernel for 2 MiB pages. What the figures
// mean for the engine: sac/docs/representation.md.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "representation_records.hpp"
#include "representation_trace.hpp"

namespace {

using namespace representation;

constexpr int kRounds = 5;
constexpr std::size_t kOperations = 500'000;

struct Workload {
  std::size_t n;
  std::string shape;
  std::vector<char> enters;                                    // 2n, see Trace::run
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;  // 2 * kOperations of call indices
};

void enter_tree(std::vector<char>& enters, std::size_t n) {
  if (n == 0) return;
  enters.push_back(true);
  enter_tree(enters, (n - 1) / 2);
  enter_tree(enters, n - 1 - (n - 1) / 2);
  enters.push_back(false);
}

/// leaves: no call has a child; tree: binary, half have; chain: all have, as in a tail loop.
Workload make_workload(std::size_t n, std::string_view shape) {
  Workload w{n, std::string(shape), {}, {}};
  if (shape == "tree") enter_tree(w.enters, n);
  for (std::size_t i = 0; shape != "tree" && i < 2 * n; ++i)
    w.enters.push_back(shape == "chain" ? i < n : i % 2 == 0);
  for (std::uint64_t i = 1; i <= 2 * kOperations; ++i) {
    const std::uint64_t r = mixed(i * 0x9e3779b97f4a7c15);
    w.pairs.emplace_back((r >> 32) % n, (r & 0xffffffff) % n);
  }
  return w;
}

double cpu_ns() {
  timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return 1e9 * static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_nsec);
}

/// (figure, unit, candidate) -> one value per round
using Samples = std::map<std::tuple<std::string, std::string, char>, std::vector<double>>;

template <class R>
class Round {
 public:
  Round(char candidate, const Workload& w, bool huge, Samples& samples)
      : candidate_(candidate), w_(w), pool_(huge), samples_(samples) {}

  /// Returns a checksum of every answer, equal for all candidates.
  std::uint64_t measure() {
    first_run("first_run", true);
    pool_.rewind();
    first_run("first_run_without_memo_touched_pages", false);
    pool_.rewind();
    first_run("first_run_touched_pages", true);
    account();
    queries("");
    timed("discard_recreate", kOperations, "ns", [&] {
      for (std::size_t i = 0; i < kOperations; ++i) {
        CallRef& c = calls_[w_.pairs[i].first];
        c = trace_->recreate(c);
      }
    });
    queries("_aged");
    return sum_;
  }

 private:
  using CallRef = typename Trace<R>::CallRef;

  template <class Body>
  void timed(const std::string& figure, std::size_t operations, const char* unit, Body body) {
    const double begin = cpu_ns();
    body();
    note(figure, unit, (cpu_ns() - begin) / static_cast<double>(operations));
  }
  void note(const std::string& figure, const char* unit, double value) {
    samples_[{figure, unit, candidate_}].push_back(value);
  }

  void first_run(const char* figure, bool memo) {
    trace_ = std::make_unique<Trace<R>>(pool_, w_.n + 1, memo);
    before_ = pool_.live_bytes();
    timed(figure, w_.n, "ns", [&] { calls_ = trace_->run(w_.enters); });
  }
  void account() {
    const double n = static_cast<double>(w_.n);
    note("bytes_per_call_with_two_edges", "B",
         static_cast<double>(pool_.live_bytes() - before_) / n);
    note("memo_bytes_per_call", "B", static_cast<double>(trace_->memo_bytes()) / n);
  }

  void queries(const std::string& suffix) {
    std::vector<std::pair<CallRef, CallRef>> pairs;
    for (auto [a, b] : w_.pairs) pairs.emplace_back(calls_[a], calls_[b]);
    timed("compare" + suffix, kOperations, "ns", [&] {
      for (std::size_t i = 0; i < kOperations; ++i)
        sum_ += trace_->precedes(pairs[i].first, pairs[i].second);
    });
    timed("compare_dependent" + suffix, kOperations, "ns", [&] {
      for (std::size_t i = 0, at = 0; i < kOperations; ++i)  // at < 2 * kOperations
        sum_ += at += trace_->precedes(pairs[at].first, pairs[at].second) + i % 2;
    });
    timed("walk_edges" + suffix, kOperations, "ns", [&] {
      for (std::size_t i = 0; i < kOperations; ++i)
        sum_ += trace_->sum_of_neighbours(pairs[i].first);
    });
    timed("walk_later" + suffix, kOperations, "ns", [&] {
      for (std::size_t i = 0; i < kOperations; ++i)
        sum_ += trace_->sum_of_later_neighbours(pairs[i].first);
    });
  }

  char candidate_;
  const Workload& w_;
  Pool<typename R::Address> pool_;
  Samples& samples_;
  std::unique_ptr<Trace<R>> trace_;
  std::vector<CallRef> calls_;
  std::size_t before_ = 0;
  std::uint64_t sum_ = 0;
};

void run_round(const Workload& w, bool huge, Samples& samples) {
  const std::uint64_t a = Round<Separate>('A', w, huge, samples).measure();
  const std::uint64_t b = Round<Embedded<RangeHandles>>('B', w, huge, samples).measure();
  const std::uint64_t c = Round<Wide>('C', w, huge, samples).measure();
  const std::uint64_t d = Round<Embedded<ChunkHandles>>('D', w, huge, samples).measure();
  if (a != b || a != c || a != d) throw std::logic_error("the candidates disagree");
}

void print(const Workload& w, bool huge, Samples& samples) {
  for (auto& [key, values] : samples) {
    const auto& [figure, unit, candidate] = key;
    std::sort(values.begin(), values.end());
    std::printf(
        "{\"bench\":\"representation\",\"figure\":\"%s\",\"candidate\":\"%c\","
        "\"shape\":\"%s\",\"n\":%zu,\"huge_pages\":%s,\"unit\":\"%s\","
        "\"median\":%.2f,\"min\":%.2f,\"max\":%.2f}\n",
        figure.c_str(), candidate, w.shape.c_str(), w.n, huge ? "true" : "false", unit.c_str(),
        values[values.size() / 2], values.front(), values.back());
  }
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  bool huge = false;
  std::vector<std::size_t> sizes;
  for (const std::string_view arg : std::vector<std::string_view>(argv + 1, argv + argc))
    if (arg == "--huge")
      huge = true;
    else
      sizes.push_back(std::strtoull(arg.data(), nullptr, 10));
  if (sizes.empty()) sizes = {100'000, 1'000'000};
  for (const std::size_t n : sizes)
    for (const char* shape : {"leaves", "tree", "chain"}) {
      const Workload w = make_workload(n, shape);
      Samples samples;
      for (int i = 0; i < kRounds; ++i) run_round(w, huge, samples);
      print(w, huge, samples);
    }
}
