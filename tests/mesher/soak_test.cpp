// A mesher that is edited for long takes no more memory, and no more vertices, than a fresh one.
//
// One edit is a random point inserted and a random one removed, as one update. The figures are
// printed; n and the number of edits can be given: SOAK_POINTS, SOAK_EDITS.
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

#include "any_id.hpp"
#include "facade/box_mesher.hpp"
#include "mesher/extra/generate.hpp"

namespace {

using mesher::Point;

std::size_t resident_bytes() {
  std::ifstream file("/proc/self/statm");
  std::size_t total = 0;
  std::size_t resident = 0;
  file >> total >> resident;
  return resident * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

long from_environment(const char* name, long otherwise) {
  const char* text = std::getenv(name);
  return text == nullptr ? otherwise : std::atol(text);
}

double mean(const std::vector<double>& all, std::size_t from, std::size_t to) {
  double sum = 0;
  for (std::size_t i = from; i < to; ++i) sum += all[i];
  return sum / static_cast<double>(to - from);
}

// From the first tenth to the last.
double growth(const std::vector<double>& all) {
  const std::size_t tenth = all.size() / 10;
  return mean(all, all.size() - tenth, all.size()) / mean(all, 0, tenth);
}

// The same of all tenths but the one in which it grows the most and the steps next to that: a table
// doubles once more when it is fuller than ever.
double growth_but_for_a_step(const std::vector<double>& all) {
  const std::size_t tenth = all.size() / 10;
  const auto of = [&](std::size_t t) { return mean(all, t * tenth, (t + 1) * tenth); };
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t t = 1; t + 1 < 10; ++t) {
    least = std::min(least, of(t - 1) / of(0) * of(9) / of(t + 1));
  }
  return least;
}

void soak(std::size_t n, std::size_t edits) {
  mesher::SplitMix64 random(5);
  const auto point = [&] { return Point<2>{random.unit(), random.unit()}; };
  const mesher::Options<2> options{.domain = {{0, 0}, {1, 1}}};
  mesher::BoxMesher<2> m(options);
  std::vector<Point<2>> points(n);
  for (std::size_t i = 0; i < n; ++i) {
    points[i] = point();
    m.insert(AnyId{static_cast<std::int64_t>(i)}, points[i]);
  }
  m.update();
  std::vector<double> trace, resident;
  for (std::size_t k = 0; k < edits; ++k) {
    const std::size_t i = random.below(n);
    points[i] = point();
    m.remove(AnyId{static_cast<std::int64_t>(i)});
    m.insert(AnyId{static_cast<std::int64_t>(i)}, points[i]);
    m.update();
    if (k % (edits / 200) != 0) continue;
    const auto stats = m.stats();  // the mesh's own size goes up and down with the points
    trace.push_back(static_cast<double>(stats.trace_bytes) / static_cast<double>(stats.vertices));
    resident.push_back(static_cast<double>(resident_bytes()));
  }
  const std::size_t tenth = trace.size() / 10;
  for (std::size_t t = 0; t < 10; ++t) {
    std::cout << "n " << n << " tenth " << t + 1 << ": trace a vertex "
              << mean(trace, t * tenth, (t + 1) * tenth) << " resident "
              << mean(resident, t * tenth, (t + 1) * tenth) << std::endl;
  }
  const auto mesh = m.mesh();
  mesher::BoxMesher<2> fresh(options);
  for (std::size_t i = 0; i < n; ++i) fresh.insert(AnyId{static_cast<std::int64_t>(i)}, points[i]);
  fresh.update();
  std::cout << "n " << n << " edits " << edits << ": vertices " << mesh.vertices.size()
            << ", fresh " << fresh.stats().vertices << "; trace " << m.stats().trace_bytes
            << ", fresh " << fresh.stats().trace_bytes << "; growth of trace " << growth(trace)
            << ", but for a step " << growth_but_for_a_step(trace) << ", of resident memory "
            << growth(resident) << std::endl;
  CHECK(growth_but_for_a_step(trace) < 1.0155);  // 1.02 to the 7/9: seven of nine steps in time
  CHECK(growth(resident) < 1.02);
  CHECK(mesh == fresh.mesh());
  CHECK(m.stats().calls == fresh.stats().calls);
  CHECK(m.stats().edges == fresh.stats().edges);
  m.check_invariants();
}

}  // namespace

TEST_CASE("soak: memory stays flat over random insertions and removals, and the mesh a fresh one's",
          "[.soak][soak]") {
  soak(static_cast<std::size_t>(from_environment("SOAK_POINTS", 1000)),
       static_cast<std::size_t>(from_environment("SOAK_EDITS", 100000)));
}

TEST_CASE("soak: the same with ten times the points", "[.soak][soak]") {
  if (std::getenv("SOAK_POINTS") == nullptr) soak(10000, 100000);
}
