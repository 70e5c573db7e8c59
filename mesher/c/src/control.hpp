// Runs that can be watched and stopped.
#pragma once

#include "livemesh.h"
#include "mesher/meshing.hpp"

namespace lm {

/// What the caller wants of a run; null: nothing. The timeout begins now.
/// Throws: Failure (LM_BAD_SIZE, LM_BAD_ARGUMENT, LM_BAD_HANDLE), Error(cancelled) if it is stopped
/// already.
[[nodiscard]] mesher::RunControl control_of(const lm_control* control);

}  // namespace lm
