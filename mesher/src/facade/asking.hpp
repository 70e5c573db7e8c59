// Asking the caller whether to go on, while no calls run that would.
#pragma once

#include <functional>

#include "program/meter.hpp"
#include "sac/engine.hpp"

namespace mesher::detail {

/// As the engine does, so that what was announced stays.
[[noreturn]] inline void fail_stopped() { throw sac::Cancelled(); }

/// Reports that this phase has begun, as often as it is called; if the run shall stop it calls
/// `fail`, which throws. `control` must outlive it. Throws: also what control.progress throws.
[[nodiscard]] inline std::function<void()> asking(const RunControl& control, Phase phase,
                                                  void (*fail)()) {
  return [&control, phase, fail] {
    if (!report(control, {.phase = phase})) fail();
  };
}

}  // namespace mesher::detail
