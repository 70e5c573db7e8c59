// Stability: compares the change of a program's trace under random edits with the cost of
// propagating them.
//
// By Theorem 1.4.4, the work W of change propagation in a concise and monotone program is within a
// constant factor of the distance D between the traces of runs from scratch before and after the
// edit. D itself depends on the program: a table of D beside the figures of the input (its size,
// its spread) shows how.
//
// Example
//   class Sorting : public traces::Subject { ... };
//   Sorting program(1000);
//   for (const auto& row : traces::stability(program, 100)) assert(row.work() <= 8 * row.distance);
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "sac/engine.hpp"
#include "traces/trace.hpp"

namespace traces {

/// A named number.
struct Figure {
  std::string name;
  double value = 0;
};

/// A program that has run on an input of its own.
class Subject {
 public:
  virtual ~Subject() = default;

  /// Makes the next random edit and propagates it.
  struct Edit {
    sac::Counts work;
    std::vector<Figure> figures;  // of the edit and the input, always in the same order
  };
  virtual Edit edit() = 0;
  /// The current trace, with names for the objects that it refers to.
  [[nodiscard]] virtual Trace trace() const = 0;
  /// The trace of a run from scratch on the current input.
  [[nodiscard]] virtual Trace fresh_trace() const = 0;
};

/// The measurements of one edit.
struct StabilityRow {
  std::vector<Figure> figures;
  std::uint64_t distance = 0;         ///< D: before and after the edit
  std::uint64_t weight_distance = 0;  ///< D by weight (traces/distance.hpp)
  std::uint64_t heaviest = 0;         ///< greatest weight of a call that only one of the two has
  sac::Counts counts;                 ///< of the propagation
  /// Distance of the propagated trace and a fresh one: 0 if the engine is correct.
  std::uint64_t drift = 0;

  /// W: the calls created, discarded and executed.
  [[nodiscard]] std::uint64_t work() const noexcept {
    return counts.created + counts.discarded + counts.executed;
  }
  /// W by weight: W plus the weights that the executed bodies reported.
  [[nodiscard]] std::uint64_t weight_work() const noexcept { return work() + counts.weight; }
  /// W / D; W if nothing changed.
  [[nodiscard]] double ratio() const noexcept { return quotient(work(), distance); }
  [[nodiscard]] double weight_ratio() const noexcept {
    return quotient(weight_work(), weight_distance);
  }

 private:
  [[nodiscard]] static double quotient(std::uint64_t w, std::uint64_t d) noexcept {
    return static_cast<double>(w) / static_cast<double>(d == 0 ? 1 : d);
  }
};

/// Options of stability().
struct StabilityOptions {
  /// Whether to compare with runs from scratch; otherwise propagated traces replace theirs, and
  /// drift is not measured.
  bool fresh = true;
  /// Called with each row as soon as it is measured.
  std::function<void(const StabilityRow&)> each;
};

/// Measures `edits` edits and returns a row for each. Throws: std::invalid_argument for a trace
/// that has calls without a name, and exceptions of the program.
/// Cost: for each edit two recordings and two distances, and a run from scratch if `fresh`.
std::vector<StabilityRow> stability(Subject& subject, std::uint64_t edits,
                                    const StabilityOptions& options = {});

}  // namespace traces
