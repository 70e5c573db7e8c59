// Edits one after the other, each compared with the input before it.
#include "traces/stability.hpp"

#include <stdexcept>
#include <utility>

#include "traces/distance.hpp"

namespace traces {
namespace {

// Hashes of labels without names mean nothing in another run.
Trace named(Trace trace) {
  if (trace.unnamed == 0) return trace;
  throw std::invalid_argument("stability: " + std::to_string(trace.unnamed) + " of " +
                              std::to_string(trace.calls.size()) +
                              " calls have arguments without a name");
}

}  // namespace

std::vector<StabilityRow> stability(Subject& subject, std::uint64_t edits,
                                    const StabilityOptions& options) {
  std::vector<StabilityRow> rows;
  Trace before = named(options.fresh ? subject.fresh_trace() : subject.trace());
  for (std::uint64_t i = 0; i < edits; ++i) {
    StabilityRow row;
    Subject::Edit edit = subject.edit();
    row.counts = edit.work;
    row.figures = std::move(edit.figures);
    Trace after = named(subject.trace());
    if (options.fresh) {
      Trace fresh = named(subject.fresh_trace());
      row.drift = distance(after, fresh).all.distance();
      after = std::move(fresh);
    }
    const CallCounts apart = distance(before, after).all;
    row.distance = apart.distance();
    row.weight_distance = apart.weight_distance;
    row.heaviest = apart.heaviest;
    before = std::move(after);
    if (options.each) options.each(row);
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace traces
