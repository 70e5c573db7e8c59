// How an example (sac/examples) is measured: from scratch and under edits.
//
// One JSON line per figure. Times from scratch are medians of 3 runs, in processor time, as is the
// mean of the updates; their median and 99th percentile are in real time, of all updates:
//   baseline       ms of ordinary C++ on ordinary data
//   plain          ms of the same program text on sac::PlainScope
//   from_scratch   ms of the traced run
//   overhead       from_scratch / plain
//   bytes          bytes of trace and values per element, without the inputs
//   update_median, update_mean, update_p99    us per edit and propagation
//   reexecuted, created, discarded, reused    calls, mean per update
//   work           the sum of the first three
//   speedup        baseline / mean update
// Results are compared with the baseline's, before and after the edits.
#pragma once

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <type_traits>
#include <vector>

#include "bench_support.hpp"
#include "sac/sac.hpp"

namespace bench {

struct IntRandom : Random {
  /// 0 .. n - 1
  int operator()(int n) { return static_cast<int>(below(static_cast<std::size_t>(n))); }
};

template <class Host>
using ScopeOf = std::conditional_t<std::is_same_v<Host, sac::Engine>, sac::Scope, sac::PlainScope>;

inline void require_equal(const char* example, std::uint64_t a, std::uint64_t b) {
  if (a == b) return;
  std::fprintf(stderr, "%s: results differ\n", example);
  std::exit(1);
}

/// An Example has
///   static constexpr const char* kName;
///   struct Input { explicit Input(int n); std::uint64_t baseline() const; };
///   template <class Host> struct World {
///     World(Host&, const Input&);
///     void run();
///     std::uint64_t result();
///     void edit(Input&, IntRandom&);    // of both; does not propagate
///   };
template <class Example>
void measure(int n, int updates) {
  const auto out = [&](const char* figure, double value) {
    std::printf("{\"bench\":\"examples\",\"example\":\"%s\",\"n\":%d,\"%s\":%.2f}\n",
                Example::kName, n, figure, value);
    std::fflush(stdout);
  };
  typename Example::Input input(n);
  std::vector<double> baseline, plain, traced;
  std::uint64_t expected = 0;
  for (int round = 0; round < 3; ++round) {
    baseline.push_back(cpu_nanoseconds([&] { expected = input.baseline(); }));
    sac::PlainScope scope;
    typename Example::template World<sac::PlainScope> world(scope, input);
    plain.push_back(cpu_nanoseconds([&] { world.run(); }));
    require_equal(Example::kName, world.result(), expected);
  }
  for (int round = 0; round < 2; ++round) {
    sac::Engine engine;
    typename Example::template World<sac::Engine> world(engine, input);
    traced.push_back(cpu_nanoseconds([&] { world.run(); }));
  }
  sac::Engine engine;
  typename Example::template World<sac::Engine> world(engine, input);
  engine.propagate();  // the edits are final: what would undo them goes
  const std::size_t before = engine.bytes();
  traced.push_back(cpu_nanoseconds([&] { world.run(); }));
  require_equal(Example::kName, world.result(), expected);
  const double base = median(baseline);
  out("baseline", base / 1e6);
  out("plain", median(plain) / 1e6);
  out("from_scratch", median(traced) / 1e6);
  out("overhead", median(traced) / median(plain));
  out("bytes", static_cast<double>(engine.bytes() - before) / n);
  IntRandom random;
  std::vector<double> times;
  sac::Counts sum;
  const double total = cpu_nanoseconds([&] {
    for (int i = 0; i < updates; ++i) {
      sac::Counts counts;
      times.push_back(nanoseconds([&] {
        world.edit(input, random);
        counts = engine.propagate();
      }));
      sum.executed += counts.executed;
      sum.created += counts.created;
      sum.discarded += counts.discarded;
      sum.reused += counts.reused;
    }
  });
  const double mean = total / updates;
  require_equal(Example::kName, world.result(), input.baseline());
  const auto per_update = [&](std::uint64_t calls) { return static_cast<double>(calls) / updates; };
  out("update_median", median(times) / 1e3);
  out("update_mean", mean / 1e3);
  out("update_p99", quantile(times, 0.99) / 1e3);
  out("reexecuted", per_update(sum.executed - sum.created));
  out("created", per_update(sum.created));
  out("discarded", per_update(sum.discarded));
  out("reused", per_update(sum.reused));
  out("work", per_update(sum.executed + sum.discarded));
  out("speedup", base / mean);
}

/// The arguments of a benchmark of examples: [SCALE [EXAMPLE]].
class Selection {
 public:
  Selection(int argc, char** argv)
      : scale_(argc > 1 ? std::strtod(argv[1], nullptr) : 1), only_(argc > 2 ? argv[2] : "") {}

  /// Measures the example, if its name starts with EXAMPLE, with SCALE * n elements.
  template <class Example>
  void run(int n, int updates) const {
    if (!std::string_view(Example::kName).starts_with(only_)) return;
    measure<Example>(static_cast<int>(n * scale_), updates);
  }

 private:
  double scale_;
  std::string_view only_;
};

}  // namespace bench
