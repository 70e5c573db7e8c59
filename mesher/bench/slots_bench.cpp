// Slots: what it costs to keep them, and to read a change by them beside reading the mesh.
//
//   slots_bench [[3d:]N]...
//
// default: 10000 100000 1000000 3d:10000 3d:100000. Points uniform in the unit square or cube. One
// JSON line per figure, times of the process in microseconds:
//   update   the median of single insertions, and of single removals, of a mesher that keeps slots
//            and of one that does not, of the same points, in turn; the ratio of their sums
//   read     the median to follow a change by slots (a field by vertex slot gets values for what
//   has
//            come, and the corners of new simplices are summed); mesh() and compact(), which any
//            other numbering needs
//   memory   bytes of the arrays, by vertex, and beside the trace; seconds of the first run with
//   and
//            without slots
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <vector>

#include "bench_help.hpp"
#include "facade/box_mesher.hpp"
#include "mesher/extra/generate.hpp"
#include "sample.hpp"

namespace {

using mesher::BoxMesher;
using mesher::Point;
using mesher::PointId;
using mesher::Slot;

template <int D>
Point<D> place(mesher::SplitMix64& random) {
  Point<D> p;
  for (double& x : p) x = random.unit();
  return p;
}

template <int D>
mesher::Options<D> unit_box() {
  mesher::Options<D> options;
  for (std::size_t i = 0; i < D; ++i) options.domain.hi[i] = 1;
  return options;
}

template <int D>
struct Run {
  BoxMesher<D> m{unit_box<D>()};
  double first_seconds = 0;
  std::vector<double> inserts, removes;

  Run(std::size_t n, bool keeps) {
    m.keep_slots(keeps);
    mesher::SplitMix64 random(1);
    std::int64_t id = 0;
    while (m.size() < n) insert(++id, place<D>(random));
    first_seconds = bench::seconds_of([&] { m.update(); });
  }
  // Places that are taken are passed over.
  bool insert(std::int64_t id, const Point<D>& p) {
    try {
      m.insert(PointId{id}, p);
      return true;
    } catch (const mesher::Error&) {
      return false;
    }
  }
  mesher::Change<D> update(std::vector<double>& times) {
    mesher::Change<D> change;
    times.push_back(1e6 * bench::seconds_of([&] { change = m.update(); }));
    return change;
  }
};

double sum(const std::vector<double>& all) {
  double total = 0;
  for (const double x : all) total += x;
  return total;
}

// What a solver does with a change.
template <int D>
struct Solver {
  std::vector<double> field;
  std::vector<double> times;
  std::uint64_t corners = 0;

  void follow(const mesher::LiveMesh<D>& live, const mesher::SlotChange& change) {
    times.push_back(1e6 * bench::seconds_of([&] {
                      for (int again = 0; again < kTimes; ++again) read(live, change);
                    }) /
                    kTimes);
  }

 private:
  static constexpr int kTimes = 100;  // a clock does not tell less
  void read(const mesher::LiveMesh<D>& live, const mesher::SlotChange& change) {
    field.resize(live.vertex_slots());
    for (const Slot v : change.vertices_added) field[v] = live.points()[v][0];
    for (const Slot t : change.simplices_added) {
      for (const Slot v : live.simplices()[t]) corners += v;
    }
    for (const Slot t : change.simplices_removed) corners += live.neighbours()[t][0];
  }
};

template <int D>
void run(std::size_t n) {
  constexpr int kEdits = 400;
  Run<D> with(n, true), without(n, false);
  Solver<D> solver;
  solver.field.reserve(2 * with.m.live().vertex_slots());
  mesher::SplitMix64 random(2);
  for (std::int64_t i = 1; i <= kEdits; ++i) {
    const std::int64_t id = -i;
    const Point<D> p = place<D>(random);
    if (!with.insert(id, p) || !without.insert(id, p)) continue;
    Run<D>& first = i % 2 == 0 ? with : without;
    Run<D>& second = i % 2 == 0 ? without : with;
    const auto read = [&](const Run<D>& of, const mesher::Change<D>& change) {
      if (&of == &with) solver.follow(with.m.live(), change.slots);
    };
    read(first, first.update(first.inserts));
    read(second, second.update(second.inserts));
    first.m.remove(PointId{id});
    second.m.remove(PointId{id});
    read(second, second.update(second.removes));
    read(first, first.update(first.removes));
  }
  const double ratio =
      (sum(with.inserts) + sum(with.removes)) / (sum(without.inserts) + sum(without.removes));
  std::printf(
      "{\"bench\":\"slots\",\"figure\":\"update\",\"dimension\":%d,\"n\":%zu,"
      "\"insert_us\":%.1f,\"insert_without_us\":%.1f,\"remove_us\":%.1f,"
      "\"remove_without_us\":%.1f,\"ratio\":%.4f}\n",
      D, n, bench::quantile(with.inserts, 0.5), bench::quantile(without.inserts, 0.5),
      bench::quantile(with.removes, 0.5), bench::quantile(without.removes, 0.5), ratio);
  const double mesh_us = 1e6 * bench::seconds_of([&] { static_cast<void>(with.m.mesh()); });
  const double compact_us =
      1e6 * bench::seconds_of([&] { static_cast<void>(with.m.live().compact()); });
  std::printf(
      "{\"bench\":\"slots\",\"figure\":\"read\",\"dimension\":%d,\"n\":%zu,"
      "\"read_us\":%.3f,\"p99_us\":%.3f,\"mesh_us\":%.0f,\"compact_us\":%.0f,"
      "\"check\":%llu}\n",
      D, n, bench::quantile(solver.times, 0.5), bench::quantile(solver.times, 0.99), mesh_us,
      compact_us, static_cast<unsigned long long>(solver.corners % 1000));
  const auto stats = with.m.stats();
  const auto bytes = static_cast<double>(with.m.live().bytes());
  std::printf(
      "{\"bench\":\"slots\",\"figure\":\"memory\",\"dimension\":%d,\"n\":%zu,"
      "\"bytes_per_vertex\":%.1f,\"of_trace\":%.4f,\"first_run_s\":%.3f,"
      "\"first_run_without_s\":%.3f}\n",
      D, n, bytes / static_cast<double>(stats.vertices),
      bytes / static_cast<double>(stats.trace_bytes), with.first_seconds, without.first_seconds);
  std::fflush(stdout);
}

void run(std::string_view what) {
  const bool space = what.starts_with("3d:");
  if (space) what.remove_prefix(3);
  const auto n = static_cast<std::size_t>(std::strtoull(what.data(), nullptr, 10));
  space ? run<3>(n) : run<2>(n);
}

}  // namespace

int main(int argc, char** argv) {
  if (bench::shows_help(argc, argv)) return 0;
  const std::vector<std::string_view> defaults{"10000", "100000", "1000000", "3d:10000",
                                               "3d:100000"};
  const std::vector<std::string_view> given(argv + 1, argv + argc);
  for (const auto what : given.empty() ? defaults : given) run(what);
}
