// Reports the progress of a run to the caller, and stops it on request.
#pragma once

#include <algorithm>
#include <cstdint>

#include "mesher/mesher.hpp"
#include "program/world.hpp"

namespace mesher::detail {

[[nodiscard]] inline bool watches(const RunControl& control) {
  return control.progress != nullptr || control.stop.stop_possible();
}

/// Throws: Error(cancelled).
[[noreturn]] void fail_cancelled();

/// Throws: Error(cancelled) if somebody has asked to stop.
inline void require_unstopped(const RunControl& control) {
  if (control.stop.stop_requested()) fail_cancelled();
}

/// False if the run shall stop. Throws: what control.progress throws.
[[nodiscard]] inline bool report(const RunControl& control, const Progress& progress) {
  if (control.stop.stop_requested()) return false;
  return control.progress == nullptr || control.progress(progress);
}

/// The phases of a first or static run.
template <class S, int D = 2>
class RunMeter {
 public:
  /// `points`: how many there are to locate.
  RunMeter(const World<S, D>& world, const RunControl& control, std::size_t points)
      : world_(world), control_(control), progress_{.of = points} {}

  /// `calls` have run in all; false if the run shall stop.
  [[nodiscard]] bool operator()(std::uint64_t calls) {
    while (progress_.phase != Phase::triangulate && ended(progress_.phase)) begin_next(calls);
    progress_.done = calls - calls_before_;
    if (progress_.of != 0) progress_.of = std::max(progress_.of, progress_.done);
    return report(control_, progress_);
  }
  /// The same at the end of a run in which vertices were triangulated without calls.
  [[nodiscard]] bool end(std::uint64_t calls) {
    while (progress_.phase != Phase::triangulate) begin_next(calls);
    progress_.done = progress_.of;
    return report(control_, progress_);
  }

 private:
  // Refine sets a mark where a phase ends.
  [[nodiscard]] bool ended(Phase phase) const {
    return world_.marks[static_cast<std::size_t>(phase) + 1].time_since_epoch().count() != 0;
  }
  void begin_next(std::uint64_t calls) {
    progress_.phase = static_cast<Phase>(static_cast<int>(progress_.phase) + 1);
    calls_before_ = calls;
    progress_.of = 0;
    if (progress_.phase != Phase::triangulate) return;
    world_.vertices.pool().for_each([&](const Vertex<D>&) { ++progress_.of; });
  }

  const World<S, D>& world_;
  const RunControl& control_;
  Progress progress_;
  std::uint64_t calls_before_ = 0;
};

}  // namespace mesher::detail
