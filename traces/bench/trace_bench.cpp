// Recording, loading and comparing traces.
//
//   trace_bench [CALLS]      default 1000000
//
// Two programs of about CALLS calls: a tree of calls with numbers as arguments, and a mapped list,
// two thirds of whose calls are keyed allocations that others refer to. For each, medians of 3
// rounds, one JSON line per figure; memory is what the process held at most, less what it held
// before:
//   engine        bytes of the program's own trace a call
//   record        nanoseconds and bytes of memory a call; bytes of the file a call
//   trace         the same in memory: nanoseconds and bytes a call
//   load          nanoseconds and bytes of memory a call
//   distance      of two equal traces: nanoseconds and bytes of memory a call, beside the traces
//   audit         both audits: nanoseconds a call
//   render        of two equal traces: nanoseconds and bytes of memory a call
#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "bench_help.hpp"
#include "sac/sac.hpp"
#include "traces/audit.hpp"
#include "traces/distance.hpp"
#include "traces/recorder.hpp"
#include "traces/render.hpp"

namespace {

// Bytes of a field of /proc/self/status.
double memory(const std::string& field) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    double kilobytes = 0;
    if (word == field + ":" && status >> kilobytes) return kilobytes * 1024;
  }
  return 0;
}

class Bench {
 public:
  Bench(const char* program, std::uint64_t calls)
      : program_(program), calls_(static_cast<double>(calls)) {}

  void measure(const char* figure, const std::function<void()>& body) const {
    std::vector<double> times, bytes;
    for (int round = 0; round < 3; ++round) {
      malloc_trim(0);
      std::ofstream("/proc/self/clear_refs") << 5;  // forgets the peak
      const double before = memory("VmRSS");
      const auto start = std::chrono::steady_clock::now();
      body();
      const std::chrono::duration<double, std::nano> took =
          std::chrono::steady_clock::now() - start;
      times.push_back(took.count());
      bytes.push_back(std::max(0.0, memory("VmHWM") - before));
    }
    print(figure, "ns_per_call", median(times));
    print(figure, "memory_bytes_per_call", median(bytes));
  }
  void print(const char* figure, const char* unit, double total) const {
    std::printf(
        "{\"bench\":\"trace\",\"program\":\"%s\",\"figure\":\"%s\",\"calls\":%.0f,"
        "\"%s\":%.2f}\n",
        program_, figure, calls_, unit, total / calls_);
  }

 private:
  static double median(std::vector<double> x) {
    std::sort(x.begin(), x.end());
    return x[x.size() / 2];
  }
  const char* program_;
  double calls_;
};

void measure_all(const char* program, const sac::Engine& engine, const traces::Recorder& recorder) {
  const std::string path = "trace_bench." + std::to_string(std::random_device{}()) + ".trace";
  const Bench bench(program, engine.live_calls());
  if (recorder.trace().unnamed != 0) std::abort();
  bench.print("engine", "memory_bytes_per_call", static_cast<double>(engine.bytes()));
  bench.measure("record", [&] { recorder.record(path); });
  bench.print("record", "file_bytes_per_call",
              static_cast<double>(std::filesystem::file_size(path)));
  bench.measure("trace", [&] { static_cast<void>(recorder.trace()); });
  bench.measure("load", [&] { static_cast<void>(traces::load_trace(path)); });
  {
    const traces::Trace trace = recorder.trace();
    bench.measure("distance", [&] {
      if (traces::distance(trace, trace).all.distance() != 0) std::abort();
    });
    bench.measure("audit", [&] {
      if (traces::check_concise(trace).surplus != 0) std::abort();
      if (traces::check_monotone(trace, trace).moved != 0) std::abort();
    });
  }
  bench.measure("render", [&] { static_cast<void>(traces::render_difference(path, path)); });
  std::filesystem::remove(path);
}

// --- A tree ----------------------------------------------------------------------------------

void tree(sac::Scope& s, std::uint64_t first, std::uint64_t last) {
  if (last - first < 2) return;
  const std::uint64_t middle = first + (last - first) / 2;
  s.call<tree>(first, middle);
  s.call<tree>(middle, last);
}

void bench_tree(std::uint64_t calls) {
  sac::Engine engine;
  engine.run<tree>(std::uint64_t{0}, calls / 2);
  measure_all("tree", engine, traces::Recorder(engine));
}

// --- A list ----------------------------------------------------------------------------------

struct Item {
  std::uint64_t id = 0;
  sac::Mod<const Item*> next;
};

void map(sac::Scope& s, sac::Mod<const Item*> in, sac::Mod<const Item*> out) {
  const Item* item = s.read(in);
  if (item == nullptr) return s.write<const Item*>(out, nullptr);
  Item& copy = s.make<Item>("copy", item->id);
  copy.id = ~item->id;
  copy.next = s.cell<const Item*>("next", item->id);
  s.write<const Item*>(out, &copy);
  s.tail<map>(item->next, copy.next);
}

void bench_list(std::uint64_t calls) {
  std::vector<Item> items(calls / 3);
  sac::Engine engine;
  traces::Recorder recorder(engine);
  const Item* next = nullptr;
  for (std::uint64_t i = items.size(); i > 0; --i) {
    Item& item = items[i - 1];
    item = {i, engine.input(next)};
    recorder.name(&item, "item", i);
    recorder.name(item.next, "link", i);
    next = &item;
  }
  const auto head = engine.input(next), out = engine.cell<const Item*>();
  recorder.name(head, "head");
  recorder.name(out, "out");
  engine.run<map>(head, out);
  measure_all("list", engine, recorder);
}

}  // namespace

int main(int argc, char** argv) {
  if (bench::shows_help(argc, argv)) return 0;
  const std::uint64_t calls = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1'000'000;
  bench_tree(calls);
  bench_list(calls);
}
