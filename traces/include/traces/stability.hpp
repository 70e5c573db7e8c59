// Stability: what random edits change in a program's trace, beside what propagating them costs.
//
// Theorem 1.4.4 says of a concise and monotone program that the work W of change propagation is
// within a constant factor of the distance D between the traces of runs from scratch before and
// after the edit. What D itself is depends on the program: a table of D beside the figures of the
// input (its size, its spread) shows it.
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
    std::vector<Figure> figures;  // of edit and input, in the same order each time
  };
  virtual Edit edit() = 0;
  /// The trace of now, with names for what it refers to.
  [[nodiscard]] virtual Trace trace() const = 0;
  /// The trace of a run from scratch on the input of now.
  [[nodiscard]] virtual Trace fresh_trace() const = 0;
};

struct StabilityRow {
  std::vector<Figure> figures;
  std::uint64_t distance = 0;         ///< D: before and after the edit
  std::uint64_t weight_distance = 0;  ///< D by weight (traces/distance.hpp)
  std::uint64_t heaviest = 0;         ///< weight of a call of only one of the two, the greatest
  sac::Counts counts;                 ///< of the propagation
  std::uint64_t drift = 0;  ///< of the propagated trace and a fresh one: 0 if the engine is right

  /// W: calls made, let go and run.
  [[nodiscard]] std::uint64_t work() const noexcept {
    return counts.created + counts.discarded + counts.executed;
  }
  /// W by weight: W, and what the bodies that ran said they did inside.
  [[nodiscard]] std::uint64_t weight_work() const noexcept { return work() + counts.weight; }
  /// W / D; where nothing changed, W.
  [[nodiscard]] double ratio() const noexcept { return quotient(work(), distance); }
  [[nodiscard]] double weight_ratio() const noexcept {
    return quotient(weight_work(), weight_distance);
  }

 private:
  [[nodiscard]] static double quotient(std::uint64_t w, std::uint64_t d) noexcept {
    return static_cast<double>(w) / static_cast<double>(d == 0 ? 1 : d);
  }
};

struct StabilityOptions {
  /// Compares with runs from scratch; otherwise propagated traces are taken for theirs, and drift
  /// is not looked for.
  bool fresh = true;
  /// Called with each row as soon as it is there.
  std::function<void(const StabilityRow&)> each;
};

/// A row for each of `edits` edits. Throws: std::invalid_argument for a trace with calls that have
/// no name, and what the program throws.
/// Cost: for each edit two recordings and two distances, and a run from scratch if `fresh`.
std::vector<StabilityRow> stability(Subject& subject, std::uint64_t edits,
                                    const StabilityOptions& options = {});

}  // namespace traces
