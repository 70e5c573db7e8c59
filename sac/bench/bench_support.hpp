// What the benchmarks share: a clock, medians, random numbers, memory in use.
#pragma once

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <utility>
#include <vector>

#include "sac/label.hpp"

namespace bench {

/// Processor time that body() takes; resolves microseconds. What else runs does not count.
template <class Body>
double cpu_nanoseconds(Body&& body) {
  const auto now = [] {
    timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) * 1e9 + static_cast<double>(t.tv_nsec);
  };
  const double start = now();
  body();
  return now() - start;
}

/// Wall time that body() takes; for short ones.
template <class Body>
double nanoseconds(Body&& body) {
  const auto start = std::chrono::steady_clock::now();
  body();
  const auto end = std::chrono::steady_clock::now();
  return std::chrono::duration<double, std::nano>(end - start).count();
}

/// The value below which a part `q` of the sample lies. Requires: not empty, 0 <= q < 1.
inline double quantile(std::vector<double> sample, double q) {
  const auto at =
      sample.begin() + static_cast<std::ptrdiff_t>(q * static_cast<double>(sample.size()));
  std::nth_element(sample.begin(), at, sample.end());
  return *at;
}
inline double median(std::vector<double> sample) { return quantile(std::move(sample), 0.5); }

struct Random {
  std::uint64_t state = 1;
  std::uint64_t next() { return sac::mix(state += 0x9e3779b97f4a7c15u); }
  /// 0 .. n - 1
  std::size_t below(std::size_t n) { return next() % n; }
};

/// Bytes of the process that are in memory.
inline double resident_bytes() {
  long pages = 0, resident = 0;
  if (std::FILE* file = std::fopen("/proc/self/statm", "r")) {
    if (std::fscanf(file, "%ld %ld", &pages, &resident) != 2) resident = 0;
    std::fclose(file);
  }
  return static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE));
}

/// Keeps the compiler from leaving out what it computes.
inline volatile std::uint64_t sink;

}  // namespace bench
