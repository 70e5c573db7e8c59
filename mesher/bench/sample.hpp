// What benchmarks of updates share: times, their quantiles, and the work beside them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <ctime>
#include <string>
#include <vector>

#include "facade/box_mesher.hpp"

namespace bench {

/// Of the process: on a machine that does other things as well they say more than a clock's.
template <class Run>
double seconds_of(Run&& run) {
  const std::clock_t start = std::clock();
  run();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

/// The value that is above a share q of all. Requires: there are some.
inline double quantile(std::vector<double> all, double q) {
  std::sort(all.begin(), all.end());
  return all[static_cast<std::size_t>(q * static_cast<double>(all.size() - 1))];
}

/// Updates of one kind.
class Sample {
 public:
  /// Times m.update(), of a mesher of either kind.
  template <class Mesher>
  auto update(Mesher& m) {
    decltype(m.update()) change;
    const double seconds = seconds_of([&] { change = m.update(); });
    microseconds_.push_back(1e6 * seconds);
    executed_ += static_cast<double>(change.calls.executed);
    vertices_ += static_cast<double>(change.vertices_added.size() + change.vertices_removed.size());
    return change;
  }
  [[nodiscard]] std::size_t size() const { return microseconds_.size(); }
  [[nodiscard]] double total_seconds() const {
    double sum = 0;
    for (const double x : microseconds_) sum += x;
    return 1e-6 * sum;
  }
  /// A line of JSON; `more`: further members, with a comma in front.
  void print(const char* bench, const std::string& input, const std::string& figure,
             const std::string& more = {}) const {
    const auto k = static_cast<double>(size());
    std::printf(
        "{\"bench\":\"%s\",\"input\":\"%s\",\"figure\":\"%s\",\"updates\":%zu,"
        "\"median_us\":%.1f,\"p99_us\":%.1f,\"calls_executed\":%.1f,\"vertices\":%.2f%s}\n",
        bench, input.c_str(), figure.c_str(), size(), quantile(microseconds_, 0.5),
        quantile(microseconds_, 0.99), executed_ / k, vertices_ / k, more.c_str());
    std::fflush(stdout);
  }

 private:
  std::vector<double> microseconds_;
  double executed_ = 0, vertices_ = 0;
};

}  // namespace bench
