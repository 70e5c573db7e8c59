// Points that ranks announce in equal shares: what each takes before the calls of the first run,
// and until its end.
//
//   mpirun -n P ranks_bench [2|3]:N...
//
// Uniform points; default 2:1000000 3:200000. One JSON line per figure, of the rank with the most:
//   before   seconds by the clock, and bytes of memory, from points announced until the first call
//            in tiles; bytes of the process before, with the points announced
//   first    seconds of the first update, bytes of memory at its end; calls, and bytes of the
//   trace,
//            of all ranks
//   moves    microseconds of an update that moves a point anywhere, the median and the 99th
//            percentile of 200
#include <mpi.h>
#include <sys/resource.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "bench_help.hpp"
#include "mesher/extra/generate.hpp"
#include "mesher/mpi.hpp"

namespace {

int rank = 0, ranks = 1;

std::uint64_t memory() {
  struct rusage usage {};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}
double most(double value) {
  MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
  return value;
}
double percentile(std::vector<double> all, double share) {
  std::sort(all.begin(), all.end());
  return all[static_cast<std::size_t>(share * static_cast<double>(all.size() - 1))];
}

// A place that all ranks know.
template <int D>
mesher::Point<D> place(mesher::SplitMix64& random) {
  mesher::Point<D> p;
  for (double& x : p) x = random.unit();
  return p;
}

template <int D>
void run(std::uint64_t n) {
  mesher::Options<D> options;
  options.domain.hi.fill(1);
  mesher::MpiMesher<D> m(MPI_COMM_WORLD, options);
  const auto share = static_cast<std::uint64_t>(rank);
  for (std::uint64_t i = share; i < n; i += static_cast<std::uint64_t>(ranks)) {
    mesher::SplitMix64 random(i);
    m.insert(mesher::PointId{static_cast<std::int64_t>(i + 1)}, place<D>(random));
  }
  const double announced = most(static_cast<double>(memory()));
  const double start = MPI_Wtime();
  double seconds = 0, bytes = 0;
  mesher::RunControl control;
  control.progress = [&](const mesher::Progress&) {
    if (seconds == 0) seconds = MPI_Wtime() - start, bytes = static_cast<double>(memory());
    return true;
  };
  m.update(control, mesher::Told::own);
  const double all = most(MPI_Wtime() - start), end = most(static_cast<double>(memory()));
  seconds = most(seconds), bytes = most(bytes);
  const mesher::MeshStats stats = m.stats();
  std::vector<double> moves;
  mesher::SplitMix64 random(1);
  for (std::uint64_t i = 0; i < 200; ++i) {
    const mesher::PointId id{static_cast<std::int64_t>(1 + random.below(n))};
    const mesher::Point<D> to = place<D>(random);
    if (static_cast<int>(i) % ranks == rank) m.move(id, to);
    const double from = MPI_Wtime();
    m.update({}, mesher::Told::own);
    moves.push_back(1e6 * most(MPI_Wtime() - from));
  }
  if (rank != 0) return;
  const auto line = [&](const char* figure) {
    std::printf(
        "{\"bench\":\"ranks\",\"dimension\":%d,\"points\":%llu,\"ranks\":%d,\"figure\":\"%s\"", D,
        static_cast<unsigned long long>(n), ranks, figure);
  };
  line("before");
  std::printf(",\"seconds\":%.3f,\"bytes\":%.0f,\"bytes_announced\":%.0f}\n", seconds, bytes,
              announced);
  line("first");
  std::printf(",\"seconds\":%.3f,\"bytes\":%.0f,\"calls\":%llu,\"trace_bytes\":%llu}\n", all, end,
              static_cast<unsigned long long>(stats.calls),
              static_cast<unsigned long long>(stats.trace_bytes));
  line("moves");
  std::printf(",\"microseconds\":%.0f,\"microseconds_p99\":%.0f}\n", percentile(moves, 0.5),
              percentile(moves, 0.99));
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  if (bench::shows_help(argc, argv)) return 0;
  int level = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &level);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  std::vector<std::string> cases(argv + 1, argv + argc);
  if (cases.empty()) cases = {"2:1000000", "3:200000"};
  for (const std::string& one : cases) {
    const std::uint64_t n = std::strtoull(one.c_str() + 2, nullptr, 10);
    one[0] == '3' ? run<3>(n) : run<2>(n);
  }
  MPI_Finalize();
}
