// Engine::memory() says what the process has: held() against resident memory.
//
// Each program runs in a child process, so that what other tests have left behind does not count.
#include <malloc.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <catch2/catch.hpp>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <vector>

#include "list_map.hpp"
#include "sac/internal/platform.hpp"
#include "sac/sac.hpp"

// Sanitizers have memory of their own.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

namespace {

using sac::Engine;
using sac::Mod;
using sac::Scope;

// Without pages of files, such as the code that runs. What the allocator keeps of freed blocks is
// given back first.
double resident_bytes() {
  malloc_trim(0);
  long pages = 0, resident = 0, of_files = 0;
  std::FILE* const file = std::fopen("/proc/self/statm", "r");
  if (file == nullptr) return 0;
  if (std::fscanf(file, "%ld %ld %ld", &pages, &resident, &of_files) != 3) resident = of_files;
  std::fclose(file);
  return static_cast<double>(resident - of_files) * static_cast<double>(sysconf(_SC_PAGESIZE));
}

struct Sample {
  double held = 0;
  double resident = 0;
};
// After the run; after shrink(); with a tenth of the input; after shrink() again.
using Samples = std::array<Sample, 4>;

// A program is made with its inputs, run(), and reduced to a tenth by reduce().
template <class Program>
Samples measure_here() {
  const auto engine_bytes = [](const Engine& e) { return static_cast<double>(e.memory().held()); };
  Program program;
  const double before = resident_bytes();
  Engine e;
  program.start(e);
  Samples samples;
  const auto take = [&](std::size_t i) {
    samples[i] = {engine_bytes(e), resident_bytes() - before};
  };
  take(0);
  e.shrink();
  take(1);
  program.reduce(e);
  take(2);
  e.shrink();
  take(3);
  return samples;
}

// The same in a child process; zeros if that fails.
template <class Program>
Samples measure() {
  Samples samples{};
  int ends[2];
  REQUIRE(pipe(ends) == 0);
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    try {
      samples = measure_here<Program>();
    } catch (...) {
    }
    const auto written = write(ends[1], &samples, sizeof samples);
    _exit(written == static_cast<ssize_t>(sizeof samples) ? 0 : 1);
  }
  close(ends[1]);
  CHECK(read(ends[0], &samples, sizeof samples) == static_cast<ssize_t>(sizeof samples));
  close(ends[0]);
  int status = 1;
  waitpid(child, &status, 0);
  CHECK(status == 0);
  return samples;
}

template <class Program>
void check_memory() {
  const Samples samples = measure<Program>();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    CAPTURE(i, samples[i].held, samples[i].resident);
    CHECK(samples[i].held > 0);
    CHECK(samples[i].resident < 1.1 * samples[i].held);
    CHECK(samples[i].resident > 0.9 * samples[i].held);
  }
  if (sac::platform::kReturnsPages) CHECK(samples[3].held < 0.2 * samples[0].held);
}

// --- A list of 10^6 elements, mapped -------------------------------------------------------------

struct MappedList {
  using Node = examples::Node<Scope>;
  static constexpr std::size_t kSize = 1'000'000;
  std::vector<Node*> nodes = std::vector<Node*>(kSize);

  void start(Engine& e) {
    for (std::size_t i = 0; i < kSize; ++i) {
      nodes[i] = &e.make<Node>();
      nodes[i]->element = {static_cast<int>(i), static_cast<std::uint32_t>(i)};
      e.set(nodes[i]->next, nullptr);
      if (i > 0) e.set(nodes[i - 1]->next, nodes[i]);
    }
    e.propagate();  // the edits are final
    e.run<examples::map_list>(static_cast<const Node*>(nodes[0]), e.cell<const Node*>());
  }
  void reduce(Engine& e) {
    e.set(nodes[kSize / 10]->next, nullptr);
    for (std::size_t i = kSize / 10 + 1; i < kSize; ++i) e.release(*nodes[i]);
    e.propagate();
  }
};

TEST_CASE("memory held is memory resident: a mapped list of 10^6 elements") {
  check_memory<MappedList>();
}

// --- Posted calls --------------------------------------------------------------------------------

struct Posts {
  sac::Agenda* agenda = nullptr;
  Mod<int> size;

  void start(Engine& e);
  void reduce(Engine& e) {
    e.set(size, e.get(size) / 10);
    e.propagate();
  }
};

sac::Key key(int n) { return {.bucket = n / 1000, .order = static_cast<std::uint64_t>(n)}; }
void visit(Scope& s, int n) {
  const auto& posts = s.environment<Posts>();
  s.write(s.cell<int>(n), n);
  for (const int child : {2 * n + 1, 2 * n + 2}) {
    if (child < s.read(posts.size)) posts.agenda->post<visit>(s, key(child), child);
  }
}
void search(Scope& s) {
  auto& agenda = *s.environment<Posts>().agenda;
  agenda.post<visit>(s, key(0), 0);
  agenda.drain(s);
}
void Posts::start(Engine& e) {
  agenda = &e.make_agenda("visits");
  size = e.input(400'000);
  e.set_environment(this);
  e.run<search>();
}

TEST_CASE("memory held is memory resident: posted calls") { check_memory<Posts>(); }

// --- Modifiables that are written many times -----------------------------------------------------

struct Rewrites {
  static constexpr int kMods = 1000;
  std::vector<Mod<int>> mods = std::vector<Mod<int>>(kMods);
  Mod<int> steps;

  void start(Engine& e);
  void reduce(Engine& e) {
    e.set(steps, e.get(steps) / 10);
    e.propagate();
  }
};

void rewrite(Scope& s, int step) {
  auto& program = s.environment<Rewrites>();
  if (step >= s.read(program.steps)) return;
  const auto mod = program.mods[static_cast<std::size_t>(step * 7 % Rewrites::kMods)];
  s.write(mod, step < Rewrites::kMods ? step : s.read(mod) + 1);
  s.tail<rewrite>(step + 1);
}
void Rewrites::start(Engine& e) {
  for (auto& mod : mods) mod = e.cell<int>();
  steps = e.input(300'000);
  e.set_environment(this);
  e.run<rewrite>(0);
}

TEST_CASE("memory held is memory resident: modifiables written 300 times each") {
  check_memory<Rewrites>();
}

TEST_CASE("shrink gives the order of versions and readers back that are no more") {
  Rewrites program;
  Engine e;
  program.start(e);
  const std::size_t before = e.memory().versions;
  e.set(program.steps, 10);
  e.propagate();
  e.shrink();
  CHECK(e.memory().versions < 100);
  e.check_invariants();
  e.set(program.steps, 300'000);
  e.propagate();
  CHECK(e.memory().versions <= before);
  CHECK(e.get(program.mods[0]) == 299);
  e.check_invariants();
}

}  // namespace

#endif
